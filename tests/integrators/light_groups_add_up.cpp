// SPDX-License-Identifier: Apache-2.0
// Light groups: they add up to the picture pixel by pixel, and each is the picture of its lamps alone.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <map>

#include "integrators/layers.h"
#include "support/agreement.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

struct Lamp {
    std::string group;          // empty: none
    std::string before, after;  // the light's text around its group
    bool is_light;

    std::string text() const {
        std::string const key = group.empty() ? "" : fmt::format(R"(, "group": "{}")", group);
        return before + key + after;
    }
};

// A rectangle and a sphere of two groups, a point of the first, a sky in none.
std::vector<Lamp> const lamps{
    {"key",
     R"({ "type": "quad", "corners": [[-1.2,2.5,-1],[1,2.5,-1],[1,2.5,1.2],[-1.2,2.5,1.2]], "material": { "type": "black" }, "emission": { "radiance": { "data": "D65", "luminance_weighted": 3 })",
     "} }", false},
    {"fill_2",
     R"({ "type": "sphere", "centre": [1.5,1.6,0.5], "radius": 0.8, "material": { "type": "diffuse", "reflectance": 0.3 }, "emission": { "radiance": 2)",
     "} }", false},
    {"key", R"({ "type": "point", "position": [-1,2,-2], "intensity": 3)", "}", true},
    {"", R"({ "type": "environment", "radiance": 0.3)", "}", true}};

// The scene with the lamps of one group alone: the others stand there dark.
std::string scene_of(std::optional<std::string> const& alone, std::string const& material, std::string const& medium) {
    std::string shapes, lights;
    for (Lamp const& lamp : lamps) {
        bool const lit = !alone || *alone == lamp.group;
        if (lamp.is_light && lit) lights += (lights.empty() ? "" : ", ") + lamp.text();
        if (lamp.is_light) continue;
        std::string text = lamp.text();
        if (!lit) text = text.substr(0, text.find(", \"emission\"")) + " }";
        shapes += ", " + text;
    }
    return test::scene_text(test::view, fmt::format(R"({} "lights": [{}], "shapes": [{}, {}{}])", medium, lights,
                                                    test::floor_quad, test::sphere(material), shapes));
}

std::map<std::string, std::vector<float>> layers_of(Scene const& scene, std::string const& integrator,
                                                    RenderSettings const& settings, Film const& film) {
    ExrSettings of;
    of.colourspace = "XYZ";
    std::map<std::string, std::vector<float>> channels;
    for (auto& [name, value] :
         make_layers({"groups"}, scene, make_plan(scene), integrator, settings, film, of).channels)
        channels[name] = std::move(value);
    return channels;
}

}  // namespace

// Sums do not see a term that is put under the wrong lamp; the second check does. Fails for light of the sky, or light
// sampled directly, that goes to the first lamp's group.
TEST_CASE("light groups add up to the picture, and each is the picture of its lamps alone", "[law]") {
    std::string const
        glass = R"({ "type": "dielectric", "ior": { "pairs": [[300, 2.0], [900, 1.4]] } })",
        gold = R"({ "type": "conductor", "ior": "Au", "roughness": 0.3 })",
        wine = R"({ "type": "dielectric", "ior": 1.4, "absorption_per_m": 0.4, "priority": 1 })",
        haze = R"("medium": { "scattering_per_m": { "pairs": [[360, 0.5], [830, 0.02]] }, "absorption_per_m": 0.05 },)";
    struct Case {
        char const* integrator;
        std::string material, medium;
    };
    for (Case const& c : {Case{"path", gold, ""}, Case{"path", glass, ""}, Case{"path", wine, ""},
                          Case{"path", gold, haze}, Case{"reference_path", glass, haze}}) {
        auto const scene = test::scene_from(scene_of({}, c.material, c.medium));
        RenderSettings const settings{.spp = 2000, .seed = 7, .sampler = SamplerKind::independent};
        Film const film = test::rendered(*scene, c.integrator, settings);
        auto layers = layers_of(*scene, c.integrator, settings, film);
        INFO(c.integrator << " " << c.material << c.medium);
        REQUIRE(layers.size() == 9);
        double worst = 0;
        for (int i = 0; i < 144; ++i) {
            auto const pixel = static_cast<std::size_t>(i);
            double sum = 0;
            for (char const* group : {"key", "fill_2", "ungrouped"})
                sum += static_cast<double>(layers.at(fmt::format("group.{}.Y", group))[pixel]);
            double const whole = film.mean(i % 12, i / 12).Y;
            worst = std::max(worst, std::abs(sum - whole) / (whole + 1e-3));
        }
        CHECK(worst < 1e-5);  // floats, of which a pixel sums thousands in double
        for (std::string const group : {"key", "fill_2", ""}) {
            if (group.empty() && !c.medium.empty()) continue;  // haze without end lets no sky through
            auto const alone = test::scene_from(scene_of(group, c.material, c.medium));
            Film const of_lamps =
                test::rendered(*alone, "path", {.spp = 4000, .seed = 8, .sampler = SamplerKind::independent});
            auto const mean = test::picture_mean(of_lamps)[1];
            double share = 0;
            for (float y : layers.at(fmt::format("group.{}.Y", group.empty() ? "ungrouped" : group)))
                share += static_cast<double>(y) / 144;
            // The layer's own variance is at most that of the whole picture, at half as many samples.
            double const error = std::sqrt(mean.variance + test::picture_mean(film)[1].variance);
            INFO("group '" << group << "': " << share << " against " << mean.mean << " +- " << error);
            CHECK(std::abs(share - mean.mean) < 4 * error);
            CHECK(error < 0.1 * mean.mean);
        }
    }
}

