// SPDX-License-Identifier: Apache-2.0
// Into how many parts the camera paths of a pixel are split at their first vertex: each part is followed on its own and
// counts as 1 / k of the sample. A pilot of two parts a path tells, block of pixels by block, what splitting can save:
//   v = E[(a - b)^2] / 2 over the parts a, b of one path, relative to the squared mean colour [as relMSE]
// Then k ~ sqrt(v / c), c what a part costs [rays], with the factor for which time x error is least [Neyman 1934]: as
// adaptive sampling, but every pixel has the same number of samples, and as the pilot's paths are not in the picture it
// stays unbiased. Samples that are split one way weigh as their parts, in the mean over the picture, beside those that
// are split another. Where light paths go with camera paths, beside those in parts they bring a variance u and cost c,
// each of one a sample: beside time T and error E of the parts, (T + s c) (E + u / s) is least for a share s of
//   s = sqrt(u T / (c E))                                                                  [Bolin 1997] [Rath 2022]
#pragma once

#include <algorithm>
#include <functional>
#include <optional>

#include "integrators/pilot.h"

namespace iride {

// What a sample with light paths is worth beside one without, in scenes with caustics (measured: 3 to 8).
inline constexpr double worth_of_light_paths = 4;

class Splits {
  public:
    Splits() = default;
    // `parts`: of the paths of equal blocks of a picture of this size.
    Splits(Image<std::uint8_t> parts, int width, int height);

    // Whether no path is split.
    bool none() const { return parts_.pixel.empty(); }
    // Of a path through place (x, y) of the picture, in pixels.
    std::uint32_t at(float x, float y) const {
        if (none()) return 1;
        return parts_.at(block(x * columns_per_pixel_, parts_.width), block(y * rows_per_pixel_, parts_.height));
    }

  private:
    static int block(float place, int count) { return std::clamp(static_cast<int>(place), 0, count - 1); }

    Image<std::uint8_t> parts_;
    float columns_per_pixel_ = 0, rows_per_pixel_ = 0;
};

// The light paths that go with a share of camera paths that are split; none if `follow` is empty.
struct LightPathsBeside {
    std::function<void(std::span<CameraPath>, Splits const&, RayStatistics&)> follow;
    float share = 0;
};

struct LearntSplits {
    Splits splits;
    std::optional<float> light_paths;  // the share of camera paths that they should go with
};

// Runs pilots, the more thorough the more samples there are: each costs about a sixteenth of those before its next.
class SplitPilot {
  public:
    // At most `most` parts, powers of two; the first sample is whole.
    SplitPilot(RenderPlan plan, int most) : plan_(std::move(plan)), most_(most) {}

    // How many samples of a pixel, from `first` on, are split alike.
    int samples_alike(std::uint32_t first) const;
    // Whether this sample wants other splits than the latest found.
    bool is_due(std::uint32_t sample) const { return stage_of(sample) != latest_; }
    // Of each sample split as found: about the reciprocal of its variance.
    std::uint32_t weight() const { return weight_; }
    // A function of scene, plan and stage alone. `follow`: paths that are not split.
    LearntSplits learn(Scene const& scene, std::uint32_t sample, FollowPaths const& follow,
                       LightPathsBeside const& beside, RayStatistics& statistics);

  private:
    static int stage_of(std::uint32_t sample);

    RenderPlan plan_;
    std::optional<PilotStarter> starter_;  // of all pilots, made for the first
    int most_;
    int latest_ = -1;
    std::uint32_t weight_ = 1;
};

}  // namespace iride
