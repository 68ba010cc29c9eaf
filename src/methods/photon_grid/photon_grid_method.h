// SPDX-License-Identifier: Apache-2.0
// Method `photon-grid`: photons into a regular grid of their own, shown by marching.
// in: a scene and its medium -> out: light generation by generation, planes of pictures.
// docs/photon-grid.md
#pragma once
#include "src/methods/method_tools.h"
#include "src/methods/photon_grid/photon_grid_state.h"
#include "src/photons/photon_report.h"

namespace pileus {

class PhotonGridMethod : public PhotonMethod {
public:
    explicit PhotonGridMethod(const MethodInputs& inputs);
    const PhotonGridState& state() const { return state_; }

    Status prepare(const Context& context, const FrameView& view) override;
    TraceInput trace_input(const Context& context, const FrameView& view) const override;
    std::uint64_t most_generations() const override { return most_grid_generations(state_); }
    /// Mean relative standard error of a picture that is made for it.
    Status error(const Context& context, const FrameView& view, double& mean_relative);

protected:
    Status check(const Context& context, const FrameView& view) override;
    Status choose(const FrameView& view) override { return choose_grid_light(view, state_); }
    Status measure(const Context& context, const FrameView& view, Plan& plan) override {
        return measure_photon_grid(context, view, state_, plan);
    }
    Status compose(const Context& context, const FrameView& view, Planes& planes) override;
    bool is_turned(const FrameView& view) const override;

private:
    PhotonGridState state_;
};

/// What people are told of it. The method outlives it.
class PhotonGridReport : public PhotonReport {
public:
    explicit PhotonGridReport(PhotonGridMethod& of) : PhotonReport(of), of_(of) {}

    void explain(const Context& context, const FrameView& view, Plan& plan) const override;
    void digest(const FrameView& view, Digests& digests) const override;
    LightGoal goal(const FrameView& view) const override;
    Status error(const Context& context, const FrameView& view, double& mean_relative) override;
    void report(Report& report) const override;
    void put_work(const FrameWork& work, MethodTables& tables) const override;

protected:
    PhotonGridMethod& of_;
};

std::unique_ptr<MethodReport> photon_grid_report(PhotonGridMethod& method);

Status check_photon_grid(const Scene& scene, const Budget& budget);
MethodRow photon_grid_row();
extern const MethodTools photon_grid_tools;

}  // namespace pileus
