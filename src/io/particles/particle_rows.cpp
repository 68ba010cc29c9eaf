// SPDX-License-Identifier: Apache-2.0
// See particle_rows.h.
#include "src/io/particles/particle_rows.h"

#include <algorithm>
#include <cstring>

#include "src/base/number_text.h"
#include "src/base/reading_limit.h"
#include "src/base/single.h"

namespace pileus {

namespace {

/// A role in a row: the names that it goes by, parted by '|', and the numbers that it takes.
struct RoleRow {
    const char* names;
    double least, most;
    bool above;  ///< the least itself is out of range
};

constexpr double kMaxId = 0x1p53;
constexpr RoleRow kRoleRows[] = {
    {"|x|px|position_x|", -kMaxParticlePlace, kMaxParticlePlace, false},
    {"|y|py|position_y|", -kMaxParticlePlace, kMaxParticlePlace, false},
    {"|z|pz|position_z|", -kMaxParticlePlace, kMaxParticlePlace, false},
    {"|radius|pscale|", 0, kMaxParticlePlace, true},
    {"|density|extinction|", 0, 1e12, false},
    {"|red|r|color_r|colour_r|", 0, 1, false},
    {"|green|g|color_g|colour_g|", 0, 1, false},
    {"|blue|b|color_b|colour_b|", 0, 1, false},
    {"|id|", 0, kMaxId, false},
    {"|vx|velocity_x|", -kMaxParticlePlace, kMaxParticlePlace, false},
    {"|vy|velocity_y|", -kMaxParticlePlace, kMaxParticlePlace, false},
    {"|vz|velocity_z|", -kMaxParticlePlace, kMaxParticlePlace, false},
    {"|emission_red|emission_r|", 0, 1e9, false},
    {"|emission_green|emission_g|", 0, 1e9, false},
    {"|emission_blue|emission_b|", 0, 1e9, false},
};

std::string short_name(const RoleRow& role) {
    const std::string names = role.names;
    return names.substr(1, names.find('|', 1) - 1);
}

int role_of(std::string name) {
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    if (name.empty() || name.find('|') != std::string::npos) return -1;
    for (int i = 0; i < int(sizeof kRoleRows / sizeof kRoleRows[0]); ++i)
        if (std::string(kRoleRows[i].names).find('|' + name + '|') != std::string::npos) return i;
    return -1;
}

std::string number_of(double v) { return number_text(v, 9); }

}  // namespace

Status ParticleRows::fault(std::uint64_t particle, int role, double value) const {
    const RoleRow& r = kRoleRows[role];
    return Status::bad_input(file_ + ": particle " + std::to_string(particle) + ": " +
                             short_name(r) + ": out of range, " + number_of(value) +
                             ", allowed: number in " + (r.above ? "(" : "[") + number_of(r.least) +
                             ", " + number_of(r.most) + "]");
}

Status ParticleRows::begin(const std::vector<ParticleColumn>& columns, std::uint64_t count,
                           const ParticleReading& reading) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const int role = role_of(columns[i].name);
        if (role < 0) continue;
        if (columns_[role].at >= 0)
            return Status::bad_input(file_ + ": " + short_name(kRoleRows[role]) +
                                     ": given twice, allowed: one column");
        columns_[role].at = int(i);
        if (columns[i].byte && role >= kRed && role <= kBlue) columns_[role].scale = 1.0 / 255;
    }
    for (const int axis : {kX, kY, kZ})
        if (columns_[axis].at < 0)
            return Status::bad_input(file_ + ": " + short_name(kRoleRows[axis]) +
                                     ": missing, nothing, allowed: columns x, y and z");
    radius_ = reading.radius;
    progress_ = reading.progress;
    if (columns_[kRadius].at < 0 && !(radius_ > 0))
        return Status::bad_input(file_ +
                                 ": radius: missing, nothing, allowed: a column radius, or the key "
                                 "density.radius_m");
    const auto three = [&](int first) {
        int given = 0;
        for (int i = 0; i < 3; ++i) given += columns_[first + i].at >= 0 ? 1 : 0;
        return given;
    };
    const int colours = three(kRed), speeds = three(kSpeedX), glows = three(kGlowRed);
    if (colours != 0 && colours != 3)
        return Status::bad_input(file_ + ": colour: not whole, " + std::to_string(colours) +
                                 " columns, allowed: red, green and blue, or none");
    if (speeds != 0 && speeds != 3)
        return Status::bad_input(file_ + ": velocity: not whole, " + std::to_string(speeds) +
                                 " columns, allowed: vx, vy and vz, or none");
    if (glows != 0 && glows != 3)
        return Status::bad_input(file_ + ": emission: not whole, " + std::to_string(glows) +
                                 " columns, allowed: emission_red, emission_green and "
                                 "emission_blue, or none");
    if (count > reading.most)
        return Status::limit(file_ + ": too many particles, " + std::to_string(count) +
                             ", allowed: at most " + std::to_string(reading.most));
    const std::uint64_t floats =
        std::uint64_t(4 + colours + glows + speeds) + (columns_[kDensity].at >= 0 ? 1 : 0);
    const std::uint64_t each = 4 * floats + (columns_[kId].at >= 0 ? sizeof(std::uint64_t) : 0);
    PILEUS_TRY(check_reading(file_, count * each));
    set_ = ParticleSet();
    set_.count = count;
    PILEUS_TRY(set_.position.resize(3 * count, "particles"));
    PILEUS_TRY(set_.radius.resize(count, "particles"));
    if (columns_[kDensity].at >= 0) PILEUS_TRY(set_.density.resize(count, "particles"));
    if (colours == 3) PILEUS_TRY(set_.colour.resize(3 * count, "particles"));
    if (glows == 3) PILEUS_TRY(set_.emission.resize(3 * count, "particles"));
    if (speeds == 3) PILEUS_TRY(set_.velocity.resize(3 * count, "particles"));
    if (columns_[kId].at >= 0) PILEUS_TRY(set_.id.resize(count, "particles"));
    for (int a = 0; a < 3; ++a) set_.low[a] = 4 * kMaxParticlePlace, set_.high[a] = -set_.low[a];
    return Status::ok();
}

