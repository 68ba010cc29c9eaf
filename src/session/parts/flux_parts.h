// SPDX-License-Identifier: Apache-2.0
// Fluxes in parts: what a process traces of them, kept, and what all have kept, told again.
// in: a measurement -> out: light of a part; in: all parts -> out: the measurement of one process.
// docs/farm.md, "Fluxes"
#pragma once
#include "src/run/work_share.h"
#include "src/session/parts/parts.h"

namespace pileus {

/// Keeps the numbers of its own share, in the order in which they are asked for. What else is
/// measured on the way is of no use.
class KeptShare : public WorkShare {
public:
    explicit KeptShare(const WorkPart& part) : part_(part) {}
    WorkPart part() const override { return part_; }
    Status sum(Span<std::int64_t> values) override;
    Status gather(Span<double> values, std::uint64_t width) override;
    Status decide(std::uint64_t&) override { return Status::ok(); }
    /// All of it. kLimit: out of memory.
    Status take(PartLight& light) const;

private:
    WorkPart part_;
    std::vector<std::int64_t> sums_;
    std::vector<double> rows_;
};

/// Traces nothing: numbers are those that sorted parts have kept. kBadInput: they have kept others.
class ToldShare : public WorkShare {
public:
    explicit ToldShare(const std::vector<Part>& parts) : parts_(parts) {}
    WorkPart part() const override;
    Status sum(Span<std::int64_t> values) override;
    Status gather(Span<double> values, std::uint64_t width) override;
    Status decide(std::uint64_t&) override { return Status::ok(); }
    /// Whether all that was kept has been told.
    Status end() const;

private:
    const std::vector<Part>& parts_;
    std::uint64_t sums_ = 0;
    std::vector<std::uint64_t> rows_;
};

}  // namespace pileus
