// SPDX-License-Identifier: Apache-2.0
// Opens NetCDF files of either kind and reads blocks of classic ones.
// in: a path or bytes -> out: see netcdf_file.h.
// docs/formats.md
#include "src/io/netcdf/netcdf_file.h"

#include <cstring>

#include "src/base/buffer.h"
#include "src/base/file.h"
#include "src/io/netcdf/netcdf_values.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMaxHead = std::uint64_t{1} << 24;
constexpr std::size_t kPiece = 65536;  // bytes that pass through at once

template <class List>
auto* find_in(List& list, const std::string& name) {
    for (auto& element : list)
        if (element.name == name) return &element;
    return static_cast<decltype(list.data())>(nullptr);
}

/// Goes to the next outer index, the last of `fixed` fastest; false after the last.
bool next(const NcBlock& block, std::size_t fixed, std::vector<std::uint64_t>& index) {
    for (std::size_t k = fixed; k-- > 0;) {
        if (++index[k] < block.count[k]) return true;
        index[k] = 0;
    }
    return false;
}

}  // namespace

const NcAttribute* NcVariable::find(const std::string& attribute) const {
    return find_in(attributes, attribute);
}
std::string NcVariable::text(const std::string& attribute) const {
    const NcAttribute* found = find(attribute);
    return found != nullptr ? found->text : std::string();
}
const NcVariable* NcHead::find(const std::string& variable) const {
    return find_in(variables, variable);
}
const NcAttribute* NcHead::attribute(const std::string& wanted) const {
    return find_in(attributes, wanted);
}

std::uint64_t NcBlock::values() const {
    std::uint64_t product = 1;
    for (const std::uint64_t n : count)
        if (!checked_multiply(product, n, product)) return ~std::uint64_t{0};
    return product;
}

NcBlock whole_block(const NcHead& head, const NcVariable& variable) {
    NcBlock block;
    for (std::size_t k = 0; k < variable.dimensions.size(); ++k) {
        block.start.push_back(0);
        block.count.push_back(head.size(variable, k));
    }
    return block;
}

Status nc_fault(const std::string& file, const NcVariable& variable, const std::string& line) {
    return Status::bad_input(file + ": variable " + printable_line(variable.name) + ": " +
                             printable_line(line));
}

NcFile::~NcFile() {
    if (handle_ >= 0) close_hdf5(handle_);
}

Status NcFile::find(const std::string& path) {
    name_ = path;
    return open_file(path, file_);
}

Status NcFile::open(const std::string& path) {
    if (name_.empty()) PILEUS_TRY(find(path));
    unsigned char start[4] = {};
    size_ = file_.size();
    if (size_ >= 4) PILEUS_TRY(take(0, 4, "head", start));
    if (std::memcmp(start, "GRIB", 4) == 0) {
        PILEUS_TRY(read_grib(path, own_));
        PILEUS_TRY(open_bytes(path, own_.span()));
        head_.kind = "GRIB";
        return Status::ok();
    }
    return open_head(size_);
}

Status NcFile::open_bytes(const std::string& name, Span<const char> bytes) {
    name_ = name;
    bytes_ = bytes;
    in_memory_ = true;
    return open_head(bytes.size);
}

Status NcFile::take(std::uint64_t at, std::uint64_t count, const char* what,
                    unsigned char* to) const {
    if (count == 0 && at <= size_) return Status::ok();
    if (at > size_ || count > size_ - at)
        return Status::bad_input(name_ + ": " + printable_line(what) +
                                 ": the file ends before its values do, " + std::to_string(size_) +
                                 " bytes, allowed: at least " + std::to_string(at + count));
    if (in_memory_) {
        std::memcpy(to, bytes_.data + at, std::size_t(count));
        return Status::ok();
    }
    const FileResult result = file_.read_at(at, to, std::size_t(count));
    return result ? Status::ok() : read_fault(name_, result);
}

Status NcFile::open_head(std::uint64_t size) {
    size_ = size;
    Buffer<char> start;
    PILEUS_TRY(start.resize(size < kMaxHead ? size : kMaxHead, "head of a NetCDF file"));
    PILEUS_TRY(take(0, start.size(), "head", reinterpret_cast<unsigned char*>(start.data())));
    static const char kHdf5[] = "\x89HDF\r\n\x1a\n";
    if (start.size() >= 8 && std::memcmp(start.data(), kHdf5, 8) == 0) {
        PILEUS_TRY(in_memory_ ? open_hdf5_bytes(name_, bytes_, handle_)
                              : open_hdf5(name_, handle_));
        return read_hdf5_head(name_, handle_, head_);
    }
    if (start.size() < 4 || std::memcmp(start.data(), "CDF", 3) != 0)
        return Status::bad_input(name_ +
                                 ": no NetCDF file, it begins otherwise, allowed: CDF-1, "
                                 "CDF-2, CDF-5 or HDF5");
    return read_classic_head(name_, start.span(), size, head_);
}

