// SPDX-License-Identifier: Apache-2.0
// Second vertices that neighbouring paths share bring the light that paths alone find, with less noise.
#include "integrators/shared_vertices.h"

#include <fmt/format.h>

#include "support/agreement.h"
#include "support/same_bits.h"

using namespace iride;
using namespace iride::test;

namespace {

std::string const white = R"({ "type": "diffuse", "reflectance": 0.7 })",
                  gold = R"({ "type": "conductor", "ior": "Au", "roughness": 0.15 })",
                  glass = R"({ "type": "dielectric", "ior": { "pairs": [[300, 1.7], [900, 1.4]] }, )"
                          R"("absorption_per_m": 0.5 })";

// A floor and two walls that meet, a ball of some material between them, a lamp above. Pictures whose last blocks are
// not full.
std::shared_ptr<Scene> corner(std::string const& ball) {
    auto const quad = [](char const* corners) {
        return fmt::format(R"({{ "type": "quad", "corners": {}, "material": {} }})", corners, white);
    };
    auto const text =
        scene_text(view, fmt::format(R"("shapes": [{}, {}, {}, {}, {}])", floor_quad,
                                     quad("[[-3,0,1.2],[-3,4,1.2],[3,4,1.2],[3,0,1.2]]"),
                                     quad("[[-1,0,-3],[-1,4,-3],[-1,4,3],[-1,0,3]]"), lamp, sphere(ball)));
    std::shared_ptr<Scene> scene = scene_from(text);
    scene->film.width = 14, scene->film.height = 10;
    return scene;
}

// Mean and squared error of each pixel's Y, by pictures of many seeds.
struct PixelMeans {
    std::vector<double> mean, error2;
};
PixelMeans means_of(Scene const& scene, std::string const& integrator, int pictures, int spp) {
    auto const pixels = static_cast<std::size_t>(scene.film.width * scene.film.height);
    std::vector<double> sum(pixels), squares(pixels);
    for (int i = 0; i < pictures; ++i) {
        Film const film =
            rendered(scene, integrator,
                     {.spp = spp, .seed = 50 + static_cast<unsigned>(i), .sampler = SamplerKind::independent});
        for (std::size_t k = 0; k < pixels; ++k) {
            double const Y = film.mean(static_cast<int>(k) % film.width(), static_cast<int>(k) / film.width()).Y;
            sum[k] += Y, squares[k] += Y * Y;
        }
    }
    PixelMeans m;
    for (std::size_t k = 0; k < pixels; ++k) {
        double const mean = sum[k] / pictures;
        m.mean.push_back(mean);
        m.error2.push_back((squares[k] / pictures - mean * mean) / (pictures - 1));
    }
    return m;
}

// Pixel by pixel: what one has too much its block has too little. z^2 is 1 in the mean; neighbours' errors are alike,
// as if there were some 15 of them: it is beyond 2.3 by chance once in 500 times.
void check_same_light(Scene const& scene, std::string const& sharing, std::string const& alone) {
    INFO(sharing << " against " << alone);
    PixelMeans const a = means_of(scene, sharing, 60, 100), b = means_of(scene, alone, 60, 300);
    double z2 = 0, relative2 = 0;
    for (std::size_t k = 0; k < a.mean.size(); ++k) {
        double const error2 = a.error2[k] + b.error2[k];
        z2 += square(a.mean[k] - b.mean[k]) / error2;
        relative2 += error2 / square(b.mean[k]);
    }
    auto const pixels = static_cast<double>(a.mean.size());
    CHECK(z2 / pixels < 2.3);
    CHECK(std::sqrt(relative2 / pixels) < 0.016);  // that it can tell
}

// Half the squared difference of two pictures, over the square of the second's mean.
double noise(Scene const& scene, std::string const& integrator, int spp) {
    Film const a = rendered(scene, integrator, {.spp = spp, .seed = 1}),
               b = rendered(scene, integrator, {.spp = spp, .seed = 2});
    double sum = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) sum += square(a.mean(x, y).Y - b.mean(x, y).Y);
    return sum / (2 * square(picture_mean(b)[1].mean) * a.width() * a.height());
}

}  // namespace

