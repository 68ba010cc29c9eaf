// SPDX-License-Identifier: Apache-2.0
// Fuzz target: studies.
// in: bytes as a study file -> out: a checked study, or lines that all name the file and a place.
// docs/study.md, "The file"
#include "tests/fuzz/target.h"
#include "tools/study/study_file.h"

int fuzz::study(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    pileus::Study study;
    const pileus::Status status = pileus::read_study_text(text, "s.toml", "", study);
    if (!status) {
        fuzz::check_fault(status, "s.toml:", false);
        return 0;
    }
    fuzz::require(study.seeds >= 1 && study.seeds <= 64, "1 to 64 seeds");
    fuzz::require(study.first_seed >= 0 && study.reference.first_seed >= 0, "seeds count from 0");
    fuzz::require(!study.scenes.empty() && study.scenes.size() <= 64, "1 to 64 scenes");
    fuzz::require(!study.curves.empty() && study.curves.size() <= 64, "1 to 64 curves");
    for (const pileus::StudyCurve& curve : study.curves) {
        fuzz::require(!curve.budgets.empty(), "a curve has points");
        for (const std::string& budget : curve.budgets) {
            std::string kind;
            double amount = 0;
            fuzz::require(pileus::split_budget(budget, kind, amount) && amount > 0,
                          "a budget is a kind and an amount");
        }
    }
    return 0;
}
