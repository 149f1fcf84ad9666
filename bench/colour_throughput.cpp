// SPDX-License-Identifier: Apache-2.0
// Pixels per second through the shipped config, by rows and in one call: see bench/README.md.
#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "base/clock.h"
#include "base/diagnostics.h"
#include "colour/colour_config.h"

namespace {

using namespace iride;
namespace ocio = OCIO_NAMESPACE;
using Picture = std::vector<float>;

// Mpixel/s, the best of `rounds`: noise of a shared machine only ever slows down.
double speed(Picture const& picture, int rounds, std::function<void(Picture&)> const& convert) {
    double best = 0;
    for (int i = 0; i < rounds; ++i) {
        Picture copy = picture;
        auto const start = Clock::now();
        convert(copy);
        double const seconds = seconds_since(start);
        best = std::max(best, static_cast<double>(picture.size()) / 3e6 / seconds);
    }
    return best;
}

void measure(ColourConfig const& config, std::string const& to, int width, int height, int rounds) {
    Picture picture(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    for (std::size_t i = 0; i < picture.size(); ++i) picture[i] = static_cast<float>(i * 7919 % 10007) / 5000.0f;
    ColourTransform const rows = config.between("ACEScg", to);
    auto const whole = ocio::Config::CreateFromFile(config.path().c_str())
                           ->getProcessor("ACEScg", to.c_str())
                           ->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS);
    double const one_call = speed(picture, rounds, [&](Picture& p) {
        ocio::PackedImageDesc image(p.data(), width, height, 3);
        whole->apply(image);
    });
    double const one = speed(picture, rounds, [&](Picture& p) { rows.apply(p, 1); });
    double const two = speed(picture, rounds, [&](Picture& p) { rows.apply(p, 2); });
    fmt::print("{:<24} one call {:6.1f} Mpixel/s; by rows: 1 thread x {:.2f}, 2 threads x {:.2f}\n", to, one_call,
               one / one_call, two / one_call);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        ColourConfig const config;
        for (char const* to : {"CIE XYZ (D65)", "sRGB - Texture", "CIE Lab (D65)", "CIE Luv (D65)", "sRGB"})
            measure(config, to, 3840, 2160, argc > 1 ? std::max(1, std::atoi(argv[1])) : 5);
        return 0;
    } catch (InputError const& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    }
}
