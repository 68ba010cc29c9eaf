// SPDX-License-Identifier: Apache-2.0
// What methods that shoot photons have in common: lights, the ring of generations, its frames.
// in: a view of a frame -> out: generations shot, planes of a picture.
// docs/methods.md 3, "Generations and error".
#pragma once
#include "src/photons/photon_state.h"

namespace pileus {

/// What stores light where, and shows it, derives from it.
class PhotonMethod : public Method {
public:
    const PhotonState& photons() const { return shared_; }
    /// For digests, which slots keep.
    Photons& sums() { return shared_.ring.photons; }

    Status plan(const Context& context, const FrameView& view, Plan& plan) override;
    Status reserve(const FrameView& view, LateRows& late) override;
    void seal() override;
    Status set_view(const Context& context, const FrameView& view,
                    const ViewChange& change) override;
    Status accumulate(const Context& context, const FrameView& view, std::uint64_t units,
                      std::uint64_t& done) override;
    void restart(const Context& context, std::uint64_t first) override;
    Status render(const Context& context, const FrameView& view, const RenderAsk& ask,
                  Planes*& planes) override;
    LightUnits progress() const override;
    FrameWork full_work() const override;
    Status set_limits(const FrameWork& work) override;
    Status worst_case(const FrameView& view, const FrameWork& work,
                      FrameUnits& units) const override;
    void count(Counts& counts) const override;
    void release(Phase phase) override;

    /// As MethodReport::bring_together, for a still picture.
    Status bring_together(WorkShare& share);
    /// As MethodReport::add_light, for a still picture.
    Status add_light(const PartLight& light, bool counts);

    /// What launches read.
    virtual TraceInput trace_input(const Context& context, const FrameView& view) const = 0;

protected:
    /// The state is the derived class's own.
    explicit PhotonMethod(PhotonState& state) : shared_(state) {}

    /// What a scene cannot have, before anything is chosen.
    virtual Status check(const Context& context, const FrameView& view) = 0;
    /// Lights, and what a collision stores, for the medium as it is known now.
    virtual Status choose(const FrameView& view) = 0;
    /// Fills the plan's figures, bounds or exact by what the state holds; chooses who adds to the
    /// sums. kLimit: too much of something.
    virtual Status measure(const Context& context, const FrameView& view, Plan& plan) = 0;
    /// The picture as it is lit now.
    virtual Status compose(const Context& context, const FrameView& view, Planes& planes) = 0;
    /// Whether deposits are made for another view than this one.
    virtual bool is_turned(const FrameView&) const { return false; }
    /// Generations that the sums have room for; a ring holds its own length for ever.
    virtual std::uint64_t most_generations() const { return shared_.ring.generations; }

    /// Between the plan of sizes and `lay_out`.
    Status choose_and_measure(const Context& context, const FrameView& view, Plan& plan);
    Status lay_out(const Context& context, const FrameView& view);

private:
    Status relight(const Context& context, const FrameView& view, bool new_sky);

    PhotonState& shared_;
};

}  // namespace pileus
