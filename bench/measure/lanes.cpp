// SPDX-License-Identifier: Apache-2.0
// What this build's number of wavelengths per path costs and brings: time of a path and relMSE, to be held against
// builds with other numbers (-DIRIDE_LANES=n); how noisy luminance and colour are; and the noise of wavelengths alone,
// as found where light and its way vary by nothing else against what the packets' densities predict:
//   colours that follow the BSDF (`reference_path`) from flat patches under an even sky bring L(w) exactly, so
//   var X / X^2 of a path = E[(1/N sum_i xbar(w_i) L(w_i) / p_i)^2] / X^2 - 1, the mean over one number u by
//   quadrature.
#include <fmt/format.h>

#include "bench/measure/benchmark.h"
#include "bench/measure/clock.h"
#include "bench/measure/reference.h"

namespace iride::bench {

namespace {

constexpr int spp = 64;

// Mean over pixels of relative variances of one sample.
struct Noise {
    double luminance = 0;  // of Y
    double colour = 0;     // of X and Z where Y is known: of X / mean X - Y / mean Y, and Z
    double packet = 0;     // of X, Y and Z, their mean; the median pixel's: at edges places tell too
};

Noise noise_of(Film const& film) {
    Noise noise;
    std::vector<double> packet;
    double const pixels = film.width() * film.height();
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            Xyz const mean = film.mean(x, y);
            MatrixDouble const C = film.covariance(x, y);
            if (!(mean.X > 0 && mean.Y > 0 && mean.Z > 0)) continue;
            Eigen::Array3d const inverse = to_vector(mean).array().inverse();
            auto const relative = [&](int i, int j) { return C(i, j) * inverse[i] * inverse[j]; };
            double const n = film.sample_count(x, y) / pixels;
            noise.luminance += n * relative(1, 1);
            for (int i : {0, 2}) noise.colour += n * (relative(i, i) - 2 * relative(i, 1) + relative(1, 1)) / 2;
            packet.push_back(n * pixels * (relative(0, 0) + relative(1, 1) + relative(2, 2)) / 3);
        }
    noise.packet = spread_of(packet).median;
    return noise;
}

// That of `checker` by quadrature: pixel by pixel the light of its first path, at the packets of even numbers u.
double predicted_packet_noise(Scene const& scene) {
    RenderPlan const plan = make_plan(scene);
    auto const integrator = make_integrator("reference_path", scene, plan);
    WavelengthSampler const wavelengths = make_wavelength_sampler(scene, plan);
    PathStarter const starter(scene, plan, scene.film.width, scene.film.height, SamplerKind::independent, 0);
    constexpr int packets = 1024;
    Film film = make_film(scene);
    RayStatistics rays;
    std::array<CameraPath, 1> path;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            for (int i = 0; i < packets; ++i) {
                starter.start(x, y, 0, path[0]);
                path[0].wavelengths = wavelengths.sample((static_cast<float>(i) + .5f) / packets);
                integrator->follow(scene, path, rays);
                film.add(x, y, path[0].wavelengths, path[0].radiance);
            }
    return noise_of(film).packet;
}

Rows::value_type spectral_noise(Settings const& settings) {
    auto const scene = load_for_picture("checker");
    scene->film.width = scene->film.height = 64;
    settings.say("lanes: noise of wavelengths alone");
    RenderPlan const plan = make_plan(*scene);
    Film film = make_film(*scene);
    render(*scene, plan, *make_integrator("reference_path", *scene, plan),
           {.spp = 1024, .sampler = SamplerKind::independent}, film);
    return {{"lanes", lane_count},
            {"scene", "checker"},
            {"integrator", "reference_path"},
            {"us_per_path", nullptr},
            {"relmse", nullptr},
            {"luminance_noise", nullptr},
            {"colour_noise", nullptr},
            {"packet_noise", noise_of(film).packet},
            {"packet_noise_predicted", predicted_packet_noise(*scene)}};
}

}  // namespace

Rows measure_lanes(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, {"cornell", "cornell-gold", "metals"})) {
        auto const scene = load_for_picture(name);
        Reference const reference = reference_of(*scene, settings);
        RenderPlan const plan = make_plan(*scene);
        auto const integrator = make_integrator("path", *scene, plan);
        std::vector<double> seconds, relmse;
        Noise noise;
        for (int round = 0; round < settings.rounds; ++round) {
            settings.say(fmt::format("lanes: {}, round {}", name, round + 1));
            Film film = make_film(*scene);
            RenderSettings const r{.spp = spp, .seed = static_cast<std::uint64_t>(round), .threads = 1};
            seconds.push_back(render(*scene, plan, *integrator, r, film).seconds);
            relmse.push_back(reference.relmse_of(picture_of(film)));
            noise = noise_of(film);
        }
        double const paths = static_cast<double>(spp) * picture_size * picture_size;
        rows.push_back({{"lanes", lane_count},
                        {"scene", name},
                        {"integrator", "path"},
                        {"us_per_path", spread_of(seconds).median / paths * 1e6},
                        {"relmse", spread_of(relmse).median},
                        {"luminance_noise", noise.luminance},
                        {"colour_noise", noise.colour},
                        {"packet_noise", nullptr},
                        {"packet_noise_predicted", nullptr}});
    }
    rows.push_back(spectral_noise(settings));
    return rows;
}

}  // namespace iride::bench
