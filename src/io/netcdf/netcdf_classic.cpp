// SPDX-License-Identifier: Apache-2.0
// The head of a classic NetCDF file.
// in: bytes that nobody vouches for -> out: see netcdf_file.h, read_classic_head.
// Unidata, "NetCDF Classic Format Specification" (CDF-1, CDF-2), and CDF-5 of PnetCDF.
#include <cstring>

#include "src/base/buffer.h"
#include "src/io/netcdf/netcdf_values.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMaxNumbers = 65536;  // of one attribute; of more none is kept
constexpr std::uint32_t kDimensionList = 10, kVariableList = 11, kAttributeList = 12;

/// Walks through big-endian numbers; every step is checked against the end.
class Reader {
public:
    Reader(const std::string& file, Span<const char> bytes, std::uint64_t size, NcHead& head)
        : file_(file), bytes_(bytes), size_(size), head_(head) {}

    Status run() {
        PILEUS_TRY(magic());
        PILEUS_TRY(number(wide_ ? 8 : 4, "count of records", records_));
        PILEUS_TRY(dimensions());
        PILEUS_TRY(attributes(head_.attributes));
        PILEUS_TRY(variables());
        return records();
    }

private:
    Status fault(const std::string& line) const {
        return Status::bad_input(file_ + ": byte " + std::to_string(at_) + ": " +
                                 printable_line(line));
    }
    Status take(std::uint64_t count, const char* what, const unsigned char*& from) {
        if (count > bytes_.size - at_)
            return fault(std::string(what) + ": ends too early, " +
                         std::to_string(bytes_.size - at_) + " bytes left, allowed: at least " +
                         std::to_string(count));
        from = reinterpret_cast<const unsigned char*>(bytes_.data) + at_;
        at_ += count;
        return Status::ok();
    }
    Status number(unsigned width, const char* what, std::uint64_t& value) {
        const unsigned char* from = nullptr;
        PILEUS_TRY(take(width, what, from));
        value = 0;
        for (unsigned i = 0; i < width; ++i) value = value << 8 | from[i];
        return Status::ok();
    }
    Status count(const char* what, std::uint64_t& value) {
        return number(wide_ ? 8 : 4, what, value);
    }

    Status magic() {
        const unsigned char* from = nullptr;
        PILEUS_TRY(take(4, "magic number", from));
        version_ = from[3];
        if (version_ != 1 && version_ != 2 && version_ != 5)
            return fault("version: unknown, " + std::to_string(version_) +
                         ", allowed: 1, 2, 5 of classic NetCDF");
        wide_ = version_ == 5;
        head_.kind = "NetCDF classic, CDF-" + std::to_string(version_);
        return Status::ok();
    }

    /// The tag of a list and how many elements follow, each of at least `least` bytes.
    Status list(std::uint32_t tag, const char* what, std::uint64_t least, std::uint64_t& elements) {
        std::uint64_t found = 0;
        PILEUS_TRY(number(4, what, found));
        PILEUS_TRY(count(what, elements));
        if (found != tag && !(found == 0 && elements == 0))
            return fault(std::string(what) + ": damaged list, tag " + std::to_string(found) +
                         ", allowed: " + std::to_string(tag));
        if (elements > (bytes_.size - at_) / least)
            return fault(std::string(what) + ": too many for the file, " +
                         std::to_string(elements));
        return Status::ok();
    }
    Status padded(std::uint64_t length, const char* what, const unsigned char*& from) {
        if (length > bytes_.size) return fault(std::string(what) + ": longer than the file");
        return take((length + 3) / 4 * 4, what, from);
    }
    Status text(const char* what, std::string& value) {
        std::uint64_t length = 0;
        const unsigned char* from = nullptr;
        PILEUS_TRY(count(what, length));
        PILEUS_TRY(padded(length, what, from));
        value.assign(reinterpret_cast<const char*>(from), std::size_t(length));
        return Status::ok();
    }
    Status type(NcType& value) {
        std::uint64_t found = 0;
        PILEUS_TRY(number(4, "type", found));
        const std::uint64_t most = wide_ ? 11 : 6;
        if (found < 1 || found > most)
            return fault("type: unknown, " + std::to_string(found) + ", allowed: 1 to " +
                         std::to_string(most));
        value = NcType(found);
        return Status::ok();
    }

    Status dimensions() {
        std::uint64_t elements = 0;
        PILEUS_TRY(list(kDimensionList, "dimensions", 8, elements));
        for (std::uint64_t i = 0; i < elements; ++i) {
            NcDimension d;
            PILEUS_TRY(text("name of a dimension", d.name));
            PILEUS_TRY(count("length of a dimension", d.size));
            d.unlimited = d.size == 0;
            head_.dimensions.push_back(d);
        }
        return Status::ok();
    }

