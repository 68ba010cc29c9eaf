// SPDX-License-Identifier: Apache-2.0
// Photons in parts: each has a share of every generation, and sums are whole numbers.
// in: slots of a still picture -> out: light of a part; in: that -> out: slots.
// docs/farm.md
#include <cstring>

#include "src/photons/photon_report.h"
#include "src/run/work_share.h"

namespace pileus {
namespace {

/// What a plan proves of one work; works of several seeds may be more.
constexpr std::int64_t kMax = std::int64_t{1} << 62;
constexpr std::size_t kTallyWords = sizeof(TraceTally) / sizeof(std::int64_t);

std::uint64_t bits_of(double v) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    return bits;
}

/// What must be alike: sizes, and what a photon stands for in each slot.
std::vector<std::uint64_t> likeness(const PhotonRing& ring) {
    const Photons& photons = ring.photons;
    std::vector<std::uint64_t> same{photons.slots.size(), photons.tallies.size()};
    for (const PhotonSlot& slot : photons.slots) {
        same.push_back(slot.sums.size());
        for (const double flux : slot.flux_per_photon_m2) same.push_back(bits_of(flux));
        for (const float v : slot.sun_travel) same.push_back(bits_of(double(v)));
    }
    return same;
}

std::uint64_t words_of(const Photons& photons) {
    std::uint64_t words = photons.tallies.size() * kTallyWords;
    for (const PhotonSlot& slot : photons.slots) words += 1 + slot.sums.size();
    return words;
}

}  // namespace

Status PhotonReport::take_light(PartLight& light) {
    const PhotonRing& ring = photons_.photons().ring;
    const Photons& photons = ring.photons;
    light.same = likeness(ring);
    light.first = {ring.next_generation};
    for (const PhotonSlot& slot : photons.slots) light.first.push_back(slot.generations);
    PILEUS_TRY(light.sums.resize(words_of(photons), "light of a part"));
    std::int64_t* to = light.sums.data();
    for (const TraceTally& tally : photons.tallies) {
        std::memcpy(to, &tally, sizeof tally);
        to += kTallyWords;
    }
    for (const PhotonSlot& slot : photons.slots) {
        *to++ = slot.scatterings;
        if (slot.sums.size() > 0)
            std::memcpy(to, slot.sums.data(), slot.sums.size() * sizeof(std::int64_t));
        to += slot.sums.size();
    }
    return Status::ok();
}

Status PhotonReport::add_light(const PartLight& light, const std::vector<int>&, bool counts) {
    return photons_.add_light(light, counts);
}

Status PhotonReport::bring_together(WorkShare& share) { return photons_.bring_together(share); }

Status PhotonMethod::bring_together(WorkShare& share) {
    Photons& photons = shared_.ring.photons;
    const bool first = share.part().is_first();
    for (TraceTally& tally : photons.tallies) {
        PILEUS_TRY(share.sum({reinterpret_cast<std::int64_t*>(&tally), kTallyWords}));
        if (!first) tally = TraceTally{};
    }
    for (PhotonSlot& slot : photons.slots) {
        PILEUS_TRY(share.sum(slot.sums.span()));
        PILEUS_TRY(share.sum({&slot.scatterings, 1}));
        ++slot.serial;
        if (first) continue;
        // The first has them now.
        for (std::int64_t& sum : slot.sums.span()) sum = 0;
        slot.scatterings = 0;
    }
    return Status::ok();
}

Status PhotonMethod::add_light(const PartLight& light, bool counts) {
    PhotonRing& ring = shared_.ring;
    Photons& photons = ring.photons;
    const Status foreign = Status::bad_input("of another picture, allowed: parts of one work");
    if (light.first.size() != photons.slots.size() + 1 || light.sums.size() != words_of(photons))
        return foreign;
    for (std::size_t s = 0; s < photons.slots.size(); ++s)
        if (light.first[s + 1] > 0) begin_slot(shared_, photons.slots[s]);
    if (light.same != likeness(ring)) return foreign;
    const std::int64_t* from = light.sums.data();
    for (TraceTally& tally : photons.tallies) {
        TraceTally more;
        std::memcpy(&more, from, sizeof more);
        add_tally(more, tally);
        from += kTallyWords;
    }
    for (std::size_t s = 0; s < photons.slots.size(); ++s) {
        PhotonSlot& slot = photons.slots[s];
        slot.scatterings += *from++;
        for (std::size_t i = 0; i < slot.sums.size(); ++i) {
            std::int64_t& sum = slot.sums[i];
            const bool over = __builtin_add_overflow(sum, from[i], &sum);
            if (over || sum > kMax || sum < -kMax)
                return Status::limit("too much light for 64-bit sums, allowed: fewer seeds");
        }
        from += slot.sums.size();
        if (counts) slot.generations += light.first[s + 1];
        ++slot.serial;
    }
    if (counts) ring.next_generation += light.first[0];
    return Status::ok();
}

}  // namespace pileus
