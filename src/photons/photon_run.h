// SPDX-License-Identifier: Apache-2.0
// What a run that shoots photons holds: lights, sums in slots, the ring of generations.
// in: a scene and its world -> out: light in integer sums, generation by generation.
// docs/methods.md 3, "Generations and error"; what the sums mean belongs to the method.
#pragma once
#include "src/methods/methods.h"
#include "src/photons/beam.h"
#include "src/photons/ring_sum.h"
#include "src/photons/trace.h"
#include "src/picture/layers.h"
#include "src/picture/nodes/ground_shadow.h"
#include "src/picture/nodes/lamp_light.h"
#include "src/picture/upsample.h"
#include "src/plan/plan.h"
#include "src/world/world.h"

namespace pileus {

/// Most groups of generations that the standard error is made from.
constexpr std::uint64_t kMostBatches = 16;

/// Made by the method's `prepare`, lit by shoot_generation.
struct PhotonRun : MethodRun {
    std::int64_t budget_photons = 0;           ///< of all generations
    std::vector<std::uint64_t> light_photons;  ///< per light and generation while it is up
    std::uint64_t unit_photons = 0;  ///< of a generation of a session, fewer than these; 0: these
    SunPlace sun;
    Majorants majorants;
    DepositPlan deposit;
    GroundMap ground_map;
    Photons photons;
    RingSum ring_sum;  ///< of an animation's ring, once a picture was shown
    TraceScratch scratch;
    std::uint64_t next_generation = 0, generations = 1;
    bool ring = true;              ///< an animation keeps every generation apart
    std::uint64_t ring_first = 0;  ///< generation in the first slot of a ring that time cut short
    std::uint32_t max_events = 1u << 20;
    NodeGrid shadow_nodes{};
    Buffer<float> shadow;       ///< optical depth to the sun per node
    Buffer<float> visibility;   ///< and what solids leave of the sun; empty without solids
    bool shadow_ready = false;  ///< visibility and beam
    SunSlices shadow_slices;
    int light_refresh = 1;  ///< frames in which sunlight on nodes is made anew
    bool thins = true;      ///< pictures are marched: they may have fewer pixels
    UpsampleSettings thin;  ///< which
    std::int64_t turn = 0;  ///< number of the picture, for that
    Beam beam;              ///< made with the shadow where deposit.peak_turn asks for it
    GroundShadow ground_shadow;
    LampNodes lamps;             ///< of the march that shows light of [[light]]
    Planes planes;               ///< of a session's picture
    Buffer<float> lit_quads;     ///< light on nodes as the march reads it
    Buffer<float> near_light;    ///< MarchBuffers::near
    UpsampleMemory upsample;     ///< of pixels that are not marched
    int frame = 0;               ///< that is shown
    std::uint64_t relights = 0;  ///< times that a host changed the light
    std::uint32_t layouts = 0;   ///< times that the sums were laid out
    bool interrupted = false;  ///< fewer generations than asked for, because the user wanted an end

    // In place: a virtual function of one file would tie its type there, which has no type
    // information.
    Status reserve(LateRows& late) override { return reserve_pictures(late); }
    Status reserve_pictures(LateRows& late);
    void seal() override {
        MethodRun::seal();
        near_light = Buffer<float>();
    }
};

/// Slots of the sums: the generations of an animation's ring, or batches for the error.
std::uint64_t photon_slots(const PhotonRun& run);

/// Whether slots are packed, and the light of all of them kept summed up: each frame of a ring
/// changes one of many.
bool sums_ring(const PhotonRun& run);

/// Brings that sum up to date; nothing where it is not kept. kLimit: out of memory.
Status sum_ring(const TraceInput& in, PhotonRun& run);

/// Groups of slots that the standard error is made from; 0: no error layer.
int photon_batches(const PhotonRun& run);

/// Chooses lights, their photons and the ground's map for the medium as it is known now, in at most
/// so many generations. The plan begins anew. Errors: those of the sky map.
Status choose_photon_lights(std::uint64_t generations, PhotonRun& run);

/// What launches read; the method says where light is stored.
TraceInput photon_trace_input(const Context& context, const PhotonRun& run);

/// Empty sums; what was shot before is forgotten. kLimit: out of memory.
Status lay_out_photons(const TraceInput& in, PhotonRun& run);

/// Shoots one generation into its slot, in a ring in place of the oldest; sets run.interrupted
/// where the user ended it within.
Status shoot_generation(TraceInput in, const Context& context, PhotonRun& run);

/// kLimit: the sums have no room for the photons under `key`, with what each may leave.
Status sums_overflow(const char* key, const PhotonRun& run);

/// Where deposits of the phase function look: the camera, or back along its parallel rays.
void aim_deposit(PhotonRun& run);

/// Decides deposit.peak_turn: a beam of light scattered within so many degrees is kept apart from
/// the photons' deposits, where the march shows the sun's first order of one medium. Else the plan
/// leaves it out.
void choose_peak(double peak_deg, PhotonRun& run);

/// Closure "camera" evaluates phase functions where photons scatter. kBadInput, named by `key`: one
/// sends light exactly straight on or back, which has no density.
Status check_camera_closure(const char* key, const PhotonRun& run);

/// Tables that the beam will have.
std::uint64_t beam_sets(const PhotonRun& run);

/// Moves the sun; generations already shot keep the sun they were shot under.
void set_photon_sun(const SunPlace& sun, PhotonRun& run);

/// Takes up a new sun, sky or ground of the run's scene. False: a light appears that the slots have
/// no place for, so that they are to be laid out anew.
bool relight_photons(PhotonRun& run);

/// The fault of such a light where nothing may be laid out any more.
Status refuse_new_lights();

/// LiveMethod::set_limits: photons of the generations to come, slices of sunlight, marched pixels.
/// kBadInput: other photons in one sum, whose generations are all alike.
Status set_photon_limits(const FrameWork& work, MethodRun& run);

/// Whether photons of one are photons of the other.
bool same_lights(const Lighting& a, const Lighting& b);

}  // namespace pileus
