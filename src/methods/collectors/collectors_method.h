// SPDX-License-Identifier: Apache-2.0
// Method `collectors`: photons into virtual photon collectors, shown as billboards or marched.
// in: a scene and its medium -> out: light generation by generation, planes of pictures.
// docs/collectors.md
#pragma once
#include "src/methods/collectors/collectors_state.h"
#include "src/methods/method_tools.h"
#include "src/photons/photon_report.h"

namespace pileus {

class CollectorsMethod : public PhotonMethod {
public:
    explicit CollectorsMethod(const MethodInputs& inputs)
        : CollectorsMethod(inputs, inputs.scene.collectors) {}
    /// By other settings than the scene's.
    CollectorsMethod(const MethodInputs& inputs, const CollectorSettings& settings);
    const CollectorsState& state() const { return state_; }
    /// For measurements, which take parts of the method alone.
    CollectorsState& state() { return state_; }

    Status prepare(const Context& context, const FrameView& view) override;
    Status worst_case(const FrameView& view, const FrameWork& work,
                      FrameUnits& units) const override;
    void count(Counts& counts) const override;
    const char* fixed_view() const override;
    void release(Phase phase) override;
    TraceInput trace_input(const Context& context, const FrameView& view) const override;

protected:
    Status check(const Context& context, const FrameView& view) override;
    Status choose(const FrameView& view) override { return choose_collectors_light(view, state_); }
    Status measure(const Context& context, const FrameView& view, Plan& plan) override {
        return measure_collectors(context, view, state_, plan);
    }
    Status compose(const Context& context, const FrameView& view, Planes& planes) override;

private:
    CollectorsState state_;
};

/// What people are told of it. The method outlives it.
class CollectorsReport : public PhotonReport {
public:
    explicit CollectorsReport(CollectorsMethod& of) : PhotonReport(of), of_(of) {}

    void explain(const Context& context, const FrameView& view, Plan& plan) const override;
    void digest(const FrameView& view, Digests& digests) const override;
    LightGoal goal(const FrameView& view) const override;
    void report(Report& report) const override;
    void put_work(const FrameWork& work, MethodTables& tables) const override;

protected:
    CollectorsMethod& of_;
};

std::unique_ptr<MethodReport> collectors_report(CollectorsMethod& method);
/// Of a plan that is complete but for its limits.
void note_collectors_limits(const Context& context, const FrameView& view, Plan& plan);

constexpr const char* kCollectorsName = "collectors";
Status check_collectors(const Scene& scene, const Budget& budget);
MethodRow collectors_row();
extern const MethodTools collectors_tools;

}  // namespace pileus
