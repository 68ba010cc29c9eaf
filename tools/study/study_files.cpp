// SPDX-License-Identifier: Apache-2.0
// See study_files.h.
// in: scenes -> out: digests; names of outputs -> out: clashes.
// docs/study.md, "Runs"
#include "tools/study/study_files.h"

#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/scene/read_scene.h"
#include "tools/study/output_check.h"
#include "tools/study/scene_files.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 34;

}  // namespace

Status StudyFiles::digest_file(const std::string& path, std::uint64_t& digest) {
    const auto known = files_.find(path);
    if (known != files_.end()) {
        digest = known->second;
        return Status::ok();
    }
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxFileBytes, bytes));
    Digest sum;
    sum.bytes(bytes.data(), bytes.size());
    digest = sum.value();
    files_.emplace(path, digest);
    return Status::ok();
}

Status StudyFiles::digest_scene(const std::string& scene, const std::vector<std::string>& sets,
                                std::string& hex) {
    Scene read;
    PILEUS_TRY(read_scene_file(scene, sets, read));
    if (read.animation.is_film())
        return Status::bad_input(scene + ": animation.frames: a study compares single pictures, " +
                                 std::to_string(read.animation.frames) + ", allowed: 1");
    scenes_.insert(scene);
    Digest digest;
    digest.u64(read.text.size());
    digest.text(read.text);
    for (const std::string& path : scene_files(read)) {
        std::uint64_t bytes = 0;
        PILEUS_TRY(digest_file(path, bytes));
        digest.u64(bytes);
    }
    hex = digest.hex();
    return Status::ok();
}

Status StudyFiles::check_outputs(const Study& study, const StudyOptions& options,
                                 const std::vector<StudyRun>& runs) const {
    OutputCheck check;
    check.reads(study.file, "the study itself");
    check.reads(options.program, "the program");
    for (const std::string& scene : scenes_) check.reads(scene, "a scene of the study");
    for (const auto& file : files_) check.reads(file.first, "a file that a scene reads");

    std::vector<std::string> outputs;
    for (const char* name : {"study.json", "study.md", "index.html"})
        outputs.push_back(options.folder + "/" + name);
    for (const StudyScene& scene : study.scenes)
        for (const char* extension : {".svg", ".png"})
            outputs.push_back(options.folder + "/plots/" + scene.name + extension);
    for (const StudyRun& run : runs)
        for (const std::string& path : {run.image, run.record, run.record + ".report"})
            outputs.push_back(path);
    for (const std::string& path : outputs) PILEUS_TRY(check.writes(path));
    return Status::ok();
}

}  // namespace pileus
