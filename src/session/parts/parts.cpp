// SPDX-License-Identifier: Apache-2.0
// See parts.h.
#include "src/session/parts/parts.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "platform/fp_mode.h"
#include "platform/threads.h"
#include "src/io/images/image_file.h"
#include "src/plan/crop.h"
#include "src/scene/method_column.h"
#include "src/scene/read_scene.h"
#include "src/session/deliver.h"
#include "src/session/run_context.h"
#include "src/session/session.h"
#include "src/session/warnings.h"

namespace pileus {
namespace {

Status check_work(const Scene& scene, const RenderOptions& options) {
    const auto refuse = [](const char* what, const char* allowed) {
        return Status::bad_input(std::string("--part: ") + what + ", allowed: " + allowed);
    };
    if (scene.clouds.present())
        return refuse("a sky of [[clouds]] has whole frames", "--frames A-B of a film");
    if (options.budget.seconds > 0 || aims_at_error(scene, options.budget))
        return refuse("no part knows how far the others are",
                      "a number of samples, photons or steps in place of an error or a time");
    if (!options.budget.state.empty())
        return refuse("together with --state", "one of both: a part is its own state");
    if (options.verify > 0 || !options.show.empty())
        return refuse("together with --verify or --show", "a picture's light");
    if (scene.animation.is_film()) return refuse("a film is divided by frames", "--frames A-B");
    const UpsampleSettings& thin = scene.raymarch.thin;
    if (method_column(scene) == MethodColumn::kRaymarch && thin.every() > 1)
        return refuse("pixels of raymarch.scale and temporal look at rows of other parts",
                      "raymarch.scale = 1");
    return Status::ok();
}

/// What lies in no pixel: places on a map.
bool of_place(const std::string& name) {
    return name == "world_file" || name == "extent_m" || name == "projection";
}

/// Names and texts that all parts have in common.
std::vector<std::pair<std::string, std::string>> common_of(const Part& part, bool means) {
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto& told : part.rows.origin)
        if (!means || told.first != "seed") out.push_back(told);
    return out;
}

Status foreign(const Part& part, const std::string& what, const Part& first) {
    return Status::bad_input(part.name + ": part: " + what + ", allowed: that of " + first.name);
}

/// `part` of the same work as `first`, but for its number.
Status check_alike(const Part& part, const Part& first, bool means) {
    if (part.rows.scene_text != first.rows.scene_text) return foreign(part, "another scene", first);
    if (part.part.count != first.part.count)
        return foreign(part, "one of " + std::to_string(part.part.count), first);
    if (part.division != first.division || part.frame != first.frame)
        return foreign(part, "another frame or method", first);
    const auto own = common_of(part, means), others = common_of(first, means);
    for (std::size_t i = 0; i < own.size() && i < others.size(); ++i)
        if (own[i] != others[i])
            return foreign(part, "another " + own[i].first + ", " + own[i].second, first);
    if (own.size() != others.size()) return foreign(part, "other options", first);
    return Status::ok();
}

/// The rows of a part into the window's image.
void put_rows(const Image& rows, const std::vector<int>& lines, Image& image) {
    const std::size_t width = std::size_t(image.width);
    for (std::size_t c = 0; c < image.channels.size(); ++c)
        for (std::size_t i = 0; i < lines.size(); ++i)
            std::memcpy(image.channels[c].pixels.data() + std::size_t(lines[i]) * width,
                        rows.channels[c].pixels.data() + i * width, width * sizeof(float));
}

/// The pictures of several seeds, each with its layers, become their mean.
Status mean_of(std::vector<Image>& images) {
    Image& mean = images[0];
    const double count = double(images.size());
    for (std::size_t c = 0; c < mean.channels.size(); ++c) {
        // Errors are of pictures that know nothing of one another.
        const bool squares = mean.channels[c].name.rfind("error.", 0) == 0;
        Buffer<float>& out = mean.channels[c].pixels;
        for (const Image& image : images)
            if (image.channels.size() != mean.channels.size() ||
                image.channels[c].pixels.size() != out.size())
                return Status::bad_input("merge: pictures of several seeds differ in their layers");
        for (std::size_t i = 0; i < out.size(); ++i) {
            double sum = 0;
            bool same = true;
            for (const Image& image : images) {
                const float v = image.channels[c].pixels[i];
                same = same && v == out[i];
                sum += squares ? double(v) * double(v) : double(v);
            }
            if (squares)
                out[i] = float(__builtin_sqrt(sum) / count);
            else if (!same)
                out[i] = float(sum / count);
        }
    }
    return Status::ok();
}

/// What the report tells of the mean.
void tell_mean(const Image& mean, const std::vector<Report>& reports, Report& report) {
    report = reports[0];
    for (std::size_t i = 1; i < reports.size(); ++i) {
        report.photons.traced += reports[i].photons.traced;
        report.photons.generations += reports[i].photons.generations;
        report.events.scatterings += reports[i].events.scatterings;
    }
    const Channel* error = mean.find("error.G");
    if (error == nullptr) return;
    ErrorSum sum;
    const Channel &alpha = *mean.find("A"), &light = *mean.find("G");
    for (std::size_t i = 0; i < error->pixels.size(); ++i)
        sum.add(1 - alpha.pixels[i], error->pixels[i], light.pixels[i]);
    report.errors.mean_relative = sum.mean_relative();
    report.errors.rmse_estimate = sum.rms();
}

/// A picture whose rows are finished.
Status merge_rows(const Scene& described, const RenderOptions& options,
                  const std::vector<Part>& parts, const FrameSink& sink) {
    const RunStart start;
    Report report;
    PILEUS_TRY(plan_scene(described, options, false, report));
    Scene scene = described;
    const Shown shown = take_window(scene);
    const Camera& camera = scene.camera;
    const Part* model = nullptr;
    for (const Part& part : parts)
        if (model == nullptr && !part.rows.channels.empty()) model = &part;
    if (model == nullptr) return Status::bad_input(parts[0].name + ": part: no rows");
    Image image;
    image.width = camera.resolution[0];
    image.height = camera.resolution[1];
    image.world_to_camera = model->rows.world_to_camera;
    image.world_to_ndc = model->rows.world_to_ndc;
    image.screen_window_width = model->rows.screen_window_width;
    const std::uint64_t pixels = std::uint64_t(image.width) * std::uint64_t(image.height);
    for (const Channel& channel : model->rows.channels) {
        image.channels.push_back({channel.name, {}});
        PILEUS_TRY(image.channels.back().pixels.resize(pixels, "merged picture"));
    }
    for (const Part& part : parts) {
        const std::vector<int> lines = rows_of(camera, part.part);
        if (lines.empty()) continue;
        const bool sized = part.rows.width == image.width &&
                           part.rows.height == int(lines.size()) &&
                           part.rows.channels.size() == image.channels.size();
        if (!sized) return foreign(part, "rows of another size", *model);
        put_rows(part.rows, lines, image);
    }
    PILEUS_TRY(cut_image(camera, shown, image));
    for (const auto& told : model->rows.origin)
        if (of_place(told.first)) image.origin.push_back(told);
    report.counters.clear();
    for (const auto& count : model->counters) {
        std::uint64_t sum = 0;
        for (const Part& part : parts)
            for (const auto& own : part.counters)
                if (own.first == count.first) sum += own.second;
        report.counters.emplace_back(count.first, sum);  // as long as the parts are there
    }
    report.hash = pixel_hash(image);
    report.digests = {{"image", report.hash}};
    report.budget_used = model->told("budgetUsed");
    find_warnings(described, image, report);
    return deliver(described, start, parts[0].frame, sink, image, report);
}

/// Light of paths and photons, which a session then shows.
Status merge_light(const Scene& scene, const RenderOptions& options, const Part* parts,
                   std::size_t count, const FrameSink& sink) {
    Scene window = scene;
    (void)take_window(window);
    RenderOptions own = options;
    own.parts = [&](MethodReport& of) {
        bool counted = false;
        for (std::size_t i = 0; i < count; ++i) {
            const Part& part = parts[i];
            const std::vector<int> lines = rows_of(window.camera, part.part);
            const bool photons = part.division == Division::kPhotons;
            // Rows that there are not, and photons that an earlier part has.
            if (photons ? part.light.sums.empty() : lines.empty()) continue;
            Status status =
                of.add_light(part.light, lines, photons ? !counted : part.part.is_first());
            counted = true;
            if (!status) {
                status.message = part.name + ": part: " + status.message;
                return status;
            }
        }
        return Status::ok();
    };
    return render(scene, own, sink);
}

}  // namespace

