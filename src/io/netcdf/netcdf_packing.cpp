// SPDX-License-Identifier: Apache-2.0
// See netcdf_packing.h.
#include "src/io/netcdf/netcdf_packing.h"

#include <cmath>

#include "src/base/number_text.h"
#include "src/base/printable.h"
#include "src/io/netcdf/netcdf_values.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool is_whole(NcType type) {
    return type != NcType::kFloat && type != NcType::kDouble && type != NcType::kChar &&
           type != NcType::kOther;
}

bool has_sign(NcType type) {
    return type == NcType::kByte || type == NcType::kShort || type == NcType::kInt ||
           type == NcType::kInt64;
}

/// How many numbers a type of whole ones has.
double span_of(NcType type) {
    double span = 1;
    for (std::uint64_t i = 0; i < nc_bytes(type); ++i) span *= 256;
    return span;
}

/// What the library fills in where nothing was written; NaN: nothing of its own.
double usual_fill(NcType type) {
    switch (type) {
        case NcType::kFloat:
        case NcType::kDouble:
            return 9.9692099683868690e+36;
        case NcType::kShort:
            return -32767;
        case NcType::kInt:
            return -2147483647;
        case NcType::kUShort:
            return 65535;
        case NcType::kUInt:
            return 4294967295.0;
        default:
            return kNan;
    }
}

/// What an attribute holds, for messages.
std::string contents(const NcAttribute& a) {
    if (a.is_text) return "a text, " + quote_text(a.text);
    if (a.numbers.empty()) return "no number";
    std::string list;
    for (const double number : a.numbers)
        if (list.size() < 40) list += (list.empty() ? "" : ", ") + number_text(number);
    return list;
}

}  // namespace

class NcPackingReader {
public:
    NcPackingReader(const std::string& file, const NcVariable& v, NcPacking& packing)
        : file_(file), v_(v), to_(packing) {}

    Status run() {
        if (v_.type == NcType::kChar || v_.type == NcType::kOther) return Status::ok();
        std::string text;
        for (const char* name : {"standard_name", "axis", "positive", "calendar", "formula_terms",
                                 "grid_mapping", "coordinates", "bounds"})
            PILEUS_TRY(read_text(file_, v_, name, text));
        PILEUS_TRY(sign());
        PILEUS_TRY(one("scale_factor", to_.scale_));
        PILEUS_TRY(one("add_offset", to_.offset_));
        if (to_.scale_ == 0) return fault(*v_.find("scale_factor"), "0", "any other number");
        PILEUS_TRY(marks());
        return range();
    }

private:
    Status fault(const NcAttribute& a, const std::string& found, const std::string& allowed) const {
        return nc_fault(file_, v_, a.name + ": " + found + ", allowed: " + allowed);
    }

    /// Numbers of an attribute, at most `most` of them; null where it is not there.
    Status numbers(const char* name, std::size_t least, std::size_t most,
                   const NcAttribute*& found) const {
        found = v_.find(name);
        if (found == nullptr) return Status::ok();
        const std::size_t n = found->is_text ? 0 : found->numbers.size();
        if (n < least || n > most || n == 0)
            return fault(*found, contents(*found),
                         most == 1   ? "one number"
                         : most == 2 ? "two numbers"
                                     : "numbers of the variable's type");
        return Status::ok();
    }

    Status one(const char* name, double& value) const {
        const NcAttribute* a = nullptr;
        PILEUS_TRY(numbers(name, 1, 1, a));
        if (a == nullptr) return Status::ok();
        value = a->numbers[0];
        if (value - value == 0) return Status::ok();
        return fault(*a, number_text(value), "a finite number");
    }

    Status sign() {
        const NcAttribute* a = v_.find("_Unsigned");
        if (a == nullptr) return Status::ok();
        const std::string text = lower_case(a->text);
        const bool on = text == "true", off = text == "false";
        if (!a->is_text || (!on && !off)) return fault(*a, contents(*a), "\"true\" or \"false\"");
        if (on && !is_whole(v_.type))
            return fault(*a, "\"true\" of type " + std::string(nc_type_name(v_.type)),
                         "of whole numbers");
        if (!is_whole(v_.type) || on != has_sign(v_.type)) return Status::ok();
        to_.span_ = span_of(v_.type);
        to_.low_ = on ? 0 : -0.5 * to_.span_;
        return Status::ok();
    }

    /// Numbers that the variable can hold; a mark that it cannot is one of another unit or type.
    bool holds(double number) const {
        if (!is_whole(v_.type)) return true;
        const double span = span_of(v_.type), low = has_sign(v_.type) ? -0.5 * span : 0;
        if (!(number >= -0.5 * span && number < span) || number != std::floor(number)) return false;
        return to_.span_ > 0 || (number >= low && number < low + span);
    }

