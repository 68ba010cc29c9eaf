// SPDX-License-Identifier: Apache-2.0
// Parts of a frame make the picture of one run: every bit of every layer, for any number of parts.
// in: the scenes of assets/scenes/identity -> out: equal pixels; one line for what does not fit.
// docs/farm.md
#include "src/session/parts/parts.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

Scene identity_scene(const std::string& file, std::vector<std::string> set = {}) {
    set.insert(set.end(), {"path.target_error=0", "path.samples_per_pixel=3"});
    Scene scene;
    const Status read = read_scene_file(file, set, scene);
    REQUIRE_MESSAGE(read, read.message);
    return scene;
}

/// Parts as a file brings them back.
std::vector<Part> parts_of(const Scene& scene, std::uint32_t count) {
    std::vector<Part> parts;
    for (std::uint32_t i = 0; i < count; ++i) {
        Part part, back;
        RenderOptions options;
        options.part = {(i * 7 + 3) % count, count, true};
        if (count % 7 == 0) options.part.index = i;
        const Status status = render_part(scene, options, part);
        REQUIRE_MESSAGE(status, status.message);
        Buffer<char> bytes;
        REQUIRE(encode_part(part, bytes));
        const Status read = decode_part("p.part", bytes.span(), back);
        REQUIRE_MESSAGE(read, read.message);
        parts.push_back(std::move(back));
        // As merge does: some are added as they come.
        if (i % 2 == 1) REQUIRE(fold_photons(parts));
    }
    return parts;
}