TEST_CASE("a name of a shape is that of its Cryptomatte object, six faces of a box together", "[unit]") {
    auto const scene = test::scene_from(R"({
      "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 60 }, "film": { "size": [8, 8] },
      "shapes": [{ "type": "box", "name": "crate", "min": [-9,-9,1], "max": [9,9,2], "material": { "type": "diffuse", "reflectance": 0.5 } },
                 { "type": "sphere", "centre": [0,0,-99], "radius": 1, "material": { "type": "black" } }],
      "lights": [{ "type": "environment", "radiance": 1 }] })");
    RenderSettings const settings{.spp = 4};
    Film const film = test::rendered(*scene, "path", settings);
    ExtraLayers const layers = make_layers({"object"}, *scene, make_plan(*scene), "path", settings, film, {});
    std::string manifest;
    for (auto const& [key, value] : layers.attributes)
        if (key.ends_with("/manifest")) manifest = value;
    CHECK_THAT(manifest, Contains("\"crate\":") && Contains("\"shapes.6\":") && !Contains("\"shapes.0\""));
    for (auto const& [name, value] : layers.channels)
        if (name == "CryptoObject00.G")
            for (float coverage : value) CHECK(coverage == 1);
}

TEST_CASE("the plan says which layers are computed, and that an image without computes none", "[unit]") {
    auto const decision = [](std::string const& film) {
        auto const scene =
            test::scene_from(test::scene_text(test::view, "\"shapes\": [" + test::floor_quad + "]", film));
        RenderPlan const plan = make_plan(*scene);
        auto const found = std::ranges::find(plan.decisions, "aovs", &RenderPlan::Decision::name);
        REQUIRE(found != plan.decisions.end());
        return *found;
    };
    CHECK(!decision("").used);
    CHECK_THAT(decision("").reason, Contains("nothing is computed beside the picture"));
    CHECK(decision(R"(, "aovs": ["depth", "normal"])").used);
    CHECK_THAT(decision(R"(, "aovs": ["depth", "normal"])").reason, Contains("depth, normal:"));
}

TEST_CASE("layers that a scene cannot give, and groups that are no names, are refused with their place", "[input]") {
    auto const text = [](std::string const& film, std::string const& light) {
        return "{ \"camera\": { \"eye\": [0,0,-9], \"target\": [0,0,0], \"field_deg\": 30 }, \"shapes\": [" +
               test::floor_quad + "],\n\"film\": { " + film +
               " },\n\"lights\": [ { \"type\": \"point\", \"position\": [0,2,0], \"intensity\": 3" + light + " } ] }";
    };
    auto const refusal = [&](std::string const& film, std::string const& light, char const* integrator = "path",
                             bool adaptive = false) -> std::string {
        try {
            auto const scene = test::scene_from(text(film, light));
            check_layers(scene->film.aovs, *scene, make_plan(*scene), integrator, adaptive);
        } catch (InputError const& e) {
            return e.what();
        }
        return "(accepted)";
    };
    std::string const grouped = R"(, "group": "key-1")", groups = R"("aovs": ["groups"])";
    CHECK(refusal(groups, grouped) == "(accepted)");
    CHECK(refusal(groups, grouped, "auto") == "(accepted)");  // which is path here
    CHECK_THAT(refusal(R"("aovs": ["dept", "depth", "grops"])", ""),
               Contains("scene.json:2:20: film.aovs[0]: unknown layer 'dept'; did you mean 'depth'?") &&
                   Contains("film.aovs[2]: unknown layer 'grops'; did you mean 'groups'?"));
    CHECK_THAT(refusal(R"("aovs": "depth")", ""),
               Contains("film.aovs: found") && Contains("but an array of names is wanted"));
    CHECK_THAT(refusal(R"("aovs": [1])", ""), Contains("film.aovs[0]: found the number 1, but a name is wanted"));
    CHECK_THAT(refusal(groups, ""), Contains("the layer 'groups' wants lights that have a 'group'"));
    CHECK_THAT(
        refusal(groups, grouped, "bidirectional"),
        Contains("the integrator 'bidirectional' cannot give the layer 'groups'; allowed: path, reference_path"));
    CHECK_THAT(refusal(groups, grouped, "path", true), Contains("'groups' is not to be had with --adaptive"));
    for (std::string const& bad : {std::string(), std::string("a b"), std::string("a.R"), std::string(65, 'x')})
        CHECK_THAT(refusal("", fmt::format(R"(, "group": "{}")", bad)),
                   Contains("scene.json:3:") && Contains("lights[0].group: found '" + bad + "', allowed: 1 .. 64"));
    CHECK_THAT(refusal("", R"(, "group": 3)"), Contains("lights[0].group"));
}
