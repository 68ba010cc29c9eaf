// SPDX-License-Identifier: Apache-2.0
// See picture_layers.h.
#include "src/io/images/picture_layers.h"

#include <algorithm>
#include <vector>

#include "src/base/reading_limit.h"
#include "src/io/images/channel_name.h"
#include "src/io/images/image_file.h"

namespace pileus {

namespace {

/// Where the channels of one layer lie; -1: it has none.
struct Layer {
    std::string name;
    int rgb[3] = {-1, -1, -1};
    int grey = -1, alpha = -1;
    bool coloured() const { return rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0; }
    bool seen() const { return coloured() || grey >= 0; }
};

void add_channel(const std::string& channel, int index, Layer& layer) {
    const std::string last = last_of(channel);
    const char* const names[3][2] = {{"r", "red"}, {"g", "green"}, {"b", "blue"}};
    for (int c = 0; c < 3; ++c)
        for (const char* name : names[c])
            if (last == name) layer.rgb[c] = index;
    for (const char* name : {"y", "v", "l"})
        if (last == name) layer.grey = index;
    if (last == "a" || last == "alpha") layer.alpha = index;
}

/// Layers in the order of the file; a layer that has R alone is grey.
std::vector<Layer> find_layers(const Image& image) {
    std::vector<Layer> layers;
    for (std::size_t i = 0; i < image.channels.size(); ++i) {
        const std::string name = layer_of(image.channels[i].name);
        auto at = std::find_if(layers.begin(), layers.end(),
                               [&](const Layer& layer) { return layer.name == name; });
        if (at == layers.end()) {
            layers.emplace_back();
            layers.back().name = name;
            at = layers.end() - 1;
        }
        add_channel(image.channels[i].name, int(i), *at);
    }
    for (Layer& layer : layers)
        if (layer.rgb[0] >= 0 && layer.rgb[1] < 0 && layer.rgb[2] < 0 && layer.grey < 0)
            layer.grey = layer.rgb[0];
    if (image.channels.size() == 1) layers[0].grey = 0;
    return layers;
}

std::string list_of(const std::vector<Layer>& layers) {
    std::string list;
    for (const Layer& layer : layers)
        if (layer.seen()) list += (list.empty() ? "" : ", ") + printable_line(layer.name);
    return list.empty() ? "none in this file" : list;
}

/// The layer that is the picture, or null where that cannot be told.
const Layer* find_picture(const std::vector<Layer>& layers) {
    std::vector<const Layer*> seen, called;
    for (const Layer& layer : layers) {
        if (!layer.seen()) continue;
        if (layer.name.empty()) return &layer;
        seen.push_back(&layer);
        for (const char* name : {"combined", "beauty", "rgba", "rgb", "color", "colour", "main"})
            if (last_of(layer.name) == name) called.push_back(&layer);
    }
    if (seen.size() == 1) return seen[0];
    return called.size() == 1 ? called[0] : nullptr;
}

/// Moves channels out of `image` under new names.
void keep(const std::vector<std::pair<int, const char*>>& wanted, Image& image) {
    std::vector<Channel> kept;
    for (const auto& [index, name] : wanted) {
        if (index < 0) continue;
        kept.emplace_back();
        kept.back().name = name;
        kept.back().pixels.swap(image.channels[std::size_t(index)].pixels);
    }
    image.channels.swap(kept);
}

/// Copies `count` floats; the places come from the windows of a file.
void copy_part(const Buffer<float>& from, std::int64_t at, std::int64_t count, Buffer<float>& to,
               std::int64_t to_at) {
    const Span<const float> taken = from.span().part(std::size_t(at), std::size_t(count));
    std::copy(taken.begin(), taken.end(),
              to.span().part(std::size_t(to_at), std::size_t(count)).begin());
}

int index_of(const Image& image, const char* name) {
    for (std::size_t i = 0; i < image.channels.size(); ++i)
        if (image.channels[i].name == name) return int(i);
    return -1;
}

}  // namespace

Status choose_layer(const std::string& name, const std::string& layer, Image& image,
                    std::string& chosen) {
    const std::vector<Layer> layers = find_layers(image);
    const Layer* taken = nullptr;
    if (layer.empty()) {
        taken = find_picture(layers);
    } else {
        for (const Layer& one : layers)
            if (one.seen() && one.name == layer) taken = &one;
    }
    if (taken == nullptr)
        return Status::bad_input(
            name + ": layer: " + (layer.empty() ? "none stands out as the picture" : "not there") +
            ", \"" + printable_line(layer) + "\", allowed: " + list_of(layers));
    chosen = taken->name;
    // Standard errors belong to the picture as a whole, and alpha of the whole serves any layer.
    int alpha = taken->alpha >= 0 ? taken->alpha : index_of(image, "A");
    std::vector<std::pair<int, const char*>> wanted;
    if (taken->coloured()) {
        wanted = {{taken->rgb[0], "R"}, {taken->rgb[1], "G"}, {taken->rgb[2], "B"}};
    } else {
        wanted = {{taken->grey, "Y"}};
        if (taken->grey == alpha) alpha = -1;
    }
    wanted.emplace_back(alpha, "A");
    if (taken->name.empty())
        for (const char* error : {"error.R", "error.G", "error.B"})
            wanted.emplace_back(index_of(image, error), error);
    keep(wanted, image);
    return Status::ok();
}

Status fit_display_window(const std::string& name, Image& image, std::uint64_t most_pixels,
                          float outside) {
    const DisplayWindow window = image.display;
    if (window.width == 0) return Status::ok();
    if (window.x == 0 && window.y == 0 && window.width == image.width &&
        window.height == image.height)
        return Status::ok();
    PILEUS_TRY(
        check_image_size(name + ": display window", window.width, window.height, most_pixels));
    const std::uint64_t pixels = std::uint64_t(window.width) * std::uint64_t(window.height);
    PILEUS_TRY(check_reading(name, pixels * sizeof(float) * image.channels.size()));
    // Copy what lies in both windows; nothing is known of the rest of the display.
    const std::int64_t left = std::max<std::int64_t>(window.x, 0);
    const std::int64_t right = std::min<std::int64_t>(window.x + window.width, image.width);
    const std::int64_t top = std::max<std::int64_t>(window.y, 0);
    const std::int64_t bottom = std::min<std::int64_t>(window.y + window.height, image.height);
    for (Channel& channel : image.channels) {
        Buffer<float> fitted;
        PILEUS_TRY(fitted.resize(pixels, "display window"));
        if (outside != 0) std::fill(fitted.span().begin(), fitted.span().end(), outside);
        for (std::int64_t y = top; y < bottom && left < right; ++y)
            copy_part(channel.pixels, y * image.width + left, right - left, fitted,
                      (y - window.y) * window.width + left - window.x);
        channel.pixels.swap(fitted);
    }
    image.width = int(window.width);
    image.height = int(window.height);
    image.display = DisplayWindow();
    return Status::ok();
}

Status cut_pixels(int x0, int y0, int x1, int y1, Image& image) {
    const std::int64_t width = x1 - x0, height = y1 - y0;
    for (Channel& channel : image.channels) {
        Buffer<float> part;
        PILEUS_TRY(part.resize(std::uint64_t(width) * std::uint64_t(height), "part of a picture"));
        for (std::int64_t y = 0; y < height; ++y)
            copy_part(channel.pixels, (y0 + y) * image.width + x0, width, part, y * width);
        channel.pixels.swap(part);
    }
    image.width = int(width);
    image.height = int(height);
    return Status::ok();
}

Status cut_to_part(Image& a, Image& b, const Image*& cut) {
    cut = nullptr;
    for (Image* part : {&a, &b}) {
        Image& whole = part == &a ? b : a;
        const DisplayWindow& window = part->display;
        const bool within = window.width == whole.width && window.height == whole.height &&
                            window.x <= 0 && window.y <= 0 &&
                            part->width - window.x <= whole.width &&
                            part->height - window.y <= whole.height;
        if (!within || (part->width == whole.width && part->height == whole.height)) continue;
        PILEUS_TRY(cut_pixels(int(-window.x), int(-window.y), int(part->width - window.x),
                              int(part->height - window.y), whole));
        whole.display = window;
        cut = &whole;
        return Status::ok();
    }
    return Status::ok();
}

}  // namespace pileus
