// SPDX-License-Identifier: Apache-2.0
// See sensor_file.h.
// in: bytes of a text that nobody has checked -> out: sensors, or one line file:line:column.
// docs/flux.md, "Sensors"
#include "src/io/text/sensor_file.h"

#include "src/base/angles.h"
#include "src/base/file.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr std::size_t kMaxName = 64;
constexpr double kFarthest = 1e9;  // m
constexpr std::int64_t kMaxSamples = std::int64_t{1} << 31;

class Reader {
public:
    explicit Reader(const std::string& file) : file_(file) {}
    Status all(const Node& root, std::vector<Sensor>& sensors) const;

private:
    Status fault(const Place& at, const std::string& what) const {
        return Status::bad_input(file_ + ':' + std::to_string(at.line) + ':' +
                                 std::to_string(at.column) + ": " + what);
    }
    Status value_fault(const Node& node, const char* allowed) const {
        return fault(node.at, "sensor." + node.key + ": out of range, " + value_text(node) +
                                  ", allowed: " + allowed);
    }
    Status number(const Node& node, double low, double high, const char* allowed,
                  double& out) const {
        if (!node.is_number()) return value_fault(node, allowed);
        out = number_of(node);
        return out >= low && out <= high ? Status::ok() : value_fault(node, allowed);
    }
    Status vector(const Node& node, double most, const char* allowed, Double3& out) const;
    /// A direction of any length, made unit.
    Status unit(const Node& node, Double3& out) const;
    Status keys(const Node& table) const;
    Status place(const Node& table, Sensor& sensor) const;
    Status direction(const Node& table, Sensor& sensor) const;
    Status one(const Node& table, Sensor& sensor) const;

    const std::string& file_;
};

Status Reader::vector(const Node& node, double most, const char* allowed, Double3& out) const {
    if (!node.is_array() || node.children.size() != 3) return value_fault(node, allowed);
    for (std::size_t a = 0; a < 3; ++a) {
        const Node& n = node.children[a];
        const double v = n.is_number() ? number_of(n) : most * 2;
        if (!(v >= -most && v <= most)) return value_fault(node, allowed);
        out[int(a)] = v;
    }
    return Status::ok();
}

Status Reader::unit(const Node& node, Double3& out) const {
    constexpr const char* kAllowed = "[x, y, z], not all 0, each in [-1e+9, 1e+9]";
    PILEUS_TRY(vector(node, kFarthest, kAllowed, out));
    double most = 0;
    for (int a = 0; a < 3; ++a) {
        const double size = out[a] < 0 ? -out[a] : out[a];
        most = size > most ? size : most;
    }
    if (!(most >= 1e-9)) return value_fault(node, kAllowed);
    out *= 1.0 / most;
    out *= 1.0 / __builtin_sqrt(out.x * out.x + out.y * out.y + out.z * out.z);
    return Status::ok();
}

Status Reader::keys(const Node& table) const {
    for (const Node& n : table.children) {
        bool known = false;
        for (const char* key : {"name", "position_m", "direction", "normal", "elevation_deg",
                                "azimuth_deg", "height_m", "samples"})
            known = known || n.key == key;
        if (!known)
            return fault(n.key_at,
                         "sensor." + quote_text(n.key) +
                             ": unknown key, allowed: name, position_m, direction, normal, "
                             "elevation_deg, azimuth_deg, height_m, samples");
    }
    return Status::ok();
}

Status Reader::direction(const Node& table, Sensor& sensor) const {
    const Node *way = table.find("direction"), *normal = table.find("normal");
    const Node *up = table.find("elevation_deg"), *round = table.find("azimuth_deg");
    const int given = (way != nullptr) + (normal != nullptr) + (up != nullptr);
    if (given != 1)
        return fault(table.at,
                     "sensor: looks nowhere or twice, allowed: one of direction, "
                     "normal and elevation_deg (with azimuth_deg)");
    if (round != nullptr && up == nullptr)
        return fault(round->key_at,
                     "sensor.azimuth_deg: without an elevation, allowed: beside elevation_deg");
    if (normal != nullptr) sensor.kind = SensorKind::kPlane;
    if (up == nullptr) return unit(normal != nullptr ? *normal : *way, sensor.direction);
    double elevation = 0, azimuth = 0;
    PILEUS_TRY(number(*up, -90, 90, "number in [-90, 90]", elevation));
    if (round != nullptr) PILEUS_TRY(number(*round, -360, 360, "number in [-360, 360]", azimuth));
    sensor.direction = towards_deg(azimuth, elevation);
    return Status::ok();
}

