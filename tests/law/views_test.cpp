// SPDX-License-Identifier: Apache-2.0
// Views against their definition: counts, places and values that can be worked out beforehand.
// in: small scenes -> out: pixels and counters.
// docs/how-it-works.md
#include <cmath>

#include "kernels_cpu/display/tone.h"
#include "lab/views/canvas.h"
#include "lab/views/colours.h"
#include "lab/views/follow.h"
#include "lab/views/show_walk.h"
#include "lab/views/view_list.h"
#include "tests/law/prepare_fields.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

/// A cube of density 1, 140 m wide, seen along +y without perspective: 1 m a pixel, the cube from
/// x = -70 to 70 and z = 0 to 140 fills the picture. Voxels of 10 m; nothing outside.
const char* const kCube = R"(
seed = 3
[camera]
position_m = [0, -500, 70]
target_m = [0, 0, 70]
projection = "orthographic"
height_m = 140
resolution = [140, 140]
[sun]
elevation_deg = 40
[[medium]]
density = "uniform:box"
bounds_m = [[-70, -70, 0], [70, 70, 140]]
resolution = [14, 14, 14]
extinction_per_m = 0.05
[collectors]
photons = 20_000
generations = 4
samples = 700
)";

const char* const kCloud = R"(
seed = 5
[camera]
position_m = [0, -3000, 600]
target_m = [0, 0, 1080]
fov_deg = 40
resolution = [96, 54]
[sun]
azimuth_deg = 120
elevation_deg = 35
[ground]
altitude_m = 0
albedo = 0.25
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-800, -800, 600], [800, 800, 1700]]
resolution = [32, 32, 22]
extinction_per_m = 0.05
albedo = 0.99
phase = { type = "henyey-greenstein", g = 0.85 }
[collectors]
photons = 20_000
generations = 4
samples = 1_500
)";