Status ParticleRows::measure(std::uint64_t particle, Span<const double> row) {
    tell(0, particle);
    for (int role = 0; role < kRoles; ++role) {
        if (columns_[role].at < 0 || (role == kRadius && radius_ > 0)) continue;
        const RoleRow& r = kRoleRows[role];
        const double v = number(role, row);
        if (!(v >= r.least && v <= r.most) || (r.above && v == r.least) ||
            (role == kId && v != double(std::uint64_t(v))))
            return fault(particle, role, v);
    }
    // A radius below what floats hold would be none.
    const double radius = radius_of(row);
    if (!(single_or_0(radius) > 0)) return fault(particle, kRadius, radius);
    for (int a = 0; a < 3; ++a) {
        const double v = number(kX + a, row);
        set_.low[a] = std::min(set_.low[a], v - radius);
        set_.high[a] = std::max(set_.high[a], v + radius);
    }
    return Status::ok();
}

void ParticleRows::measured() {
    if (set_.count == 0) set_.low = set_.high = Double3{};
    // A whole number: places near it lose no digit by being counted from it.
    for (int a = 0; a < 3; ++a) {
        const double middle = 0.5 * set_.low[a] + 0.5 * set_.high[a];
        set_.origin[a] = double(std::int64_t(middle));
    }
}

Status ParticleRows::keep(std::uint64_t particle, Span<const double> row) {
    tell(0.5, particle);
    const std::size_t i = std::size_t(particle);
    for (std::size_t a = 0; a < 3; ++a)
        set_.position.at(3 * i + a) = float(number(int(a), row) - set_.origin[int(a)]);
    set_.radius.at(i) = float(radius_of(row));
    if (!set_.density.empty()) set_.density.at(i) = float(number(kDensity, row));
    for (std::size_t c = 0; c < 3 && !set_.colour.empty(); ++c)
        set_.colour.at(3 * i + c) = float(number(kRed + int(c), row));
    for (std::size_t c = 0; c < 3 && !set_.emission.empty(); ++c)
        set_.emission.at(3 * i + c) = float(number(kGlowRed + int(c), row));
    for (std::size_t a = 0; a < 3 && !set_.velocity.empty(); ++a)
        set_.velocity.at(3 * i + a) = float(number(kSpeedX + int(a), row));
    if (!set_.id.empty()) set_.id.at(i) = std::uint64_t(number(kId, row));
    return Status::ok();
}

namespace {

/// Names in lower case, parted by '|', as Houdini, Maya and Partio have them.
struct AttributeRow {
    const char* names;
    const char* columns[3];
};
constexpr AttributeRow kAttributeRows[] = {
    {"|p|position|", {"x", "y", "z"}},
    {"|v|velocity|", {"vx", "vy", "vz"}},
    {"|cd|color|rgbpp|", {"red", "green", "blue"}},
    {"|pscale|radius|radiuspp|", {"radius", nullptr, nullptr}},
    {"|density|", {"density", nullptr, nullptr}},
    {"|id|particleid|", {"id", nullptr, nullptr}},
};

const AttributeRow* attribute_row(std::string name) {
    if (name.empty() || name.find('|') != std::string::npos) return nullptr;
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    for (const AttributeRow& row : kAttributeRows)
        if (std::string(row.names).find('|' + name + '|') != std::string::npos) return &row;
    return nullptr;
}

}  // namespace

std::string ParticleAttributes::add(const std::string& name, std::uint64_t size) {
    if (++attributes_ > kMaxAttributes)
        return "attributes: too many, allowed: at most " + std::to_string(kMaxAttributes);
    if (size > kMaxAttributeNumbers - numbers())
        return "attribute " + name + ": too long, " + std::to_string(size) + ", allowed: at most " +
               std::to_string(kMaxAttributeNumbers) + " numbers for a particle";
    const AttributeRow* row = attribute_row(name);
    const std::uint64_t wanted = row == nullptr ? size : row->columns[1] != nullptr ? 3 : 1;
    if (size != wanted)
        return "attribute " + name + ": wrong size, " + std::to_string(size) +
               ", allowed: " + std::to_string(wanted);
    for (std::uint64_t i = 0; i < size; ++i)
        columns_.push_back({row != nullptr ? row->columns[i] : "", false});
    return "";
}

double attribute_number(const unsigned char* from, bool big_endian, bool floats) {
    std::uint32_t bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits = bits << 8 | from[big_endian ? i : 3 - i];
    if (floats) {
        float value;
        std::memcpy(&value, &bits, sizeof value);
        return double(value);
    }
    return double(bits) - ((bits & 0x80000000u) != 0 ? 0x1p32 : 0);
}

}  // namespace pileus