std::string Part::told(const std::string& wanted) const {
    for (const auto& [own, text] : rows.origin)
        if (own == wanted) return text;
    return "";
}

void note_part(const Scene& scene, const Report& report, Image& told) {
    Image all;
    note_origin(report, all);
    // How much light there is, the light itself says.
    for (auto& entry : all.origin)
        if (entry.first != "generations" && entry.first != "samplesPerPixel")
            told.origin.push_back(std::move(entry));
    told.scene_text = scene.text;
}

Status render_part(const Scene& described, const RenderOptions& options, Part& out) {
    const FpModeGuard guard;
    ThreadPool threads;
    const PoolGuard lent(threads);
    PILEUS_TRY(check_work(described, options));
    PILEUS_TRY(check_crop(described, options.budget, false));
    Scene scene = described;
    (void)take_window(scene);
    MethodRow row;
    PILEUS_TRY(find_method(scene, row));
    RenderOptions own = options;
    own.digests = true;
    own.part.given = row.division != Division::kRows;
    bool empty = false;
    if (row.division != Division::kPhotons) {
        empty = rows_of(scene.camera, options.part).empty();
        // Some camera there must be for the plan.
        if (!empty) take_rows(options.part, scene.camera);
    }
    out.division = row.division;
    out.part = options.part;
    out.frame = options.first_frame;
    Session session;
    PILEUS_TRY(session.open_film(scene, opened_at(scene, out.frame), own, !empty, nullptr));
    Report& report = session.report();
    const FilmFrame step{out.frame, true, true};
    if (!empty && row.division == Division::kRows)
        PILEUS_TRY(draw_frame(scene, session, step, out.rows));
    else if (!empty)
        PILEUS_TRY(session.render_light(step, out.light));
    if (!empty) session.finish_report();
    if (!empty) out.world = session.scenery().world;
    report.frame = out.frame;
    for (const auto& [name, count] : report.counters)
        out.counters.emplace_back(std::string(name), count);
    note_part(described, report, out.rows);
    return Status::ok();
}