Picture show(const Scene& scene, const char* view) {
    RenderOptions options;
    options.show = view;
    options.find_view = find_view;
    Picture picture;
    const Status status = render(scene, options, [&](int, Image& image, Report& report) {
        picture.image = std::move(image);
        picture.report = report;
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    return picture;
}

float largest(const Channel& c) {
    float most = 0;
    for (float v : c.pixels.span()) most = v > most ? v : most;
    return most;
}

CameraParams square_camera(int side) {
    CameraParams c{};
    c.right[0] = c.up[2] = c.forward[1] = 1;
    c.half_width = c.half_height = 1;
    c.width = c.height = side;
    c.orthographic = 1;
    return c;
}

double covered(const Canvas& canvas) {
    double sum = 0;
    for (std::size_t i = 0; i < canvas.rgb.size(); i += 3) sum += double(canvas.rgb[i]);
    return sum;
}

}  // namespace

TEST_CASE("views: a canvas gives a disc and a line their areas") {
    Canvas canvas;
    REQUIRE(make_canvas(64, 64, {0, 0, 0}, canvas));
    const Disc disc{31.3, 30.8, 0, 10, 1, {1, 1, 1}, false};
    draw_discs({&disc, 1}, 1, canvas);
    // The ramp across the edge is a midpoint rule: 1 % of the area for a radius of ten pixels.
    CHECK(covered(canvas) == doctest::Approx(3.14159265 * 100).epsilon(0.01));
    for (const float width : {0.3f, 1.0f, 3.0f}) {
        REQUIRE(make_canvas(64, 64, {0, 0, 0}, canvas));
        const Line line{8, 11.5, 56, 37.5, 0, width, 1, {1, 1, 1}};
        draw_lines({&line, 1}, 1, canvas);
        const double length = std::sqrt(48.0 * 48.0 + 26.0 * 26.0);
        // Half discs at the ends add up to 4.3 % for a width of three; midpoints err by under 3 %.
        CAPTURE(width);
        CHECK(covered(canvas) / length > 0.97 * double(width));
        CHECK(covered(canvas) / length < 1.07 * double(width));
    }
}

TEST_CASE("views: marks blend over each other, the nearest last") {
    Canvas canvas;
    REQUIRE(make_canvas(8, 8, {0, 0, 0}, canvas));
    Disc discs[3] = {{4, 4, 1, 3, 1, {1, 0, 0}, false},
                     {4, 4, 9, 3, 1, {0, 1, 0}, false},
                     {4, 4, 1, 3, 0.5f, {0, 0, 1}, false}};
    sort_by_depth(Span<Disc>{discs, 3});
    draw_discs({discs, 3}, 1, canvas);
    const float* pixel = canvas.rgb.data() + 3 * (4 * 8 + 4);
    // The farthest is hidden; the equal ones keep their order.
    CHECK(pixel[0] == 0.5f);
    CHECK(pixel[1] == 0.0f);
    CHECK(pixel[2] == 0.5f);
}

TEST_CASE("views: points and lines land where the camera's rays come from") {
    CameraParams c = square_camera(100);
    for (int flat = 0; flat < 2; ++flat) {
        c.orthographic = flat;
        const Ray<float> ray = camera_ray(c, 30.0f, 80.0f);
        const double t = 7;
        const double at[3] = {double(ray.origin.x) + t * double(ray.direction.x),
                              double(ray.origin.y) + t * double(ray.direction.y),
                              double(ray.origin.z) + t * double(ray.direction.z)};
        const Projected p = project_point(c, at);
        REQUIRE(p.visible);
        CHECK(p.x == doctest::Approx(30.5).epsilon(1e-5));  // single precision of the ray
        CHECK(p.y == doctest::Approx(80.5).epsilon(1e-5));
    }
    c.orthographic = 0;
    const double behind[3] = {0.1, -1, 0.2}, ahead[3] = {0.1, 1, 0.2}, farther[3] = {3, -9, 1};
    CHECK_FALSE(project_point(c, behind).visible);
    Line line{};
    CHECK_FALSE(project_line(c, behind, farther, line));
    REQUIRE(project_line(c, behind, ahead, line));
    CHECK(line.x1 == doctest::Approx(55));
    CHECK(line.y0 < -1000);  // runs out of the picture towards the camera
}

TEST_CASE("views: a walk meets all voxels of a ray once and fills its length") {
    const Grid grid{{7, 5, 4}, {1.0f, 2.0f, 0.5f}};
    int walks = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const auto random = [&](std::uint32_t k) { return prepare_test::noise(17, 8 * i + k); };
        Vec<float> d{random(0) - 0.5f, random(1) - 0.5f, random(2) - 0.5f};
        if (i % 7 == 0) d.x = 0;
        if (i % 11 == 0) d.z = 0;
        const Ray<float> ray{{random(3) * 12 - 3, random(4) * 16 - 3, random(5) * 6 - 2},
                             normalized(d)};
        const float extent[3] = {7, 10, 2};
        const Segment<float> box = clip_to_box(ray.origin, ray.direction, extent);
        double sum = 0, last = -1;
        std::size_t before = ~std::size_t{0};
        walk_grid(grid, ray, [&](const WalkStep& s) {
            CHECK(s.voxel < voxel_count(grid));
            CHECK(s.voxel != before);
            if (last >= 0) CHECK(s.enter == last);
            // The middle of the stretch lies in the voxel, but for a rounding of its borders.
            const double t = 0.5 * (s.enter + s.leave);
            const double at[3] = {double(ray.origin.x) + t * double(ray.direction.x),
                                  double(ray.origin.y) + t * double(ray.direction.y),
                                  double(ray.origin.z) + t * double(ray.direction.z)};
            for (int a = 0; a < 3; ++a) {
                CHECK(at[a] > double(grid.cell_m[a]) * s.at[a] - 1e-5);
                CHECK(at[a] < double(grid.cell_m[a]) * (s.at[a] + 1) + 1e-5);
            }
            before = s.voxel;
            last = s.leave;
            sum += s.leave - s.enter;
            return true;
        });
        const double length = std::max(0.0, double(box.leave) - double(box.enter));
        CHECK(sum == doctest::Approx(length).epsilon(1e-4).scale(1));  // float clip, double walk
        walks += sum > 0 ? 1 : 0;
    }
    CHECK(walks > 400);
}

TEST_CASE("views: colours keep to the display's range, and 8-bit codes come back") {
    for (std::uint32_t code = 0; code < 256; ++code) CHECK(srgb_code(linear_of_code(code)) == code);
    float before = -1;
    for (int i = -10; i <= 1010; ++i) {
        const Float3 c = map_colour(ColourMap::kHeat, float(i) / 1000);
        for (float v : c) CHECK((v >= 0 && v <= 1));
        const float light = luminance(Rgb<float>{c[0], c[1], c[2]});
        CHECK(light >= before);  // a map of amounts must not turn back
        before = light;
    }
    CHECK(map_colour(ColourMap::kHeat, NAN) == map_colour(ColourMap::kHeat, 0));
}

TEST_CASE("views: gradient shows the field's largest value, at the cube's faces") {
    const Scene scene = scene_from(kCube);
    const Picture p = show(scene, "gradient");
    const Channel* value = p.image.find("value");
    REQUIRE(value != nullptr);
    // At a corner of the cube three faces meet: 1 / (2 h) along each axis, h = 10 m.
    CHECK(largest(*value) == doctest::Approx(std::sqrt(3.0) / 20).epsilon(1e-6));
    CHECK(p.at("value", 3, 3) == largest(*value));
    CHECK(p.at("value", 136, 136) == largest(*value));
    // Through the middle of a face only that face counts.
    CHECK(p.at("value", 70, 70) == doctest::Approx(0.05).epsilon(1e-6));
    CHECK(p.at("R", 3, 3) > p.at("R", 70, 70));
    CHECK(p.report.prepared.samples == 0);
    CHECK(p.report.photons.traced == 0);
    CHECK(p.report.plan.needed == std::vector<std::string>{"gradient"});
}

