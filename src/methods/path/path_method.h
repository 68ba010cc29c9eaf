// SPDX-License-Identifier: Apache-2.0
// Method `path`: an unbiased path tracer, the reference that the other methods are measured by.
// in: a scene -> out: images with their standard error, pass by pass until a budget is met.
// docs/path.md
#pragma once
#include "src/methods/method_tools.h"
#include "src/methods/path/path_state.h"

namespace pileus {

/// Its units are samples of every pixel of a view.
class PathMethod final : public Method {
public:
    explicit PathMethod(const MethodInputs& inputs);
    const PathState& state() const { return state_; }

    Status plan(const Context& context, const FrameView& view, Plan& plan) override;
    Status prepare(const Context& context, const FrameView& view) override;
    Status reserve(const FrameView& view, LateRows& late) override;
    Status set_view(const Context& context, const FrameView& view,
                    const ViewChange& change) override;
    Status accumulate(const Context& context, const FrameView& view, std::uint64_t units,
                      std::uint64_t& done) override;
    Status render(const Context& context, const FrameView& view, const RenderAsk& ask,
                  Planes*& planes) override;
    LightUnits progress() const override;
    Status set_limits(const FrameWork& work) override;
    Status worst_case(const FrameView& view, const FrameWork& work,
                      FrameUnits& units) const override;
    void count(Counts& counts) const override;
    bool keeps_planes() const override { return true; }
    void release(Phase phase) override;

    // Of what is measured by paths, and of films that a file brings.

    /// As accumulate does by itself, for the view that was set.
    Status begin(const Context& context, const FrameView& view);
    /// What paths of the view read.
    PathInput input(const Context& context, const FrameView& view) const {
        return path_input(context, view, state_);
    }
    /// The error of the film filtered by regression, before the frame is shown.
    Status filtered_error(const Context& context, const FrameView& view, ErrorSum& sum) {
        return path_filtered_error(context, view, state_, sum);
    }
    /// Memory for them.
    PathScratch& scratch() { return state_.scratch; }
    Film& film() { return state_.film; }
    Planes& planes() { return state_.planes; }

private:
    PathState state_;
};

/// The method outlives it.
std::unique_ptr<MethodReport> path_report(PathMethod& method, const Budget& budget);

/// As the row makes it; `made` owns it.
PathMethod& make_path(const MethodInputs& inputs, MadeMethod& made);

Status check_path(const Scene& scene, const Budget& budget);
MethodRow path_row();
extern const MethodTools path_tools;

}  // namespace pileus
