// SPDX-License-Identifier: Apache-2.0
// Radiosity of whole scenes: form factors by every method, closed forms, agreement with path tracing.
#include <catch2/catch.hpp>

#include "integrators/radiosity/closed_forms.h"
#include "integrators/radiosity/radiosity.h"
#include "support/scenes.h"

using namespace iride;
using namespace iride::radiosity;

namespace {

FormFactorMethod const& method(std::string const& name) {
    for (FormFactorMethod const& m : form_factor_methods())
        if (m.name == name) return m;
    throw std::logic_error(name);
}

// A closed unit cube whose six faces emit `radiance` and reflect `rho`.
std::string cube(double rho, double radiance) {
    std::string shapes;
    for (char const* corners : {"[[0,1,0],[1,1,0],[1,1,1],[0,1,1]]", "[[0,0,0],[0,0,1],[1,0,1],[1,0,0]]",
                                "[[0,0,0],[0,1,0],[0,1,1],[0,0,1]]", "[[1,0,0],[1,0,1],[1,1,1],[1,1,0]]",
                                "[[0,0,1],[0,1,1],[1,1,1],[1,0,1]]", "[[0,0,0],[1,0,0],[1,1,0],[0,1,0]]"})
        shapes += fmt::format(R"({}{{"type":"quad","material":"m","corners":{},"emission":{{"radiance":{}}}}})",
                              shapes.empty() ? "" : ",", corners, radiance);
    return fmt::format(R"({{"camera":{{"eye":[0.5,0.5,0.02],"target":[0.5,0.5,1],"field_deg":90}},
        "film":{{"size":[16,16]}},"materials":{{"m":{{"type":"diffuse","reflectance":{}}}}},"shapes":[{}]}})",
                       rho, shapes);
}

constexpr char inside_of_a_sphere[] = R"({"camera":{"eye":[0,0,0],"target":[0,0,1],"field_deg":60},
    "materials":{"m":{"type":"diffuse","reflectance":0.5}},
    "shapes":[{"type":"sphere","centre":[0,0,0],"radius":1,"material":"m","flip":true,"emission":{"radiance":1}}]})";

}  // namespace

// A face of the cube as one patch. The hemicube sees only its centre: .2395 for the ceiling, and its weights sum to
// 1 + .5419 / N^2.
TEST_CASE("every method finds the form factors of the cube to its own error", "[law]") {
    auto const scene = test::scene_from(cube(.5, 1));
    PatchMesh const mesh = make_patches(*scene, 1);
    PatchTracer const tracer(mesh);
    REQUIRE(mesh.patch.size() == 6);
    auto const factors = [&](char const* name, int fineness) { return method(name).compute(mesh, tracer, fineness); };
    double const opposite = .199824895698387383, adjacent = .200043776075403154;
    FormFactors const exact = factors("analytic", 4);
    CHECK(exact.coeff(0, 1) == Approx(opposite).epsilon(1e-7));  // the scene is in single precision
    CHECK(exact.coeff(0, 2) == Approx(adjacent).epsilon(1e-7));
    constexpr int rays = 1 << 14;
    double const sigma = std::sqrt(adjacent * (1 - adjacent) / rays);  // of independent rays: an upper bound here
    for (char const* name : {"rays", "global-lines"}) {
        FormFactors const F = factors(name, rays);
        INFO(name);
        CHECK(std::abs(F.coeff(0, 1) - opposite) < 4 * sigma);
        CHECK(std::abs(F.coeff(0, 2) - adjacent) < 4 * sigma);
    }
    for (int n : {8, 16, 32, 64}) {
        FormFactors const F = factors("hemicube", n);
        double const sum = Eigen::VectorXd(F * Eigen::VectorXd::Ones(6))[0];
        CHECK((sum - 1) * n * n == Approx(.5419).epsilon(n < 16 ? .02 : .005));
    }
    FormFactors const seen = factors("hemicube", 128), lifted = factors("hemisphere", 256);
    CHECK(seen.coeff(0, 1) == Approx(0.23945647046077354).epsilon(2e-3));
    CHECK(lifted.coeff(0, 1) == Approx(0.23945647046077354).epsilon(2e-3));
    CHECK(lifted.coeff(0, 2) == Approx(0.1901358823848066).epsilon(6e-3));  // half a part of 256 along the edge
}

