// SPDX-License-Identifier: Apache-2.0
// One camera, one light and one method over a world: what programs, tests and hosts draw with.
// in: Scene, options, a world to share -> out: pictures, one after the other; a Report.
// docs/architecture.md, "How a frame is made"; docs/embedding.md
#pragma once
#include <memory>

#include "platform/threads.h"
#include "src/methods/governor.h"
#include "src/methods/scenery.h"
#include "src/picture/late_rows.h"
#include "src/picture/pixels.h"
#include "src/session/render.h"

namespace pileus {

/// A world of a scene, all read and made. Errors: those of the readers; kLimit.
Status make_world(const Scene& scene, const RenderOptions& options, std::shared_ptr<World>& world);
Status make_world(const Scene& scene, const RenderOptions& options,
                  std::shared_ptr<const World>& world);

/// A channel of an image, by its name, and the floats that it is written to.
struct LayerTarget {
    std::string name;
    Rows rows;
};

/// What a picture is written to; the parts that are null are left out.
struct FrameTarget {
    bool has_colour = false;
    PixelTarget colour;
    bool has_depth = false;
    Rows depth;
    DepthKind depth_kind = DepthKind::kDistance;
    bool depth_halves = false;
    std::uint64_t* hash = nullptr;
    std::vector<LayerTarget> layers;
};

struct SessionStats {
    std::uint32_t prepared = 0;
    std::uint64_t pictures = 0, units = 0;
    double render_s = 0, stages_s = 0;
};

/// What shines, and whether there is a ground.
struct Shine {
    bool sun = false, sky = false, ground = false;
};
Shine shine_of(const Lighting& lighting);

/// A frame of a film; `first` and `last` are those of the run, not of the animation.
struct FilmFrame {
    int frame = 0;
    bool first = true, last = true;
    bool new_run = false;  ///< pictures before this one count no more
};

struct StateFile;

/// A picture of an earlier density that fades away while this session draws the next one.
class Fading {
public:
    Fading() = default;
    Fading(const Fading&) = delete;
    Fading& operator=(const Fading&) = delete;
    virtual ~Fading() = default;

    /// Before a picture of its scene is made, after the one in `shown`, which it may take. False in
    /// `goes_on`: it has faded.
    virtual Status begin(const Context& context, const Scenery& scenery, Planes* shown,
                         bool& goes_on) = 0;
    /// `planes`, those of the new picture, become those that are shown; `leave`: by others.
    virtual Status mix(const Context& context, const Scenery& scenery, bool leave,
                       Planes*& planes) = 0;
};

class Session {
public:
    Session() = default;
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Of a host, which sets camera and lights. `world`: as make_world, or null for one of its own;
    /// `exact` false: as far as sizes tell, for the plan alone. Once only. Errors: as render's.
    Status open(const Scene& scene, const RenderOptions& options, bool exact,
                std::shared_ptr<const World> world);
    /// With another camera, sun, sky and ground than the scene's.
    Status open(const Scene& scene, const FrameState& frame, const RenderOptions& options,
                std::shared_ptr<const World> world);
    /// Likewise one that the scene's animation moves, with the world and the sky of `frame`.
    Status open_film(const Scene& scene, const FrameState& frame, const RenderOptions& options,
                     bool exact, std::shared_ptr<const World> world);

    Report& report() { return report_; }
    const Report& report() const { return report_; }
    /// Of several processes that light one picture, whether this one shows it.
    bool is_first() const;
    const MethodRow& row() const { return row_; }
    /// A step of the method in place of its picture.
    bool shows_view() const { return !options_.show.empty(); }
    const Scenery& scenery() const { return scenery_; }
    const World& world() const { return *scenery_.world; }
    const Plan& plan() const { return plan_; }
    const MethodReport& method_report() const { return *made_.report; }
    const Context& context() const { return context_; }
    const SessionStats& stats() const { return stats_; }

    /// Lights and draws a frame of the animation as an image with the scene's layers.
    Status render_image(const FilmFrame& step, Image& image);
    /// The next pictures of a film are of this window of the picture; light of photons stays.
    Status set_window(const Camera& camera);
    /// The light of a part of a frame, before there is a picture.
    Status render_light(const FilmFrame& step, PartLight& light);
    /// What the method counted goes to the report, after render_image.
    void finish_report();

