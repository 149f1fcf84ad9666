// SPDX-License-Identifier: Apache-2.0
// Choosing among lights is exact: the probability that is told is that of the choice, it sums to 1, and it is 0 only
// where a lamp brings nothing.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "scene/light_selection.h"
#include "support/scenes.h"
#include "support/statistics.h"

using namespace iride;

namespace {

Sampler numbers(std::uint32_t i) { return Sampler(SamplerKind::independent, 77, 0, i); }

VectorDouble in_cube(Sampler& s, double half) {
    Sample2 const a = s.next2();
    return half * VectorDouble(2 * a.x - 1, 2 * a.y - 1, 2 * s.next() - 1);
}

std::vector<LightBounds> random_bounds(int count) {
    std::vector<LightBounds> all;
    for (int i = 0; i < count; ++i) {
        Sampler s = numbers(static_cast<std::uint32_t>(i));
        VectorDouble const at = in_cube(s, 5), size = in_cube(s, 0.3).cwiseAbs();
        Sample2 const u = s.next2();
        all.push_back({at - size, at + size, to_sphere(s.next2()).cast<double>(), pi_double * u.x * u.x, pi_double / 2,
                       i % 7 == 0, std::pow(10.0, 4.0 * u.y - 2)});
    }
    return all;
}

LightReceiver random_receiver(std::uint32_t i) {
    Sampler s = numbers(1000000 + i);
    LightReceiver r{in_cube(s, 6).cast<float>(), to_sphere(s.next2())};
    if (i % 5 == 0) r.normal = Vector(0, 0, 0);
    return r;
}

// Lamps of every kind at random places, small and large.
std::string many_lamps(int of_each) {
    std::string shapes, lights;
    Sampler s = numbers(4711);
    auto const place = [&] {
        VectorDouble const p = in_cube(s, 4);
        return fmt::format("[{:.4f}, {:.4f}, {:.4f}]", p[0], p[1], p[2]);
    };
    auto const add = [](std::string& list, std::string const& item) { list += (list.empty() ? "" : ",\n") + item; };
    auto const emitting = [&](std::string const& geometry, bool two_sided, int profile) {
        add(shapes,
            fmt::format(
                R"({{ {}, "material": {{ "type": "black" }}, "emission": {{ "radiance": 2, "two_sided": {}{} }} }})",
                geometry, two_sided,
                profile == 0   ? ""
                : profile == 1 ? R"(, "profile": { "exponent": 4 })"
                               : R"(, "profile": { "cone_deg": 25 })"));
    };
    for (int i = 0; i < of_each; ++i) {
        emitting(fmt::format(R"("type": "sphere", "centre": {}, "radius": 0.2)", place()), false, i % 3);
        emitting(fmt::format(R"("type": "disc", "centre": {}, "normal": {}, "radius": 0.5)", place(), place()), i % 2,
                 i % 3);
        emitting(fmt::format(R"("type": "cylinder", "from": {}, "to": {}, "radius": 0.1)", place(), place()), false, 0);
        emitting(fmt::format(R"("type": "mesh", "vertices": [{}, {}, {}, {}], "triangles": [[0,1,2],[1,2,3]])", place(),
                             place(), place(), place()),
                 i % 2, i % 3);
        VectorDouble const c = in_cube(s, 4);
        emitting(fmt::format(R"("type": "quad", "corners": [[{0},{1},{2}],[{3},{1},{2}],[{3},{1},{4}],[{0},{1},{4}]])",
                             c[0], c[1], c[2], c[0] + 0.5, c[2] + 0.7),
                 i % 2, i % 3);
        add(lights,
            fmt::format(
                R"({{ "type": "spot", "position": {}, "target": {}, "cone_deg": {}, "full_deg": 5, "intensity": 3 }})",
                place(), place(), 10 + 30 * (i % 4)));
        add(lights, fmt::format(R"({{ "type": "point", "position": {}, "intensity": 1 }})", place()));
    }
    add(lights, R"({ "type": "environment", "radiance": 0.1 })");
    add(lights, R"({ "type": "distant", "direction": [0, -1, 0], "irradiance": 1 })");
    return fmt::format(
        R"({{ "camera": {{ "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }}, "shapes": [{}], "lights": [{}] }})",
        shapes, lights);
}

}  // namespace

