// SPDX-License-Identifier: Apache-2.0
// A checkered floor to the horizon: filtered by ray cones it has the mean that supersampling of points converges to,
// row by row, and less noise where a pixel holds many squares.
#include <catch2/catch.hpp>

#include "base/picture.h"
#include "support/scenes.h"

using namespace iride;

namespace {

struct Rows {
    std::vector<double> mean, variance;  // of the pixels of a row
};
Rows rows_of(Film const& film) {
    Rows rows;
    for (int y = 0; y < film.height(); ++y) {
        double sum = 0, squares = 0;
        for (int x = 0; x < film.width(); ++x) {
            sum += film.mean(x, y).Y;
            squares += square(film.mean(x, y).Y);
        }
        rows.mean.push_back(sum / film.width());
        rows.variance.push_back(squares / film.width() - square(rows.mean.back()));
    }
    return rows;
}

std::string floor_of(std::string const& reflectance) {
    return R"({ "camera": { "eye": [0.3,1,0], "target": [0.3,0.6,-3], "field_deg": 40 }, "film": { "size": [64, 32] },
        "render": { "max_bounces": 1 },
        "shapes": [ { "type": "quad", "corners": [[-200,0,1],[200,0,1],[200,0,-400],[-200,0,-400]],
                      "material": { "type": "diffuse", "reflectance": )" +
           reflectance + R"( } } ],
        "lights": [ { "type": "distant", "direction": [0.1,-1,0.2], "irradiance": 3 } ] })";
}

// `share`: the most of the points' noise that the filter may leave.
void check_floor(Scene const& scene, double share) {
    Rows const filtered = rows_of(test::rendered(scene, "path", {.spp = 16}));
    Rows const points = rows_of(test::rendered(scene, "reference_path", {.spp = 16}));
    Rows const truth = rows_of(test::rendered(scene, "reference_path", {.spp = 256}));
    double of_filtered = 0, of_points = 0;
    int far_rows = 0;
    for (std::size_t y = 0; y < truth.mean.size(); ++y) {
        if (truth.mean[y] < .1) continue;  // sky, and the row that is half of it
        INFO("row " << y);
        if (y > 0 && truth.mean[y - 1] > .1) CHECK(filtered.mean[y] == Approx(truth.mean[y]).epsilon(.03));
        if (++far_rows <= 8) of_filtered += filtered.variance[y], of_points += points.variance[y];
    }
    CHECK(far_rows > 12);
    CHECK(of_filtered < share * of_points);
}

}  // namespace

TEST_CASE("a checkered floor has the mean of many samples, with less noise", "[law]") {
    check_floor(*test::scene_from(floor_of(R"({ "checker": [0.1, 0.9], "scale": [800, 800] })")), .5);
}

// Pictures are averaged across the ray alone: along it, where a pixel is many times longer, the samples do it.
TEST_CASE("so has a floor of pictures", "[law]") {
    test::TemporaryFolder const folder;
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < 3; ++c) bytes.push_back((x / 8 + y / 8) % 2 == 0 ? 30 : 250);
    write_png(folder.path() / "tiles.png", 16, 16, bytes);
    check_floor(*load_scene(folder.write(
                    "scene.json", floor_of(R"({ "image": "tiles.png", "space": "sRGB", "scale": [400, 400] })"))),
                .85);
}

TEST_CASE("cones are carried only where a texture is averaged, and the plan says what is skipped", "[unit]") {
    auto const used = [](RenderPlan const& plan, std::string const& name) {
        auto const found = std::ranges::find(plan.decisions, name, &RenderPlan::Decision::name);
        REQUIRE(found != plan.decisions.end());
        return found->used;
    };
    auto const plain = test::scene_from(floor_of("0.5"));
    RenderPlan const without = make_plan(*plain);
    CHECK(!without.ray_cones);
    for (char const* name : {"textures", "bumps", "alpha", "uv and tangents", "ray cones"}) CHECK(!used(without, name));
    auto const checkered = test::scene_from(floor_of(R"({ "checker": [0.1, 0.9] })"));
    RenderPlan const with = make_plan(*checkered);
    CHECK(with.ray_cones);
    CHECK((used(with, "textures") && used(with, "uv and tangents") && !used(with, "bumps") && !used(with, "alpha")));
    CHECK((!used(with, "transmission") && !used(with, "films")));
}
