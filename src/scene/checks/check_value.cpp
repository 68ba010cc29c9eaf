// SPDX-License-Identifier: Apache-2.0
// Checks the type, size and range of one value.
// in: a row of the key table and a node -> out: true, or a fault that says what is allowed.
// docs/scene.md, section Messages.
#include "src/base/number_text.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/rows/density_row.h"

namespace pileus {
namespace {

constexpr std::size_t kMaxTexts = 16;

struct ValueCheck {
    const KeyRow& row;
    const std::string& path;
    FaultList& faults;

    bool fault(const Node& node, const char* what) const {
        faults.add(node.at, path,
                   std::string(what) + ", " + value_text(node) + ", allowed: " + allowed_text(row));
        return false;
    }

    bool number(const Node& node) const {
        if (!node.is_number()) return fault(node, "wrong type");
        const double value = number_of(node);
        // Refuse NaN and the infinities apart from the range: no comparison holds for NaN.
        if (!(value - value == 0)) return fault(node, "not finite");
        return holds(row.allowed.range, value) || fault(node, "out of range");
    }

    bool integer(const Node& node) const {
        if (!number(node)) return false;
        if (node.kind == NodeKind::kInteger) return true;
        // Accept 5e6 for a count: a whole number that a double holds exactly.
        const bool exact = node.number > -0x1p53 && node.number < 0x1p53;
        if (exact && node.number == static_cast<double>(static_cast<std::int64_t>(node.number)))
            return true;
        return fault(node, "not a whole number");
    }

    template <class Element>
    bool list(const Node& node, std::size_t count, Element element) const {
        if (!node.is_array()) return fault(node, "wrong type");
        if (node.children.size() != count) return fault(node, "wrong length");
        bool good = true;
        for (const Node& child : node.children) good = element(child) && good;
        return good;
    }

    bool numbers(const Node& node, std::size_t count) const {
        return list(node, count, [this](const Node& n) { return number(n); });
    }
    bool integers(const Node& node, std::size_t count) const {
        return list(node, count, [this](const Node& n) { return integer(n); });
    }

    bool bounds(const Node& node) const {
        if (!list(node, 2, [this](const Node& corner) { return numbers(corner, 3); })) return false;
        for (std::size_t i = 0; i < 3; ++i) {
            const Node &low = node.children[0].children[i], &high = node.children[1].children[i];
            if (!(number_of(low) < number_of(high))) return fault(node, "inverted or empty");
            const double least = least_width(number_of(low), number_of(high));
            if (number_of(high) - number_of(low) >= least) continue;
            faults.add(node.at, path,
                       std::string("too thin along ") + "xyz"[i] + ", " + value_text(node) +
                           ", allowed: at least " + number_text(least) + " m wide there");
            return false;
        }
        return true;
    }

    bool rectangle(const Node& node) const {
        if (!list(node, 2, [this](const Node& corner) { return numbers(corner, 2); })) return false;
        for (std::size_t i = 0; i < 2; ++i)
            if (!(number_of(node.children[0].children[i]) <
                  number_of(node.children[1].children[i])))
                return fault(node, "inverted or empty");
        return true;
    }

    bool text(const Node& node) const {
        if (row.allowed.moments && !node.written.empty()) return true;
        if (!node.is_text()) return fault(node, "wrong type");
        // A null byte would cut a file name short without a word.
        if (node.text.find('\0') != std::string::npos) return fault(node, "null byte in text");
        const Allowed& allowed = row.allowed;
        if (allowed.choices == nullptr || place_in(allowed.choices, node.text) >= 0) return true;
        const bool later = allowed.later != nullptr && place_in(allowed.later, node.text) >= 0;
        return fault(node, later ? "not in this version" : "unknown value");
    }

    /// A text, or true and false where they are among a row's choices.
    bool choice(const Node& node) const {
        const bool flag =
            node.kind == NodeKind::kBool && place_in(row.allowed.choices, choice_text(node)) >= 0;
        return flag || text(node);
    }

    /// A density that is none of the names is the path of a file.
    bool density(const Node& node) const {
        if (!text(node)) return false;
        const bool named = density_row(node.text) != nullptr;
        return named || !is_like_density_name(node.text) || fault(node, "unknown value");
    }

    bool texts(const Node& node) const {
        if (!node.is_array()) return fault(node, "wrong type");
        if (node.children.size() > kMaxTexts) return fault(node, "too many");
        bool good = true;
        for (std::size_t i = 0; i < node.children.size(); ++i) {
            const Node& child = node.children[i];
            bool once = true;
            for (std::size_t j = 0; j < i; ++j) once = once && node.children[j].text != child.text;
            good = text(child) && (once || fault(child, "given twice")) && good;
        }
        return good;
    }
};

}  // namespace

bool check_value(const KeyRow& row, const Node& node, const std::string& path, FaultList& faults) {
    const ValueCheck check{row, path, faults};
    switch (row.kind()) {
        case KeyKind::kBool:
            return node.kind == NodeKind::kBool || check.fault(node, "wrong type");
        case KeyKind::kInteger:
            return check.integer(node);
        case KeyKind::kInteger2:
            return check.integers(node, 2);
        case KeyKind::kInteger3:
            return check.integers(node, 3);
        case KeyKind::kInteger4:
            return check.integers(node, 4);
        case KeyKind::kNumber:
            return check.number(node);
        case KeyKind::kNumber2:
            return check.numbers(node, 2);
        case KeyKind::kNumber3:
            return check.numbers(node, 3);
        case KeyKind::kColor:
            return node.is_array() ? check.numbers(node, 3) : check.number(node);
        case KeyKind::kBounds:
            return check.bounds(node);
        case KeyKind::kRectangle:
            return check.rectangle(node);
        case KeyKind::kText:
            return check.text(node);
        case KeyKind::kChoice:
            return check.choice(node);
        case KeyKind::kTexts:
            return check.texts(node);
        case KeyKind::kIndexOrText:
            return node.is_text() ? check.text(node) : check.integer(node);
        case KeyKind::kDensity:
            return node.is_table() || check.density(node);
        case KeyKind::kRows:
            return check_rows(row, node, path, faults);
        case KeyKind::kTable:
            return node.is_table() || check.fault(node, "wrong type");
        case KeyKind::kLater:
            break;
    }
    faults.add(node.key_at, path,
               "not in this version, " + value_text(node) + ", allowed: nothing");
    return false;
}

}  // namespace pileus
