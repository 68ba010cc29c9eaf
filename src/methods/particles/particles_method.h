// SPDX-License-Identifier: Apache-2.0
// Method `particles`: a medium of particles, lit and shown by themselves and not on a grid.
// in: a scene with a file of particles -> out: an image without noise.
// Monette and Whitehead 2014; docs/particles.md, "The method".
#pragma once
#include "src/methods/particles/particles_state.h"

namespace pileus {

/// No light is accumulated: pictures are all there is.
class ParticlesMethod final : public Method {
public:
    explicit ParticlesMethod(const MethodInputs& inputs);
    ParticlesState& state() { return state_; }
    const ParticlesState& state() const { return state_; }

    Status plan(const Context& context, const FrameView& view, Plan& plan) override;
    Status prepare(const Context& context, const FrameView& view) override;
    Status reserve(const FrameView& view, LateRows& late) override;
    Status set_view(const Context& context, const FrameView& view,
                    const ViewChange& change) override;
    Status accumulate(const Context& context, const FrameView& view, std::uint64_t units,
                      std::uint64_t& done) override;
    Status render(const Context& context, const FrameView& view, const RenderAsk& ask,
                  Planes*& planes) override;
    FrameWork full_work() const override;
    Status set_limits(const FrameWork& work) override;
    Status worst_case(const FrameView& view, const FrameWork& work,
                      FrameUnits& units) const override;
    void count(Counts& counts) const override;

private:
    ParticlesState state_;
};

/// The method outlives it.
std::unique_ptr<MethodReport> particles_report(ParticlesMethod& method);

Status check_particles(const Scene& scene, const Budget& budget);
MethodRow particles_row();

}  // namespace pileus
