// SPDX-License-Identifier: Apache-2.0
// See camera_depth.h.
#include "src/world/solids/camera_depth.h"

#include <cstring>
#include <vector>

#include "src/io/images/channel_name.h"
#include "src/world/camera/view.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

/// As renderers call it: depth.Z, ViewLayer.Depth.Z, Depth.V, zDepth, VRayZDepth.R, Z-depth.
bool means_depth(const std::string& word) {
    for (const char* known : {"z", "depth", "zdepth", "z-depth", "z_depth", "vrayzdepth"})
        if (word == known) return true;
    return false;
}

/// The channels of one layer, as they come.
struct DepthLayer {
    std::string name;
    std::vector<const Channel*> channels;  ///< without alpha
    bool is_vector = false;                ///< has an x: a normal or a place

    /// The channel Z, or one that stands alone, or three that are equal.
    const Channel* plane(bool& differ) const {
        if (is_vector) return nullptr;
        for (const Channel* channel : channels)
            if (means_depth(last_of(channel->name))) return channel;
        if (channels.empty()) return nullptr;
        const Channel& first = *channels[0];
        if (channels.size() == 1) return &first;
        if (channels.size() != 3) return nullptr;
        for (const Channel* channel : channels)
            differ =
                differ || channel->pixels.size() != first.pixels.size() ||
                std::memcmp(channel->pixels.data(), first.pixels.data(), first.pixels.bytes()) != 0;
        return differ ? nullptr : &first;
    }
};

std::vector<DepthLayer> layers_of(const Image& image) {
    std::vector<DepthLayer> layers;
    for (const Channel& channel : image.channels) {
        const std::string name = layer_of(channel.name), last = last_of(channel.name);
        std::size_t at = 0;
        while (at < layers.size() && layers[at].name != name) ++at;
        if (at == layers.size()) layers.push_back({name, {}, false});
        layers[at].is_vector = layers[at].is_vector || last == "x";
        if ((last != "a" && last != "alpha") || image.channels.size() == 1)
            layers[at].channels.push_back(&channel);
    }
    return layers;
}

/// The plane of distances: Z; else the one that is called so; else the only one, or three equal
/// ones. Any other choice would be a guess.
Status find_depth(const std::string& name, const Image& image, const Channel*& z) {
    const std::vector<DepthLayer> layers = layers_of(image);
    bool differ = false;
    int called = 0;
    z = image.find("Z");
    if (z != nullptr) return Status::ok();
    for (const DepthLayer& layer : layers) {
        bool colours = false;
        const Channel* plane = layer.plane(colours);
        if (plane == nullptr) continue;
        if (!means_depth(last_of(plane->name)) && !means_depth(last_of(layer.name))) continue;
        z = plane;
        ++called;
    }
    if (called == 1) return Status::ok();
    z = called == 0 && layers.size() == 1 ? layers[0].plane(differ) : nullptr;
    if (z != nullptr) return Status::ok();
    if (differ)
        return Status::bad_input(name +
                                 ": depth: colours, R G B differ, allowed: one value a pixel");
    std::string list;
    for (const Channel& channel : image.channels) list += (list.empty() ? "" : ", ") + channel.name;
    return Status::bad_input(name + ": depth: " + (called > 1 ? "several" : "no channel Z") +
                             " among " + (list.empty() ? "none" : printable_line(list)) +
                             ", allowed: Z, one layer of depth, a single channel of any name, or "
                             "three that are equal");
}

}  // namespace

void CameraDepth::put(std::size_t pixel, double value) {
    float along = value >= 1e30 ? __builtin_inff() : float(value);
    if (!(value == value)) {
        along = __builtin_inff();
        ++broken;
    } else if (value < 0) {
        along = 0;
        ++negative;
    }
    metres[pixel] = along;
}

Status take_camera_depth(const Camera& camera, const ViewFiles& files, const std::string& name,
                         const Image& image, CameraDepth& depth) {
    const CameraParams view = make_camera(camera, 0, {});
    if (image.width != whole_width(view) || image.height != whole_height(view))
        return Status::bad_input(name + ": depth: wrong size, " + std::to_string(image.width) +
                                 " x " + std::to_string(image.height) +
                                 ", allowed: " + std::to_string(whole_width(view)) + " x " +
                                 std::to_string(whole_height(view)) + ", camera.resolution");
    const Channel* z = nullptr;
    PILEUS_TRY(find_depth(name, image, z));
    const std::size_t width = std::size_t(view.width), whole = std::size_t(image.width);
    const std::size_t pixels = width * std::size_t(view.height);
    PILEUS_TRY(depth.metres.resize(pixels, "camera depth"));
    depth.columns = width;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::size_t x = i % width + std::size_t(view.left),
                          y = std::size_t(picture_row(view, int(i / width)));
        double metres = double(z->pixels.at(y * whole + x)) * files.depth_scale;
        if (files.depth_on_axis) metres *= ray_slant(view, double(x), double(y));
        depth.put(i, metres);
    }
    return Status::ok();
}

void outline_camera_depth(const Scene& scene, CameraDepth& depth) {
    depth = CameraDepth();
    depth.present = !scene.view_files.depth.empty();
}

}  // namespace pileus