Status NcFile::check_room(const NcVariable& variable, const NcBlock& block) const {
    if (head_.on_hdf5 || block.values() == 0) return Status::ok();
    std::uint64_t end = variable.begin, step = nc_bytes(variable.type);
    for (std::size_t k = block.count.size(); k-- > 0;) {
        const bool record = k == 0 && variable.by_record;
        std::uint64_t offset = 0;
        if (!checked_multiply(block.start[k] + block.count[k] - 1,
                              record ? head_.record_bytes : step, offset) ||
            __builtin_add_overflow(end, offset, &end) ||
            !checked_multiply(step, record ? 1 : head_.size(variable, k), step))
            return nc_fault(name_, variable, "place: beyond any file");
    }
    end += nc_bytes(variable.type);
    if (end <= size_) return Status::ok();
    return nc_fault(name_, variable,
                    "the file ends before its values do, " + std::to_string(size_) +
                        " bytes, allowed: at least " + std::to_string(end));
}

Status NcFile::read(const NcVariable& variable, const NcBlock& block, Span<double> to) const {
    if (block.values() != to.size || block.count.size() != variable.dimensions.size())
        return nc_fault(name_, variable, "block: of another size than its room");
    for (std::size_t k = 0; k < block.count.size(); ++k) {
        const std::uint64_t size = head_.size(variable, k);
        if (block.start[k] > size || block.count[k] > size - block.start[k])
            return nc_fault(name_, variable, "block: outside the variable");
    }
    if (variable.type == NcType::kOther)
        return nc_fault(name_, variable,
                        "type: neither number nor character, allowed: byte to uint64");
    if (to.size == 0) return Status::ok();
    PILEUS_TRY(check_room(variable, block));
    if (head_.on_hdf5) return read_hdf5(name_, handle_, variable, block, to);
    return read_classic(variable, block, to);
}

Status NcFile::read_run(const NcVariable& variable, std::uint64_t at, Span<double> to) const {
    unsigned char piece[kPiece];
    const std::size_t bytes = std::size_t(nc_bytes(variable.type));
    const std::size_t most = kPiece / bytes;
    const std::string what = "variable " + variable.name;
    for (std::size_t from = 0; from < to.size; from += most) {
        const std::size_t count = to.size - from < most ? to.size - from : most;
        PILEUS_TRY(take(at + from * bytes, count * bytes, what.c_str(), piece));
        nc_values(variable.type, piece, to.part(from, count));
    }
    return Status::ok();
}

Status NcFile::read_classic(const NcVariable& variable, const NcBlock& block,
                            Span<double> to) const {
    // Trailing dimensions that are taken whole make one run with the one before them.
    const std::size_t sides = block.count.size(), least = variable.by_record ? 1 : 0;
    std::size_t fixed = sides;
    std::uint64_t run = 1;
    while (fixed > least) {
        --fixed;
        run *= block.count[fixed];
        if (block.count[fixed] != head_.size(variable, fixed)) break;
    }
    std::vector<std::uint64_t> step(sides, nc_bytes(variable.type)), index(sides, 0);
    for (std::size_t k = sides; k-- > 0;)
        if (k + 1 < sides) step[k] = step[k + 1] * head_.size(variable, k + 1);
    if (variable.by_record) step[0] = head_.record_bytes;
    std::size_t done = 0;
    do {
        std::uint64_t at = variable.begin;
        for (std::size_t k = 0; k < sides; ++k) {
            std::uint64_t offset = 0;
            if (!checked_multiply(block.start[k] + index[k], step[k], offset) ||
                __builtin_add_overflow(at, offset, &at) || at >> 62 != 0)
                return nc_fault(name_, variable, "place: beyond any file");
        }
        PILEUS_TRY(read_run(variable, at, to.part(done, std::size_t(run))));
        done += std::size_t(run);
    } while (next(block, fixed, index));
    return Status::ok();
}

}  // namespace pileus
