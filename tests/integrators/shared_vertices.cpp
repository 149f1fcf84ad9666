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

struct Mean {
    Eigen::Array3d value{0, 0, 0}, error{0, 0, 0};
};
// Of pixels x % 4 == column of pictures of many seeds: neighbours share, so the pixels of one picture say little of the
// error of their mean.
Mean mean_of(Scene const& scene, std::string const& integrator, int pictures, int spp, int column) {
    Mean m;
    Eigen::Array3d squares(0, 0, 0);
    for (int i = 0; i < pictures; ++i) {
        Film const film =
            rendered(scene, integrator,
                     {.spp = spp, .seed = 50 + static_cast<unsigned>(i), .sampler = SamplerKind::independent});
        Eigen::Array3d sum(0, 0, 0);
        int count = 0;
        for (int y = 0; y < film.height(); ++y)
            for (int x = column; x < film.width(); x += widest_block, ++count)
                sum += to_vector(film.mean(x, y)).array();
        m.value += sum / count;
        squares += (sum / count).square();
    }
    m.value /= pictures;
    m.error = ((squares / pictures - m.value.square()) / (pictures - 1)).sqrt();
    return m;
}

void check_same_light(Scene const& scene, std::string const& sharing, std::string const& alone) {
    for (int column : {0, 3}) {
        Mean const a = mean_of(scene, sharing, 60, 60, column), b = mean_of(scene, alone, 60, 250, column);
        for (int k = 0; k < 3; ++k) {
            double const error = std::hypot(a.error[k], b.error[k]);
            INFO(sharing << ", column " << column << ": " << a.value[k] << " against " << b.value[k] << " +- "
                         << error);
            CHECK(std::abs(a.value[k] - b.value[k]) < 4 * error);
            CHECK(error < 0.01 * b.value[k]);
        }
    }
}

// Half the squared difference of two pictures, over the square of the second's mean.
double noise(Scene const& scene, std::string const& integrator, int spp) {
    Film const a = rendered(scene, integrator, {.spp = spp, .seed = 1}),
               b = rendered(scene, integrator, {.spp = spp, .seed = 2});
    double sum = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            sum += square(a.mean(x, y).Y - b.mean(x, y).Y) / (2 * square(picture_mean(b)[1].mean));
    return sum / (a.width() * a.height());
}

}  // namespace

// Fails if shadows between neighbours are left out (2 % too bright), or if a path's parts do not count in the shares.
TEST_CASE("neighbours that share second vertices find the light that paths alone find", "[law]") {
    check_same_light(*corner(white), "path:share=true", "path");
    check_same_light(*corner(white), "path:share=true,splits=8", "path");
    check_same_light(*corner(glass), "path:share=true", "path");
}

// Fails if the weights of light paths differ between neighbours that share.
TEST_CASE("neighbours share beside light paths what their weights agree on", "[law]") {
    check_same_light(*corner(gold), "caustic-path:share=true", "caustic-path");
    check_same_light(*corner(glass), "caustic-path:share=true", "caustic-path");
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
