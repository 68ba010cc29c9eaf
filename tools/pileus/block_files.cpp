// SPDX-License-Identifier: Apache-2.0
// See block_files.h.
// in: scenes, files -> out: files, lines.
// docs/crosscheck.md
#include "tools/pileus/block_files.h"

#include <fmt/format.h>

#include "lab/compare/welch.h"
#include "src/base/file.h"
#include "tools/pileus/command.h"
#include "tools/pileus/option_text.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 32;

Status read_file(const std::string& path, BlockSums& blocks) {
    Buffer<char> text;
    PILEUS_TRY(check_file_name(path));
    PILEUS_TRY(read_whole_file(path, kMaxBytes, text));
    return read_blocks(path, {text.data(), text.size()}, blocks);
}

}  // namespace

Status read_block_arguments(const BlockArguments& arguments, BlockSettings& settings) {
    Status faults;
    if (!arguments.file && (arguments.passes || arguments.side))
        return Status::bad_input(
            "--block-passes, --block-side: without --blocks, allowed: with it");
    if (!arguments.file) return faults;
    settings.file = *arguments.file;
    add_fault(check_file_name(settings.file), faults);
    if (arguments.passes)
        add_fault(read_integer("--block-passes", *arguments.passes, 2, 1'000'000, settings.passes),
                  faults);
    if (arguments.side)
        add_fault(read_integer("--block-side", *arguments.side, 1, 16384, settings.side), faults);
    PILEUS_TRY(faults);
    return can_write_file(settings.file);
}

Status render_blocks(const Scene& scene, const RenderOptions& options,
                     const BlockSettings& settings) {
    if (options.first_frame != options.last_frame)
        return Status::bad_input("--blocks: several frames, allowed: one, by --frames N");
    if (!options.show.empty() || !options.budget.state.empty())
        return Status::bad_input("--blocks: together with --show or --state, allowed: without");
    BlockSums blocks;
    Scene pass = scene;
    for (std::int64_t i = 0; i < settings.passes; ++i) {
        pass.seed = scene.seed + i;
        PILEUS_TRY(render(pass, options, [&](int, Image& image, Report& report) -> Status {
            if (report.interrupted)
                return {Code::kCheckFailed, "interrupted before all passes; no file written"};
            if (i == 0) start_blocks(image.width, image.height, int(settings.side), blocks);
            return add_pass(image, blocks);
        }));
    }
    const std::string text = blocks_text(blocks);
    PILEUS_TRY(write_file(settings.file, {text.data(), text.size()}));
    return print(fmt::format("{:16} {}\n", "blocks", settings.file));
}

Status compare_blocks(const std::string& a, const std::string& b,
                      const std::optional<std::string>& significance, bool json) {
    double level = kWelchSignificance;
    if (significance) PILEUS_TRY(read_number("--significance", *significance, 1e-15, 0.5, level));
    BlockSums first, second;
    Status faults;
    add_fault(read_file(a, first), faults);
    add_fault(read_file(b, second), faults);
    PILEUS_TRY(faults);
    WelchResult result;
    PILEUS_TRY(compare_welch(first, second, level, result));
    PILEUS_TRY(print(json ? welch_json(a, b, result) : welch_lines(a, b, result)));
    if (!result.differ) return Status::ok();
    return {Code::kCheckFailed,
            fmt::format("{}: means: differ from {}, largest |z| {:.2f}, allowed: none that Holm "
                        "rejects at {:g}",
                        a, b, result.largest_z < 0 ? -result.largest_z : result.largest_z, level)};
}

}  // namespace pileus
