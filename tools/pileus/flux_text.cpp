// SPDX-License-Identifier: Apache-2.0
// See flux_text.h.
// in: FluxResult -> out: lines, JSON, bytes.
// docs/flux.md
#define JSON_NOEXCEPTION 1
#include "tools/pileus/flux_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace pileus {
namespace {

using Json = nlohmann::ordered_json;

/// All channels as one, weighed by the incident light in each.
struct Weighed {
    double mean = 0, standard_error = 0;
};
Weighed weigh(const FluxResult& flux, const FluxShare& share) {
    Weighed out;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double weight = double(flux.irradiance[c]);
        sum += weight;
        out.mean += weight * share.mean[c];
        // Channels share their paths: their errors add up.
        out.standard_error += weight * share.standard_error[c];
    }
    return {out.mean / sum, out.standard_error / sum};
}

/// What is not direct.
FluxShare diffuse_of(const FluxResult& flux) {
    FluxShare out = flux.transmittance;
    for (std::size_t c = 0; c < 3; ++c) out.mean[c] -= flux.transmittance_direct.mean[c];
    return out;
}

FluxShare scaled(const FluxShare& share, double factor) {
    FluxShare out = share;
    for (std::size_t c = 0; c < 3; ++c) {
        out.mean[c] *= factor;
        out.standard_error[c] *= factor;
    }
    return out;
}

Json weighed_json(const FluxResult& flux, const FluxShare& share) {
    const Weighed all = weigh(flux, share);
    return {{"mean", all.mean},
            {"standard_error", all.standard_error},
            {"channels", share.mean},
            {"channel_errors", share.standard_error}};
}

Json channels_json(const FluxShare& share) {
    return {{"channels", share.mean}, {"channel_errors", share.standard_error}};
}

double layer_height(const AbsorbedPower& power, std::size_t layer) {
    const double low = power.bounds_m[0].z, high = power.bounds_m[1].z;
    return low + (high - low) * (double(layer) + 0.5) / double(power.cells[2]);
}

Json absorbed_json(const AbsorbedPower& power, double factor, const char* unit) {
    Json json;
    json["unit"] = unit;
    json["box"] = channels_json(scaled(power.all, factor));
    std::array<double, 3> largest = power.largest;
    for (double& v : largest) v *= factor;
    json["largest"] = largest;
    for (std::size_t z = 0; z < power.layers.size(); ++z) {
        Json layer = channels_json(scaled(power.layers[z], factor));
        layer["height_m"] = layer_height(power, z);
        json["layers"].push_back(std::move(layer));
    }
    return json;
}

Json sensor_json(const Sensor& sensor, const SensorReading& reading) {
    Json json;
    json["name"] = sensor.name;
    FluxShare direct;
    direct.mean = reading.direct;
    const Double3 &at = sensor.position_m, &d = sensor.direction;
    if (sensor.kind == SensorKind::kLevel) {
        json["height_m"] = sensor.height_m;
        json["up"] = channels_json(reading.up);
        json["down"] = channels_json(reading.down);
        json["down_direct"] = channels_json(direct);
    } else {
        const bool plane = sensor.kind == SensorKind::kPlane;
        json["position_m"] = {at.x, at.y, at.z};
        json[plane ? "normal" : "direction"] = {d.x, d.y, d.z};
        json[plane ? "irradiance" : "radiance"] =
            channels_json(plane ? reading.down : reading.radiance);
        if (plane) json["irradiance_direct"] = channels_json(direct);
    }
    json["samples"] = reading.samples;
    return json;
}

std::string share_line(const char* name, const Weighed& all) {
    return fmt::format("{:24} {:.6f}  standard error {:.6f}\n", name, all.mean, all.standard_error);
}

/// A line of three channels and their errors.
std::string channels_line(const std::string& name, const FluxShare& share) {
    const auto &m = share.mean, &e = share.standard_error;
    return fmt::format("{:24} {:.6g} {:.6g} {:.6g}  standard error {:.3g} {:.3g} {:.3g}\n", name,
                       m[0], m[1], m[2], e[0], e[1], e[2]);
}

std::string absorbed_lines(const AbsorbedPower& power, const AirHeating& heating) {
    const auto& n = power.cells;
    std::string text = channels_line("absorbed, W/m3", power.all);
    const auto largest = [&](const char* name, double factor) {
        return fmt::format("{:24} {:.6g} {:.6g} {:.6g}  of {} x {} x {} cells\n", name,
                           power.largest[0] * factor, power.largest[1] * factor,
                           power.largest[2] * factor, n[0], n[1], n[2]);
    };
    text += largest("  largest", 1);
    if (!heating.wanted()) return text;
    text += channels_line("heating, K/day", scaled(power.all, heating.kelvin_per_day()));
    return text + largest("  largest", heating.kelvin_per_day());
}