    // What a host sets, in a live session. Values are checked; kBadInput names the key.
    Status set_camera(const Camera& camera);
    Status set_depth_scale(const DepthScale& scale);
    Status set_sun(const Sun& sun);
    /// `map`: another one; null: none, or with `keep` the one that there is, as it was scaled and
    /// turned. A sky that is not present has none.
    Status set_sky(const Sky& sky, const Image* map, bool keep);
    /// The same of a sun that has moved by so little, with its sky or without, that pictures before
    /// may still be shown in part.
    Status follow_sun(const Sun& sun);
    Status follow_sky(const Sky& sky, const Image* map);
    bool has_sky_map() const { return scenery_.environment.sky_map.present(); }
    Status set_ground(const Ground& ground);
    /// So many hours after the scene's date and time, as it was opened: sun, moon and stars. `sun`:
    /// as the scene's text has it. kBadInput: a scene without a date.
    Status set_hours(double hours, const Sun& sun);
    /// Of the scene's air, whose tables are made anew. kBadInput: out of range, or no air.
    Status set_turbidity(double turbidity);
    /// In place of all that there were: point, spot and parallel lights, with `held` numbers.
    Status set_lights(const std::vector<LightSettings>& lights);
    Status set_placement(const Double3& offset_m, double yaw_deg);
    /// Extinction, albedo, emission and phase functions of a scene's media, as many as there are;
    /// light begins anew. The bits are those of a session that is opened so. kBadInput, kLimit, the
    /// readers': all is as it was.
    Status set_media(const Scene& scene);
    Status set_frame(int number);
    /// Null rows: nothing solid.
    Status set_depth(const Rows* rows, DepthKind kind);
    /// Room for a depth image of the camera as it is, which has nothing solid.
    Status reserve_depth();
    /// Once open, before light and pictures: takes what they may need under any work and with any
    /// target. kLimit: out of memory.
    Status reserve();
    /// From now on nothing is laid out anew: lights, sizes and maps that are not there are refused.
    void seal();
    /// What the next steps and pictures may cost; members that are 0 are the scene's. kBadInput: a
    /// member that the method has not, or more than the scene's.
    Status set_work(const FrameWork& work);
    /// As it is set now, every member filled in.
    const FrameWork& work() const { return work_; }
    /// From all of the scene's work to less and less, for `govern`.
    std::vector<FrameWork> work_levels() const;

    /// What a frame, one unit of light and one picture, of such work takes at the most, as all is
    /// set now; members that are 0 are the scene's. kBadInput: as set_work, or the method's cost
    /// depends on the view.
    Status most_units(const FrameWork& work, FrameUnits& units);
    /// The first of work_levels that costs no more than `most`. kLimit: none does; `work` is the
    /// last.
    Status fit_work(const UnitCosts& costs, double most, FrameWork& work);

    /// Camera as it was set, in the host's coordinates.
    const Camera& camera() const { return host_.camera; }
    /// The ground likewise, and how many [[light]] there are.
    const Ground& ground() const { return host_.ground; }
    std::size_t light_count() const { return host_.lights.size(); }

    /// Traces so many whole units; `done` fewer where the host's `interrupted` ended it.
    Status step(std::uint64_t units, std::uint64_t& done);
    LightUnits light() const;

    /// Draws what is lit, into a host's memory.
    Status render(const FrameTarget& target);

    /// Draws in place of `from` from now on: takes over its view, its work, its threads and what
    /// its host is asked and told, and lets its last picture fade over `frames` of its own. Then
    /// `from` may light another density. kBadInput: sessions that differ too much; kLimit: both are
    /// as they were. docs/living.md
    Status take_over(Session& from, std::uint32_t frames);
    /// Keeps what a host lent as long as arrays may lie in it.
    void keep(const std::shared_ptr<const void>& lent);

    /// The report of a live session up to now.
    Report told() const;
    /// What the last picture and the method counted, without the report around it: for flights,
    /// which take no memory for it. Valid until the next call.
    const Counts& counters();

    /// As long as what is returned is held, this is the sky of many clouds: it takes neither lights
    /// nor work, which they have no use for.
    std::shared_ptr<const void> carry_clouds();
    const FrameWork& whole_work() const { return whole_work_; }
    /// kBadInput: it is such a sky.
    Status refuse_clouds_sky(const char* what) const;

