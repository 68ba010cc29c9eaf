// SPDX-License-Identifier: Apache-2.0
// Methods `raymarch`: sunlight scattered once, or forward many times, added up along each ray; and
// `optical-depth`: the look of clouds from one buffer of optical depths towards the sun.
// in: a scene -> out: an image without noise, as fine as its steps.
// Palenik 2016, docs/raymarch.md; Maerkl 2018, 3.1 and 4.4, docs/optical-depth.md
#pragma once
#include "src/methods/march/march_state.h"

namespace pileus {

struct MethodTools;

/// No light is accumulated: pictures are all there is. Both methods march; optical-depth has a look
/// in its choice, appearance and not physics.
class MarchMethod final : public Method {
public:
    explicit MarchMethod(MarchChoice choice);
    MarchState& state() { return state_; }
    const MarchState& state() const { return state_; }

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
    MarchState state_;
};

/// The method outlives it.
std::unique_ptr<MethodReport> march_report(MarchMethod& method);

Status check_raymarch(const Scene& scene, const Budget& budget);
Status check_optical_depth(const Scene& scene, const Budget& budget);
MethodRow raymarch_row();
MethodRow optical_depth_row();
extern const MethodTools raymarch_tools, optical_depth_tools;

}  // namespace pileus