Status fold_photons(std::vector<Part>& parts) {
    Part& last = parts.back();
    if (last.division != Division::kPhotons) return Status::ok();
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        PartLight& to = parts[i].light;
        const bool alike = parts[i].division == last.division && !to.sums.empty() &&
                           to.sums.size() == last.light.sums.size() && to.same == last.light.same &&
                           to.first == last.light.first &&
                           parts[i].told("seed") == last.told("seed");
        if (!alike) continue;
        for (std::size_t k = 0; k < to.sums.size(); ++k)
            if (__builtin_add_overflow(to.sums[k], last.light.sums[k], &to.sums[k]))
                return Status::limit(last.name + ": part: too much light for 64-bit sums");
        last.light.sums = Buffer<std::int64_t>();
        return Status::ok();
    }
    return Status::ok();
}

Status check_one_work(const Part& part, const Part& first) {
    return check_alike(part, first, false);
}

Status check_parts(bool means, std::vector<Part>& parts) {
    if (parts.empty()) return Status::bad_input("merge: no parts, allowed: one or more files");
    for (const Part& part : parts) PILEUS_TRY(check_alike(part, parts[0], means));
    const auto seed = [](const Part& part) {
        const std::string text = part.told("seed");
        return std::make_pair(text.size(), text);
    };
    std::stable_sort(parts.begin(), parts.end(), [&](const Part& a, const Part& b) {
        const auto x = seed(a), y = seed(b);
        return x != y ? x < y : a.part.index < b.part.index;
    });
    const std::uint32_t count = parts[0].part.count;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        const bool again =
            i > 0 && seed(parts[i - 1]) == seed(part) && parts[i - 1].part.index == part.part.index;
        if (again)
            return Status::bad_input(part.name + ": part: " + std::to_string(part.part.index + 1) +
                                     " is there twice, in " + parts[i - 1].name +
                                     ", too, allowed: each once");
        const Part& begin = parts[i - i % count];
        const bool lit = !part.light.same.empty() && !begin.light.same.empty();
        if (lit && seed(begin) == seed(part) && part.light.same != begin.light.same)
            return foreign(part, "of another picture or number of samples", begin);
        const std::uint32_t wanted = std::uint32_t(i % count);
        if (part.part.index != wanted)
            return Status::bad_input("merge: part " + std::to_string(wanted + 1) + " of " +
                                     std::to_string(count) + " is missing, allowed: all");
    }
    if (parts.size() % count != 0)
        return Status::bad_input("merge: part " + std::to_string(parts.size() % count + 1) +
                                 " of " + std::to_string(count) + " is missing, allowed: all");
    if (parts.size() > count && parts[0].division == Division::kRows)
        return Status::bad_input(parts[0].name +
                                 ": part: pictures of this method have no noise, allowed: parts of "
                                 "one work, without --mean");
    return Status::ok();
}

