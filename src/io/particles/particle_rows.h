// SPDX-License-Identifier: Apache-2.0
// Rows of numbers, by the names of their columns, as particles.
// in: each row twice, first to measure, then to keep -> out: a ParticleSet, or one line.
// docs/formats.md, "Particles".
#pragma once
#include <string>
#include <vector>

#include "src/base/span.h"
#include "src/base/status.h"
#include "src/io/particles/particle_file.h"

namespace pileus {

class ParticleRows {
public:
    /// `file` opens the lines of faults.
    ParticleRows(const std::string& file, ParticleSet& set) : file_(file), set_(set) {}

    /// Finds the columns; takes memory for `count` particles. No place, no radius, a name that
    /// stands twice: kBadInput; too many: kLimit.
    Status begin(const std::vector<ParticleColumn>& columns, std::uint64_t count,
                 const ParticleReading& reading);
    /// Looks at a row, so that the origin does not depend on the order of rows.
    Status measure(std::uint64_t particle, Span<const double> row);
    /// Between the two: the origin.
    void measured();
    Status keep(std::uint64_t particle, Span<const double> row);

private:
    struct Column {
        int at = -1;  ///< -1: none
        double scale = 1;
    };
    static constexpr int kRoles = 15;

    /// Every so many rows; `from` is 0 while rows are measured, then a half.
    void tell(double from, std::uint64_t particle) const {
        constexpr std::uint64_t kRowsUntold = std::uint64_t{1} << 18;
        if (particle % kRowsUntold == 0 && progress_)
            progress_(from + 0.5 * double(particle) / double(set_.count));
    }
    Status fault(std::uint64_t particle, int role, double value) const;
    double number(int role, Span<const double> row) const {
        return row[std::size_t(columns_[role].at)] * columns_[role].scale;
    }
    double radius_of(Span<const double> row) const {
        return columns_[kRadius].at >= 0 && radius_ == 0 ? number(kRadius, row) : radius_;
    }

    enum Role {
        kX,
        kY,
        kZ,
        kRadius,
        kDensity,
        kRed,
        kGreen,
        kBlue,
        kId,
        kSpeedX,
        kSpeedY,
        kSpeedZ,
        kGlowRed,
        kGlowGreen,
        kGlowBlue
    };

    const std::string& file_;
    ParticleSet& set_;
    Column columns_[kRoles];
    double radius_ = 0;
    std::function<void(double share)> progress_;
};

// What readers of other programs' attributes share: names, limits, numbers in bytes.

constexpr std::uint64_t kMaxAttributes = 256;         ///< of a particle
constexpr std::uint64_t kMaxAttributeNumbers = 1024;  ///< of all of a particle's together

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
