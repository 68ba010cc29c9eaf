// SPDX-License-Identifier: Apache-2.0
// A NetCDF file: its dimensions, attributes and variables, and values as doubles.
// in: a path or bytes that nobody vouches for -> out: plain structs; blocks of one variable.
// Classic files (CDF-1, 2, 5) are read here, those on HDF5 through libnetcdf. docs/formats.md
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "platform/file.h"
#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

/// Numbered as in files.
enum class NcType : std::uint32_t {
    kOther = 0,  ///< of NetCDF-4 alone: texts of any length, structures; not read
    kByte,
    kChar,
    kShort,
    kInt,
    kFloat,
    kDouble,
    kUByte,
    kUShort,
    kUInt,
    kInt64,
    kUInt64
};

/// Bytes of a value; 0 of kOther. "float".
std::uint64_t nc_bytes(NcType type);
const char* nc_type_name(NcType type);

struct NcAttribute {
    std::string name;
    NcType type = NcType::kOther;
    bool is_text = false;
    std::string text;             ///< without the null characters at its end
    std::vector<double> numbers;  ///< none of a type that is not read, or of more than can be meant
};

struct NcDimension {
    std::string name;
    std::uint64_t size = 0;
    bool unlimited = false;
};

struct NcVariable {
    std::string name;
    NcType type = NcType::kOther;
    std::vector<std::size_t> dimensions;  ///< slowest first
    std::vector<NcAttribute> attributes;
    std::uint64_t begin = 0;  ///< of a classic file: where its values stand
    bool by_record = false;   ///< of a classic file: apart for each element of the first dimension

    const NcAttribute* find(const std::string& attribute) const;
    /// Of a text attribute; empty where there is none.
    std::string text(const std::string& attribute) const;
};

struct NcHead {
    std::string kind;  ///< "NetCDF classic, CDF-1"
    bool on_hdf5 = false;
    std::vector<NcDimension> dimensions;
    std::vector<NcAttribute> attributes;
    std::vector<NcVariable> variables;
    std::uint64_t record_bytes = 0;  ///< of a classic file: from one record to the next

    /// Null where there is none.
    const NcVariable* find(const std::string& variable) const;
    const NcAttribute* attribute(const std::string& name) const;
    /// Elements of one dimension of a variable.
    std::uint64_t size(const NcVariable& variable, std::size_t dimension) const {
        return dimensions[variable.dimensions[dimension]].size;
    }
};

/// A block of a variable: first element and count along each of its dimensions.
struct NcBlock {
    std::vector<std::uint64_t> start, count;
    std::uint64_t values() const;
};

/// How much of a variable that is stored in pieces libnetcdf keeps unpacked, and what it needs
/// itself.
constexpr std::uint64_t kNcCacheBytes = std::uint64_t{1} << 25;
constexpr std::uint64_t kNcLibraryBytes = std::uint64_t{3} << 24;

/// All of a variable.
NcBlock whole_block(const NcHead& head, const NcVariable& variable);

class NcFile {
public:
    NcFile() = default;
    NcFile(const NcFile&) = delete;
    NcFile& operator=(const NcFile&) = delete;
    ~NcFile();

    /// Learns how long the file is; `open` goes on from there. Missing: kBadInput.
    Status find(const std::string& path);
    /// Reads the head. A GRIB file is made into a NetCDF file in memory. Missing, neither of them,
    /// damaged, or of a part that was not built in: kBadInput.
    Status open(const std::string& path);
    /// The same of bytes that outlive this; `name` opens every line.
    Status open_bytes(const std::string& name, Span<const char> bytes);

    const NcHead& head() const { return head_; }
    /// Of a file that is held in memory whole.
    std::uint64_t held_bytes() const { return own_.size(); }
    /// Of the file as it lies on the disk.
    std::uint64_t file_bytes() const { return file_.size(); }
    const std::string& name() const { return name_; }

    /// Whether a classic file is long enough for a block, so that memory may be taken for it.
    Status check_room(const NcVariable& variable, const NcBlock& block) const;

    /// Values as they stand in the file, neither scaled nor checked, the last dimension fastest.
    /// `to` has room for exactly the block, which lies within the variable. A file that ends
    /// before: kBadInput; reading failed: kIo.
    Status read(const NcVariable& variable, const NcBlock& block, Span<double> to) const;

private:
    Status open_head(std::uint64_t size);
    Status start(std::uint64_t most, std::string& bytes) const;
    Status take(std::uint64_t at, std::uint64_t count, const char* what, unsigned char* to) const;
    Status read_classic(const NcVariable& variable, const NcBlock& block, Span<double> to) const;
    Status read_run(const NcVariable& variable, std::uint64_t at, Span<double> to) const;

    std::string name_;
    InputFile file_;
    Buffer<char> own_;        ///< of a GRIB file
    Span<const char> bytes_;  ///< instead of file_
    bool in_memory_ = false;
    std::uint64_t size_ = 0;
    NcHead head_;
    int handle_ = -1;  ///< of libnetcdf
};

/// The head of a classic file from its first bytes; `size` is that of all of it.
Status read_classic_head(const std::string& name, Span<const char> start, std::uint64_t size,
                         NcHead& head);

/// "name: variable q: line".
Status nc_fault(const std::string& file, const NcVariable& variable, const std::string& line);

/// Whether libnetcdf was built in: "NetCDF-4 yes".
std::string netcdf_library_text();

// Files on HDF5, by libnetcdf, an optional part; without it: one clear line.

/// Gives a handle to close. Of bytes: they are copied by the library.
Status open_hdf5(const std::string& path, int& handle);
Status open_hdf5_bytes(const std::string& name, Span<const char> bytes, int& handle);
void close_hdf5(int handle);

Status read_hdf5_head(const std::string& name, int handle, NcHead& head);
Status read_hdf5(const std::string& name, int handle, const NcVariable& variable,
                 const NcBlock& block, Span<double> to);

// GRIB files as NetCDF: their fields become variables of a classic file in memory. WMO, Manual on
// Codes, FM 92 GRIB, by ecCodes; docs/weather.md, "Files".

/// "GRIB yes": whether ecCodes was built in.
std::string grib_library_text();

/// Fields of hybrid levels, pressure levels and the ground on one regular grid of longitudes and
/// latitudes; all others are passed over. Not built in, no library, no such field, another grid,
/// levels or times that lack fields: kBadInput; more fields or memory than allowed: kLimit.
Status read_grib(const std::string& path, Buffer<char>& bytes);
/// The same from the bytes of a file.
Status decode_grib(const std::string& name, Span<const char> from, Buffer<char>& bytes);

}  // namespace pileus
