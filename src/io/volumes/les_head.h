// SPDX-License-Identifier: Apache-2.0
// The head of LES texts, and the fields of their lines.
// in: a text that nobody has checked -> out: sizes, levels, columns; numbers one after the other.
// docs/formats.md
#pragma once
#include <array>
#include <vector>

#include "src/io/text/text_scan.h"
#include "src/io/volumes/les_layers.h"

namespace pileus {

/// What a column of a row holds.
enum LesColumn : std::size_t {
    kLesI,
    kLesJ,
    kLesK,
    kLesLwc,
    kLesReff,
    kLesNeeded,
    kLesPassed = kLesNeeded
};

struct LesHead {
    bool commas = false;             ///< between fields, and names of the columns
    bool shdom = false;              ///< SHDOM's own: temperatures in the head, indices from 1
    std::vector<LesColumn> columns;  ///< of a row; with blanks one more may follow
    std::string passed;              ///< names of columns that do not matter here
    std::array<std::int64_t, 3> size{0, 0, 0};
    std::array<double, 2> step_m{0, 0};  ///< along x and y
    std::vector<double> levels_m;        ///< cell centres, ascending
    LayerStack stack;                    ///< of two levels or more
    TextRange rows;                      ///< what follows the head
};

class LesText : protected TextScan {
public:
    /// `text` has no mark of UTF-8.
    LesText(const std::string& name, Span<const char> text, bool commas)
        : TextScan(name, text, commas ? ',' : ' '), commas_(commas) {}

    Status head(LesHead& head) const;

protected:
    /// Fields of one line, in turn.
    struct Fields {
        TextRange range;
        bool first = true;
    };

    Status open_field(Fields& fields, const std::string& key) const;
    template <class Number>
    Status field(Fields& fields, const std::string& key, Number& value) const {
        PILEUS_TRY(open_field(fields, key));
        return number(fields.range, key, value);
    }
    Status bounded(Fields& fields, const std::string& key, double low, double high,
                   const char* allowed, double& value) const;
    Status number_in(Fields& fields, const std::string& key, double low, double high,
                     const char* allowed, double& value) const;
    Status close(Fields& fields, const std::string& what) const;

    bool commas_;

private:
    Status head_line(TextRange& rest, const char* what, Fields& fields) const;
    Status levels(Fields& fields, LesHead& head) const;
    Status temperatures(TextRange& rest, const LesHead& head) const;
    Status column_names(TextRange& rest, LesHead& head) const;
    Status sizes(TextRange& rest, LesHead& head) const;
};

/// Tells the form by the first line, and reads the head.
Status read_les_text_head(const std::string& name, Span<const char> text, LesHead& head);

}  // namespace pileus
