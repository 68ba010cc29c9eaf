// SPDX-License-Identifier: Apache-2.0
// See viewer.h. It draws as any host does, by pileus.h; where the scene begins it reads itself.
#include "tools/view/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "src/scene/calendar.h"
#include "src/scene/read_scene.h"
#include "src/world/atmosphere/atmosphere.h"
#include "tools/view/controls.h"
#include "tools/view/drawn.h"
#include "tools/view/noise.h"
#include "tools/view/overlay.h"
#include "tools/view/screenshot.h"
#include "tools/view/smaller.h"

namespace pileus::view {
namespace {

constexpr double kAdaptSeconds = 0.7;  // of the eye
constexpr double kWantedLuma = 0.42;   // of the displayed picture's mean
constexpr double kRestSeconds = 0.25;  // between looks at nothing new
constexpr std::uint32_t kSunFrames = 8;
constexpr std::size_t kShownTimes = 120;  // of the graph

class Viewer {
public:
    Viewer(const Settings& settings, Window& window, Outcome& outcome)
        : settings_(settings), window_(window), outcome_(outcome) {}

    Status run() {
        PILEUS_TRY(begin());
        while (!state_.ended && (settings_.frames == 0 || outcome_.frames < settings_.frames))
            PILEUS_TRY(frame());
        if (!moving_.empty()) {
            const auto middle = moving_.begin() + std::ptrdiff_t(moving_.size() / 2);
            std::nth_element(moving_.begin(), middle, moving_.end());
            outcome_.moving_s = *middle;
            outcome_.moving = int(moving_.size());
        }
        return Status::ok();
    }

private:
    Status begin() {
        Scene scene;
        PILEUS_TRY(settings_.path.empty()
                       ? read_scene_text(settings_.text, "default scene", "", settings_.sets, scene)
                       : read_scene_file(settings_.path, settings_.sets, scene));
        place_sun(scene.atmosphere, 0, scene.sun);
        View& v = state_.view;
        for (int a = 0; a < 3; ++a) {
            v.position[std::size_t(a)] = scene.camera.position_m[a];
            v.target[std::size_t(a)] = scene.camera.target_m[a];
            v.up[std::size_t(a)] = scene.camera.up[a];
        }
        v.fov_deg = scene.camera.fov_deg;
        seen_ = v;
        state_.has_sun = scene.sun.present || scene.atmosphere.present;
        irradiance_ = scene.sun.irradiance;
        if (scene.ground.present) state_.lowest_m = scene.ground.altitude_m + 0.5;
        window_.size(state_.width, state_.height);
        state_.lit = !settings_.hold;
        PILEUS_TRY(open_method());
        state_.box = drawn_->box();
        v.azimuth_deg = scene.sun.azimuth_deg;
        v.elevation_deg = scene.sun.elevation_deg;
        if (settings_.hold) apply_key(Key::kF3);
        take_day(scene);
        state_.home = v;
        window_.set_title("pileus");
        return Status::ok();
    }

    /// The slider of a scene with a date goes from one midnight to the next.
    void take_day(const Scene& scene) {
        double hours = 0;
        if (scene.atmosphere.date.empty() || !read_time(scene.atmosphere.time, hours)) return;
        state_.view.day_share = std::min(std::max(hours / 24, 0.0), 1.0);
        state_.sun_at = [own = Scene(scene), hours](double share, View& view) mutable {
            Sun sun = own.sun;
            place_sun(own.atmosphere, 24 * share - hours, sun);
            view.azimuth_deg = sun.azimuth_deg;
            view.elevation_deg = sun.elevation_deg;
        };
    }

    void apply_key(Key key) {
        Event e;
        e.kind = EventKind::kKey;
        e.key = key;
        apply(e, state_);
    }

    Status open_method() {
        Settings own = settings_;
        own.width = state_.width, own.height = state_.height;
        auto drawn = std::make_unique<Drawn>();
        PILEUS_TRY(drawn->open(own, state_.method > 0 ? method_named(state_.method) : nullptr));
        noise_.begin();
        drawn_ = std::move(drawn);
        width_ = seen_width_ = own.width, height_ = seen_height_ = own.height;
        governor_ = cleared<pileus_governor>();
        governor_.target_s = 1 / settings_.fps;
        frame_s_ = 0;
        state_.moved = true;
        state_.sun_moved = state_.sun_moved || outcome_.frames > 0;
        return Status::ok();
    }

