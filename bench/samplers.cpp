// SPDX-License-Identifier: Apache-2.0
// samplers [SCENE ...]: the error of each sampler at equal samples, as it is and after a small blur, which is what the
// eye sees of a picture's noise: root mean square over pixels of the relative error of Y, for the median of some seeds;
// and the processor's time. The reference is `path` with Sobol' points of its own seed.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "integrators/render.h"

namespace {

using namespace iride;

constexpr int side = 48, reference_spp = 4096, seeds = 5;

struct Timed {
    std::vector<double> Y;
    double seconds;
};

Timed rendered(Scene const& scene, SamplerKind kind, int spp, std::uint64_t seed) {
    RenderPlan const plan = make_plan(scene);
    Film film = make_film(scene);
    auto const integrator = make_integrator("path", scene, plan);
    std::clock_t const start = std::clock();
    render(scene, plan, *integrator, {.spp = spp, .seed = seed, .sampler = kind, .threads = 1}, film);
    Timed result{{}, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) result.Y.push_back(film.mean(x, y).Y);
    return result;
}

// A Gaussian of a standard deviation of one pixel, cut off at three; pixels beyond the edge repeat those at it.
std::vector<double> blurred(std::vector<double> const& image) {
    constexpr int reach = 3;
    auto const pass = [&](std::vector<double> const& in, int dx, int dy) {
        std::vector<double> out(in.size());
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                double sum = 0, weights = 0;
                for (int k = -reach; k <= reach; ++k) {
                    int const u = std::clamp(x + k * dx, 0, side - 1), v = std::clamp(y + k * dy, 0, side - 1);
                    double const w = std::exp(-0.5 * k * k);
                    sum += w * in[static_cast<std::size_t>(v * side + u)];
                    weights += w;
                }
                out[static_cast<std::size_t>(y * side + x)] = sum / weights;
            }
        return out;
    };
    return pass(pass(image, 1, 0), 0, 1);
}

// Of what is darker than a tenth of the mean, in shares of that: no few bright or dark pixels decide.
double relative_rms(std::vector<double> const& a, std::vector<double> const& b) {
    double squares = 0, mean = 0;
    auto const n = static_cast<double>(a.size());
    for (double x : b) mean += x / n;
    for (std::size_t i = 0; i < a.size(); ++i) squares += square((a[i] - b[i]) / std::max(b[i], mean / 10));
    return std::sqrt(squares / n);
}

double median(std::vector<double> x) {
    std::ranges::sort(x);
    return x[x.size() / 2];
}

void compare_samplers(std::string const& name) {
    auto const scene = load_scene(find_scene(name));
    scene->film.width = scene->film.height = side;
    std::vector<double> const exact = rendered(*scene, SamplerKind::sobol, reference_spp, 4711).Y;
    std::vector<double> const smooth = blurred(exact);
    for (std::size_t kind = 0; kind < sampler_names.size(); ++kind)
        for (int spp : {1, 4, 16, 64}) {
            std::vector<double> plain, after_blur, seconds;
            for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
                Timed const r = rendered(*scene, static_cast<SamplerKind>(kind), spp, seed);
                plain.push_back(relative_rms(r.Y, exact));
                after_blur.push_back(relative_rms(blurred(r.Y), smooth));
                seconds.push_back(r.seconds);
            }
            fmt::print("| {} | {} | {} | {:.4f} | {:.4f} | {:.3f} |\n", name, sampler_names[kind], spp, median(plain),
                       median(after_blur), median(seconds));
            std::fflush(stdout);
        }
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> scenes(argv + 1, argv + argc);
    if (scenes.empty()) scenes = {"cornell", "metals"};
    fmt::print("| scene | sampler | spp | error | error after a blur | seconds |\n|---|---|---:|---:|---:|---:|\n");
    try {
        for (std::string const& name : scenes) compare_samplers(name);
    } catch (InputError const& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    }
}