Status merge_parts(const Scene& scene, const RenderOptions& options, const std::vector<Part>& parts,
                   const FrameSink& sink) {
    const Division division = parts[0].division;
    if (division == Division::kFlux)
        return Status::bad_input(parts[0].name +
                                 ": part: of pileus flux, allowed: pileus flux SCENE --merge");
    if (division == Division::kRows) return merge_rows(scene, options, parts, sink);
    const std::size_t count = parts[0].part.count, works = parts.size() / count;
    if (works == 1) return merge_light(scene, options, parts.data(), count, sink);
    std::string seeds;
    for (std::size_t i = 0; i < parts.size(); i += count)
        seeds += (seeds.empty() ? "" : " ") + parts[i].told("seed");
    const FrameSink told = [&](int frame, Image& image, Report& report) {
        image.origin.emplace_back("seeds", seeds);
        return sink(frame, image, report);
    };
    // Samples of a pixel are alike whatever their seed; places of collectors are the seed's own.
    if (division == Division::kPaths)
        return merge_light(scene, options, parts.data(), parts.size(), told);
    std::vector<Image> images;
    std::vector<Report> reports;
    for (std::size_t w = 0; w < works; ++w) {
        Scene own = scene;
        std::int64_t seed = 0;
        const std::string text = parts[w * count].told("seed");
        std::from_chars(text.data(), text.data() + text.size(), seed);
        own.seed = seed;
        PILEUS_TRY(merge_light(own, options, parts.data() + w * count, count,
                               [&](int, Image& image, Report& report) {
                                   images.push_back(std::move(image));
                                   reports.push_back(report);
                                   return Status::ok();
                               }));
    }
    PILEUS_TRY(mean_of(images));
    Report report;
    tell_mean(images[0], reports, report);
    report.hash = images[0].pixel_hash = pixel_hash(images[0]);
    for (auto& digest : report.digests)
        if (digest.first == "image") digest.second = report.hash;
    return told(parts[0].frame, images[0], report);
}

}  // namespace pileus