Status Reader::place(const Node& table, Sensor& sensor) const {
    const Node *at = table.find("position_m"), *height = table.find("height_m");
    if ((at != nullptr) == (height != nullptr))
        return fault(table.at,
                     "sensor: is nowhere or at two places, allowed: one of position_m and "
                     "height_m");
    if (height != nullptr) {
        sensor.kind = SensorKind::kLevel;
        for (const char* key : {"direction", "normal", "elevation_deg", "azimuth_deg"})
            if (const Node* n = table.find(key); n != nullptr)
                return fault(n->key_at, "sensor." + n->key +
                                            ": beside height_m, allowed: beside position_m; a "
                                            "level looks up and down");
        return number(*height, -kFarthest, kFarthest, "number in [-1e+9, 1e+9]", sensor.height_m);
    }
    PILEUS_TRY(vector(*at, kFarthest, "[x, y, z], each in [-1e+9, 1e+9]", sensor.position_m));
    return direction(table, sensor);
}

Status Reader::one(const Node& table, Sensor& sensor) const {
    PILEUS_TRY(keys(table));
    PILEUS_TRY(place(table, sensor));
    if (const Node* n = table.find("samples"); n != nullptr) {
        if (n->kind != NodeKind::kInteger || n->integer < 64 || n->integer > kMaxSamples)
            return value_fault(*n, "whole number in [64, 2147483648]");
        sensor.samples = std::uint64_t(n->integer);
    }
    if (const Node* n = table.find("name"); n != nullptr) {
        bool printable = n->is_text() && !n->text.empty() && n->text.size() <= kMaxName;
        for (std::size_t i = 0; printable && i < n->text.size(); ++i)
            printable = n->text[i] >= ' ' && n->text[i] <= '~';
        if (!printable) return value_fault(*n, "1 to 64 printable ASCII characters");
        sensor.name = n->text;
    }
    return Status::ok();
}

Status Reader::all(const Node& root, std::vector<Sensor>& sensors) const {
    for (const Node& n : root.children)
        if (n.key != "sensor")
            return fault(n.key_at,
                         quote_text(n.key) + ": unknown table, allowed: [[sensor]], each a sensor");
    const Node* list = root.find("sensor");
    if (list == nullptr || !list->is_array() || list->children.empty())
        return fault({-1, 1, 1}, "sensor: none, allowed: 1 to 4096 tables [[sensor]]");
    if (list->children.size() > kMaxSensors)
        return fault(list->key_at, "sensor: too many, " + std::to_string(list->children.size()) +
                                       ", allowed: 1 to 4096");
    for (const Node& table : list->children) {
        if (!table.is_table())
            return fault(table.at,
                         "sensor: " + value_text(table) + ", allowed: a table [[sensor]]");
        Sensor sensor;
        sensor.name = "sensor " + std::to_string(sensors.size());
        PILEUS_TRY(one(table, sensor));
        sensors.push_back(std::move(sensor));
    }
    return Status::ok();
}

}  // namespace

Status decode_sensors(const std::string& name, Span<const char> text,
                      std::vector<Sensor>& sensors) {
    sensors.clear();
    if (text.size > kMaxSensorBytes)
        return Status::limit(name + ": too long, " + std::to_string(text.size) +
                             " bytes, allowed: at most 1048576");
    Node root;
    SyntaxFault syntax;
    if (!parse_toml({text.data, text.size}, root, syntax))
        return Status::bad_input(name + ':' + std::to_string(syntax.line) + ':' +
                                 std::to_string(syntax.column) + ": not TOML, " + syntax.what);
    return Reader(name).all(root, sensors);
}

Status read_sensors(const std::string& path, std::vector<Sensor>& sensors) {
    Buffer<char> bytes;
    PILEUS_TRY(check_file_name(path));
    PILEUS_TRY(read_whole_file(path, kMaxSensorBytes, bytes));
    return decode_sensors(path, bytes.span(), sensors);
}

}  // namespace pileus
