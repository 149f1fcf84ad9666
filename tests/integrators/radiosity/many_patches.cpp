// SPDX-License-Identifier: Apache-2.0
// Links between groups of patches against a line for every pair, and what is said of scenes that are no diffuse rooms.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "integrators/radiosity/radiosity.h"
#include "integrators/radiosity/solution_file.h"
#include "support/scenes.h"

using namespace iride;
using namespace iride::radiosity;

namespace {

// Root mean square over area and wavelengths of a - b over b.
double difference(SceneRadiosity const& a, SceneRadiosity const& b) {
    auto const weight = [&](Spectra const& x) { return (x.square().colwise() * b.system().area).sum(); };
    return std::sqrt(weight(a.radiosity() - b.radiosity()) / weight(b.radiosity()));
}

}  // namespace

TEST_CASE("links find the radiosity of a room within their tolerance, and are few", "[law]") {
    auto const scene = load_scene(find_scene("cube-ceiling"));
    SceneRadiosity const exact(*scene, visible_range, {.patches = 600, .wavelengths = 2, .fineness = 8192});
    double before = 1;
    for (double tolerance : {1e-4, 1e-5, 1e-6}) {
        SceneRadiosity const linked(
            *scene, visible_range,
            {.patches = 600, .wavelengths = 2, .form_factors = "hierarchical", .link_tolerance = tolerance});
        double const error = difference(linked, exact);
        INFO(tolerance << " " << error);
        CHECK(error < (tolerance > 5e-5 ? .1 : tolerance > 5e-6 ? .04 : .015));
        CHECK(error < before);
        before = error;
    }
    auto const links = [&](int patches) {
        return static_cast<double>(
            SceneRadiosity(
                *scene, visible_range,
                {.patches = patches, .wavelengths = 1, .form_factors = "hierarchical", .link_tolerance = 1e-5})
                .report()
                .links);
    };
    CHECK(links(16000) < 5 * links(4000));  // n^2 would be 16
}

TEST_CASE("shooting without stored factors finds what shooting with them does", "[law]") {
    auto const scene = load_scene(find_scene("cube-ceiling"));
    Settings settings{.patches = 100, .wavelengths = 2, .solver = "shooting"};
    settings.stop.tolerance = 1e-4;
    SceneRadiosity const stored(*scene, visible_range, settings);
    settings.on_demand = true;
    SceneRadiosity const made(*scene, visible_range, settings);
    CHECK(difference(made, stored) < .01);  // the stored ones are made reciprocal
}

TEST_CASE("radiosity says what it approximates, ignores or cannot place", "[input]") {
    using Catch::Contains;
    auto const remarks = [](std::string const& materials, std::string const& shapes) {
        auto const scene = test::scene_from(fmt::format(
            R"({{"camera":{{"eye":[0.5,0.5,2],"target":[0.5,0.5,0],"field_deg":60}},"materials":{{{}}},"shapes":[{}]}})",
            materials, shapes));
        SceneRadiosity const solution(*scene, visible_range, {.patches = 12, .wavelengths = 2});
        std::string all;
        for (std::string const& r : solution.report().remarks) all += r + "\n";
        return all;
    };
    std::string const floor = R"({"type":"quad","material":"m","corners":[[0,0,0],[1,0,0],[1,1,0],[0,1,0]],
                                  "emission":{"radiance":1}})",
                      plain = R"("m":{"type":"diffuse","reflectance":0.5})";
    CHECK_THAT(remarks(plain, floor), Contains("the scene leaks: closure defect 1 at patch"));
    CHECK_THAT(remarks(plain, floor + "," + floor), Contains("duplicate patches"));
    CHECK_THAT(remarks(R"("m":{"type":"conductor","ior":"Au"})", floor),
               Contains("'m' (conductor) is a mirror") && Contains("no surface is diffuse"));
    CHECK_THAT(remarks(R"("m":{"type":"dielectric","ior":1.5})", floor), Contains("'m' (dielectric) transmits"));
    CHECK_THAT(remarks(R"("m":{"type":"plastic","reflectance":0.5})", floor),
               Contains("'m' (plastic) is taken for a diffuse surface"));
}

TEST_CASE("a saved solution shows the same picture, and no other scene's", "[input]") {
    using Catch::Contains;
    auto const scene = load_scene(find_scene("cube-ceiling"));
    scene->film.width = scene->film.height = 8;
    SceneRadiosity const solution(*scene, visible_range, {.patches = 60, .wavelengths = 4, .fineness = 64});
    test::TemporaryFolder const folder;
    auto const path = folder.path() / "solution.ply";
    save_solution(path, *scene, *solution.field());
    auto const picture = [&](std::shared_ptr<RadiosityField const> field) {
        RenderPlan const plan = make_plan(*scene);
        Film film = make_film(*scene);
        render(*scene, plan, *show(std::move(field)), {.spp = 2}, film);
        return film;
    };
    Film const a = picture(solution.field()), b = picture(load_solution(path, *scene));
    for (int p = 0; p < 64; ++p) CHECK(a.mean(p % 8, p / 8).Y == b.mean(p % 8, p / 8).Y);
    auto const refused = [&](std::filesystem::path const& file, Scene const& other) {
        try {
            load_solution(file, other);
        } catch (InputError const& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    CHECK_THAT(refused(path, *load_scene(find_scene("room"))), Contains("solution of another scene"));
    std::ifstream in(path, std::ios::binary);
    std::string const whole((std::istreambuf_iterator<char>(in)), {});
    CHECK_THAT(refused(folder.write("short.ply", whole.substr(0, whole.size() - 9)), *scene), Contains("too early"));
    CHECK_THAT(refused(folder.write("long.ply", whole + "x"), *scene), Contains("damaged"));
    CHECK_THAT(refused(folder.write("other.ply", "ply\nformat ascii 1.0\n"), *scene), Contains("no saved solution"));
    CHECK_THAT(refused(folder.path() / "none.ply", *scene), Contains("cannot be read"));
}