    /// A method that the scene is not for stays where it was, and a line tells why.
    void change_method() {
        const int before = shown_method_;
        if (const Status opened = open_method(); !opened) {
            state_.method = before;
            message_ = opened.message.substr(0, opened.message.find('\n')).substr(0, 100);
            return;
        }
        shown_method_ = state_.method;
        message_.clear();
    }

    Status set_camera(const View& v) {
        auto error = cleared<pileus_error>();
        auto camera = cleared<pileus_camera>();
        camera.width = std::uint32_t(width_);
        camera.height = std::uint32_t(height_);
        std::copy_n(v.position.data(), 3, camera.position_m);
        std::copy_n(v.target.data(), 3, camera.target_m);
        std::copy_n(v.up.data(), 3, camera.up);
        camera.fov_deg = v.fov_deg;
        return of(pileus_session_set_camera(drawn_->get(), &camera, &error), error);
    }

    /// A place that no camera may have is passed over, and a size that the session refuses: what is
    /// drawn into has the size of what the session draws.
    void move_camera() {
        Status set = set_camera(state_.view);
        if (!set) {
            message_ = set.message.substr(0, 100);
            View& v = state_.view;
            v.position = seen_.position, v.target = seen_.target;
            set = set_camera(v);
        }
        if (!set) width_ = seen_width_, height_ = seen_height_;
        seen_ = state_.view;
        seen_width_ = width_, seen_height_ = height_;
    }

    Status aim() {
        auto error = cleared<pileus_error>();
        const View& v = state_.view;
        if (state_.moved) move_camera();
        if (state_.sun_moved) {
            auto sun = cleared<pileus_sun>();
            sun.present = state_.has_sun ? 1 : 0;
            sun.azimuth_deg = v.azimuth_deg;
            sun.elevation_deg = v.elevation_deg;
            std::copy_n(irradiance_.data(), 3, sun.irradiance);
            PILEUS_TRY(of(pileus_session_set_sun(drawn_->get(), &sun, &error), error));
        }
        if (state_.moved || state_.sun_moved) noise_.begin();
        state_.moved = state_.sun_moved = false;
        return Status::ok();
    }

    /// One unit of light while the picture has not all that it should have.
    Status trace(bool moved, bool& more) {
        auto error = cleared<pileus_error>();
        auto light = cleared<pileus_progress>();
        PILEUS_TRY(of(pileus_session_progress(drawn_->get(), &light, &error), error));
        more = false;
        if (state_.lit && light.units < light.whole) {
            PILEUS_TRY(of(pileus_session_step(drawn_->get(), 1, nullptr, &error), error));
            PILEUS_TRY(of(pileus_session_progress(drawn_->get(), &light, &error), error));
            more = light.units < light.whole;
        }
        units_ = light.whole == 0
                     ? std::string("no noise")
                     : fmt::format("light {} of {} {}s", light.units, light.whole, light.unit);
        lit_ = light.whole == 0 || light.units > 0;
        if (moved || !noise_.wants(light.units, light.whole)) return Status::ok();
        // Once in a doubling, the picture as numbers.
        auto frame = cleared<pileus_frame>();
        linear_.resize(4 * std::size_t(width_) * std::size_t(height_));
        frame.colour = linear_.data();
        frame.format = PILEUS_FORMAT_RGBA32F;
        PILEUS_TRY(of(pileus_session_render(drawn_->get(), &frame, &error), error));
        noise_.add(light.units, linear_);
        return Status::ok();
    }

    Status draw() {
        auto error = cleared<pileus_error>();
        const std::size_t pixels = std::size_t(width_) * std::size_t(height_);
        bytes_.resize(4 * pixels);
        depth_.resize(state_.shown == Shown::kDepth ? pixels : 0);
        auto frame = cleared<pileus_frame>();
        frame.colour = bytes_.data();
        frame.format = PILEUS_FORMAT_RGBA8_SRGB;
        frame.exposure_stops = float(stops_);
        frame.depth = depth_.empty() ? nullptr : depth_.data();
        frame.depth_kind = PILEUS_DEPTH_DISTANCE;
        return of(pileus_session_render(drawn_->get(), &frame, &error), error);
    }

