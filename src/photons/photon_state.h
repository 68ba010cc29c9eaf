// SPDX-License-Identifier: Apache-2.0
// What a method of photons holds: lights, sums in slots, the ring of generations, what shows them.
// in: a view of a frame -> out: light in integer sums, generation by generation.
// docs/methods.md 3, "Generations and error"; what the sums mean belongs to the method.
#pragma once
#include "src/methods/method.h"
#include "src/photons/ring_sum.h"
#include "src/photons/trace.h"
#include "src/picture/layers.h"
#include "src/picture/nodes/ground_shadow.h"
#include "src/picture/nodes/lamp_light.h"
#include "src/picture/upsample.h"
#include "src/plan/plan.h"
#include "src/world/light/beam.h"
#include "src/world/world.h"

namespace pileus {

/// Most groups of generations that the standard error is made from.
constexpr std::uint64_t kMaxBatches = 16;

/// What is shot.
struct PhotonLights {
    /// Of the frame, but for `lights`: those have their photons, and the places of a ring.
    Lighting lighting;
    std::int64_t budget_photons = 0;           ///< of all generations
    std::vector<std::uint64_t> light_photons;  ///< per light and generation while it is up
    std::uint64_t unit_photons = 0;            ///< of a generation, fewer than these; 0: these
    SunPlace sun;
    DepositPlan deposit;
    GroundMap ground_map;
    std::uint32_t max_events = 1u << 20;
    double diagonal_m = 0;  ///< of the media's box, by which the ledger tells paths
};

/// Generations and their sums.
struct PhotonRing {
    bool on = true;            ///< where frames follow every generation is kept apart
    bool many_frames = false;  ///< frames follow: a host's, or those of a film, whatever part of it
    bool animated = false;     ///< the same, or a film of one frame
    bool shared_sums = false;  ///< all threads add to one set
    Photons photons;
    RingSum sum;  ///< once a picture was shown
    TraceScratch scratch;
    std::uint64_t next_generation = 0, generations = 1;
    std::uint64_t first = 0;     ///< generation in the first slot
    bool fresh = false;          ///< filled from `begin` on, and not shown
    std::uint64_t begin = 0;     ///< the first generation of a film
    std::uint64_t relights = 0;  ///< times that a host changed the light
    std::uint32_t layouts = 0;   ///< times that the sums were laid out
    bool interrupted = false;  ///< fewer generations than asked for, because the user wanted an end
};

/// Sunlight on nodes, which the march reads.
struct SunShadow {
    NodeGrid nodes{};
    Buffer<float> depth;       ///< optical depth to the sun per node
    Buffer<float> visibility;  ///< and what solids leave of the sun; empty without solids
    bool ready = false;        ///< visibility and beam
    SunSlices slices;
    int light_refresh = 1;  ///< frames in which sunlight on nodes is made anew
    Beam beam;              ///< made with the depths where deposit.peak_turn asks for it
    BehindView behind{};    ///< made with the beam, without lights
};

/// What pictures keep.
struct PhotonPicture {
    GroundShadow ground_shadow;
    LampNodes lamps;  ///< of the march that shows light of [[light]]
    Planes planes;
    Buffer<float> lit_quads;   ///< light on nodes as the march reads it
    Buffer<float> near_light;  ///< MarchBuffers::near
    bool thins = true;         ///< pictures are marched: they may have fewer pixels
    UpsampleSettings thin;     ///< which
    UpsampleMemory upsample;   ///< of pixels that are not marched
    int frame = 0;             ///< that is shown
    std::int64_t turn = 0;     ///< number of the picture
    std::string colours;       ///< digest of what a film's picture was made from
    bool alone = false;        ///< what lies behind the media is not wanted
};

/// Made by `prepare`, lit by shoot_generation.
struct PhotonState {
    Budget budget;
    bool hosted = false;        ///< a host moves camera and lights; else frames are a film's
    bool outlined_only = true;  ///< sizes are known, values are not
    bool error_layer = false;   ///< light is kept in batches, to tell its error
    bool sealed = false;        ///< nothing may be laid out anew: docs/flight.md
    double cell_m = 0;          ///< shortest edge of the cells that hold scattered light; 0: none
    Majorants majorants;
    PhotonLights lights;
    PhotonRing ring;
    SunShadow shadow;
    PhotonPicture picture;
};

/// Budget, and whether frames follow.
void begin_photons(const MethodInputs& inputs, PhotonState& state);

/// Slots of the sums: the generations of an animation's ring, or batches for the error.
std::uint64_t photon_slots(const PhotonState& state);

/// Whether slots are packed, and the light of all of them kept summed up: each frame of a ring
/// changes one of many.
bool sums_ring(const PhotonState& state);

/// Brings that sum up to date; nothing where it is not kept. kLimit: out of memory.
Status sum_ring(const TraceInput& in, PhotonState& state);

/// Groups of slots that the standard error is made from; 0: no error layer.
int photon_batches(const PhotonState& state);

/// Chooses lights, their photons and the ground's map for the medium as it is known now, in at most
/// so many generations. Errors: those of the sky map.
Status choose_photon_lights(const FrameView& view, std::uint64_t generations, PhotonState& state);

/// What launches read; the method says where light is stored.
TraceInput photon_trace_input(const Context& context, const FrameView& view,
                              const PhotonState& state);

/// Empty sums; what was shot before is forgotten. kLimit: out of memory.
Status lay_out_photons(const TraceInput& in, PhotonState& state);

/// The next generation is number `first`; what was shot before is forgotten.
void restart_photons(int threads, std::uint64_t first, PhotonState& state);

/// Before the first picture of a film: where time cut its ring short, what there is begins at the
/// first slot, so that no gap lies before it.
void settle_ring(PhotonState& state);

/// The digest of what a picture is made from, where a report wants it.
void note_colours(const Context& context, Span<const float> light, PhotonState& state);

/// A slot learns what its photons will stand for.
void begin_slot(const PhotonState& state, PhotonSlot& slot);

/// Shoots one generation into its slot, in a ring in place of the oldest; sets `interrupted` where
/// the user ended it within.
Status shoot_generation(const Context& context, TraceInput in, PhotonState& state);

/// kLimit: the sums have no room for the photons under `key`, with what each may leave.
Status sums_overflow(const char* key, const FrameView& view, const PhotonState& state);

/// Where deposits of the phase function look: the camera, or back along its parallel rays.
void aim_deposit(const FrameView& view, PhotonState& state);

/// Whether there is light of one direction at a place: the sun's or lamps'.
bool has_axes(const Lighting& lighting);

/// Decides how many axes deposits know, and which are lamps', once its bands and degrees are known.
void choose_axes(const FrameView& view, PhotonState& state);

/// Decides deposit.peak_turn: light of the sun and of lamps scattered within so many degrees is
/// kept apart from the photons' deposits, where the march shows the first order; of several media
/// with `harmonics` alone, bands on marched nodes, whose light from all around it is apart in, too.
void choose_peak(const FrameView& view, double peak_deg, bool harmonics, PhotonState& state);
/// Why there is none; null: there is.
const char* why_no_peak(const FrameView& view, double peak_deg, bool harmonics,
                        const PhotonState& state);

/// Closure "camera" evaluates phase functions where photons scatter. kBadInput, named by `key`: one
/// sends light exactly straight on or back, which has no density.
Status check_camera_closure(const char* key, const FrameView& view, const PhotonState& state);

/// Whether there are tables of points, too: any light of [[light]] may become one.
bool beam_of_points(const FrameView& view, const PhotonState& state);
/// Tables that the beam will have.
std::uint64_t beam_sets(const FrameView& view, const PhotonState& state);

/// Takes up the lights of a film's frame; generations already shot keep the sun they were shot
/// under. A light that the slots have no place for is left out.
void follow_lights(const FrameView& view, PhotonState& state);

/// Takes up lights that a host has changed. False: one appears that the slots have no place for,
/// so that they are to be laid out anew.
bool relight_photons(const FrameView& view, PhotonState& state);

/// Takes up photons of the generations to come, slices of sunlight, marched pixels. kBadInput:
/// other photons in one sum, whose generations are all alike.
Status limit_photons(const FrameWork& work, PhotonState& state);

/// Whether light of lamps differs by colour.
bool coloured_lamps(const Lighting& lighting);

/// Whether photons of one are photons of the other.
bool same_lights(const Lighting& a, const Lighting& b);

}  // namespace pileus