// Fails when the number is not rescaled on the way, and when a trail starts at the wrong end.
TEST_CASE("lamps of a tree are chosen as often as their probability says", "[law]") {
    std::vector<LightBounds> const bounds = random_bounds(100);
    LightTree const tree(bounds);
    constexpr double level = 1e-3 / 20;
    for (std::uint32_t r = 0; r < 20; ++r) {
        LightReceiver const receiver = random_receiver(r);
        std::vector<double> count(bounds.size());
        double none = 0, sum = 0;
        constexpr int draws = 100000;
        for (std::uint32_t i = 0; i < draws; ++i) {
            auto const choice = tree.choose(receiver, numbers(i).next());
            if (choice.lamp < 0) {
                ++none;
                continue;
            }
            ++count[static_cast<std::size_t>(choice.lamp)];
            REQUIRE(choice.probability == tree.probability(receiver, choice.lamp));
        }
        test::ChiSquared verdict;
        for (std::size_t k = 0; k < bounds.size(); ++k) {
            double const p = static_cast<double>(tree.probability(receiver, static_cast<int>(k)));
            sum += p;
            verdict.add(draws * p, count[k]);
        }
        verdict.add(draws * std::max(0.0, 1 - sum), none);
        CHECK(sum < 1 + 1e-5);
        CHECK(verdict.p_value() > level);
    }
}

// Of lamps that emit all around, none can be behind its own horizon, and without a normal none behind the receiver's.
TEST_CASE("the probabilities of a tree of round lamps sum to 1", "[law]") {
    for (int count : {1, 2, 3, 17, 1000}) {
        std::vector<LightBounds> bounds = random_bounds(count);
        for (LightBounds& b : bounds) b.normals_rad = pi_double;
        LightTree const tree(bounds);
        for (std::uint32_t r = 0; r < 20; ++r) {
            LightReceiver const receiver{random_receiver(r).position, {0, 0, 0}};
            double sum = 0;
            for (int k = 0; k < count; ++k) sum += static_cast<double>(tree.probability(receiver, k));
            CHECK(std::abs(sum - 1) < 1e-5);
        }
    }
}

// Fails when the box's angle is left out of either cosine, and when a cone that unites others is the wider of them.
TEST_CASE("no lamp that lights a place has probability 0 there", "[law]") {
    auto const scene = test::scene_from(many_lamps(12));
    for (LightSelection how : {LightSelection::uniform, LightSelection::power, LightSelection::tree}) {
        LightSelector const selector(scene->lights, how);
        Wavelengths const w = WavelengthSampler(visible_range, SpectralFunction::constant(1), scene->grid).sample(0.5f);
        int lit = 0, never = 0;
        for (std::uint32_t r = 0; r < 1000; ++r) {
            LightReceiver const receiver = random_receiver(r);
            bool const either_side = receiver.normal == Vector(0, 0, 0);
            for (int k = 0; k < static_cast<int>(scene->lights.size()); ++k) {
                auto const sample = scene->lights.light(k).sample(receiver.position, w, numbers(r).next2());
                if (!sample || is_black(sample->radiance)) continue;
                if (!either_side && !(sample->wi.dot(receiver.normal) > 0)) continue;
                ++lit;
                never += selector.probability(receiver, k) > 0 ? 0 : 1;
            }
        }
        CHECK(never == 0);
        CHECK(lit > 10000);
    }
}

