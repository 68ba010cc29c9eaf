// SPDX-License-Identifier: Apache-2.0
// METAR reports are read group by group; nothing is dropped without a word, faults are one line.
// in: reports of many countries, hostile texts -> out: pass or fail. docs/metar.md
#include <doctest/doctest.h>

#include "tests/law/metar_reports.h"

using namespace metar_test;

namespace {

/// "" where the text is read, else the fault, which must be one line and must leave `out` alone.
std::string fault_of(const std::string& text) {
    Metar out;
    out.station = "KEPT";
    const Status status = read_metar(text, out);
    if (status) return "";
    CHECK(out.station == "KEPT");
    CHECK(status.message.find('\n') == std::string::npos);
    CHECK(status.message.substr(0, 7) == "metar: ");
    return status.message;
}

Metar read(const std::string& text) {
    Metar out;
    const Status status = read_metar(text, out);
    INFO(status.message);
    REQUIRE(bool(status));
    return out;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("metar: reports of many countries say what they say") {
    static_assert(sizeof kReports / sizeof kReports[0] >= 60, "as many as were asked for");
    for (const Report& report : kReports) {
        CAPTURE(report.text);
        CHECK(summary(read(report.text)) == report.says);
    }
}

TEST_CASE("metar: every group is a member, without effect, or not understood") {
    const Metar m = read(
        "METAR EDDF 121650Z 24004KT 9999 R25C/1100N R07/290055 FEW020 HELLO 12/08 Q1013 RESHRA WS "
        "R25C W11/S5 88290595 BLU+ SNOCLO 12345 NOSIG TEMPO 2000 RA RMK A2992 SLP1");
    CHECK(m.without_effect == Texts{"R25C/1100N", "R07/290055", "Q1013", "RESHRA", "WS R25C",
                                    "W11/S5", "88290595", "BLU+", "SNOCLO", "NOSIG",
                                    "TEMPO 2000 RA", "RMK A2992 SLP1"});
    CHECK(m.not_understood == Texts{"HELLO", "12345"});
    CHECK(m.clouds.size() == 1);
}

TEST_CASE("metar: order, letters and blanks do not matter, a second group is set aside") {
    CHECK(summary(read("  metar\teddf 121650z\n24004kt cavok 12/08 q1013=")) ==
          "EDDF 12-1650 240/2.1 v>10000 CAVOK T12/8 Q1013");
    const Metar twice = read("EDDF 121650Z 24004KT 25005KT 5000 6000 12/08 13/09 3SM");
    CHECK(twice.not_understood == Texts{"25005KT", "6000", "13/09", "3SM"});
    CHECK(twice.wind.from_deg == 240);
    CHECK(read("EDDF 121650Z CAVOK= EDDM CAVOK").not_understood == Texts{"EDDM", "CAVOK"});
    CHECK(read("FEW020").clouds.size() == 1);
    CHECK(read("EDDF FEW020").station == "EDDF");
    CHECK(read("EDDF 121650Z RASN FEW020").weather.size() == 1);
}

TEST_CASE("metar: visibilities") {
    const struct {
        const char* word;
        double m;
        MetarBound bound;
    } kWords[] = {{"0000", 50, MetarBound::kLess},
                  {"0050", 50, MetarBound::kExact},
                  {"9999", 10000, MetarBound::kMore},
                  {"5000", 5000, MetarBound::kExact},
                  {"1/16SM", 1609.344 / 16, MetarBound::kExact},
                  {"M1/4SM", 1609.344 / 4, MetarBound::kLess},
                  {"1 3/8SM", 1609.344 * 1.375, MetarBound::kExact},
                  {"0SM", 1609.344 / 16, MetarBound::kLess},
                  {"7SM", 1609.344 * 7, MetarBound::kExact},
                  {"10SM", 16093.44, MetarBound::kMore},
                  {"P6SM", 1609.344 * 6, MetarBound::kMore},
                  {"CAVOK", 10000, MetarBound::kMore}};
    for (const auto& row : kWords) {
        CAPTURE(row.word);
        const Metar m = read("KJFK 121651Z " + std::string(row.word));
        CHECK(m.visibility.given);
        CHECK(m.visibility.m == doctest::Approx(row.m).epsilon(1e-12));  // rounding
        CHECK(m.visibility.bound == row.bound);
        CHECK(m.not_understood.empty());
    }
    const Metar sides = read("EDDF 121650Z 4000 1500SW 1200NE 3000N");
    CHECK(sides.visibility.m == 4000);
    CHECK(sides.visibility.least_m == 1200);
    CHECK(sides.visibility.least_towards == "NE");
}

TEST_CASE("metar: what looks like weather and is none is set aside") {
    for (const char* word : {"RAX",   "-",    "+",      "VC",    "SH",       "RASNPLGR",
                             "XXRA",  "--RA", "SHTSRA", "FEW02", "FEW0200",  "OVC010CBX",
                             "V010",  "VV01", "24/",    "M1/M2", "Q101",     "Q9999",
                             "A0001", "R24",  "1/2",    "24010", "24010KTX", "99999999999SM",
                             "BKN",   "W1/S", "RE",     "REXX"}) {
        CAPTURE(word);
        const Metar m = read("EDDF 121650Z " + std::string(word) + " 5000");
        const bool dry_dew = std::string(word) == "24/";  // a temperature without a dew point
        CHECK(m.not_understood.size() == (dry_dew ? 0 : 1));
        CHECK(m.visibility.m == 5000);
    }
}

TEST_CASE("metar: values that the code does not allow name their group") {
    const struct {
        const char* text;
        const char* group;
    } kFaults[] = {{"EDDF 121650Z 40010KT", "40010KT"},
                   {"EDDF 121650Z 361100KT", "361100KT"},
                   {"EDDF 122550Z 24010KT", "122550Z"},
                   {"EDDF 121660Z 24010KT", "121660Z"},
                   {"EDDF 001650Z 24010KT", "001650Z"},
                   {"EDDF 321650Z 24010KT", "321650Z"},
                   {"EDDF 121650Z 24010KT 100V400", "100V400"},
                   {"EDDF 121650Z 240999KT", "240999KT"},
                   {"EDDF 121650Z 24010G999MPS", "24010G999MPS"},
                   {"KJFK 121650Z 1/0SM", "1/0SM"},
                   {"KJFK 121650Z 3/2SM", "3/2SM"},
                   {"KJFK 121650Z 1 2/3SM", "2/3SM"},
                   {"KJFK 121650Z NIL", "NIL"},
                   {"NIL", "NIL"}};
    for (const auto& row : kFaults) {
        CAPTURE(row.text);
        CHECK(fault_of(row.text).find(row.group) != std::string::npos);
    }
    CHECK(fault_of("EDDF 121650Z 40010KT") ==
          "metar: wind direction out of range, \"40010KT\", allowed: 000 to 360");
}

TEST_CASE("metar: hostile texts end in one line or are listed") {
    for (const std::string& text :
         {std::string(), std::string("   \n"), std::string("="), std::string("hello world"),
          std::string("METAR"), std::string("METAR EDDF"), std::string("AUTO COR"),
          std::string(4096, 'A'), std::string(5000, ' '), std::string("\x01\x80\xff\0\x1b[2J", 7)})
        CHECK(fault_of(text) != "");
    CHECK(fault_of(std::string(4097, 'A')) == "metar: too long, 4097 bytes, allowed: up to 4096");
    const Metar m = read(std::string("EDDF 121650Z 5000 \x1b[31m \xff\xfe ") +
                         std::string(900, '9') + " " + std::string(900, '/'));
    REQUIRE(m.not_understood.size() == 4);
    CHECK(m.not_understood[0] == "\\x1b[31M");
    CHECK(m.not_understood[1] == "\\xff\\xfe");
    for (const std::string& text : m.not_understood) CHECK(text.size() <= 320);
    std::string many = "EDDF 121650Z";
    while (many.size() + 7 <= kMaxMetarBytes) many += " FEW001";
    const Metar crowd = read(many);
    CHECK(crowd.clouds.size() == kMaxMetarGroups);
    CHECK(crowd.not_understood.size() > 500);
    CHECK(read("EDDF 121650Z RA RA RA RA RA RA RA RA RA").not_understood == Texts{"RA"});
}

TEST_CASE("metar: a text cut anywhere is read or refused") {
    for (const Report& report : kReports) {
        const std::string whole = report.text;
        for (std::size_t length = 0; length < whole.size(); ++length)
            fault_of(whole.substr(0, length));
    }
}
