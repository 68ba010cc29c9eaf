// SPDX-License-Identifier: Apache-2.0
// What readers of other programs' attributes share: names, limits, numbers in bytes.
// in: attributes by name and size, rows of numbers -> out: a ParticleSet, or one line.
// docs/particles.md, "Files".
#pragma once
#include <string>
#include <vector>

#include "src/io/particles/particle_rows.h"

namespace pileus {

constexpr std::uint64_t kMostAttributes = 256;         ///< of a particle
constexpr std::uint64_t kMostAttributeNumbers = 1024;  ///< of all of a particle's together

/// Columns of a particle's numbers in their order; those that mean nothing here have no name.
class ParticleAttributes {
public:
    /// What is wrong with an attribute of so many numbers; empty: nothing, and it has its columns.
    std::string add(const std::string& name, std::uint64_t size);
    const std::vector<ParticleColumn>& columns() const { return columns_; }
    std::uint64_t numbers() const { return columns_.size(); }

private:
    std::vector<ParticleColumn> columns_;
    std::uint64_t attributes_ = 0;
};

/// Reads `count` rows twice, each by `fill(particle, numbers)`, which begins anew at particle 0.
template <class Fill>
Status read_particle_rows(const std::string& file, const ParticleAttributes& attributes,
                          std::uint64_t count, const ParticleReading& reading, ParticleSet& set,
                          Fill fill) {
    ParticleRows rows(file, set);
    PILEUS_TRY(rows.begin(attributes.columns(), count, reading));
    std::vector<double> row(attributes.numbers());
    const Span<const double> numbers{row.data(), row.size()};
    for (std::uint64_t i = 0; i < count; ++i) {
        PILEUS_TRY(fill(i, row));
        PILEUS_TRY(rows.measure(i, numbers));
    }
    rows.measured();
    for (std::uint64_t i = 0; i < count; ++i) {
        PILEUS_TRY(fill(i, row));
        PILEUS_TRY(rows.keep(i, numbers));
    }
    return Status::ok();
}

/// A number of 4 bytes, a float or a whole one with a sign.
double attribute_number(const unsigned char* from, bool big_endian, bool floats);

}  // namespace pileus
