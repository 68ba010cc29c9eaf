// SPDX-License-Identifier: Apache-2.0
// Reads numbers as scenes do: in the same forms, in every locale.
// in: texts of options -> out: see option_text.h.
// docs/program.md
#include "tools/pileus/option_text.h"

#include <fmt/format.h>

#include "src/base/number_text.h"
#include "src/scene/keys/key_value.h"

namespace pileus {

namespace {

template <class Number>
bool parse(const std::string& text, Number& value) {
    const char* const end = text.data() + text.size();
    const std::from_chars_result r = number_from(text.data(), end, value);
    return r.ec == std::errc() && r.ptr == end;
}

/// A number in any form that a scene takes: 5_000_000, 5e6.
bool parse_toml_number(const std::string& text, Node& value) {
    Node root;
    SyntaxFault ignored;
    if (text.find_first_of("\n\r") != std::string::npos) return false;
    if (!parse_toml("v = " + text, root, ignored) || root.children.size() != 1) return false;
    value = root.children[0];
    return value.is_number();
}

bool parse_integer(const std::string& text, std::int64_t& value) {
    if (parse(text, value)) return true;
    Node node;
    if (!parse_toml_number(text, node)) return false;
    const double number = number_of(node);
    const bool exact = node.kind == NodeKind::kInteger || (number > -0x1p53 && number < 0x1p53);
    if (exact) value = integer_of(node);
    return exact && double(value) == number;
}

bool parse_number(const std::string& text, double& value) {
    if (parse(text, value)) return true;
    Node node;
    if (!parse_toml_number(text, node)) return false;
    value = number_of(node);
    return true;
}

}  // namespace

Status read_integer(const char* option, const std::string& text, std::int64_t low,
                    std::int64_t high, std::int64_t& value) {
    std::int64_t read = 0;
    if (parse_integer(text, read) && read >= low && read <= high) {
        value = read;
        return Status::ok();
    }
    return Status::bad_input(fmt::format("{}: no such whole number, {}, allowed: {} to {}", option,
                                         quote_text(text), low, high));
}

Status read_number(const char* option, const std::string& text, double low, double high,
                   double& value) {
    double read = 0;
    if (parse_number(text, read) && read >= low && read <= high) {
        value = read;
        return Status::ok();
    }
    return Status::bad_input(fmt::format("{}: no such number, {}, allowed: {} to {}", option,
                                         quote_text(text), low, high));
}

Status read_frames(const std::string& text, int frames, int& first, int& last) {
    const std::size_t dash = text.find('-');
    int a = -1, b = -1;
    const bool read = parse(text.substr(0, dash), a) &&
                      parse(dash == std::string::npos ? text : text.substr(dash + 1), b);
    if (!read || a < 0 || b < a || b >= frames)
        return Status::bad_input(
            fmt::format("--frames: no such frames, {}, allowed: A-B within 0-{}", quote_text(text),
                        frames - 1));
    first = a;
    last = b;
    return Status::ok();
}

void add_fault(const Status& fault, Status& all) {
    if (fault) return;
    if (all) all.code = fault.code;
    if (!all.message.empty()) all.message += '\n';
    all.message += fault.message;
}

std::string bytes_text(std::uint64_t bytes) {
    static const char* const units[] = {"KiB", "MiB", "GiB", "TiB"};
    if (bytes < 1024) return fmt::format("{} bytes", bytes);
    double amount = double(bytes) / 1024;
    int unit = 0;
    for (; amount >= 1023.95 && unit < 3; ++unit) amount /= 1024;
    return fmt::format("{:.1f} {}", amount, units[unit]);
}

}  // namespace pileus