std::string sensor_lines(const FluxSettings& settings, const FluxResult& flux) {
    std::string text;
    for (std::size_t i = 0; i < flux.sensors.size(); ++i) {
        const Sensor& sensor = settings.sensors[i];
        const SensorReading& reading = flux.sensors[i];
        if (sensor.kind == SensorKind::kLevel) {
            text += channels_line(sensor.name + ", up", reading.up);
            text += channels_line(sensor.name + ", down", reading.down);
        } else {
            text += channels_line(
                sensor.name, sensor.kind == SensorKind::kPlane ? reading.down : reading.radiance);
        }
    }
    return text;
}

void append(float value, Span<char> to, std::size_t& at) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    for (unsigned b = 0; b < 4; ++b) to.at(at++) = char(bits >> (8 * b) & 255);
}

bool same(const Buffer<float>& a, const Buffer<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

}  // namespace

std::string flux_lines(const FluxSettings& settings, const FluxResult& flux,
                       const AirHeating& heating) {
    std::string text = share_line("reflectance", weigh(flux, flux.reflectance));
    text += share_line("transmittance", weigh(flux, flux.transmittance));
    text += share_line("  direct", weigh(flux, flux.transmittance_direct));
    text += share_line("  diffuse", weigh(flux, diffuse_of(flux)));
    text += share_line("absorptance", weigh(flux, flux.absorptance));
    if (flux.absorbed.cells[0] > 0) text += absorbed_lines(flux.absorbed, heating);
    text += sensor_lines(settings, flux);
    text += settings.from_below
                ? "of the flux from below"
                : fmt::format("of the sun's irradiance on a level plane, mu0 {:.6g}", flux.mu0);
    text += fmt::format("; {} x {} columns, ", flux.columns[0], flux.columns[1]);
    if (settings.method == FluxMethod::kPhotons)
        text += fmt::format("{} photons in {} batches\n", flux.photons, flux.batches);
    else
        text += fmt::format("{} paths each\n", flux.samples);
    if (flux.terminated > 0)
        text += fmt::format("{:.3g} of the light was given up: photons with too many events\n",
                            flux.terminated);
    return text;
}

std::string flux_json(const FluxSettings& settings, const FluxResult& flux,
                      const AirHeating& heating, const Report& report) {
    Json json;
    json["version"] = report.version;
    json["scene"] = report.scene;
    json["method"] = report.method;
    json["seed"] = report.seed;
    json["light"] = settings.from_below ? "below" : "scene";
    json["mu0"] = flux.mu0;
    json["irradiance"] = flux.irradiance;
    json["reflectance"] = weighed_json(flux, flux.reflectance);
    json["transmittance"] = weighed_json(flux, flux.transmittance);
    json["transmittance_direct"] = weighed_json(flux, flux.transmittance_direct);
    json["transmittance_diffuse"] = weighed_json(flux, diffuse_of(flux));
    json["absorptance"] = weighed_json(flux, flux.absorptance);
    json["columns"] = flux.columns;
    if (settings.method == FluxMethod::kPhotons) {
        json["photons"] = flux.photons;
        json["batches"] = flux.batches;
        json["terminated"] = flux.terminated;
    } else {
        json["samples_per_column"] = flux.samples;
        json["paths"] = flux.paths;
    }
    if (flux.absorbed.cells[0] > 0) {
        json["cells"] = flux.absorbed.cells;
        json["absorbed"] = absorbed_json(flux.absorbed, 1, "W/m3");
        if (heating.wanted())
            json["heating"] = absorbed_json(flux.absorbed, heating.kelvin_per_day(), "K/day");
    }
    for (std::size_t i = 0; i < flux.sensors.size(); ++i)
        json["sensors"].push_back(sensor_json(settings.sensors[i], flux.sensors[i]));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Status absorbed_file(const AbsorbedPower& power, const AirHeating& heating, const std::string& path,
                     Buffer<char>& bytes, std::string& head) {
    bool grey = true;
    for (std::size_t c = 1; c < 3; ++c)
        grey = grey && same(power.mean[0], power.mean[c]) && same(power.error[0], power.error[c]);
    const std::size_t channels = grey ? 1 : 3, cells = power.mean[0].size();
    PILEUS_TRY(bytes.resize(std::uint64_t(cells) * channels * 8, path.c_str()));
    std::size_t at = 0;
    for (const Buffer<float>* planes : {power.mean, power.error})
        for (std::size_t c = 0; c < channels; ++c)
            for (const float v : planes[c].span()) append(v, bytes.span(), at);
    Json json;
    json["file"] = path;
    json["type"] = "float32";
    json["endian"] = "little";
    json["unit"] = "W/m3";
    json["size"] = power.cells;
    const auto &low = power.bounds_m[0], &high = power.bounds_m[1];
    json["bounds_m"] = {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
    if (grey)
        json["planes"] = {"power", "error"};
    else
        json["planes"] = {"power.R", "power.G", "power.B", "error.R", "error.G", "error.B"};
    json["order"] = "x fastest, then y, z, plane; from the west, the south and the bottom";
    if (heating.wanted()) json["kelvin_per_day_per_w_m3"] = heating.kelvin_per_day();
    head = json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
    return Status::ok();
}

}  // namespace pileus