    /// What others draw in, of a host's session as it is set now and lit.
    Status lit(Scenery*& scenery);
    int frame() const { return host_.number; }
    const DepthScale& depth_scale() const { return depth_scale_; }
    /// A picture of the media alone, with depths; the session keeps it until its next call. Light
    /// that is gathered for a camera may be off by `slack_deg` of it.
    Status draw_alone(double slack_deg, const Planes*& planes);

private:
    /// What a host has changed since the light was made.
    struct Changes {
        bool stale = true, anew = false;
        bool air_old = false;    ///< the air's sky is another sun's or ground's
        bool air_moved = false;  ///< it is that of a sun that has moved a little
    };
    /// Nothing may be laid out anew: docs/flight.md
    struct Seal {
        bool on = false;
        Shine shine;
        std::size_t lights = 0;
    };
    struct LastPicture {
        Planes* planes = nullptr;  ///< but for its late rows; null: none
        Camera camera;             ///< as the scene had it
        bool has_hash = false;
        std::uint64_t hash = 0;
    };

    FrameView view() { return scenery_.view(host_.number); }
    /// The method's picture, seen through the air.
    Status draw(const FrameView& view, const RenderAsk& ask, Planes*& planes);
    /// Whether pictures may have them, and channels of the image that a picture would be in a file.
    Status check_layers(const std::vector<LayerTarget>& layers) const;
    Status show_layers(const FrameView& view, const std::vector<LayerTarget>& layers,
                       const Planes& planes);
    Status open_either(const Scene& scene, const FrameState& frame, const RenderOptions& options,
                       bool hosted, bool exact, std::shared_ptr<const World> world);
    Status film_frame(const FilmFrame& step, Image& image);
    Status light_frame(const FilmFrame& step);
    Status show_frame(const FilmFrame& step, Image& image);
    /// The light of it, until the method's goal is met or the user wants an end.
    Status film_light(const FrameView& view);
    Status film_passes(const FrameView& view, const LightGoal& goal, StateFile& file);
    Status film_view(int frame, bool new_run);
    /// Of a method that keeps a ring: each generation for the view of its own frame.
    Status film_ring(const FilmFrame& step);
    Status film_generation(std::uint64_t number, std::uint64_t ring);
    /// Whole units, between which the user may end it.
    Status trace(std::uint64_t units, std::uint64_t& done);
    Status aim();
    Status check_sealed() const;
    Status check_media(const char* key, const Ground& ground, double moved_m) const;
    /// Whether the method is for this scene, this session and its world; finds a view of it.
    Status check_method(bool hosted, const World* world);
    void tell_plan(bool exact);
    void keep_opened();
    Status take_world(std::vector<MediumSettings>& media, std::shared_ptr<const World> world);
    /// As trace, where a host may end it.
    Status trace_passes(std::uint64_t held, std::uint64_t units, std::uint64_t& done);
    Status take_frame(int frame);
    void move_to(int frame);
    Status relight_air();
    void place();
    Status check_take_over(const Session& from, std::uint32_t frames) const;
    Status take_view(const Session& from);
    Status fade_from(Session& from, std::uint32_t frames, std::unique_ptr<Fading>& fading);

    std::vector<std::shared_ptr<const void>> lent_;
    std::shared_ptr<const void> clouds_;  ///< held by those over this sky, too
    std::unique_ptr<ThreadPool> threads_ = std::make_unique<ThreadPool>();  ///< where none is lent
    Scene scene_;      ///< as the method sees it: in the media's coordinates
    FrameState host_;  ///< as a host set it, or as the file has it
    std::shared_ptr<const FrameState> opened_;  ///< what the session began with; not in flights
    std::shared_ptr<const World> base_world_;   ///< before media were set; null: none were
    DepthScale depth_scale_;
    FrameWork whole_work_, work_;  ///< the scene's, and that of the next frame
    Changes changed_;
    Seal seal_;
    RenderOptions options_;
    Report report_;
    Counts counted_;  ///< what counters() returned last
    Context context_;
    MethodRow row_;
    Scenery scenery_;  ///< of `scene_`
    Plan plan_;        ///< as the light's sums are laid out now
    Digests digests_;  ///< of what no frame changes
    MadeMethod made_;
    LateRows late_;
    LastPicture last_;
    std::unique_ptr<Fading> fading_;
    SessionStats stats_;
};

}  // namespace pileus
