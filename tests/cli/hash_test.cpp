// SPDX-License-Identifier: Apache-2.0
// Hashes of several pictures, and whether they are those of a list.
// in: PILEUS_PROGRAM, lists sound and broken -> out: pass or fail.
// docs/program.md, "hash"
#include "src/io/images/image_file.h"
#include "tests/cli/run_program.h"
#include "tests/io/test_image.h"

using namespace pileus;
using test::holds;
using test::line_count;
using test::Outcome;
using test::ProgramFolder;

namespace {

/// A picture all of whose pixels have one value; its hash.
std::string put_picture(const ProgramFolder& folder, const std::string& name, float value) {
    Image image = test::make_image(2, 2);
    for (Channel& channel : image.channels)
        for (float& pixel : channel.pixels.span()) pixel = value;
    std::filesystem::create_directories(
        std::filesystem::path(folder.files().path(name)).parent_path());
    REQUIRE(write_image(image, folder.files().path(name), {}));
    // A .pfm has no A, which then counts as 1.
    for (float& pixel : image.channels[3].pixels.span()) pixel = 1;
    return pixel_hash(image);
}

/// Three pictures, and a list of the first two.
struct Pictures {
    ProgramFolder folder;
    std::string a, b, c;
    Pictures()
        : a(put_picture(folder, "a.pfm", 1)),
          b(put_picture(folder, "out/b.pfm", 2)),
          c(put_picture(folder, "c.pfm", 3)) {
        folder.files().put("list", a + "  a.pfm\n" + b + "  out/b.pfm\n");
    }
};

struct Fault {
    const char* list;
    int lines;
    const char* said;
};

std::string upper(std::string text) {
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
    return text;
}

}  // namespace

TEST_CASE("hash: one picture is a hash, several are a line each") {
    const Pictures p;
    CHECK(p.a != p.b);
    CHECK(p.folder.run("hash a.pfm").output == p.a + "\n");
    const Outcome several = p.folder.run("hash a.pfm out/b.pfm a.pfm");
    CHECK(several.exit_status == 0);
    CHECK(several.output == p.a + "  a.pfm\n" + p.b + "  out/b.pfm\n" + p.a + "  a.pfm\n");
    CHECK(several.errors == "");
    // What is missing, or is no picture, hides none of the others.
    p.folder.files().put("text.pfm", "PF\nno");
    const Outcome gap = p.folder.run("hash none.pfm a.pfm s.toml text.pfm c.pfm");
    CHECK(gap.exit_status == 2);
    CHECK(gap.output == p.a + "  a.pfm\n" + p.c + "  c.pfm\n");
    CHECK(line_count(gap.errors) == 3);
    CHECK(gap.errors.find("none.pfm: ") == 0);
    CHECK(holds(gap.errors, "\ns.toml: extension: unknown, \".toml\", allowed: "));
    CHECK(holds(gap.errors, "\ntext.pfm:"));
}

TEST_CASE("hash: a list is what the program printed, and names the pictures") {
    const Pictures p;
    REQUIRE(p.folder.run("hash a.pfm out/b.pfm").output == p.folder.files().get("list"));
    const Outcome all = p.folder.run("hash --expect list");
    CHECK(all.exit_status == 0);
    CHECK(all.output == p.folder.files().get("list"));
    CHECK(all.errors == "");
    CHECK(p.folder.run("hash ./out/../a.pfm --expect list").exit_status == 0);
    CHECK(p.folder.run("hash out/b.pfm a.pfm --expect list").exit_status == 0);
    // Capital digits, one blank, blank lines, remarks, and the ends of lines of other systems.
    // So does a mark of UTF-8 before the first line.
    p.folder.files().put("marked", "\xef\xbb\xbf" + p.folder.files().get("list"));
    CHECK(p.folder.run("hash --expect marked").exit_status == 0);
    p.folder.files().put("other", "# of the release\r\n\r\n" + upper(p.b) + " ./out/b.pfm\r\n\n" +
                                      p.a + " \t a.pfm");
    CHECK(p.folder.run("hash --expect other").exit_status == 0);
    // What is printed of one picture is a list of it.
    p.folder.files().put("one", p.folder.run("hash a.pfm").output);
    CHECK(p.folder.run("hash a.pfm --expect one").exit_status == 0);
    CHECK(p.folder.run("hash c.pfm --expect one").exit_status == 1);
    // And so is what rendering says.
    p.folder.files().put("rendered", p.folder.run("render s.toml -q -o d.pfm e.pfm").output);
    const Outcome alpha = p.folder.run("hash --expect rendered");
    CHECK(line_count(alpha.output) == 2);
    CHECK_MESSAGE(alpha.exit_status == 0, alpha.errors);
}

