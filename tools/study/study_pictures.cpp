// SPDX-License-Identifier: Apache-2.0
// Reference, pictures, differences and FLIP maps of a scene as PNG for a page.
// in: pictures on the disk -> out: data URIs.
// docs/study.md, "Output"
#include <fmt/format.h>

#include "lab/compare/difference.h"
#include "lab/compare/flip.h"
#include "lab/compare/metrics.h"
#include "src/io/images/image_file.h"
#include "tools/study/study_report.h"

namespace pileus {

namespace {

constexpr double kFullDifference = 0.25;  // of the mean radiance

Status picture_uri(const Image& image, const ToneSettings& tone, std::string& uri) {
    Buffer<char> bytes;
    PILEUS_TRY(encode_image(image, "picture.png", tone, bytes));
    uri = "data:image/png;base64," + base64(bytes.data(), bytes.size());
    return Status::ok();
}

/// The exposure that suits the reference, as fixed stops for all pictures beside it.
Status measured_tone(const Image& image, ToneSettings& tone) {
    double stops = 0;
    tone = ToneSettings();
    tone.automatic = true;
    PILEUS_TRY(measured_stops(image, tone, stops));
    tone.automatic = false;
    tone.stops = float(stops);
    return Status::ok();
}

/// Red where the picture is too bright, blue where too dark, grey outside the cloud.
Status difference_uri(const Image& image, const Image& reference, double mean, std::string& uri) {
    Image values, colours;
    PILEUS_TRY(difference_picture(image, reference, MetricOptions().alpha_least, values));
    PILEUS_TRY(signed_colours(values, kFullDifference * mean, colours));
    return picture_uri(colours, ToneSettings(), uri);
}

Status flip_uri(const Image& image, const Image& reference, std::string& uri) {
    FlipResult eye;
    Image colours;
    PILEUS_TRY(flip(image, reference, FlipOptions(), eye));
    PILEUS_TRY(flip_colours(eye, colours));
    return picture_uri(colours, ToneSettings(), uri);
}

}  // namespace

Status scene_pictures(const Study& study, const SceneResult& scene, ScenePictures& pictures) {
    pictures = ScenePictures();
    if (!scene.fault.empty()) return Status::ok();
    Image halves[2], reference;
    for (int h = 0; h < 2; ++h) PILEUS_TRY(read_image(scene.half_image[h], halves[h]));
    PILEUS_TRY(merge_halves(halves[0], halves[1], reference));
    ToneSettings tone;
    PILEUS_TRY(measured_tone(reference, tone));
    PILEUS_TRY(picture_uri(reference, tone, pictures.reference));
    for (const CurveResult& curve : scene.curves) {
        const StudyPoint& point = curve.points.back();
        Image image;
        PILEUS_TRY(read_image(point.image, image));
        PictureRow row;
        row.title = study.curves[std::size_t(curve.curve)].title;
        row.note = fmt::format("{}, {} CPU, relMSE {}, FLIP {}", point.budget_text,
                               seconds_text(point.cpu_s), number_short(point.error.relmse),
                               number_short(point.flip_mean));
        PILEUS_TRY(picture_uri(image, tone, row.picture));
        PILEUS_TRY(difference_uri(image, reference, scene.reference.mean, row.difference));
        PILEUS_TRY(flip_uri(image, reference, row.flip));
        pictures.rows.push_back(std::move(row));
    }
    pictures.note = fmt::format(
        "All pictures of a scene have the reference's exposure ({:+.1f} stops). Difference: red "
        "too bright, blue too dark, full colour at {:.0f} % of the cloud's mean radiance. "
        "HDR-FLIP: black where an eye sees no difference, pale yellow at the most (1).",
        double(tone.stops), 100 * kFullDifference);
    return Status::ok();
}

}  // namespace pileus
