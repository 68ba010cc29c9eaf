// SPDX-License-Identifier: Apache-2.0
// Every number of every key is held by a float with all its digits, or is 0, or is refused.
// in: the rows of the key table, numbers at the ends of floats and of the rows' ranges
// -> out: pass or fail.
// src/base/single.h; docs/scene.md, "Small numbers".
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "src/base/number_text.h"
#include "src/base/single.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/read_scene.h"
#include "src/scene/toml/toml_tree.h"

namespace single_keys_test {

using namespace pileus;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// At the ends of floats, and of the row's range as doubles and as floats.
std::vector<double> numbers_for(const KeyRow& row) {
    std::vector<double> all{
        4.9e-324,   1e-300, 1e-46, 1e-45, 1e-41, 1e-38,        1.1754943508222874e-38,
        kMinSingle, 1e-30,  1e-10, 1e30,  1e38,  3.4028235e38, 3.5e38,
        1e39};
    const KeyRange& r = row.allowed.range;
    for (const double end : {r.low, r.high})
        for (const double to : {-kInfinity, kInfinity})
            all.insert(all.end(), {end, std::nextafter(end, to),
                                   double(std::nextafter(float(end), float(to)))});
    const std::size_t count = all.size();
    for (std::size_t i = 0; i < count; ++i) all.push_back(-all[i]);
    return all;
}

/// As a number with a fraction: TOML's whole numbers end before those of floats.
std::string text_of(double number) {
    const std::string text = number_text(number);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string three(const std::string& n) { return "[" + n + ", " + n + ", " + n + "]"; }

/// The ways in which a key of this kind may hold the number; none: it holds no number.
std::vector<std::string> values_with(KeyKind kind, const std::string& n) {
    switch (kind) {
        case KeyKind::kInteger:
        case KeyKind::kIndexOrText:
        case KeyKind::kNumber:
            return {n};
        case KeyKind::kColor:
            return {n, three(n), "[0, 1, " + n + "]"};
        case KeyKind::kInteger2:
        case KeyKind::kNumber2:
            return {"[" + n + ", " + n + "]", "[1, " + n + "]"};
        case KeyKind::kInteger4:
            return {"[0, 0, " + n + ", " + n + "]", "[0, 0, 1, " + n + "]"};
        case KeyKind::kInteger3:
        case KeyKind::kNumber3:
            return {three(n), "[1, 1, " + n + "]"};
        case KeyKind::kBounds:
            return {"[[0, 0, 0], " + three(n) + "]", "[" + three(n) + ", [1, 1, 1]]",
                    "[" + three(n) + ", [0, 0, 0]]",
                    "[[1e6, 0, 0], [1000000.000001, 1, " + n + "]]"};
        case KeyKind::kRectangle:
            return {"[[0, 0], [" + n + ", " + n + "]]", "[[" + n + ", 0], [1, 1]]"};
        default:
            return {};
    }
}

/// Every number within a value.
void numbers_in(const Node& node, std::vector<double>& out) {
    if (node.kind == NodeKind::kNumber) out.push_back(node.number);
    for (const Node& child : node.children) numbers_in(child, out);
}

void check_refused(const FaultList& faults) {
    const std::string line = faults.status().message;
    CHECK_MESSAGE(line.find("allowed: ") != std::string::npos, line);
}

/// What single precision makes of a number that was accepted.
void check_held(const KeyRow& row, double value) {
    CAPTURE(value);
    const float single = float(value);
    CHECK(std::isfinite(single));
    CHECK((value == 0 || std::fabs(double(single)) >= kMinSingle));
    CHECK((!row.allowed.range.high_open || single < float(row.allowed.range.high)));
}

TEST_CASE("each number of each key is one that floats hold, or 0, or is refused") {
    int accepted = 0, refused = 0, rows = 0;
    for (const KeyRow* row : all_scene_keys()) {
        if (row->field.set == nullptr || values_with(row->kind(), "1").empty()) continue;
        ++rows;
        CAPTURE(row->path);
        std::string path = row->path;
        if (const std::size_t n = path.find(".N."); n != std::string::npos)
            path.replace(n + 1, 1, "0");
        for (const double number : numbers_for(*row))
            for (const std::string& text : values_with(row->kind(), text_of(number))) {
                CAPTURE(text);
                Node root;
                SyntaxFault fault;
                REQUIRE(parse_toml("[[medium]]\n[[solid]]\n[[light]]\n", root, fault));
                FaultList faults("s.toml", {path + "=" + text}), none = faults;
                apply_overrides({path + "=" + text}, root, faults);
                Scene scene;
                SceneCheck check{scene, faults, true, {}};
                check_keys(root, check);
                const auto found = check.found.find(path);
                REQUIRE(found != check.found.end());
                const Node* node = found->second.node;
                if (!found->second.valid) {
                    ++refused;
                    CHECK_FALSE(check_value(*row, *node, path, none));
                    check_refused(none);
                    continue;
                }
                ++accepted;
                const KeySource source{scene, scene.media[0], scene.solids[0], scene.lights[0]};
                std::vector<double> values;
                numbers_in(value_of(*row, source), values);
                for (const double value : values) check_held(*row, value);
            }
    }
    CHECK(rows > 110);
    CHECK(accepted > 1500);
    CHECK(refused > 4000);
}

TEST_CASE("the same of keys within lists of tables") {
    int rows = 0;
    for (const KeyRow* outer : all_scene_keys()) {
        if (outer->list == nullptr) continue;
        for (const KeyRow& row : outer->list->keys()) {
            CAPTURE(outer->path);
            CAPTURE(row.path);
            if (values_with(row.kind(), "1").empty()) continue;
            ++rows;
            for (const double number : numbers_for(row))
                for (const std::string& text : values_with(row.kind(), text_of(number))) {
                    CAPTURE(text);
                    Node root;
                    SyntaxFault fault;
                    REQUIRE(parse_toml("v = " + text, root, fault));
                    FaultList faults("s.toml", {});
                    if (!check_value(row, root.children[0], row.path, faults)) {
                        check_refused(faults);
                        continue;
                    }
                    const Node& value = root.children[0];
                    if (!value.is_array()) check_held(row, number_of(value));
                    for (const Node& child : value.children) check_held(row, number_of(child));
                }
        }
    }
    CHECK(rows > 12);
}

std::string fault_of(const std::vector<std::string>& overrides) {
    Scene scene;
    return read_scene_text(
               "[camera]\nposition_m = [0, -3000, 600]\ntarget_m = [0, 0, 900]\n[[medium]]\n"
               "density = \"uniform:sphere\"\nextinction_per_m = 0.01\n"
               "bounds_m = [[-100, -100, 800], [100, 100, 1000]]\n",
               "s.toml", "", overrides, scene)
        .message;
}

TEST_CASE("a box whose corners floats do not tell apart is refused, with the least width there") {
    const auto box = [](const char* bounds) {
        return fault_of({std::string("medium.0.bounds_m=") + bounds});
    };
    const std::string far = box("[[1e6, 0, 0], [1000000.000001, 1, 1]]");
    CHECK_MESSAGE(far.find("medium.0.bounds_m: too thin along x, ") != std::string::npos, far);
    CHECK_MESSAGE(far.find("allowed: at least 0.238418579") != std::string::npos, far);
    CHECK(box("[[0, 0, 0], [1, 1e-10, 1]]").find("allowed: at least 1e-09 m wide there") !=
          std::string::npos);
    CHECK(box("[[0, 0, 0], [1, 1e-9, 1]]").empty());
    CHECK(box("[[1e6, 0, 0], [1000001, 1, 1]]").empty());
}

TEST_CASE("what only two numbers together break: a view, a layer, rows of a transfer function") {
    const std::string near =
        fault_of({"camera.position_m=[1e6, 0, 0]", "camera.target_m=[1000000.00001, 0, 0]"});
    CHECK_MESSAGE(near.find("same as position_m") != std::string::npos, near);
    CHECK(
        fault_of({"camera.position_m=[1e6, 0, 0]", "camera.target_m=[1000000.01, 0, 0]"}).empty());
    const std::string rows =
        fault_of({"medium.0.transfer=[{value=1,extinction_per_m=0},"
                  "{value=1.00000001,extinction_per_m=1}]"});
    CHECK_MESSAGE(rows.find("not rising") != std::string::npos, rows);
    const std::vector<std::string> sky{"medium.0.density=procedural:sky",
                                       "medium.0.sky.type=custom", "medium.0.sky.perlin_m=1000",
                                       "medium.0.sky.worley_m=1000", "medium.0.sky.base_m=1e6"};
    std::vector<std::string> thin = sky;
    thin.push_back("medium.0.sky.top_m=1000000.1");
    CHECK(fault_of(thin).find("sky.top_m: not above base_m") != std::string::npos);
    std::vector<std::string> fine = sky;
    fine.insert(fine.end(), {"medium.0.sky.top_m=1001000", "medium.0.sky.scale=1e-9"});
    CHECK(fault_of(fine).find("sky.perlin_m: ") == std::string::npos);
    fine.push_back("medium.0.sky.perlin_m=0.1");
    CHECK(fault_of(fine).find("sky.perlin_m: too short with sky.scale") != std::string::npos);
}

}  // namespace single_keys_test
