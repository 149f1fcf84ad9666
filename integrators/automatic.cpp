// SPDX-License-Identifier: Apache-2.0
#include "integrators/automatic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "integrators/bidirectional.h"
#include "integrators/choice.h"
#include "integrators/path.h"
#include "integrators/splits.h"
#include "integrators/trial.h"

namespace iride {

namespace {

constexpr int usual_splits = 16;

// What a ray of a bidirectional path costs, in rays of paths from the camera (measured: 1.1 to 1.7).
constexpr double ray_of_joined_path = 1.4;
// What the first samples of paths in parts are worth, of what they weigh (integrators/splits.cpp; measured: .6 to .8).
constexpr double worth_of_first_parts = 0.7;

// Looks at whole and joined paths, each closer than the one before. Joined paths are refused at the first look that
// finds time x error of whole ones, over their own, below `at_least`; if none does, they are taken. Measured: `room` is
// found at 1 to 1.25 and is 1.4, `cornell` is found at .7 and is .5, and all other scenes are below; fireflies, which
// whole paths have more of, are seen too seldom.
struct Look {
    int block;    // pixels along a side, at least
    int samples;  // of each of two independent estimates at each place of a block
    double at_least;
};
constexpr std::array<Look, 3> looks{{{32, 8, 0.45}, {16, 8, 0.75}, {8, 8, 0.87}}};
constexpr int least_blocks = 16;  // of the last look: fewer tell nothing

std::unique_ptr<Integrator> camera_paths(Scene const& scene, RenderPlan const& plan, bool caustics, int splits,
                                         IntegratorOptions& options) {
    return (caustics ? caustic_path_in_parts : path_in_parts)(scene, plan, options, splits);
}

// `first` before the trial; from there on `first` or joined paths, whichever it finds the better. Both are unbiased,
// and the samples of a pixel weigh as each is worth.
class Automatic final : public Integrator {
  public:
    // `caustics`: `first` has light paths beside it.
    Automatic(RenderPlan plan, std::unique_ptr<Integrator> first, bool caustics)
        : plan_(std::move(plan)), first_(std::move(first)), caustics_(caustics) {}

    void prepare(Scene const& scene, SamplePass const& pass, RayStatistics& statistics) override {
        bool const is_late = pass.first >= samples_before_trial;  // no pass goes across
        if (!is_late) weight_of_joined_.reset();                  // another picture
        if (is_late && !weight_of_joined_) weight_of_joined_ = try_joined(scene, statistics);
        takes_joined_ = is_late && *weight_of_joined_ > 0;
        if (!takes_joined_) first_->prepare(scene, pass, statistics);
    }
    int samples_alike(std::uint32_t first) const override {
        int const alike = first_->samples_alike(first);
        if (first >= samples_before_trial) return alike;
        return std::min(alike, static_cast<int>(samples_before_trial - first));
    }
    std::uint32_t weight() const override { return takes_joined_ ? *weight_of_joined_ : first_->weight(); }
    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        (takes_joined_ ? joined_ : first_)->follow(scene, paths, statistics);
    }
    bool splats() const override { return takes_joined_ || first_->splats(); }

  private:
    // What a sample of joined paths weighs; 0: they are not the better.
    std::uint32_t try_joined(Scene const& scene, RayStatistics& statistics) {
        IntegratorChoice const nothing_said;
        IntegratorOptions options(nothing_said);
        auto const whole = camera_paths(scene, plan_, caustics_, 1, options);
        joined_ = make_bidirectional_power(scene, plan_, options);
        PilotStarter const starter(scene, plan_, PilotStarter::Pairs::paths);
        double variance = 0;
        int blocks = 0;
        for (Look const& look : looks) {
            PilotBlocks const at(scene, look.block);
            if (at.count() == blocks) continue;  // a large picture is not looked at as closely
            blocks = at.count();
            TrialResult const result = try_out(scene, at, starter, look.samples, *whole, *joined_, statistics);
            if (!(result.rays_error >= look.at_least * ray_of_joined_path)) return 0;
            variance = result.variance;
        }
        constexpr double highest = 64;
        double const weight_of_whole = caustics_ ? worth_of_light_paths : 1;
        return static_cast<std::uint32_t>(
            std::clamp(std::round(weight_of_whole * variance / worth_of_first_parts), 1.0, highest));
    }

    RenderPlan plan_;
    std::unique_ptr<Integrator> first_, joined_;
    bool caustics_;
    std::optional<std::uint32_t> weight_of_joined_;
    bool takes_joined_ = false;
};

}  // namespace

std::unique_ptr<Integrator> make_auto(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    AutomaticChoice const choice = choose_integrator(scene, plan);
    bool const caustics = choice.name == "caustic-path";
    auto first = camera_paths(scene, plan, caustics, plan.whole_paths ? 1 : usual_splits, options);
    if (!choice.trial || PilotBlocks(scene, looks.back().block).count() < least_blocks) return first;
    return std::make_unique<Automatic>(plan, std::move(first), caustics);
}

}  // namespace iride
