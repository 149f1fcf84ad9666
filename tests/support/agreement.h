// SPDX-License-Identifier: Apache-2.0
// Whether two films of one scene agree, by a z-test of pixels and of the picture's mean; and pieces of small scenes.
#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scenes.h"
#include "support/statistics.h"

namespace iride::test {

inline std::string scene_text(std::string const& camera, std::string const& rest, std::string const& film = "") {
    return fmt::format(
        R"({{ "camera": {}, "film": {{ "size": [12, 12]{} }}, "render": {{ "sampler": "independent" }}, {} }})", camera,
        film, rest);
}

inline std::string const view = R"({ "eye": [0, 1, -4], "target": [0, 0.6, 0], "field_deg": 40 })";
inline std::string const floor_quad =
    R"({ "type": "quad", "corners": [[-3,0,-3],[-3,0,3],[3,0,3],[3,0,-3]], "material": { "type": "diffuse", "reflectance": 0.6 } })";
inline std::string const lamp =
    R"({ "type": "quad", "corners": [[-1.2,2.5,-1],[1,2.5,-1],[1,2.5,1.2],[-1.2,2.5,1.2]], "material": { "type": "black" }, "emission": { "radiance": { "data": "D65", "luminance_weighted": 3 } } })";
inline std::string const big_lamp_sphere =
    R"({ "type": "sphere", "centre": [1.5,1.6,0.5], "radius": 0.8, "material": { "type": "diffuse", "reflectance": 0.3 }, "emission": { "radiance": 2 } })";
inline std::string sphere(std::string const& material) {
    return fmt::format(R"({{ "type": "sphere", "centre": [0,0.7,0], "radius": 0.7, "material": {} }})", material);
}

struct Moments {
    double mean = 0, variance = 0;
};

// Mean of all pixels' X, Y and Z, and the variance of that mean.
inline std::array<Moments, 3> picture_mean(Film const& film) {
    std::array<Moments, 3> m{};
    double const n = film.width() * film.height();
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            Xyz const a = film.mean(x, y), v = film.variance(x, y);
            for (auto [k, value, var] : {std::tuple(0, a.X, v.X), {1, a.Y, v.Y}, {2, a.Z, v.Z}}) {
                m[static_cast<std::size_t>(k)].mean += value / n;
                m[static_cast<std::size_t>(k)].variance += var / (n * n);
            }
        }
    return m;
}

// Per pixel: z of Y beyond 3.3 (two-sided level 1e-3) in no more of 144 pixels than 4; the whole: |z| < 4.
inline void check_films_agree(Film const& fast, Film const& slow) {
    CHECK(fast.rejected() == std::array<std::uint64_t, rejection_count>{});
    int beyond = 0;
    for (int y = 0; y < fast.height(); ++y)
        for (int x = 0; x < fast.width(); ++x) {
            double const d = fast.mean(x, y).Y - slow.mean(x, y).Y, v = fast.variance(x, y).Y + slow.variance(x, y).Y;
            beyond += d * d > 3.3 * 3.3 * v + 1e-20;
        }
    CHECK(beyond <= 4);
    auto const a = picture_mean(fast), b = picture_mean(slow);
    for (std::size_t k = 0; k < 3; ++k) {
        double const z = (a[k].mean - b[k].mean) / std::sqrt(a[k].variance + b[k].variance + 1e-30);
        INFO("component " << k << ": " << a[k].mean << " against " << b[k].mean << ", z = " << z);
        CHECK(std::abs(z) < 4);
        CHECK(b[k].mean > 0.01);
    }
}

struct Trial {
    std::string integrator = "bidirectional", oracle = "reference_path";
    int spp = 1500, oracle_spp = 12000;
};

// Independent samples; of the integrator by `seed`, of the oracle by the next.
inline void check_agreement(Scene const& scene, Trial const& t = {}, std::uint64_t seed = 15) {
    INFO(t.integrator << " against " << t.oracle);
    Film const fast = rendered(scene, t.integrator, {.spp = t.spp, .seed = seed, .sampler = SamplerKind::independent});
    Film const slow =
        rendered(scene, t.oracle, {.spp = t.oracle_spp, .seed = seed + 1, .sampler = SamplerKind::independent});
    check_films_agree(fast, slow);
}

// An octahedron, as OBJ, whose vertex normals are a ball's: they lean up to 55 degrees from its faces.
inline std::string const faceted_ball =
    "v 0 1.4 0\nv .7 .7 0\nv 0 .7 .7\nv -.7 .7 0\nv 0 .7 -.7\nv 0 0 0\n"
    "vn 0 1 0\nvn 1 0 0\nvn 0 0 1\nvn -1 0 0\nvn 0 0 -1\nvn 0 -1 0\n"
    "f 1//1 3//3 2//2\nf 1//1 4//4 3//3\nf 1//1 5//5 4//4\nf 1//1 2//2 5//5\n"
    "f 6//6 2//2 3//3\nf 6//6 3//3 4//4\nf 6//6 4//4 5//5\nf 6//6 5//5 2//2\n";

}  // namespace iride::test