// A_j / (4 pi R^2). Facets make the sphere a little smaller, and hide neighbours from each other: those are left out.
TEST_CASE("invariant 6: inside a sphere every patch sees every other by its area", "[law]") {
    auto const scene = test::scene_from(inside_of_a_sphere);
    PatchMesh const mesh = make_patches(*scene, .35);
    PatchTracer const tracer(mesh);
    constexpr int rays = 1 << 12;
    FormFactors const F = method("rays").compute(mesh, tracer, rays);
    double total = 0;
    for (Patch const& p : mesh.patch) total += p.area;
    CHECK(total == Approx(4 * pi_double).epsilon(.03));
    double worst = 0;
    double const R = std::sqrt(total / (4 * pi_double));
    for (std::size_t i = 0; i < mesh.patch.size(); i += 7)
        for (std::size_t j = 0; j < mesh.patch.size(); ++j) {
            if ((mesh.patch[i].centre - mesh.patch[j].centre).norm() < .8) continue;
            double const wanted = inside_sphere(mesh.patch[j].area, R),
                         found = F.coeff(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
            worst = std::max(worst, std::abs(found - wanted) / (std::sqrt(wanted / rays) + .03 * wanted));
        }
    CHECK(worst < 5);
}

// b = e / (1 - rho) for any closed shape. Fails when rows of F do not sum to 1.
TEST_CASE("a closed furnace has the radiance of its geometric series", "[law]") {
    for (double rho : {0., .5, .9}) {
        Film const film = test::rendered(*test::scene_from(cube(rho, 1)), "radiosity", {.spp = 64});
        for (int p = 0; p < 16; ++p) CHECK(film.mean(p, 7).Y == Approx(1 / (1 - rho)).epsilon(2e-3));
    }
}

// Picture means of the two within half a per cent; both see the wavelengths of the same lamps.
TEST_CASE("radiosity and path tracing agree on a room of plaster", "[law]") {
    auto const scene = load_scene(find_scene("cube-ceiling"));
    scene->film.width = scene->film.height = 48;
    auto const mean = [](Film const& film) {
        Xyz sum;
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) sum = sum + film.mean(x, y);
        return sum;
    };
    Xyz const solved = mean(test::rendered(*scene, "radiosity", {.spp = 16})),
              traced = mean(test::rendered(*scene, "path", {.spp = 256}));
    CHECK(solved.X == Approx(traced.X).epsilon(5e-3));
    CHECK(solved.Y == Approx(traced.Y).epsilon(5e-3));
    CHECK(solved.Z == Approx(traced.Z).epsilon(5e-3));
}

TEST_CASE("radiosity refuses what has no solution or would not fit", "[input]") {
    using Catch::Contains;
    auto const refused = [](std::string const& scene, Settings const& settings) {
        try {
            SceneRadiosity(*test::scene_from(scene), visible_range, settings);
        } catch (InputError const& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    CHECK_THAT(refused(cube(1, 1), {.size_m = .5}),
               Contains("material 'm'") && Contains("patch 0") && Contains("has no radiosity"));
    CHECK_THAT(refused(cube(.5, 1), {.size_m = 1e-4}),
               Contains("--size") && Contains("would take") && Contains("allowed: 4 GB"));
    CHECK_THAT(refused(cube(.5, 1), {.size_m = 1, .form_factors = "hemicubes"}), Contains("did you mean 'hemicube'"));
    CHECK_THAT(refused(cube(.5, 1), {.size_m = 1, .solver = "jacoby"}), Contains("did you mean 'jacobi'"));
    CHECK_THAT(refused(cube(1, 1), {.size_m = 1, .solver = "collision-walk"}), Contains("nothing absorbs"));
    CHECK_THAT(refused(cube(.5, 1), {.size_m = 1, .form_factors = "hierarchical", .solver = "direct"}),
               Contains("allowed: conjugate-gradients, jacobi"));
    CHECK_THAT(refused(cube(.5, 1), {.size_m = 1, .on_demand = true}), Contains("allowed: shooting"));
    CHECK_THAT(refused(cube(.5, 1), {.size_m = .5, .form_factors = "hierarchical", .memory_bytes = 1e5}),
               Contains("--memory"));
}
