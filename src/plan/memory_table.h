// SPDX-License-Identifier: Apache-2.0
// Which array lives in which stages, and how many bytes live at once.
// in: rows (item, first stage, last stage, bytes) -> out: bytes per stage and their peak.
// docs/report.md, "Memory".
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pileus {

/// In the order in which a picture walks through them.
enum class Stage : std::size_t {
    kDensity,
    kSamples,
    kTree,
    kCollectors,
    kLeafGrid,
    kMajorants,
    kPhotons,
    kPaths,
    kReconstruct,
    kBackground,
    kShadow,
    kSplat,
    kDisplay,
    kLayers,
    kWrite,
    kCount
};
constexpr std::size_t kStageCount = std::size_t(Stage::kCount);

/// "density", "samples", ... as the report names them.
const char* stage_name(Stage stage);

struct MemoryRow {
    std::string item;
    Stage first = Stage::kDensity, last = Stage::kWrite;
    std::uint64_t bytes = 0;
};

class MemoryTable {
public:
    /// Adds an array that lives from the start of `first` to the end of `last`. A row without
    /// bytes is kept out: what is not there is not listed.
    void add(const char* item, Stage first, Stage last, std::uint64_t bytes) {
        if (bytes > 0) rows_.push_back({item, first, last, bytes});
    }
    const std::vector<MemoryRow>& rows() const { return rows_; }
    std::uint64_t live(Stage stage) const;
    Stage peak_stage() const;
    std::uint64_t peak() const { return live(peak_stage()); }

private:
    std::vector<MemoryRow> rows_;
};

/// a * b * c for sizes that may be bounds of anything: the largest number instead of a wrong one.
std::uint64_t bytes_of(std::uint64_t a, std::uint64_t b, std::uint64_t c = 1);

/// a + b, likewise.
std::uint64_t sum_of_bytes(std::uint64_t a, std::uint64_t b);

}  // namespace pileus