    void mark(double number) {
        constexpr double kMaxFloat = 3.4028234663852886e38;
        if (number != number) {
            to_.nan_is_missing_ = true;
            return;
        }
        // A mark that is written as a double stands for the float nearest to it.
        const bool rounds =
            v_.type == NcType::kFloat && number >= -kMaxFloat && number <= kMaxFloat;
        to_.missing_.push_back(to_.with_sign(rounds ? double(float(number)) : number));
    }

    Status marks() {
        for (const char* name : {"_FillValue", "missing_value"}) {
            const NcAttribute* a = nullptr;
            PILEUS_TRY(numbers(name, 1, name[0] == '_' ? 1 : 65536, a));
            if (a == nullptr) continue;
            for (const double number : a->numbers) {
                if (!holds(number))
                    return fault(
                        *a, number_text(number),
                        "a number of the variable's type, " + std::string(nc_type_name(v_.type)));
                mark(number);
            }
        }
        const double usual = usual_fill(v_.type);
        if (v_.find("_FillValue") == nullptr && usual == usual) mark(usual);
        return Status::ok();
    }

    /// A limit in the variable's own numbers. Whole numbers may have limits of floats, which are
    /// those of values then; a quarter of a step stands for their rounding.
    Status limit(const NcAttribute& a, double number, bool least) {
        if (number != number) return fault(a, "not a number", "a number");
        const bool packed = v_.find("scale_factor") != nullptr || v_.find("add_offset") != nullptr;
        const bool of_values = packed && is_whole(v_.type) && !is_whole(a.type);
        if (!of_values) {
            (least ? to_.least_ : to_.most_) = to_.with_sign(number);
            return Status::ok();
        }
        const double place = (number - to_.offset_) / to_.scale_;
        if (least == (to_.scale_ > 0))
            to_.least_ = place - 0.25;
        else
            to_.most_ = place + 0.25;
        return Status::ok();
    }

    Status range() {
        const NcAttribute *both = nullptr, *low = nullptr, *high = nullptr;
        PILEUS_TRY(numbers("valid_range", 2, 2, both));
        PILEUS_TRY(numbers("valid_min", 1, 1, low));
        PILEUS_TRY(numbers("valid_max", 1, 1, high));
        if (both != nullptr) {
            PILEUS_TRY(limit(*both, both->numbers[0], true));
            PILEUS_TRY(limit(*both, both->numbers[1], false));
        }
        if (low != nullptr) PILEUS_TRY(limit(*low, low->numbers[0], true));
        if (high != nullptr) PILEUS_TRY(limit(*high, high->numbers[0], false));
        if (!(to_.least_ > to_.most_)) return Status::ok();
        const NcAttribute& a = both != nullptr ? *both : *high;
        return fault(a, number_text(to_.least_) + " to " + number_text(to_.most_) + " as packed",
                     "a range that holds a number");
    }

    const std::string& file_;
    const NcVariable& v_;
    NcPacking& to_;
};

Status NcPacking::of(const std::string& file, const NcVariable& variable, NcPacking& packing) {
    packing = NcPacking();
    return NcPackingReader(file, variable, packing).run();
}

double NcPacking::with_sign(double number) const {
    if (!(span_ > 0)) return number;
    if (number < low_) return number + span_;
    return number >= low_ + span_ ? number - span_ : number;
}

bool NcPacking::take(double number, double& value) const {
    if (number != number) {
        value = number;
        return !nan_is_missing_;
    }
    const double meant = with_sign(number);
    for (const double mark : missing_)
        if (meant == mark) return false;
    if (meant < least_ || meant > most_) return false;
    value = scale_ * meant + offset_;
    return true;
}

Status read_unpacked(const NcFile& file, const NcVariable& variable, const NcBlock& block,
                     Span<double> to) {
    NcPacking packing;
    PILEUS_TRY(NcPacking::of(file.name(), variable, packing));
    PILEUS_TRY(file.read(variable, block, to));
    for (double& value : to)
        if (!packing.take(value, value)) value = kNan;
    return Status::ok();
}

Status read_text(const std::string& file, const NcVariable& variable, const char* name,
                 std::string& text) {
    const NcAttribute* a = variable.find(name);
    text.clear();
    if (a == nullptr) return Status::ok();
    if (!a->is_text)
        return nc_fault(file, variable,
                        std::string(name) + ": " + contents(*a) + ", allowed: a text");
    text = a->text;
    return Status::ok();
}

}  // namespace pileus