    Status attributes(std::vector<NcAttribute>& to) {
        std::uint64_t elements = 0;
        PILEUS_TRY(list(kAttributeList, "attributes", 12, elements));
        for (std::uint64_t i = 0; i < elements; ++i) {
            NcAttribute a;
            NcType kind;
            std::uint64_t values = 0, bytes = 0;
            const unsigned char* from = nullptr;
            PILEUS_TRY(text("name of an attribute", a.name));
            PILEUS_TRY(type(kind));
            PILEUS_TRY(count("length of an attribute", values));
            if (!checked_multiply(values, nc_bytes(kind), bytes))
                return fault("length of an attribute: too large, " + std::to_string(values));
            PILEUS_TRY(padded(bytes, "attribute", from));
            a.type = kind;
            a.is_text = kind == NcType::kChar;
            if (a.is_text) {
                a.text.assign(reinterpret_cast<const char*>(from), std::size_t(values));
                while (!a.text.empty() && a.text.back() == '\0') a.text.pop_back();
            } else {
                a.numbers.resize(values <= kMaxNumbers ? std::size_t(values) : 0);
                nc_values(kind, from, {a.numbers.data(), a.numbers.size()});
            }
            to.push_back(std::move(a));
        }
        return Status::ok();
    }

    Status variables() {
        std::uint64_t elements = 0;
        PILEUS_TRY(list(kVariableList, "variables", 24, elements));
        for (std::uint64_t i = 0; i < elements; ++i) {
            NcVariable v;
            std::uint64_t sides = 0, bytes = 0;
            PILEUS_TRY(text("name of a variable", v.name));
            PILEUS_TRY(count("dimensions of a variable", sides));
            if (sides > 32)
                return fault("variable " + v.name + ": too many dimensions, " +
                             std::to_string(sides) + ", allowed: at most 32");
            for (std::uint64_t k = 0; k < sides; ++k) {
                std::uint64_t index = 0;
                PILEUS_TRY(count("dimension of a variable", index));
                if (index >= head_.dimensions.size())
                    return fault("variable " + v.name + ": no such dimension, " +
                                 std::to_string(index));
                v.by_record = v.by_record || head_.dimensions[std::size_t(index)].unlimited;
                if (head_.dimensions[std::size_t(index)].unlimited && k > 0)
                    return fault("variable " + v.name +
                                 ": the unlimited dimension is not its first");
                v.dimensions.push_back(std::size_t(index));
            }
            PILEUS_TRY(attributes(v.attributes));
            PILEUS_TRY(type(v.type));
            PILEUS_TRY(count("size of a variable", bytes));
            PILEUS_TRY(number(version_ == 1 ? 4 : 8, "place of a variable", v.begin));
            head_.variables.push_back(std::move(v));
        }
        return Status::ok();
    }

    /// Bytes of a variable, or of one record of it; the sizes that the head states may be cut.
    Status slab_bytes(const NcVariable& v, std::uint64_t& bytes) const {
        bytes = nc_bytes(v.type);
        for (std::size_t k = v.by_record ? 1 : 0; k < v.dimensions.size(); ++k)
            if (!checked_multiply(bytes, head_.size(v, k), bytes) || bytes >> 60 != 0)
                return Status::limit(file_ + ": variable " + v.name +
                                     ": more elements than can be counted, allowed: 2^60 bytes");
        return Status::ok();
    }

    /// How long a record is and, where the head leaves it open, how many there are.
    Status records() {
        std::uint64_t step = 0, first = ~std::uint64_t{0}, kinds = 0, alone = 0;
        for (const NcVariable& v : head_.variables) {
            std::uint64_t bytes = 0;
            PILEUS_TRY(slab_bytes(v, bytes));
            if (!v.by_record) continue;
            ++kinds;
            alone = bytes;
            step += (bytes + 3) / 4 * 4;
            if (step >> 60 != 0)
                return Status::limit(file_ + ": records: longer than can be counted");
            if (v.begin < first) first = v.begin;
        }
        // A record of one variable alone is not padded.
        if (kinds == 1) step = alone;
        head_.record_bytes = step;
        const std::uint64_t open = wide_ ? ~std::uint64_t{0} : 0xffffffffu;
        if (records_ == open) records_ = step > 0 && first < size_ ? (size_ - first) / step : 0;
        if (records_ >> 48 != 0)
            return Status::limit(file_ + ": records: more than can be counted, " +
                                 std::to_string(records_));
        for (NcDimension& d : head_.dimensions)
            if (d.unlimited) d.size = records_;
        return Status::ok();
    }

    const std::string& file_;
    Span<const char> bytes_;
    std::uint64_t at_ = 0, size_;
    NcHead& head_;
    unsigned version_ = 0;
    bool wide_ = false;
    std::uint64_t records_ = 0;
};

}  // namespace

Status read_classic_head(const std::string& name, Span<const char> start, std::uint64_t size,
                         NcHead& head) {
    head = NcHead();
    return Reader(name, start, size, head).run();
}

}  // namespace pileus
