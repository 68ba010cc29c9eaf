// SPDX-License-Identifier: Apache-2.0
// Rows of comparisons with known answers, and the page that shows them.
// in: values with their standard errors, references -> out: verdicts, a section of
// docs/validation.md. docs/validation.md; the rule is that of docs/testing.md, "Two-stage rule".
#pragma once
#include <cstdlib>
#include <string>
#include <vector>

#include "src/base/file.h"
#include "tests/support/long_tests.h"
#include "tests/support/trace_harness.h"

namespace validation {

using namespace pileus;
using trace_test::Mean;

/// printf into a string.
template <class... Args>
std::string text_of(const char* form, Args... args) {
    const int length = std::snprintf(nullptr, 0, form, args...);
    std::string out(std::size_t(length) + 1, '\0');
    std::snprintf(&out[0], out.size(), form, args...);
    out.pop_back();
    return out;
}

/// `plain` samples, or `full` of them where the long forms were asked for.
inline std::uint64_t samples(std::uint64_t plain, std::uint64_t full) {
    return long_tests() ? full : plain;
}

/// Half a unit of the last of `digits` significant digits: what a printed number leaves open.
inline double half_unit(double printed, int digits) {
    if (printed == 0) return 0;
    const double power = std::floor(std::log10(std::fabs(printed)));
    return 0.5 * std::pow(10.0, power - digits + 1);
}

/// A table of one section of the page, between `<!-- name -->` and `<!-- /name -->`.
class Section {
public:
    Section(const char* name, const char* head) : name_(name) { body_ = std::string(head) + "\n"; }
    ~Section() { write(); }
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;

    void line(const std::string& text) { body_ += text + "\n"; }

    /// Two-stage verdict on `measure(multiple of samples, seed)`, and its row. `cells` opens the
    /// row: the columns before the reference, with `|` between them. `open` is what the reference
    /// itself leaves open.
    template <class Measure>
    Mean check(const std::string& row, const std::string& cells, double reference, double open,
               Measure measure) {
        const Mean m = trace_test::check_mean(row, reference, measure, open);
        show(cells, reference, open, m);
        return m;
    }

    /// The row of a value without a verdict.
    void show(const std::string& cells, double reference, double open, const Mean& m) {
        const double off = std::fmax(0.0, std::fabs(m.value - reference) - open);
        const double z = m.error > 0 ? off / m.error : off;
        line(text_of("| %s | %.6g | %.6g | %.1e | %+.2f | %.1e |", cells.c_str(), reference,
                     m.value, m.error, m.value < reference ? -z : z, 7.6 * m.error));
        rows_ += 1;
        most_ = std::fmax(most_, z);
        beyond_two_ += z > 2 ? 1 : 0;
    }

    int rows() const { return rows_; }

private:
    /// Put the body in the place of what stands between the marks of the page, where one is wanted.
    void write() {
        if (rows_ > 0)
            std::printf("%s: %d rows, largest |z| %.2f, %d beyond 2\n", name_.c_str(), rows_, most_,
                        beyond_two_);
        const char* page = std::getenv("PILEUS_VALIDATION_PAGE");
        if (page == nullptr || *page == '\0') return;
        Buffer<char> bytes;
        const Status read = read_whole_file(page, 1u << 24, bytes);
        CHECK_MESSAGE(read, read.message);
        std::string text(bytes.data(), bytes.size());
        const std::string open = "<!-- " + name_ + " -->\n", close = "<!-- /" + name_ + " -->";
        const std::size_t from = text.find(open), to = text.find(close);
        CHECK_MESSAGE(from != std::string::npos, name_, ": no such section in the page");
        CHECK_MESSAGE(to != std::string::npos, name_, ": the section has no end");
        if (from == std::string::npos || to == std::string::npos) return;
        if (rows_ > 0)
            body_ += text_of("\n%d rows, largest \\|z\\| %.2f, %d beyond 2 (by chance: %.1f).\n",
                             rows_, most_, beyond_two_, 0.0455 * rows_);
        text.replace(from + open.size(), to - from - open.size(), body_);
        const Status wrote = write_file(page, {text.data(), text.size()});
        CHECK_MESSAGE(wrote, wrote.message);
    }

    std::string name_, body_;
    int rows_ = 0, beyond_two_ = 0;
    double most_ = 0;
};

}  // namespace validation