    void show_debug() {
        for (std::size_t i = 0; i < bytes_.size() / 4; ++i) {
            std::uint8_t* at = &bytes_[4 * i];
            if (state_.shown == Shown::kAlpha) {
                at[0] = at[1] = at[2] = at[3];
            } else if (state_.shown == Shown::kDepth) {
                const double near =
                    double(depth_[i]) / (double(depth_[i]) + 2 * state_.box.radius());
                at[0] = at[1] = at[2] = std::uint8_t(depth_[i] < 1e30f ? 255 - 255 * near : 0);
            }
        }
    }

    /// The eye goes towards what makes the picture's mean brightness a middle one; whether it still
    /// does.
    bool adapt(double seconds) {
        if (settings_.fixed_exposure || state_.shown != Shown::kColour) return false;
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < bytes_.size() / 4; i += 61, ++count)
            sum += std::log2(0.02 + (0.2126 * bytes_[4 * i] + 0.7152 * bytes_[4 * i + 1] +
                                     0.0722 * bytes_[4 * i + 2]) /
                                        255);
        const double mean = std::exp2(sum / double(std::max<std::size_t>(count, 1))) - 0.02;
        const double off = 2 * std::log2(kWantedLuma / std::max(mean, 0.01));
        const double part = 1 - std::exp(-seconds / kAdaptSeconds);
        stops_ = std::min(std::max(stops_ + part * std::min(std::max(off, -2.0), 2.0), -6.0), 12.0);
        return std::abs(off) > 0.1 && stops_ < 12;
    }

    void lay_over() {
        const Canvas canvas{shown_.data(), state_.width, state_.height};
        const int scale = state_.width >= 1200 ? 2 : 1;
        if (state_.width < 160 || state_.height < 100) return;
        std::vector<std::string> lines = {
            fmt::format("{}  {:.0f} fps  {}", method_text(), shown_fps(), units_)};
        if (!work_text_.empty()) lines.push_back(work_text_);
        if (noise_.known()) lines[0] += fmt::format("  error {:.2f} %", 100 * noise_.error());
        if (state_.has_sun)
            lines.push_back(fmt::format("sun {:.1f} deg high, {:.0f} deg",
                                        state_.view.elevation_deg, state_.view.azimuth_deg) +
                            time_text());
        if (!state_.lit) lines.push_back("held: space goes on");
        if (!message_.empty()) lines.push_back(message_);
        draw_text(canvas, 10, 10, scale, lines);
        draw_times(canvas, 10, 20 + 9 * scale * int(lines.size()) + 8, 2 * int(kShownTimes), 40,
                   times_, 1 / settings_.fps);
        if (state_.help) draw_text(canvas, 40, 120, scale, help_lines());
        if (state_.has_sun) draw_slider(canvas, kSliderHeight, day_share());
    }

    double day_share() const {
        return state_.view.day_share >= 0 ? state_.view.day_share : day_of(state_.view);
    }
    /// Of a scene with a date, what its clock says.
    std::string time_text() const {
        if (!state_.sun_at || state_.view.day_share < 0) return {};
        const int minutes = int(1440 * state_.view.day_share + 0.5);
        return fmt::format("  {:02}:{:02}", minutes / 60, minutes % 60);
    }

    std::string method_text() const {
        return state_.method > 0 ? method_named(state_.method) : "scene";
    }
    double shown_fps() const {
        double sum = 0;
        for (const double s : times_) sum += s;
        return sum > 0 ? double(times_.size()) / sum : 0;
    }

    /// The picture as it is on the screen, without what is drawn over it.
    Status take_screenshot() {
        std::string path;
        PILEUS_TRY(write_screenshot(settings_.screenshots, bytes_, width_, height_, path));
        message_ = path.empty() ? "no free name for a screenshot" : path;
        if (!path.empty()) outcome_.screenshots.push_back(path);
        return Status::ok();
    }

    void choose_size(bool governed) {
        const int by = governed ? smaller_.choose(frame_s_, 1 / settings_.fps, governor_.level) : 1;
        const int width = std::max(state_.width / by, 16),
                  height = std::max(state_.height / by, 16);
        state_.moved = state_.moved || width != width_ || height != height_;
        width_ = width, height_ = height;
    }

