// SPDX-License-Identifier: Apache-2.0
// The 24 patches of the shipped scene "checker" under any lamp: rendered, by direct integration, and as CIE sums them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "colour/difference.h"
#include "colour/illuminant.h"
#include "colour/tristimulus.h"
#include "spectral/catalogue.h"
#include "support/files.h"
#include "support/scenes.h"

namespace iride::test {

// In the scene's order, four rows of six.
inline constexpr std::array<char const*, 24> patch_names{"dark_skin",
                                                         "light_skin",
                                                         "blue_sky",
                                                         "foliage",
                                                         "blue_flower",
                                                         "bluish_green",
                                                         "orange",
                                                         "purplish_blue",
                                                         "moderate_red",
                                                         "purple",
                                                         "yellow_green",
                                                         "orange_yellow",
                                                         "blue",
                                                         "green",
                                                         "red",
                                                         "yellow",
                                                         "magenta",
                                                         "cyan",
                                                         "white_9_5_05_d",
                                                         "neutral_8_23_d",
                                                         "neutral_6_5_44_d",
                                                         "neutral_5_70_d",
                                                         "neutral_3_5_1_05_d",
                                                         "black_2_1_5_d"};

// Integral of lamp times factor times matching function over that of lamp times ybar, each linear between its points:
// two-point Gauss rule in every nanometre, exact for the product of three linear functions.
inline Xyz integrated(SpectralFunction const& lamp, SpectralFunction const& factor) {
    Xyz sum;
    double white = 0;
    double const offset = 0.5 / std::sqrt(3.0);
    for (double middle = 360.5; middle < 830; ++middle)
        for (double const nm : {middle - offset, middle + offset}) {
            Xyz const eye = cie1931_2deg().at(nm);
            sum = sum + lamp.at(nm) * factor.at(nm) * eye;
            white += lamp.at(nm) * eye.Y;
        }
    return 1 / white * sum;
}

struct CheckerErrors {
    double rendered = 0, summed = 0;  // largest CIEDE2000 against direct integration: of the picture; of CIE's sums
};

inline CheckerErrors checker_errors(std::string const& lamp_name, int side, int spp, std::uint64_t seed = 1) {
    TemporaryFolder const folder;
    std::string text = content(data_folder() / "scenes" / "checker.json");
    text = std::regex_replace(text, std::regex(R"("data": "D65")"), fmt::format(R"("data": "{}")", lamp_name));
    text = std::regex_replace(text, std::regex(R"(\[256, 256\])"), fmt::format("[{}, {}]", side, side));
    auto const scene = load_scene(folder.write("checker.json", text));
    Film const film = rendered(*scene, "path", {.spp = spp, .seed = seed});
    SpectralFunction const lamp = illuminant(lamp_name);
    TristimulusWeights const cie(lamp, cie1931_2deg());
    Xyz const white = integrated(lamp, SpectralFunction::constant(1));
    int const cell = side / 6;
    CheckerErrors largest;
    for (int i = 0; i < 24; ++i) {
        SpectralFunction const patch = load_spectrum(
            fmt::format("colorchecker:{}", patch_names[static_cast<std::size_t>(i)]), SpectralQuantity::reflectance);
        Xyz seen;
        for (int y = 0; y < cell; ++y)
            for (int x = 0; x < cell; ++x)
                seen = seen + 1.0 / (cell * cell) * film.mean(i % 6 * cell + x, (i / 6 + 1) * cell + y);
        Lab const direct = to_lab(integrated(lamp, patch), white);
        largest.rendered = std::max(largest.rendered, delta_e_2000(to_lab(seen, white), direct));
        largest.summed = std::max(largest.summed, delta_e_2000(to_lab(cie.of(patch), cie.white()), direct));
    }
    return largest;
}

}  // namespace iride::test
