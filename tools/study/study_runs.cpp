// SPDX-License-Identifier: Apache-2.0
// Lists the runs of a study and names each by a digest.
// in: a Study, files of its scenes -> out: command lines.
// docs/study.md, "Runs"
#include "tools/study/study_runs.h"

#include <algorithm>
#include <map>

#include "platform/process.h"
#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/scene/toml/toml_tree.h"
#include "tools/study/study_files.h"

namespace pileus {

namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 34;

void add_text(const std::string& text, Digest& digest) {
    digest.u64(text.size());
    digest.text(text);
}

Status add_file(const std::string& path, Digest& digest) {
    Buffer<char> bytes;
    PILEUS_TRY(read_whole_file(path, kMaxFileBytes, bytes));
    digest.u64(bytes.size());
    digest.bytes(bytes.data(), bytes.size());
    return Status::ok();
}

/// The program and machine that times belong to.
Status machine_digest(const StudyOptions& options, std::string& hex) {
    Digest digest;
    PILEUS_TRY(add_file(options.program, digest));
    add_text(processor_name(), digest);
    digest.u64(std::uint64_t(options.threads));
    hex = digest.hex();
    return Status::ok();
}

bool is_wanted(const std::string& name, const std::vector<std::string>& only) {
    return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
}

/// "marched.4bands" is wanted by its own name and by its method's, "marched".
bool is_curve_wanted(const std::string& name, const std::vector<std::string>& only) {
    return is_wanted(name, only) || is_wanted(name.substr(0, name.find('.')), only);
}

Status check_names(const Study& study, const StudyOptions& options) {
    for (const std::string& name : options.only_scenes) {
        bool known = false;
        for (const StudyScene& scene : study.scenes) known |= scene.name == name;
        if (!known)
            return Status::bad_input("--scene: no such scene, " + quote_text(name) +
                                     ", allowed: a name in " + study.file);
    }
    for (const std::string& name : options.only_methods) {
        bool known = false;
        for (const StudyCurve& curve : study.curves) known |= is_curve_wanted(curve.name, {name});
        if (!known)
            return Status::bad_input("--method: no such method, " + quote_text(name) +
                                     ", allowed: a name in " + study.file);
    }
    return Status::ok();
}

/// Layers cost time and memory and are not compared; a study may ask for them all the same.
constexpr const char* kPlainLayers = "output.layers=[\"radiance\", \"alpha\"]";

class Lister {
public:
    Lister(const Study& study, const StudyOptions& options, std::vector<StudyRun>& runs)
        : study_(study), options_(options), runs_(runs) {}

    Status list() {
        PILEUS_TRY(machine_digest(options_, machine_));
        for (std::size_t i = 0; i < study_.scenes.size(); ++i) {
            const StudyScene& scene = study_.scenes[i];
            if (!scene.skipped.empty() || !is_wanted(scene.name, options_.only_scenes)) continue;
            for (int half = 0; half < 2; ++half) PILEUS_TRY(add_reference(int(i), half));
            for (int repeat = 0; repeat < study_.seeds; ++repeat)
                PILEUS_TRY(add_repeat(int(i), repeat));
        }
        return files_.check_outputs(study_, options_, runs_);
    }

private:
    Status add_repeat(int scene, int repeat) {
        std::size_t most = 0;
        for (const StudyCurve& curve : study_.curves) most = std::max(most, curve.budgets.size());
        for (std::size_t b = 0; b < most; ++b)
            for (std::size_t c = 0; c < study_.curves.size(); ++c) {
                const StudyCurve& curve = study_.curves[c];
                const bool wanted =
                    is_wanted(study_.scenes[std::size_t(scene)].name, curve.scenes) &&
                    is_curve_wanted(curve.name, options_.only_methods);
                if (wanted && b < curve.budgets.size())
                    PILEUS_TRY(add_run(scene, int(c), int(b), repeat));
            }
        return Status::ok();
    }

    Status add_run(int scene, int curve, int budget, int repeat) {
        const StudyCurve& of = study_.curves[std::size_t(curve)];
        StudyRun run;
        run.scene = scene;
        run.curve = curve;
        run.budget = budget;
        run.repeat = repeat;
        run.seed = study_.first_seed + repeat;
        return finish(run, of.sets, of.budgets[std::size_t(budget)], options_.folder + "/runs/",
                      machine_);
    }

    Status add_reference(int scene, int half) {
        StudyRun run;
        run.scene = scene;
        run.repeat = half;
        run.seed = study_.reference.first_seed + half;
        return finish(
            run, study_.reference.sets, study_.scenes[std::size_t(scene)].reference_budget,
            (options_.references.empty() ? options_.folder + "/references" : options_.references) +
                "/",
            options_.version);
    }

    /// `made_by` is the program and machine, or the version alone where time does not matter.
    Status finish(StudyRun& run, const std::vector<std::string>& sets, const std::string& budget,
                  const std::string& folder, const std::string& made_by) {
        const StudyScene& scene = study_.scenes[std::size_t(run.scene)];
        std::string kind;
        (void)split_budget(budget, kind, run.amount);
        // Half the error takes four times the work.
        if (kind == "error") run.amount = 1 / (run.amount * run.amount);
        std::vector<std::string> all{kPlainLayers};
        all.insert(all.end(), scene.sets.begin(), scene.sets.end());
        all.insert(all.end(), sets.begin(), sets.end());
        run.words = {"render", scene.file};
        for (const std::string& set : all) {
            run.words.push_back("--set");
            run.words.push_back(set);
        }
        for (const std::string& word :
             {std::string("--budget"), budget, std::string("--seed"), std::to_string(run.seed)})
            run.words.push_back(word);

        // The settings too may name files.
        std::string& read = digests_[{run.scene, run.curve}];
        if (read.empty()) PILEUS_TRY(files_.digest_scene(scene.file, all, read));
        Digest digest;
        add_text(read, digest);
        add_text(made_by, digest);
        if (!run.is_reference()) add_text(options_.isa, digest);
        for (std::size_t i = 2; i < run.words.size(); ++i) add_text(run.words[i], digest);
        run.digest = digest.hex();
        run.image = folder + run.digest + ".exr";
        run.record = folder + run.digest + ".json";
        // Nothing below this line changes a pixel.
        for (const std::string& word :
             {std::string("--threads"), std::to_string(options_.threads), std::string("--quiet")})
            run.words.push_back(word);
        if (!options_.isa.empty()) {
            run.words.push_back("--isa");
            run.words.push_back(options_.isa);
        }
        runs_.push_back(std::move(run));
        return Status::ok();
    }

    const Study& study_;
    const StudyOptions& options_;
    std::vector<StudyRun>& runs_;
    StudyFiles files_;
    std::map<std::pair<int, int>, std::string> digests_;  ///< of a scene under a curve's settings
    std::string machine_;
};

}  // namespace

Status list_runs(const Study& study, const StudyOptions& options, std::vector<StudyRun>& runs) {
    PILEUS_TRY(check_names(study, options));
    runs.clear();
    return Lister(study, options, runs).list();
}

}  // namespace pileus
