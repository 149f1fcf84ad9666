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
    int block;    // pixels along a side, at least; twice as many where the places are neighbours
    int samples;  // of each of two independent estimates at each place of a block
    double at_least;
};
constexpr std::array<Look, 3> looks{{{32, 8, 0.45}, {16, 8, 0.75}, {8, 8, 0.87}}};
PilotBlocks blocks_of(Look const& look, Scene const& scene, bool neighbours) {
    if (!neighbours) return PilotBlocks(scene, look.block);
    return PilotBlocks(scene, 2 * look.block, PilotBlocks::Places::neighbours);
}
constexpr int least_blocks = 16;  // of the last look: fewer tell nothing

// Time x error of paths that share over that of paths alone, both whole, below which they share. Splits gain as well,
// and the more samples there are, the more sharing does: few tell the light of lamps apart from what is shared.
constexpr double sharing_pays = 0.75;
constexpr int samples_of_sharing = 4;  // of each of two independent estimates at each place

std::unique_ptr<Integrator> camera_paths(PathHabits const& habits, Scene const& scene, RenderPlan const& plan,
                                         bool caustics, IntegratorOptions& options) {
    return (caustics ? caustic_path_by : path_by)(habits, scene, plan, options);
}

// All are unbiased, and the samples of a pixel weigh as each is worth beside the first, which is whole and alone.
class Automatic final : public Integrator {
  public:
    // `shared`: null, or what `split` may give way to. `caustics`: both have light paths beside them.
    Automatic(RenderPlan plan, bool caustics, bool may_join, std::unique_ptr<Integrator> split,
              std::unique_ptr<Integrator> shared)
        : plan_(std::move(plan)),
          caustics_(caustics),
          may_join_(may_join),
          split_(std::move(split)),
          shared_(std::move(shared)) {}

    void prepare(Scene const& scene, SamplePass const& pass, RayStatistics& statistics) override {
        // No pass goes across a trial; what it finds depends on scene and plan alone.
        bool const may_share = shared_ && pass.first >= samples_before_sharing;
        bool const may_join = may_join_ && pass.first >= samples_before_joining;
        if (may_share && !weight_of_shared_) weight_of_shared_ = try_sharing(scene, statistics);
        if (may_join && !weight_of_joined_) weight_of_joined_ = try_joining(scene, statistics);
        now_ = may_join && *weight_of_joined_ > 0    ? joined_.get()
               : may_share && *weight_of_shared_ > 0 ? shared_.get()
                                                     : split_.get();
        now_->prepare(scene, pass, statistics);
    }
    int samples_alike(std::uint32_t first) const override {
        int alike = shares() ? Integrator::samples_alike(first) : split_->samples_alike(first);
        if (shared_ && first < samples_before_sharing) alike = std::min(alike, to(samples_before_sharing, first));
        if (may_join_ && first < samples_before_joining) alike = std::min(alike, to(samples_before_joining, first));
        return alike;
    }
    std::uint32_t weight() const override {
        return now_ == joined_.get()   ? *weight_of_joined_
               : now_ == shared_.get() ? *weight_of_shared_
                                       : split_->weight();
    }
    int block_side() const override { return now_->block_side(); }
    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        now_->follow(scene, paths, statistics);
    }
    bool splats() const override { return now_->splats(); }

  private:
    static int to(std::uint32_t sample, std::uint32_t first) { return static_cast<int>(sample - first); }
    bool shares() const { return weight_of_shared_ && *weight_of_shared_ > 0; }
    double worth_of_whole() const { return caustics_ ? worth_of_light_paths : 1; }
    static std::uint32_t rounded(double weight) {
        constexpr double highest = 64;
        return static_cast<std::uint32_t>(std::clamp(std::round(weight), 1.0, highest));
    }
    std::unique_ptr<Integrator> whole(Scene const& scene) const {
        IntegratorChoice const nothing_said;
        IntegratorOptions options(nothing_said);
        return camera_paths({}, scene, plan_, caustics_, options);
    }

    // What a sample of paths that share weighs; 0: they are not the better.
    std::uint32_t try_sharing(Scene const& scene, RayStatistics& statistics) const {
        int const block = std::clamp(std::min(scene.film.width, scene.film.height) / 8, widest_block, 32);
        PilotBlocks const at(scene, block, PilotBlocks::Places::neighbours);
        PilotStarter const starter(scene, plan_, PilotStarter::Pairs::paths);
        TrialResult const result = try_out(scene, at, starter, samples_of_sharing, *shared_, *whole(scene), statistics);
        if (!(result.rays_error < sharing_pays)) return 0;
        return rounded(worth_of_whole() / result.variance);
    }
    // The same of joined paths.
    std::uint32_t try_joining(Scene const& scene, RayStatistics& statistics) {
        IntegratorChoice const nothing_said;
        IntegratorOptions options(nothing_said);
        joined_ = make_bidirectional_power(scene, plan_, options);
        std::unique_ptr<Integrator> const alone = shares() ? nullptr : whole(scene);
        PilotStarter const starter(scene, plan_, PilotStarter::Pairs::paths);
        double variance = 0;
        int blocks = 0;
        for (Look const& look : looks) {
            PilotBlocks const at = blocks_of(look, scene, shares());
            if (at.count() == blocks) continue;  // a large picture is not looked at as closely
            blocks = at.count();
            TrialResult const result =
                try_out(scene, at, starter, look.samples, alone ? *alone : *shared_, *joined_, statistics);
            if (!(result.rays_error >= look.at_least * ray_of_joined_path)) return 0;
            variance = result.variance;
        }
        return rounded((shares() ? *weight_of_shared_ : worth_of_whole() / worth_of_first_parts) * variance);
    }

    RenderPlan plan_;
    bool caustics_, may_join_;
    std::unique_ptr<Integrator> split_, shared_, joined_;
    std::optional<std::uint32_t> weight_of_shared_, weight_of_joined_;
    Integrator* now_ = split_.get();
};

}  // namespace

std::unique_ptr<Integrator> make_auto(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    AutomaticChoice const choice = choose_integrator(scene, plan);
    bool const caustics = choice.name == "caustic-path";
    PathHabits const habits =
        habits_asked_for(options, plan.whole_paths ? PathHabits{} : PathHabits{.splits = usual_splits, .share = true});
    auto split = camera_paths({.splits = habits.splits, .share = false}, scene, plan, caustics, options);
    std::unique_ptr<Integrator> shared;
    if (habits.share) shared = camera_paths({.splits = 1, .share = true}, scene, plan, caustics, options);
    if (shared && shared->block_side() == 1) shared.reset();  // this scene has nothing to share
    bool const may_join = choice.trial && blocks_of(looks.back(), scene, shared != nullptr).count() >= least_blocks;
    if (!shared && !may_join) return split;
    return std::make_unique<Automatic>(plan, caustics, may_join, std::move(split), std::move(shared));
}

}  // namespace iride
