// SPDX-License-Identifier: Apache-2.0
// What a digest costs: of arrays that caches hold, of those that they do not, and of a picture.
// in: made-up numbers -> out: bytes per CPU second; equal digests in every iteration.
// docs: README.md in this folder.
#include "src/base/digest.h"
#include "src/io/images/image_file.h"
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;

void count_bytes(benchmark::State& state, std::uint64_t bytes) {
    state.SetBytesProcessed(std::int64_t(bytes) * state.iterations());
}

void run_floats(benchmark::State& state, Bench& bench, std::uint64_t count) {
    Buffer<float> values;
    if (!bench.passed(state, values.resize(count, "floats"))) return;
    for (std::size_t i = 0; i < count; ++i) values[i] = float(i);
    for (auto _ : state) {
        Digest digest;
        digest.floats(values.span());
        bench.check(state, "digest/floats/" + std::to_string(count), digest.value());
    }
    count_bytes(state, values.bytes());
}

/// The hash of a picture, whose planes are apart.
void run_picture(benchmark::State& state, Bench& bench) {
    Image image;
    image.width = 1280;
    image.height = 720;
    const std::uint64_t pixels = 1280u * 720u;
    for (const char* name : {"R", "G", "B", "A"}) {
        image.channels.emplace_back();
        image.channels.back().name = name;
        if (!bench.passed(state, image.channels.back().pixels.resize(pixels, name))) return;
        for (std::size_t i = 0; i < pixels; ++i) image.channels.back().pixels[i] = float(i % 1021);
    }
    for (auto _ : state) bench.check(state, "digest/picture", image_digest(image));
    count_bytes(state, 16 * pixels);
}

}  // namespace

void register_digest_cases(Bench& bench) {
    for (const std::uint64_t count : {std::uint64_t(1) << 18, std::uint64_t(1) << 26})
        benchmark::RegisterBenchmark(
            ("digest/floats/" + std::to_string(count >> 18) + "MiB").c_str(),
            [&bench, count](benchmark::State& state) { run_floats(state, bench, count); });
    benchmark::RegisterBenchmark("digest/picture",
                                 [&bench](benchmark::State& state) { run_picture(state, bench); });
}

}  // namespace bench
