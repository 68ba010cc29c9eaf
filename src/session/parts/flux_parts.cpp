// SPDX-License-Identifier: Apache-2.0
// See flux_parts.h.
#include "src/session/parts/flux_parts.h"

#include <cstring>

namespace pileus {
namespace {

Status other(const Part& part) {
    return Status::bad_input(part.name +
                             ": part: of another measurement, allowed: the same options");
}

}  // namespace

Status KeptShare::sum(Span<std::int64_t> values) {
    sums_.insert(sums_.end(), values.data, values.data + values.size);
    return Status::ok();
}

Status KeptShare::gather(Span<double> values, std::uint64_t width) {
    each_owned_run(values.size, width, part_, [&](const PartRange& own) {
        rows_.insert(rows_.end(), values.data + own.begin, values.data + own.end);
    });
    return Status::ok();
}

Status KeptShare::take(PartLight& light) const {
    PILEUS_TRY(light.sums.resize(sums_.size(), "light of a part"));
    PILEUS_TRY(light.rows.resize(rows_.size(), "light of a part"));
    if (!sums_.empty()) std::memcpy(light.sums.data(), sums_.data(), light.sums.bytes());
    if (!rows_.empty()) std::memcpy(light.rows.data(), rows_.data(), light.rows.bytes());
    return Status::ok();
}

WorkPart ToldShare::part() const {
    const std::uint32_t count = parts_[0].part.count;
    return {count, count, true};
}

Status ToldShare::sum(Span<std::int64_t> values) {
    for (const Part& part : parts_) {
        if (part.light.sums.size() < sums_ + values.size) return other(part);
        for (std::size_t i = 0; i < values.size; ++i)
            if (__builtin_add_overflow(values.data[i], part.light.sums[std::size_t(sums_) + i],
                                       &values.data[i]))
                return other(part);
    }
    sums_ += values.size;
    return Status::ok();
}

Status ToldShare::gather(Span<double> values, std::uint64_t width) {
    rows_.resize(parts_.size(), 0);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const auto& rows = parts_[p].light.rows;
        bool enough = true;
        each_owned_run(values.size, width, parts_[p].part, [&](const PartRange& own) {
            const std::uint64_t count = own.end - own.begin;
            enough = enough && rows.size() >= rows_[p] + count;
            if (!enough) return;
            std::memcpy(values.data + own.begin, rows.data() + rows_[p],
                        std::size_t(count) * sizeof(double));
            rows_[p] += count;
        });
        if (!enough) return other(parts_[p]);
    }
    return Status::ok();
}

Status ToldShare::end() const {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const std::uint64_t rows = p < rows_.size() ? rows_[p] : 0;
        if (parts_[p].light.sums.size() != sums_ || parts_[p].light.rows.size() != rows)
            return other(parts_[p]);
    }
    return Status::ok();
}

}  // namespace pileus
