// SPDX-License-Identifier: Apache-2.0
#include "colour/cie_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/diagnostics.h"
#include "colour/chromaticity.h"
#include "colour/lch.h"

namespace iride {

namespace {

using Triple = CieSpace::Triple;

constexpr std::array spaces{CieSpace{"XYZ", "tristimulus values, white Y = 1",
                                     [](Xyz const& c, Xyz const&) {
                                         return Triple{c.X, c.Y, c.Z};
                                     },
                                     [](Triple const& t, Xyz const&) {
                                         return Xyz{t[0], t[1], t[2]};
                                     }},
                            CieSpace{"xyY", "chromaticity x, y and Y",
                                     [](Xyz const& c, Xyz const& white) {
                                         auto const [x, y, Y] = to_xyy(c, white);
                                         return Triple{x, y, Y};
                                     },
                                     [](Triple const& t, Xyz const&) {
                                         return to_xyz(Xyy{t[0], t[1], t[2]});
                                     }},
                            CieSpace{"uvY", "CIE 1976 u', v' and Y",
                                     [](Xyz const& c, Xyz const& white) {
                                         auto const [u, v, Y] = to_uv_y_prime(c, white);
                                         return Triple{u, v, Y};
                                     },
                                     [](Triple const& t, Xyz const&) {
                                         return to_xyz(UvYPrime{t[0], t[1], t[2]});
                                     }},
                            CieSpace{"Luv", "CIE 1976 L*u*v*",
                                     [](Xyz const& c, Xyz const& white) {
                                         auto const [L, u, v] = to_luv(c, white);
                                         return Triple{L, u, v};
                                     },
                                     [](Triple const& t, Xyz const& white) {
                                         return to_xyz(Luv{t[0], t[1], t[2]}, white);
                                     }},
                            CieSpace{"LCHuv", "lightness, chroma, hue [degrees] of L*u*v*",
                                     [](Xyz const& c, Xyz const& white) {
                                         auto const [L, C, h] = to_lch(to_luv(c, white));
                                         return Triple{L, C, h};
                                     },
                                     [](Triple const& t, Xyz const& white) {
                                         return to_xyz(to_luv(LchUv{t[0], t[1], t[2]}), white);
                                     }},
                            CieSpace{"Lab", "CIE 1976 L*a*b*",
                                     [](Xyz const& c, Xyz const& white) {
                                         auto const [L, a, b] = to_lab(c, white);
                                         return Triple{L, a, b};
                                     },
                                     [](Triple const& t, Xyz const& white) {
                                         return to_xyz(Lab{t[0], t[1], t[2]}, white);
                                     }},
                            CieSpace{"LCHab", "lightness, chroma, hue [degrees] of L*a*b*",
                                     [](Xyz const& c, Xyz const& white) {
                                         auto const [L, C, h] = to_lch(to_lab(c, white));
                                         return Triple{L, C, h};
                                     },
                                     [](Triple const& t, Xyz const& white) {
                                         return to_xyz(to_lab(LchAb{t[0], t[1], t[2]}), white);
                                     }}};

}  // namespace

std::span<CieSpace const> cie_spaces() { return spaces; }

CieSpace const* find_cie_space(std::string_view name) {
    auto const found = std::ranges::find(spaces, name, &CieSpace::name);
    return found == spaces.end() ? nullptr : &*found;
}

Xyz checked_xyz(CieSpace const& space, Triple const& t, Xyz const& white, std::string const& place) {
    for (double value : t)
        if (!std::isfinite(value))
            throw InputError({}, place, fmt::format("{} {} {}: finite numbers are wanted", t[0], t[1], t[2]));
    Xyz const c = space.to_xyz(t, white);
    if (!std::isfinite(c.X) || !std::isfinite(c.Y) || !std::isfinite(c.Z))
        throw InputError({}, place, fmt::format("{} {} {} is no colour in {}", t[0], t[1], t[2], space.name));
    constexpr double rounding = 1e-6;  // of the white's Y: what values written with six digits may miss 0 by
    if (std::min({c.X, c.Y, c.Z}) < -rounding * white.Y)
        throw InputError(
            {}, place,
            fmt::format("{} {} {} in {} is XYZ {:g} {:g} {:g}: tristimulus values of a light are not negative", t[0],
                        t[1], t[2], space.name, c.X, c.Y, c.Z));
    return c;
}

}  // namespace iride
