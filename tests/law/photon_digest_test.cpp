// SPDX-License-Identifier: Apache-2.0
// The digest of a ring of generations: what has not changed is not digested again.
// in: made-up slots -> out: which changes the digest shows.
#include <doctest/doctest.h>

#include "src/base/digest.h"
#include "src/photons/photon_report.h"

using namespace pileus;

TEST_CASE("photons: a slot is digested again where its sums were changed, the others are not") {
    Photons photons;
    photons.slots.resize(3);
    for (std::size_t s = 0; s < 3; ++s) {
        REQUIRE(photons.slots[s].sums.resize(100, "sums"));
        for (std::int64_t& v : photons.slots[s].sums.span()) v = std::int64_t(s) + 1;
    }
    // Without any that were kept.
    const std::string whole = photon_digest(photons);
    digest_photons(2, photons);
    CHECK(photon_digest(photons) == whole);
    Digest expected;
    for (const PhotonSlot& slot : photons.slots) {
        Digest own;
        own.integers(slot.sums.span());
        CHECK(slot.digest == own.value());
        expected.u64(own.value());
    }
    CHECK(whole == expected.hex());

    // Behind its back: nobody looks at the numbers.
    photons.slots[1].sums[7] = -5;
    digest_photons(2, photons);
    CHECK(photon_digest(photons) == whole);
    ++photons.slots[1].serial;
    const std::string changed = photon_digest(photons);
    CHECK(changed != whole);
    digest_photons(2, photons);
    CHECK(photon_digest(photons) == changed);
    // The kept digest goes with its slot.
    std::swap(photons.slots[0], photons.slots[2]);
    CHECK(photon_digest(photons) != changed);
    std::swap(photons.slots[0], photons.slots[2]);
    CHECK(photon_digest(photons) == changed);
}