Picture merged(const Scene& scene, std::vector<Part> parts, bool means = false) {
    const Status sound = check_parts(means, parts);
    REQUIRE_MESSAGE(sound, sound.message);
    Picture picture;
    const Status status = merge_parts(scene, {}, parts, [&](int, Image& image, Report& report) {
        picture.image = std::move(image);
        picture.report = report;
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    return picture;
}

void check_same(const Picture& a, const Picture& b) {
    CHECK(a.report.hash == b.report.hash);
    REQUIRE(a.image.channels.size() == b.image.channels.size());
    for (std::size_t c = 0; c < a.image.channels.size(); ++c) {
        const Channel &x = a.image.channels[c], &y = b.image.channels[c];
        CAPTURE(x.name);
        CHECK(x.name == y.name);
        REQUIRE(x.pixels.size() == y.pixels.size());
        CHECK(std::memcmp(x.pixels.data(), y.pixels.data(), x.pixels.bytes()) == 0);
    }
    CHECK(a.report.photons.traced == b.report.photons.traced);
    CHECK(a.report.events.scatterings == b.report.events.scatterings);
    CHECK(a.report.errors.mean_relative == b.report.errors.mean_relative);
}

/// Neither a film nor a sky of clouds nor thinned out.
bool has_parts(const Scene& scene) {
    const bool film = scene.animation.present && scene.animation.frames > 1;
    const bool thin = scene.method == "raymarch" && scene.raymarch.thin.every() > 1;
    return !film && !thin && !scene.clouds.present();
}

std::string refusal(std::vector<Part> parts, bool means = false) {
    return check_parts(means, parts).message;
}

}  // namespace

TEST_CASE("parts: the bits of one run, in every scene of the identity set") {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator("assets/scenes/identity"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    constexpr std::uint32_t kCounts[] = {2, 3, 5, 16, 1};
    std::size_t turn = 0, checked = 0;
    for (const std::string& file : files) {
        CAPTURE(file);
        const Scene scene = identity_scene(file);
        if (!has_parts(scene)) continue;
        const std::uint32_t count = kCounts[turn++ % 5];
        CAPTURE(count);
        RenderOptions options;
        Picture whole;
        const Status status = render(scene, options, [&](int, Image& image, Report& report) {
            whole.image = std::move(image);
            whole.report = report;
            return Status::ok();
        });
        REQUIRE_MESSAGE(status, status.message);
        check_same(whole, merged(scene, parts_of(scene, count)));
        ++checked;
    }
    CHECK(checked >= 20);
}

TEST_CASE("parts: of a crop, and of pictures with layers of their own") {
    for (const char* method : {"path", "raymarch", "collectors"}) {
        CAPTURE(method);
        const Scene scene = scene_from(
            kSmallCumulus,
            {std::string("method.name=") + method, "camera.crop=[3, 2, 20, 13]",
             "path.samples_per_pixel=4",
             std::string("output.layers=[\"depth\", \"cloud\", \"reflectance\", \"shadow\"") +
                 (std::string(method) == "raymarch" ? "]" : ", \"error\"]")});
        check_same(render_one(scene), merged(scene, parts_of(scene, 3)));
    }
}

TEST_CASE("parts: the mean of several seeds is that of all samples") {
    Scene a = scene_from(kSmallCumulus, {"method.name=path", "path.samples_per_pixel=4"});
    Scene b = a;
    b.seed = 5;
    std::vector<Part> both = parts_of(a, 2);
    for (Part& part : parts_of(b, 2)) both.push_back(std::move(part));
    const Picture mean = merged(a, std::move(both), true), first = render_one(a),
                  second = render_one(b);
    CHECK(mean.report.paths.samples_per_pixel == 8);
    const float* x = first.image.find("G")->pixels.data();
    const float* y = second.image.find("G")->pixels.data();
    const float* m = mean.image.find("G")->pixels.data();
    double worst = 0;
    for (std::size_t i = 0; i < mean.image.find("G")->pixels.size(); ++i)
        worst = std::fmax(worst, std::fabs(double(m[i]) - 0.5 * (double(x[i]) + double(y[i]))));
    // Two roundings of floats of about 1.
    CHECK(worst < 2e-7);
    CHECK(sum_of(mean, "G").error < 0.8 * sum_of(first, "G").error);
    // Of photons the pictures: collectors of another seed lie elsewhere.
    Scene c = scene_from(kSmallCumulus), d = c;
    d.seed = 5;
    std::vector<Part> photons = parts_of(c, 3);
    for (Part& part : parts_of(d, 3)) photons.push_back(std::move(part));
    const Picture one = render_one(c), two = render_one(d),
                  both_lit = merged(c, std::move(photons), true);
    CHECK(both_lit.report.photons.traced == one.report.photons.traced + two.report.photons.traced);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < one.image.find("G")->pixels.size(); ++i) {
        const auto of = [&](const Picture& p, const char* name) {
            return double(p.image.find(name)->pixels[i]);
        };
        wrong += of(both_lit, "G") != double(float(0.5 * (of(one, "G") + of(two, "G"))));
        wrong += of(both_lit, "A") != of(one, "A");
        const double error = 0.5 * std::hypot(of(one, "error.G"), of(two, "error.G"));
        wrong += std::fabs(of(both_lit, "error.G") - error) > 1e-6 * error;
    }
    CHECK(wrong == 0);
}

TEST_CASE("parts: what does not belong together is refused in one line") {
    const Scene scene = scene_from(kSmallCumulus, {"method.name=path", "path.samples_per_pixel=2"});
    std::vector<Part> parts = parts_of(scene, 3);
    const auto copy = [](const Part& part) {
        Buffer<char> bytes;
        Part out;
        REQUIRE(encode_part(part, bytes));
        REQUIRE(decode_part("copy.part", bytes.span(), out));
        return out;
    };
    const auto with = [&](std::size_t without, std::vector<const Part*> more) {
        std::vector<Part> out;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (i != without) out.push_back(copy(parts[i]));
        for (const Part* part : more) out.push_back(copy(*part));
        return out;
    };
    CHECK(refusal(std::vector<Part>()).find("merge: no parts") == 0);
    CHECK(refusal(with(1, {})).find(" is missing, allowed: all") != std::string::npos);
    CHECK(refusal(with(9, {&parts[0]})).find(" is there twice") != std::string::npos);
    Scene other = scene;
    other.seed = 99;
    const std::vector<Part> foreign = parts_of(other, 3);
    CHECK(refusal(with(0, {&foreign[0]})).find("another seed, 99") != std::string::npos);
    const std::vector<Part> fours = parts_of(scene, 4);
    CHECK(refusal(with(0, {&fours[0]})).find("one of 4") != std::string::npos);
    Scene longer = scene;
    longer.path.samples_per_pixel = 3;
    std::vector<Part> mixed = with(9, {});
    Part more = copy(parts_of(longer, 3)[0]);
    for (Part& part : mixed)
        if (part.part.index == more.part.index) part = std::move(more);
    CHECK(refusal(std::move(mixed)).find("of another picture") != std::string::npos);
    const Scene march = scene_from(kSmallCumulus, {"method.name=raymarch", "output.layers=[]"});
    Scene march2 = march;
    march2.seed = 9;
    std::vector<Part> rows = parts_of(march, 2);
    for (Part& part : parts_of(march2, 2)) rows.push_back(std::move(part));
    CHECK(refusal(std::move(rows), true).find("have no noise") != std::string::npos);
    const auto fault = [](const std::vector<std::string>& set, RenderOptions options = {}) {
        options.part = {0, 2, true};
        Part part;
        return render_part(scene_from(kSmallCumulus, set), options, part).message;
    };
    RenderOptions timed;
    timed.budget.seconds = 1;
    CHECK(fault({}, timed).find("--part: no part knows") == 0);
    CHECK(fault({"method.name=path", "path.target_error=0.1"}).find("--part: no part knows") == 0);
    CHECK(fault({"method.name=raymarch", "raymarch.scale=2", "output.layers=[]"})
              .find("--part: pixels of") == 0);
    CHECK(fault({"animation.frames=4"}).find("--part: a film") == 0);
}

TEST_CASE("parts: every damaged file is refused") {
    const Scene scene = scene_from(
        kSmallCumulus, {"method.name=path", "path.samples_per_pixel=1", "camera.resolution=[4,4]"});
    std::vector<Part> parts = parts_of(scene, 1);
    Buffer<char> bytes;
    REQUIRE(encode_part(parts[0], bytes));
    const auto taken = [](Span<const char> some) {
        Part part;
        return bool(decode_part("p.part", some, part));
    };
    CHECK(taken(bytes.span()));
    std::size_t accepted = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = char(bytes[i] ^ char(1u << (i % 8)));
        accepted += taken(bytes.span()) ? 1 : 0;
        bytes[i] = char(bytes[i] ^ char(1u << (i % 8)));
    }
    CHECK(accepted == 0);
    for (std::size_t n = 0; n < bytes.size(); n += 13) accepted += taken({bytes.data(), n}) ? 1 : 0;
    CHECK(accepted == 0);
}
