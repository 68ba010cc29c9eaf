// SPDX-License-Identifier: Apache-2.0
// See film_parts.h.
#include "src/methods/path/film_parts.h"

#include <cstring>

namespace pileus {
namespace {

constexpr std::size_t kTallyWords = sizeof(PathTally) / sizeof(std::int64_t);

std::uint64_t planes_of(const Film& film) {
    const std::uint64_t pixels = film.pixels();
    return pixels > 0 ? (film.sum.size() + film.square.size()) / pixels : 0;
}

void add_rows(const double* from, const std::vector<int>& lines, std::size_t width, double* plane) {
    for (const int y : lines) {
        double* to = plane + std::size_t(y) * width;
        for (std::size_t x = 0; x < width; ++x) to[x] += from[x];
        from += width;
    }
}

}  // namespace

Status share_film(WorkShare& share, Film& film) {
    for (Buffer<double>* sums : {&film.sum, &film.square})
        for (std::size_t at = 0; at < sums->size(); at += film.pixels())
            PILEUS_TRY(share.gather({sums->data() + at, film.pixels()}, std::uint64_t(film.width)));
    // Each has counted its own since the last time; the first keeps what all have.
    PathTally all = film.tally;
    PILEUS_TRY(share.sum({reinterpret_cast<std::int64_t*>(&all), kTallyWords}));
    const WorkPart part = share.part();
    film.tally = part.is_first() || part.index >= part.count ? all : PathTally{};
    return Status::ok();
}

Status take_film(const Film& film, PartLight& light) {
    if (film.ahead > 0)
        return Status::bad_input("part: its last pass is not whole, allowed: to let it finish");
    light.same = {std::uint64_t(film.width), std::uint64_t(film.parts), planes_of(film),
                  film.samples};
    light.first = {film.samples};
    PILEUS_TRY(light.sums.resize(kTallyWords, "light of a part"));
    std::memcpy(light.sums.data(), &film.tally, sizeof film.tally);
    const std::size_t sums = film.sum.size();
    PILEUS_TRY(light.rows.resize(sums + film.square.size(), "light of a part"));
    if (sums > 0) std::memcpy(light.rows.data(), film.sum.data(), sums * sizeof(double));
    if (!film.square.empty())
        std::memcpy(light.rows.data() + sums, film.square.data(),
                    film.square.size() * sizeof(double));
    return Status::ok();
}

Status add_film(const PartLight& light, const std::vector<int>& lines, bool counts, Film& film) {
    const std::size_t width = std::size_t(film.width), own = width * lines.size();
    const std::uint64_t planes = planes_of(film);
    const bool alike = light.same.size() == 4 && light.first.size() == 1 &&
                       light.same[0] == width && light.same[1] == std::uint64_t(film.parts) &&
                       light.same[2] == planes && light.sums.size() == kTallyWords &&
                       light.rows.size() == planes * own;
    if (!alike) return Status::bad_input("of another picture, allowed: parts of one work");
    PathTally tally;
    std::memcpy(&tally, light.sums.data(), sizeof tally);
    add_tally(tally, film.tally);
    const std::size_t kept = film.sum.size() / film.pixels();
    for (std::size_t p = 0; p < planes; ++p) {
        double* plane = p < kept ? film.sum.data() + p * film.pixels()
                                 : film.square.data() + (p - kept) * film.pixels();
        add_rows(light.rows.data() + p * own, lines, width, plane);
    }
    if (counts) film.samples += light.first[0];
    return Status::ok();
}

}  // namespace pileus
