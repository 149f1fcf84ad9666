// SPDX-License-Identifier: Apache-2.0
// An integrator estimates the spectral radiance that arrives along rays, several at a time. It is pure: no camera, no
// film, and no state but what prepare() makes for a pass.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "integrators/camera_path.h"
#include "integrators/integrator_options.h"

namespace iride {

// The most paths that are followed together, and the most of a block among them.
inline constexpr int batch_size = 64, widest_block = 4, most_in_block = widest_block * widest_block;

// Samples [first, last) of every pixel; where pixels have goals of their own, up to the highest.
struct SamplePass {
    std::uint64_t seed;
    std::uint32_t first, last;
};

class Integrator {
  public:
    virtual ~Integrator() = default;
    // Called before each pass, by one thread, for what its paths share: a function of seed and samples alone.
    virtual void prepare(Scene const&, SamplePass const&, RayStatistics&) {}
    // How many samples, from this one on, one pass may have.
    virtual int samples_alike(std::uint32_t /*first*/) const { return std::numeric_limits<int>::max(); }
    // What each sample of the pass counts beside those of others: about the reciprocal of its variance.
    virtual std::uint32_t weight() const { return 1; }
    // Side of the blocks of pixels whose paths of one sample are followed together and have the same wavelengths:
    // 1 or widest_block, the same throughout a pass.
    virtual int block_side() const { return 1; }
    // Follow at most batch_size paths, each on its own: what a path brings does not depend on those beside it but for
    // those of its block, which stand together.
    virtual void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const = 0;
    // Whether a light path goes with each camera path, and leaves splats.
    virtual bool splats() const { return false; }
    // Whether pixels or their samples share light paths: then no pixel can have a number of samples of its own.
    virtual bool shares_light_paths() const { return splats(); }
    // Whether single samples may be below 0, as those of a control variate are; of all others they are dropped.
    virtual bool may_be_negative() const { return false; }
    // What the user is told before the first path, such as which light will be missing.
    virtual std::vector<std::string> remarks() const { return {}; }
};

// Through which media light is followed; each has what stands before it.
enum class MediaKnown { in_bodies, between_bodies, scattering };

struct IntegratorEntry {
    char const* name;
    char const* summary;
    // Asks all its options, calls options.finish() if it then works long, and says what scene it cannot do.
    std::unique_ptr<Integrator> (*make)(Scene const&, RenderPlan const&, IntegratorOptions& options);
    MediaKnown media = MediaKnown::in_bodies;
};
std::span<IntegratorEntry const> integrator_entries();
// What an integrator works out before the first path is done here. Throws InputError with the nearest name.
std::unique_ptr<Integrator> make_integrator(IntegratorChoice const& choice, Scene const& scene, RenderPlan const& plan);
// The same of NAME[:key=value,...].
std::unique_ptr<Integrator> make_integrator(std::string const& text, Scene const& scene, RenderPlan const& plan);

// A path that scatters this often in a scene without absorption would never end: it is given up and counted.
inline constexpr int longest_path = 10000;

}  // namespace iride