TEST_CASE("views: slices show the field on the plane through the middle") {
    const Scene scene = scene_from(kCube);
    const Picture density = show(scene, "density-slice");
    CHECK(density.at("value", 70, 70) == 1.0f);
    CHECK(density.report.plan.needed.empty());
    const Picture gradient = show(scene, "gradient-slice");
    CHECK(gradient.at("value", 70, 70) == 0.0f);
    CHECK(gradient.at("value", 70, 4) == doctest::Approx(0.05).epsilon(1e-6));
    CHECK(gradient.at("R", 70, 4) > gradient.at("R", 70, 70));
}

TEST_CASE("views: samples draws each sample") {
    const Scene scene = scene_from(kCube);
    const Picture p = show(scene, "samples");
    CHECK(p.counter("samples_drawn") == 700);
    CHECK(p.report.prepared.samples == 700);
    CHECK(p.report.prepared.leaves == 0);
    Scene lonely = scene;
    lonely.collectors.placement.samples = 1;
    const Picture one = show(lonely, "samples");
    CHECK(one.counter("samples_drawn") == 1);
    CHECK(one.image.pixel_hash != p.image.pixel_hash);
}

TEST_CASE("views: leaves of the tree tile the grid") {
    for (const char* text : {kCube, kCloud}) {
        const Scene scene = scene_from(text);
        const Picture p = show(scene, "tree");
        const auto& n = scene.media[0].box.resolution;
        CHECK(p.counter("voxels_in_leaves") ==
              std::uint64_t(n[0]) * std::uint64_t(n[1]) * std::uint64_t(n[2]));
        CHECK(p.counter("leaves_drawn") == p.report.prepared.leaves);
        CHECK(p.counter("leaves_cut") > 0);
        CHECK(p.counter("leaves_cut") < p.report.prepared.leaves);
        CHECK(show(scene, "leaf-density").counter("leaves_drawn") == p.report.prepared.collectors);
        const Picture balls = show(scene, "collectors");
        CHECK(balls.counter("collectors") == p.report.prepared.collectors);
        CHECK(balls.counter("collectors_drawn") < p.report.prepared.collectors);
        CHECK(balls.counter("collectors_drawn") > 0);
    }
}

TEST_CASE("views: leaves of one density have one colour on the cut") {
    // Density 1 and 200 optical depths a voxel: the cut alone shows, in the brightest colour.
    const Picture p = show(scene_from(kCube, {"medium.0.extinction_per_m=5"}), "leaf-density");
    const Float3 full = map_colour(ColourMap::kHeat, 1);
    float most = 0;
    for (int y = 60; y < 80; ++y)
        for (int x = 60; x < 80; ++x) most = std::max(most, p.at("R", x, y));
    CHECK(most == doctest::Approx(double(full[0])).epsilon(1e-6));
}

TEST_CASE("views: illumination is the picture's light on the picture's collectors") {
    const Scene scene = scene_from(kCloud, {"collectors.display=\"billboards\""});
    const Picture picture = render_one(scene), lit = show(scene, "illumination");
    const auto colours = [](const Picture& p) {
        for (const auto& d : p.report.digests)
            if (d.first == "colours") return d.second;
        return std::string();
    };
    CHECK(colours(lit).size() == 16);
    CHECK(colours(lit) == colours(picture));
    CHECK(lit.report.photons.traced == picture.report.photons.traced);
    CHECK(lit.counter("collectors_drawn") == lit.report.prepared.collectors);
}

TEST_CASE("views: followed photons are the photons that were traced") {
    // Every fate of a generation, photon by photon, adds up to the tracer's ledger.
    const Scene scene = scene_from(
        kCloud, {"collectors.photons=160", "collectors.generations=1", "medium.0.albedo=0.9"});
    const Picture picture = render_one(scene);
    const EnergyRow& row = picture.report.photons.energy.at(0);
    REQUIRE(row.light == "sun");
    RenderOptions options;
    double top = 0, bottom = 0, sides = 0, absorbed = 0, ground = 0;
    std::uint32_t n = 0;
    PhotonWay way;
    for (; follow(scene, options, 0, n, way); ++n) {
        REQUIRE(way.points.size() >= 2);
        const PathEvent end = way.points.back().event;
        top += end == PathEvent::kTop;
        bottom += end == PathEvent::kBottom;
        sides += end == PathEvent::kSides;
        absorbed += end == PathEvent::kAbsorbed;
        ground += end == PathEvent::kLost;
    }
    REQUIRE(n > 60);
    CHECK(top / n == doctest::Approx(row.top).epsilon(1e-12));
    CHECK(bottom / n == doctest::Approx(row.bottom).epsilon(1e-12));
    CHECK(sides / n == doctest::Approx(row.sides).epsilon(1e-12));
    CHECK(absorbed / n == doctest::Approx(row.absorbed).epsilon(1e-12));
    CHECK(ground / n == doctest::Approx(row.ground + row.sky).epsilon(1e-12));
}