TEST_CASE("hash: a line for each difference, exit 1; a missing file counts more, exit 2") {
    const Pictures p;
    p.folder.files().put("list", p.b + "  a.pfm\n" + p.b + "  out/b.pfm\n" + p.a + "  c.pfm\n");
    const std::string differs = ": hash: differs, expected ";
    const std::string both = "a.pfm" + differs + p.b + ", got " + p.a + "\nc.pfm" + differs + p.a +
                             ", got " + p.c + "\n";
    const Outcome all = p.folder.run("hash --expect list");
    CHECK(all.exit_status == 1);
    CHECK(all.errors == both);
    CHECK(line_count(all.output) == 3);
    CHECK(p.folder.run("hash out/b.pfm --expect list").exit_status == 0);
    CHECK(p.folder.run("hash a.pfm --expect list").errors ==
          "a.pfm" + differs + p.b + ", got " + p.a + "\n");
    const std::string other = put_picture(p.folder, "d.pfm", 4);
    const Outcome unknown = p.folder.run("hash d.pfm --expect list");
    CHECK(unknown.exit_status == 1);
    CHECK(unknown.errors == "d.pfm: hash: not in list, got " + other + "\n");
    REQUIRE(std::filesystem::remove(p.folder.files().path("out/b.pfm")));
    const Outcome missing = p.folder.run("hash --expect list");
    CHECK(missing.exit_status == 2);
    CHECK(line_count(missing.errors) == 3);
    CHECK(holds(missing.errors, "\nout/b.pfm: "));
    CHECK(holds(missing.errors, "c.pfm" + differs));
}

TEST_CASE("hash: a broken list is refused with its line, exit 2") {
    const Pictures p;
    const Fault faults[] = {
        {"", 1, "list: no hashes, allowed: lines of 16 hex digits, blanks and the name"},
        {"# nothing\n\n", 1, "list: no hashes, "},
        {"0123456789abcde  a.pfm\n", 1, "list:1: no hash, \"0123456789abcde  a.pfm\", allowed: 16"},
        {"0123456789abcdefa  a.pfm\n", 1, "list:1: no hash, "},
        {"0123456789abcdeg  a.pfm\n", 1, "list:1: no hash, "},
        {"\n0123456789abcdef  a.pfm\na.pfm 0123456789abcdef\n", 1, "list:3: no hash, \"a.pfm"},
        {"x\ny\n", 2, "list:1: no hash, \"x\""},
        {"0123456789abcdef  a.pfm\n0123456789abcdef  ./a.pfm\n", 1,
         "list:2: given twice, \"./a.pfm\", allowed: once, as in line 1\n"},
        {"0123456789abcdef  a.pfm\n0123456789abcdef\n", 1,
         "list:2: no name, 0123456789abcdef, allowed: a name behind each hash, or one line\n"},
        {"0123456789abcdef\n", 1, "list:1: no name, 0123456789abcdef, allowed: a name behind the"},
        {"0123456789abcdef  a\x01.pfm\n", 1, "list:1: "},
        {"1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n", 10, "list:10: no hash, \"10\""},
    };
    for (const Fault& fault : faults) {
        CAPTURE(fault.list);
        p.folder.files().put("list", fault.list);
        const Outcome outcome = p.folder.run("hash --expect list");
        CHECK(outcome.exit_status == 2);
        CHECK(outcome.output == "");
        CHECK(line_count(outcome.errors) == fault.lines);
        CHECK_MESSAGE(holds(outcome.errors, fault.said), outcome.errors);
    }
    for (const char* line : {"hash --expect none", "hash a.pfm --expect out",
                             "hash a.pfm --expect a.pfm", "hash --expect ''"}) {
        CAPTURE(line);
        const Outcome outcome = p.folder.run(line);
        CHECK(outcome.exit_status == 2);
        CHECK(outcome.output == "");
        CHECK(line_count(outcome.errors) >= 1);
    }
}

TEST_CASE("hash: render prints what hash does, of every format that is read") {
    const ProgramFolder folder;
    std::string files = "a.pfm";
    for (const char* name : {"a.exr", "a.png"})
        if (can_write_image(name)) files += std::string(" ") + name;
    const std::string list = folder.run("render s.toml -q -o " + files).output;
    const Outcome hashes = folder.run("hash " + files);
    REQUIRE_MESSAGE(hashes.exit_status == 0, hashes.errors);
    // `HASH  FILE` of hash has one blank more.
    std::string same;
    for (std::size_t i = 0; i < hashes.output.size(); ++i)
        if (i == 0 || hashes.output[i] != ' ' || hashes.output[i - 1] != ' ')
            same += hashes.output[i];
    CHECK(same == list);
}
