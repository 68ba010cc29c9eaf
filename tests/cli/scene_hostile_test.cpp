// SPDX-License-Identifier: Apache-2.0
// Hostile and damaged scene text ends in a message, never in a crash or an endless run.
// in: generated texts up to the size limit -> out: a Status that is not ok.
// docs/scene.md, section Messages.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "src/scene/read_scene.h"

namespace {

using namespace pileus;

constexpr std::size_t kMax = kMaxSceneBytes - 100;

std::string repeated(const std::string& part, std::size_t bytes) {
    std::string text;
    while (text.size() + part.size() <= bytes) text += part;
    return text;
}

Status refusal(const std::string& text) {
    Scene scene;
    const Status status = read_scene_text(text, "s.toml", "", {}, scene);
    CHECK_FALSE(bool(status));
    // At most 1000 faults are listed, each shorter than 400 bytes.
    CHECK(status.message.size() < 400'000);
    return status;
}

void refused(const std::string& text) { CHECK(refusal(text).code == Code::kBadInput); }

TEST_CASE("nesting is refused before it can exhaust the stack") {
    refused("a = " + repeated("[", kMax));
    refused("a = " + repeated("{a=", kMax));
    refused(repeated("a.", kMax) + "a = 1");
    refused("[" + repeated("a.", kMax) + "a]");
    refused("a = " + repeated("{a.a.a=", kMax));
    refused(repeated("'a'.", kMax) + "a = 1");
    const std::string deep = "]\nb = " + repeated("[", kMax);
    // Strings of all four forms, closed in ways that could mislead the check into skipping the
    // rest.
    for (const char* text : {"[\"\"", "[\"\\\"\"", "[''", "['\\'", "[\"\"\"x\"\"\"\"\"",
                             "['''x'''''", "[\"\"\"\\\"\"\"\"", "[\"\"\"\"\"\""}) {
        CAPTURE(text);
        const Status status = refusal("a = " + std::string(text) + deep);
        CHECK(status.message.find("nested too deeply") != std::string::npos);
    }
}

TEST_CASE("the nesting limits are where the documentation says") {
    const auto message = [](const std::string& text) { return refusal(text).message; };
    const std::string close(32, ']');
    CHECK(message("seed = " + std::string(32, '[') + close).find("wrong type") !=
          std::string::npos);
    CHECK(message("seed = " + std::string(33, '[') + close + "]") ==
          "s.toml:1:40: not TOML, nested too deeply, allowed: 32 brackets");
    CHECK(message(repeated("a.", 64) + "a = 1").find("unknown key") != std::string::npos);
    CHECK(message("# a.b\n" + repeated("a.", 66) + "a = 1") ==
          "s.toml:2:66: not TOML, key with too many parts, allowed: 32 dots");
}

TEST_CASE("characters outside ASCII belong into texts and comments") {
    const std::string camera = "position_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n";
    const std::string rest = " outside ASCII, allowed: in texts and comments only";
    for (const char* mark : {"\xC3\xAC", "\xC2\xA0", "\xE2\x80\x8B", "\xEF\xBB\xBF", "\xFF"}) {
        CAPTURE(mark);
        CHECK(refusal(std::string("\n") + mark + "a = 1").message ==
              "s.toml:2:1: not TOML, character" + rest);
        CHECK(refusal(std::string("a =") + mark + "1").message ==
              "s.toml:1:4: not TOML, character" + rest);
        refused(std::string("a = \"\\") + mark + "\"");
        refused(std::string("a = x\"") + mark + "\"");
        refused(std::string("a = [1\"") + mark + "\"]");
    }
    Scene scene;
    const std::string text = "\xEF\xBB\xBF# caf\xC3\xA9\n[camera]\n" + camera +
                             "[output]\nreport = \"\"\"\\\n \xC3\xAC.json\"\"\"\n";
    CHECK(bool(read_scene_text(text, "s.toml", "", {}, scene)));
    CHECK(scene.output.report == "\xC3\xAC.json");
}

TEST_CASE("no control character of a scene reaches a message as it is") {
    // The parser quotes what it stumbles over, in words of its own.
    const std::string opening = "seed = 1\n";
    for (const char* text : {"a = \x7f", "a = tr\x7f", "a = [i\x7f]", "\x7f = 1", "a = \"\x7f\"",
                             "a = '\x1b'", "a = 1\x7f", "[\x7f]", "a = \"\\\x7f\"",
                             "a = \"\xc2\x9b\"", "seed = \"\xc2\x9b\"", "seed = \"\\u007f\"",
                             "\"\\u009b\" = 1", "a = [\x7f]", "a = 0x\x7f", "# \x7f", "a = \xff"}) {
        CAPTURE(std::string(text));
        Scene scene;
        const Status status = read_scene_text(opening + text, "s.toml", "", {}, scene);
        CHECK(status.code == Code::kBadInput);
        for (std::size_t i = 0; i < status.message.size(); ++i) {
            const auto byte = static_cast<unsigned char>(status.message[i]);
            const auto before = static_cast<unsigned char>(i > 0 ? status.message[i - 1] : 0);
            CHECK_FALSE((byte < 0x20 && byte != '\n'));
            CHECK(byte != 0x7F);
            CHECK_FALSE((before == 0xC2 && byte < 0xA0));
        }
    }
}

TEST_CASE("a control character that the parser quotes is escaped") {
    Scene scene;
    CHECK(read_scene_text("a = tr\x7f", "s.toml", "", {}, scene).message ==
          "s.toml:1:7: not TOML, Error while parsing boolean: expected 'true', saw 'tr\\x7f'");
}

TEST_CASE("texts at the size limit are refused in good time") {
    refused("a = \"" + repeated("x", kMax));
    refused("seed = " + repeated("9", kMax));
    refused("seed = 0." + repeated("9", kMax));
    refused("seed = [" + repeated("1,", kMax) + "1]");
    refused(repeated("[[medium]]\n", kMax));
    refused("[output]\nfiles = [" + repeated("\"\",", kMax) + "]");
    refused(repeated("\xff\xfe", kMax));
    refused(std::string(kMax, '\0'));
    refused(repeated("\xef\xbb\xbf", kMax));
    CHECK(refusal(repeated("#", kMaxSceneBytes + 1)).code == Code::kLimit);
    std::string names;
    for (int i = 0; names.size() < kMax; ++i) names += "k" + std::to_string(i) + "=1\n";
    const Status status = refusal(names);
    CHECK(std::count(status.message.begin(), status.message.end(), '\n') <= 1001);
    CHECK(status.message.find("more faults") != std::string::npos);
    refused("[\"" + repeated("y", kMax) + "\"]\n");
}

TEST_CASE("hostile overrides end in a message") {
    const std::string camera = "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n";
    for (const std::string& option :
         {"a=" + repeated("[", 100'000), repeated("a.", 100'000) + "a=1",
          "seed=" + repeated("9", 100'000), "a=" + repeated("{a=", 100'000),
          std::string("seed=\xff\xfe"), std::string("medium.99999999999999999999.albedo=1"),
          std::string("seed=\"\n\""), std::string("seed=1 }"), std::string(""), std::string("=")}) {
        Scene scene;
        const Status status = read_scene_text(camera, "s.toml", "", {option}, scene);
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.size() < 1000);
        CHECK(status.message.find('\n') == std::string::npos);
    }
}

TEST_CASE("every cut and many damages of a scene end in a result") {
    const std::string whole =
        "seed = 1 # any\n[camera]\nposition_m = [1, -2.5, 3]\ntarget_m = [4, 5, 6]\n"
        "[[medium]]\ndensity = { file = \"a.raw\", type = 'uint16', size = [7, 8, 9] }\n"
        "bounds_m = [[0, 0, 0], [1, 1, 1]]\nextinction_per_m = 1e12\n"
        "phase = { type = \"two-lobe\", g1 = 1, g2 = -0.5, weight = 0.75 }\n";
    Scene scene;
    REQUIRE(bool(read_scene_text(whole, "s.toml", "", {}, scene)));
    std::uint64_t state = 1;
    std::size_t sound = 0, runs = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        sound += read_scene_text(whole.substr(0, i), "s.toml", "", {}, scene) ? 1 : 0;
        ++runs;
        for (int k = 0; k < 20; ++k) {
            std::string damaged = whole;
            state = state * 6364136223846793005u + 1442695040888963407u;
            damaged[i] = static_cast<char>(state >> 56);
            sound += read_scene_text(damaged, "s.toml", "", {}, scene) ? 1 : 0;
            ++runs;
        }
    }
    // A damaged digit or comment may leave a sound scene; most damage must not pass.
    CHECK(sound > 0);
    CHECK(sound < runs / 4);
}

}  // namespace
