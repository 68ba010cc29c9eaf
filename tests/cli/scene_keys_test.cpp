// SPDX-License-Identifier: Apache-2.0
// Every row of the key table reads, checks, dumps and documents its own field, and no other.
// in: the rows -> out: pass or fail; PILEUS_WRITE_DOCS=1 writes the tables of docs/scene.md anew.
// docs/scene.md.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "src/base/number_text.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/read_scene.h"
#include "src/scene/toml/toml_tree.h"
#include "tests/support/keys_text.h"

namespace {

using namespace pileus;

std::string file_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Reads a scene of one medium, one solid and one light with one key set; its laws are left alone.
struct OneKey {
    Node root;
    Scene scene;
    FaultList faults{"s.toml", {"set"}};
    SceneCheck check{scene, faults, true, {}};

    explicit OneKey(const std::string& setting) {
        SyntaxFault fault;
        REQUIRE(parse_toml("[[medium]]\n[[solid]]\n[[light]]\n", root, fault));
        if (!setting.empty()) apply_overrides({setting}, root, faults);
        check_keys(root, check);
    }
};

/// "medium.N.albedo" of the first medium.
std::string first(std::string path) {
    const std::size_t n = path.find(".N.");
    return n == std::string::npos ? path : path.replace(n + 1, 1, "0");
}

bool allows(const KeyRow& row, const Node& node) {
    FaultList faults("s", {});
    return check_value(row, node, row.path, faults);
}

/// Values that a row may hold, as TOML.
std::vector<std::string> candidates(const KeyRow& row) {
    if (row.kind() == KeyKind::kDensity) return {"\"uniform:sphere\""};
    if (row.kind() == KeyKind::kRows && row.list->rising == nullptr)
        return {"[{name=\"a\",scene=\"b.toml\",set=[\"seed=1\"]}]",
                "[{scene=\"b.toml\",set=[\"seed=1\"]}]",
                "[{kind=\"a\",offset_m=[1,2,3],yaw_deg=4,scale=5}]",
                "[{kinds=[\"a\"],count=2,base_m=[3,4],center_m=[5,6],seed=7}]"};
    if (row.kind() == KeyKind::kRows && row.list->rising == std::string("frame"))
        return {"[{frame=0,hours=1,camera_position_m=[1,2,3]},{frame=9,way=\"step\",hours=2}]"};
    if (row.kind() == KeyKind::kRows)
        return {"[{value=0,extinction_per_m=0},{value=0.5,extinction_per_m=2,albedo=[1,0.5,0]}]"};
    if (row.allowed.choices != nullptr) {
        std::vector<std::string> texts;
        for (std::string_view choice : split_list(row.allowed.choices))
            texts.push_back('"' + std::string(choice) + '"');
        if (row.kind() != KeyKind::kTexts) return texts;
        return {"[" + texts.back() + "]"};
    }
    const KeyRange& r = row.allowed.range;
    std::vector<std::string> values{"\"a b.c\"", "[\"a.exr\", \"b.pfm\"]", "true", "false"};
    for (const double v : {r.low + 1, r.high / 2 + r.low / 2, r.high}) {
        const std::string n = number_text(v), m = number_text(r.low / 2);
        values.insert(
            values.end(),
            {n, "[" + n + ", " + m + "]", "[" + n + ", " + m + ", " + n + "]",
             "[" + n + ", " + n + "]", "[" + n + ", " + n + ", " + n + "]",
             "[0, 0, " + n + ", " + n + "]", "[[0, 0, 0], [" + n + ", " + n + ", " + n + "]]",
             "[[0, 0], [" + n + ", " + n + "]]"});
    }
    return values;
}

/// The first that is allowed and not the default.
std::string sample(const KeyRow& row) {
    for (const std::string& text : candidates(row)) {
        Node root;
        SyntaxFault fault;
        REQUIRE(parse_toml("v = " + text, root, fault));
        if (!allows(row, root.children[0])) continue;
        OneKey one(first(row.path) + "=" + text);
        if (dump_scene(one.scene) != dump_scene(OneKey("").scene)) return text;
    }
    return "";
}

std::set<std::string> lines_of(const std::string& text) {
    std::set<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.insert(line);
    return lines;
}

/// Paths whose lines differ.
std::set<std::string> differences(const std::string& a, const std::string& b) {
    std::set<std::string> paths;
    const std::set<std::string> in_a = lines_of(a), in_b = lines_of(b);
    for (const std::string& line : in_a)
        if (in_b.count(line) == 0) paths.insert(line.substr(0, line.find(' ')));
    for (const std::string& line : in_b)
        if (in_a.count(line) == 0) paths.insert(line.substr(0, line.find(' ')));
    return paths;
}

TEST_CASE("every key sets its own field and no other, and the dump shows it") {
    // Keys that are another way to say the same.
    const auto field_path = [](const std::string& path) -> std::string {
        if (path == "medium.N.density.file") return "medium.N.density";
        if (path == "medium.N.density.grid") return "medium.N.grid";
        if (path == "medium.N.phase.cloud") return "medium.N.phase.effective_radius_um";
        return path;
    };
    const std::string before = dump_scene(OneKey("").scene);
    int tried = 0;
    for (const KeyRow* row : all_scene_keys()) {
        if (row->field.set == nullptr) continue;
        CAPTURE(row->path);
        const std::string value = sample(*row);
        REQUIRE_FALSE(value.empty());
        OneKey one(first(row->path) + "=" + value);
        CHECK(one.check.valid_key(first(row->path)) != nullptr);
        CHECK(differences(before, dump_scene(one.scene)) ==
              std::set<std::string>{first(field_path(row->path))});
        ++tried;
    }
    CHECK(tried > 130);
}

TEST_CASE("what the dump shows of a key reads back as the same") {
    for (const KeyRow* row : all_scene_keys()) {
        if (row->field.get == nullptr) continue;
        CAPTURE(row->path);
        OneKey one(first(row->path) + "=" + sample(*row));
        const KeySource source{one.scene, one.scene.media[0], one.scene.solids[0],
                               one.scene.lights[0]};
        const Node value = value_of(*row, source);
        if (!has_value(value)) continue;
        const OneKey again(first(row->path) + "=" + toml_text(value));
        CHECK(dump_scene(again.scene) == dump_scene(one.scene));
    }
}

TEST_CASE("a default is allowed, or left out says something else") {
    int shown = 0;
    for (const KeyRow* row : all_scene_keys()) {
        CAPTURE(row->path);
        if (row->required() || row->field.get == nullptr) continue;
        const Node value = default_value(*row);
        if (!default_text(*row).empty()) {
            ++shown;
            CHECK(allows(*row, value));
        } else {
            CHECK(row->fallback == std::string(kNoNote));
        }
    }
    CHECK(shown > 80);
}

TEST_CASE("docs/scene.md holds the key table as it is, and its example is sound") {
    std::string text = file_text("docs/scene.md");
    const std::string begin = "<!-- keys: begin -->\n", end = "<!-- keys: end -->";
    const std::size_t from = text.find(begin) + begin.size(), to = text.find(end);
    REQUIRE(text.find(begin) != std::string::npos);
    REQUIRE(to != std::string::npos);
    const std::string table = describe_keys_markdown();
    if (std::getenv("PILEUS_WRITE_DOCS") != nullptr) {
        text.replace(from, to - from, table);
        std::ofstream("docs/scene.md", std::ios::binary) << text;
    } else {
        CHECK_MESSAGE(text.substr(from, to - from) == table,
                      "PILEUS_WRITE_DOCS=1 ctest -R cli.scene_keys_test writes it anew");
    }
    std::set<std::string> paths;
    for (const KeyRow* row : all_scene_keys())
        CHECK_MESSAGE(paths.insert(row->path).second, row->path);
    const std::size_t example = text.find("```toml\n");
    REQUIRE(example != std::string::npos);
    const std::size_t start = example + 8;
    Scene scene;
    const Status status = read_scene_text(text.substr(start, text.find("```", start) - start),
                                          "docs/scene.md", "", {}, scene);
    CHECK_MESSAGE(bool(status), status.message);
}

}  // namespace
