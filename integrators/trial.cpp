// SPDX-License-Identifier: Apache-2.0
#include "integrators/trial.h"

namespace iride {

namespace {

// What an integrator's paths say of a picture, cell by cell. Of the samples of a place the noise is that of their mean:
// they are stratified; of light paths, as if they were not.
struct Evidence {
    Image<Eigen::Array3d> mean, variance;  // X, Y, Z of a sample
    double rays;                           // of a sample
};

Evidence evidence_of(Integrator const& integrator, Scene const& scene, PilotBlocks const& blocks,
                     PilotStarter const& starter, int samples, RayStatistics& all) {
    auto const follow = [&](std::span<CameraPath> paths, RayStatistics& rays) {
        integrator.follow(scene, paths, rays);
    };
    Sighted seen(scene, blocks);
    Image<BlockNoise> const noise =
        noise_of(scene, blocks, samples, starter, integrator.block_side() > 1, follow, all, &seen);
    Evidence found{mean_around(each(noise, &BlockNoise::mean), seen),
                   averaged(each(noise, &BlockNoise::of_mean), seen.width(), seen.height()), seen.rays_of_path()};
    Image<Eigen::Array3d> const of_light_paths = seen.variance();
    for (std::size_t i = 0; i < of_light_paths.pixel.size(); ++i) found.variance.pixel[i] += of_light_paths.pixel[i];
    return found;
}

}  // namespace

TrialResult try_out(Scene const& scene, PilotBlocks const& blocks, PilotStarter const& starter, int samples,
                    Integrator const& first, Integrator const& second, RayStatistics& statistics) {
    Evidence const a = evidence_of(first, scene, blocks, starter, samples, statistics),
                   b = evidence_of(second, scene, blocks, starter, samples, statistics);
    Image<Eigen::Array3d> both(a.mean.width, a.mean.height);
    for (std::size_t i = 0; i < both.pixel.size(); ++i) both.pixel[i] = (a.mean.pixel[i] + b.mean.pixel[i]) / 2;
    double const variance = relative_noise(a.variance, both) / relative_noise(b.variance, both);
    return {variance * a.rays / b.rays, variance};
}

}  // namespace iride
