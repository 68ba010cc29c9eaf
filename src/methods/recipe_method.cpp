// SPDX-License-Identifier: Apache-2.0
// See recipe_method.h.
#include "src/methods/recipe_method.h"

#include "kernels_cpu/core/profile.h"
#include "src/picture/finish_frame.h"

namespace pileus {
namespace {

/// The run has the scene, the world and the lights, and makes its own lights of them: the views
/// are of these.
class RecipeMethod final : public Method {
public:
    RecipeMethod(const Recipe& recipe, MethodRun& run) : recipe_(recipe), run_(run) {}

    /// `prepare` has made the exact one.
    Status plan(const Context& context, const FrameView&, Plan&) override {
        if (outlined_) return Status::ok();
        outlined_ = true;
        return recipe_.outline(context, run_);
    }
    Status prepare(const Context& context, const FrameView&) override {
        return recipe_.prepare(context, run_);
    }
    Status reserve(const FrameView&, LateRows& late) override { return run_.reserve(late); }
    void seal() override { run_.seal(); }
    Status set_view(const Context& context, const FrameView& view,
                    const ViewChange& change) override {
        return recipe_.live->aim(view.frame, change.new_sky, context, run_);
    }
    Status accumulate(const Context& context, const FrameView&, std::uint64_t units,
                      std::uint64_t& done) override {
        return recipe_.live->advance(units, context, run_, done);
    }
    Status render(const Context& context, const FrameView& view, const RenderAsk& ask,
                  Planes*& planes) override {
        run_.alone = ask.media_only;
        run_.view_slack_deg = ask.view_slack_deg;
        PILEUS_TRY(
            recipe_.live->compose({view.frame, first_, false, ask.late}, context, run_, planes));
        first_ = false;
        return Status::ok();
    }

    LightUnits progress() const override { return recipe_.live->units(run_); }
    FrameWork full_work() const override {
        const bool has_work = recipe_.live != nullptr && recipe_.live->full_work != nullptr;
        return has_work ? recipe_.live->full_work(run_) : FrameWork{};
    }
    Status set_limits(const FrameWork& work) override {
        const bool has_work = recipe_.live->set_limits != nullptr;
        return has_work ? recipe_.live->set_limits(work, run_) : Status::ok();
    }
    Status worst_case(const FrameView&, const FrameWork& work, FrameUnits& units) const override {
        return recipe_.live->most_units(work, run_, units);
    }
    void count(Counts& counts) const override { recipe_.count(run_, counts); }

private:
    const Recipe& recipe_;
    MethodRun& run_;
    bool outlined_ = false;
    bool first_ = true;  ///< no picture has been made
};

class RecipeReport final : public MethodReport {
public:
    RecipeReport(const Recipe& recipe, const MethodRun& run) : recipe_(recipe), run_(run) {}

    // `outline`, `prepare` and `show` do these.
    void explain(const Context&, const FrameView&, Plan&) const override {}
    void digest(const FrameView&, Digests&) const override {}
    FinishedParts finished() const override { return {}; }
    void report(Report& report) const override { recipe_.report(run_, report); }
    void budget_used(int frame, const Report& report, Budget& used) const override {
        if (recipe_.budget_used != nullptr) recipe_.budget_used(frame, run_, report, used);
    }
    void put_work(const FrameWork& work, MethodTables& tables) const override {
        recipe_.live->put_work(work, run_, tables);
    }

private:
    const Recipe& recipe_;
    const MethodRun& run_;
};

}  // namespace

MethodRow row_of(const Recipe& recipe) {
    return {recipe.name, recipe.world, recipe.check, nullptr, &recipe};
}

MadeMethod method_of(const Recipe& recipe, MethodRun& run) {
    MadeMethod made;
    made.method = std::make_unique<RecipeMethod>(recipe, run);
    if (kPlans) made.report = std::make_unique<RecipeReport>(recipe, run);
    return made;
}

bool is_live(const MethodRow& row) { return row.recipe == nullptr || row.recipe->live != nullptr; }

}  // namespace pileus