// Fails if shadows between neighbours are left out, or if a path's parts do not count in the shares.
TEST_CASE("neighbours that share second vertices find the light that paths alone find", "[law]") {
    check_same_light(*corner(white), "path:share=true", "path");
    check_same_light(*corner(white), "path:share=true,splits=8", "path");
    check_same_light(*corner(glass), "path:share=true", "path");
}

// Fails if the weights of light paths differ between neighbours that share.
TEST_CASE("neighbours share beside light paths what their weights agree on", "[law]") {
    check_same_light(*corner(gold), "caustic-path:share=true", "caustic-path");
    check_same_light(*corner(gold), "auto", "caustic-path");
}

// Energy: what the shares of a place bring to the parts that might have found it adds up to what one has found.
TEST_CASE("shares of a place add up to one part, and none is more than a part of its own path", "[law]") {
    auto const scene = corner(white);
    std::array<CameraPath, most_in_block> paths;
    std::array<SurfacePoint, most_in_block> points;
    for (CameraPath& path : paths) path.block = paths.data();
    FirstVertices first(paths);
    Direction const up(0, 1, 0);
    std::array<float, most_in_block> parts{};
    for (std::size_t i = 0; i < most_in_block; ++i) {
        if (i == 5) continue;  // does not share
        points[i].position =
            Vector(0.9f + 0.02f * static_cast<float>(i % 4), 0, -0.8f + 0.02f * static_cast<float>(i / 4));
        points[i].normal = points[i].geometric_normal = up;
        parts[i] = static_cast<float>(1 + i % 3);
        first.add(i, {&points[i], up, up, Throughput(0.5f), parts[i], 0});
    }
    FirstVertices::Shares shares;
    RayStatistics rays;
    FirstVertices::Place const wall{Vector(1.2f, 0.4f, 1.2f), Vector(0, 0, -1), Vector(0, 0, -1)};
    REQUIRE(first.share(*scene, 2, wall, shares, rays));
    float sum = 0;
    for (std::size_t i = 0; i < most_in_block; ++i) {
        sum += shares[i] * parts[i];
        CHECK(shares[i] * parts[i] <= 1);
    }
    CHECK(sum == Approx(1));
    CHECK(shares[5] == 0);
    CHECK(rays.shadow_rays == most_in_block - 2);
    FirstVertices::Place const behind{Vector(1.2f, -0.4f, 1.2f), Vector(0, 0, -1), Vector(0, 0, -1)};
    CHECK_FALSE(first.share(*scene, 2, behind, shares, rays));
}

// Fails if shares go to the wrong path, or to its own alone.
TEST_CASE("sharing divides the noise of light from diffuse surfaces", "[law]") {
    auto const scene = corner(white);
    scene->film.width = scene->film.height = 64;
    double const alone = noise(*scene, "path", 16);
    CHECK(noise(*scene, "path:share=true", 16) < 0.4 * alone);
    CHECK(noise(*scene, "auto", 16) < 0.4 * alone);
}

TEST_CASE("pictures of neighbours that share are the same bits whatever threads, passes, stops and crops", "[law]") {
    for (auto const& [ball, integrator] :
         {std::pair(white, "path:share=true"), {white, "auto"}, {gold, "path:share=true,splits=4"}}) {
        auto const scene = corner(ball);
        scene->film.width = 41, scene->film.height = 22;
        RenderPlan const plan = make_plan(*scene);
        auto const picture = [&](RenderSettings settings) {
            settings.spp = 20;
            return rendered(*scene, integrator, settings);
        };
        Film const one = picture({.threads = 1});
        CHECK((values_of(picture({.threads = 2, .reversed_tiles = true})) == values_of(one)));
        CHECK((values_of(picture({.seconds = 1e9})) == values_of(one)));
        Film film = make_film(*scene);
        for (int spp : {3, 16, 18, 20})
            render(*scene, plan, *make_integrator(integrator, *scene, plan), {.spp = spp}, film);
        CHECK((values_of(film) == values_of(one)));
        Film crop = make_film(*scene, Crop{5, 3, 35, 18});
        render(*scene, plan, *make_integrator(integrator, *scene, plan), {.spp = 20}, crop);
        bool same = true;
        for (int y = 0; y < crop.height(); ++y)
            for (int x = 0; x < crop.width(); ++x) same = same && crop.mean(x, y).Y == one.mean(x + 5, y + 3).Y;
        CHECK(same);
    }
}