// With an environment and a distant light beside the tree.
TEST_CASE("lights of every kind are chosen as often as their probability says", "[law]") {
    auto const scene = test::scene_from(many_lamps(3));
    constexpr double level = 1e-3 / 15;
    for (LightSelection how : {LightSelection::uniform, LightSelection::power, LightSelection::tree}) {
        LightSelector const selector(scene->lights, how);
        for (std::uint32_t r = 0; r < 5; ++r) {
            LightReceiver const receiver = random_receiver(r);
            std::vector<double> count(scene->lights.size());
            double none = 0, sum = 0;
            constexpr int draws = 50000;
            for (std::uint32_t i = 0; i < draws; ++i) {
                auto const choice = selector.choose(receiver, numbers(i).next());
                if (choice.light < 0) {
                    ++none;
                    continue;
                }
                ++count[static_cast<std::size_t>(choice.light)];
                REQUIRE(choice.probability == selector.probability(receiver, choice.light));
            }
            test::ChiSquared verdict;
            for (std::size_t k = 0; k < count.size(); ++k) {
                double const p = static_cast<double>(selector.probability(receiver, static_cast<int>(k)));
                sum += p;
                verdict.add(draws * p, count[k]);
            }
            verdict.add(draws * std::max(0.0, 1 - sum), none);
            CHECK(verdict.p_value() > level);
        }
    }
}

// Lamps in a geometric row, all in one place, or all but one.
TEST_CASE("a tree is never deeper than 64", "[unit]") {
    std::vector<LightBounds> row, heap;
    for (int i = 0; i < 1000; ++i) {
        VectorDouble const at(std::pow(2.0, -i / 2.0), 0, 0), corner(1, 1, 1);
        row.push_back({at, at, {0, 0, 1}, pi_double, pi_double / 2, false, 1});
        heap.push_back({corner, corner, {0, 0, 1}, pi_double, pi_double / 2, false, 1});
    }
    CHECK(LightTree(row).depth() < 64);
    CHECK(LightTree(heap).depth() < 64);
    LightReceiver const at_corner{{1, 1, 1}, {0, 0, 0}};
    CHECK(LightTree(heap).choose(at_corner, 0.999999f).probability == Approx(1e-3).epsilon(0.1));
}

TEST_CASE("light that is the same from everywhere may be left to scattering, the lamps are asked as often as ever",
          "[law]") {
    std::string const ball =
        R"("shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": { "type": "black" } } ], )";
    auto const text = [&](std::string const& sky) {
        return R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }, )" + ball +
               R"("lights": [ { "type": "point", "position": [0,1,0], "intensity": 1 }, { "type": "point", "position": [2,1,0], "intensity": 3 })" +
               sky + "] }";
    };
    auto const with = test::scene_from(text(R"(, { "type": "environment", "radiance": 5 })")),
               without = test::scene_from(text(""));
    for (LightSelection how : {LightSelection::uniform, LightSelection::power, LightSelection::tree}) {
        LightSelector const selector(with->lights, how, UniformLight::left_to_scattering), lamps(without->lights, how);
        for (std::uint32_t i = 0; i < 100; ++i) {
            LightReceiver const r = random_receiver(i);
            float const u = numbers(i).next();
            CHECK(selector.choose(r, u).light == lamps.choose(r, u).light);
            CHECK(selector.probability(r, 2) == 0);
            for (int lamp : {0, 1}) CHECK(selector.probability(r, lamp) == Approx(lamps.probability(r, lamp)));
        }
        CHECK(LightSelector(with->lights, how).probability({}, 2) > 0);
    }
    auto const sky = test::scene_from(R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }, )" +
                                      ball + R"("lights": [ { "type": "environment", "radiance": 5 } ] })");
    CHECK(LightSelector(sky->lights, LightSelection::power, UniformLight::left_to_scattering).none());
    CHECK_FALSE(LightSelector(sky->lights, LightSelection::power).none());
}

TEST_CASE("one light is chosen for certain", "[unit]") {
    auto const scene = test::scene_from(
        R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 },
             "lights": [ { "type": "point", "position": [0,9,0], "intensity": 0 }, { "type": "point", "position": [0,9,0], "intensity": 5 } ] })");
    for (LightSelection how : {LightSelection::uniform, LightSelection::power, LightSelection::tree}) {
        auto const choice = LightSelector(scene->lights, how).choose({}, 0.3f);
        CHECK(choice.light == 1);
        CHECK(choice.probability == 1);
    }
}