    Status choose_work(bool governed, bool sun_moved) {
        auto error = cleared<pileus_error>();
        auto work = cleared<pileus_work>();
        if (governed)
            PILEUS_TRY(of(pileus_session_govern(drawn_->get(), &governor_, frame_s_, &work, &error),
                          error));
        PILEUS_TRY(of(pileus_session_set_work(drawn_->get(), &work, &error), error));
        work_text_.clear();
        if (!governed) return Status::ok();
        if (width_ < state_.width) work_text_ = fmt::format("picture {} x {}  ", width_, height_);
        if (work.scale > 1 || work.temporal > 1)
            work_text_ +=
                fmt::format("1 of {0} x {0} pixels  ", std::max(work.scale, work.temporal));
        if (work.steps > 0) work_text_ += fmt::format("{} steps  ", work.steps);
        if (work.photons > 0) work_text_ += fmt::format("{} photons", work.photons);
        if (!sun_moved) return Status::ok();
        // Sunlight in the media may follow the sun over some frames, where the method can do that.
        PILEUS_TRY(of(pileus_session_work(drawn_->get(), &work, &error), error));
        if (work.light_refresh == 0) return Status::ok();
        work.light_refresh = std::max<std::uint32_t>(work.light_refresh, kSunFrames);
        return of(pileus_session_set_work(drawn_->get(), &work, &error), error);
    }

    Status frame() {
        const double start = window_.seconds();
        bool any = outcome_.frames == 0;
        Event event;
        while (!state_.ended && window_.poll(event)) apply(event, state_), any = true;
        if (state_.ended) return Status::ok();
        if (state_.method_changed) change_method();
        state_.method_changed = false;
        const bool sun_moved = state_.sun_moved, moved = state_.moved || sun_moved;
        // At rest nothing is left out, once the eye has adapted.
        const bool governed = moved || adapts_;
        choose_size(governed && !state_.screenshot);
        PILEUS_TRY(aim());
        if (!any && !unsettled_) {
            window_.wait(kRestSeconds);
            return Status::ok();
        }
        PILEUS_TRY(choose_work(governed, sun_moved));
        bool more = false;
        PILEUS_TRY(trace(moved, more));
        PILEUS_TRY(draw());
        if (state_.shown != Shown::kColour) show_debug();
        if (state_.screenshot) PILEUS_TRY(take_screenshot());
        state_.screenshot = false;
        const double now = window_.seconds();
        if (lit_ && outcome_.first_lit_s == 0) outcome_.first_lit_s = now;
        adapts_ = adapt(std::max(now - shown_at_, 1.0 / 240));
        // What was left out while things moved is made up for once they rest.
        unsettled_ = more || adapts_ || governed || any;
        times_.push_back(std::max(now - start, 1e-4));
        if (times_.size() > kShownTimes) times_.pop_front();
        if (width_ == state_.width && height_ == state_.height)
            shown_ = bytes_;
        else
            enlarge(bytes_, width_, height_, state_.width, state_.height, shown_);
        lay_over();
        PILEUS_TRY(window_.show(shown_.data(), state_.width, state_.height));
        const double end = window_.seconds();
        // A whole picture's time says nothing of the next flight's.
        if (governed) frame_s_ = end - start;
        if (moved && moved_before_) moving_.push_back(end - last_);
        moved_before_ = moved;
        last_ = end;
        shown_at_ = now;
        ++outcome_.frames;
        return Status::ok();
    }

    const Settings& settings_;
    Window& window_;
    Outcome& outcome_;
    State state_;
    std::unique_ptr<Drawn> drawn_;
    pileus_governor governor_{};
    Float3 irradiance_{1, 1, 1};
    std::vector<std::uint8_t> bytes_, shown_;  ///< as drawn; of the window's size
    int width_ = 0, height_ = 0;               ///< of what is drawn
    View seen_;                                ///< that the session has, and the size
    int seen_width_ = 0, seen_height_ = 0;
    Smaller smaller_;
    std::vector<float> depth_, linear_;
    Noise noise_;
    std::deque<double> times_;
    std::string units_, work_text_, message_;
    double stops_ = 0, frame_s_ = 0, shown_at_ = 0, last_ = 0;
    std::vector<double> moving_;  ///< from picture to picture while things move
    bool moved_before_ = false;
    int shown_method_ = 0;
    bool unsettled_ = true, lit_ = false, adapts_ = false;
};

}  // namespace

Status run(const Settings& settings, Window& window, Outcome& outcome) {
    return Viewer(settings, window, outcome).run();
}

}  // namespace pileus::view
