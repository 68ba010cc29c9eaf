// SPDX-License-Identifier: Apache-2.0
// What every run of photons tells: the energy ledger, counts, the digest and bounds of its sums.
// in: PhotonState -> out: Report, Plan.
// docs/report.md.
#pragma once
#include "src/photons/photon_method.h"

namespace pileus {

/// Digests the slots whose sums have changed: of a ring one in each frame.
void digest_photons(int threads, Photons& photons);

/// Of the digests of all slots.
std::string photon_digest(const Photons& photons);

/// Of all lights.
TraceTally tally_of(const PhotonRing& ring);

void count_photons(const PhotonRing& ring, Counts& counters);

/// Fills generations, energy and events.
void report_photons(const PhotonState& state, Report& report);

/// What of lights is needed and left out.
void explain_photon_lights(const FrameView& view, const PhotonState& state, Plan& plan);
/// Degrees about the sun's axis; `why` there are none, null: no phase function has any.
void explain_axis(const char* why, const PhotonState& state, Plan& plan);
/// Whether sunlight scattered once is kept apart.
void explain_split(bool split, const PhotonState& state, Plan& plan);
/// Whose photons are shot, and what shows them by `display`.
void explain_photon_picture(const FrameView& view, const PhotonState& state, const char* display,
                            Plan& plan);

/// Generations of a film's frame; `most`: that the sums have room for.
LightGoal photon_goal(const PhotonState& state, std::uint64_t most);

/// Of the sums that a film's picture shows.
void digest_photon_sums(const Context& context, PhotonMethod& of, Digests& digests);

/// What is told alike of all methods of photons. The method outlives it.
class PhotonReport : public MethodReport {
public:
    explicit PhotonReport(PhotonMethod& of) : photons_(of) {}

    Status bring_together(WorkShare& share) override;
    Status take_light(PartLight& light) override;
    Status add_light(const PartLight& light, const std::vector<int>& lines, bool counts) override;
    void digest_picture(const Context& context, Digests& digests) override;
    FinishedParts finished() const override;
    /// Generations, of as many photons in all.
    void budget_used(int frame, const Report& report, Budget& used) const override;

private:
    PhotonMethod& photons_;
};

/// Adds the bounds of the sums that no picture shows but every report does, behind the first one.
void bound_ledgers(double photons, double max_events, Plan& plan);

/// kLimit where a bound of the plan is broken; `key` says how many photons were asked for.
Status check_bounds(const Plan& plan, const std::string& file, const char* key);

/// The ring, and one generation for each further picture.
std::uint64_t photons_of_run(const PhotonState& state, const Context& context);

}  // namespace pileus
