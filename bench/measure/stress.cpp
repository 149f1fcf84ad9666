// SPDX-License-Identifier: Apache-2.0
// Numerical stability, measured on scenes whose picture is known in closed form:
//   a white body in a furnace of radiance 1 is not to be seen; a closed grey box that emits has L = Le / (1 - rho);
//   a closed box lets nothing in; radiance is linear in a lamp's.
// No sample may be rejected anywhere.
#include "bench/measure/stress.h"

#include <fmt/format.h>

#include <cmath>

#include "base/constants.h"
#include "base/warp.h"
#include "bench/measure/reference.h"
#include "bench/measure/scene_text.h"

namespace iride::bench {

namespace {

std::uint64_t rejected_in(Film const& film) {
    std::uint64_t sum = 0;
    for (std::uint64_t const r : film.rejected()) sum += r;
    return sum;
}

// Of Y, over the pixels: few samples of one pixel may all miss what is rare, and say that nothing varies.
double mean_variance(Film const& film) {
    double sum = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) sum += film.variance(x, y).Y;
    return sum / (film.width() * film.height());
}

class Stress {
  public:
    explicit Stress(int spp) : spp_(spp) {}

    Film render_text(std::string const& name, std::string const& text, std::string const& integrator = "path") {
        auto const scene = scene_from(text);
        return render_scene(name, *scene, integrator);
    }
    Film render_scene(std::string const& name, Scene const& scene, std::string const& integrator) {
        RenderPlan const plan = make_plan(scene);
        Film film = make_film(scene);
        RenderReport const report =
            render(scene, plan, *make_integrator(integrator, scene, plan), {.spp = spp_, .seed = 7}, film);
        samples_ = report.paths + rejected_in(film);
        add(name + ": rejected samples", static_cast<double>(rejected_in(film)), 0);
        return film;
    }

    // Passes if value <= limit.
    void add(std::string const& name, double value, double limit) {
        cases_.push_back({name, samples_, value, limit, value <= limit});
    }

    // Pixels whose Y is `expected` within 6 standard errors, their own or the picture's usual one if that is larger
    // (few samples may all miss what is rare); the mean of the picture within 4.
    void expect_everywhere(std::string const& name, Film const& film, double expected) {
        constexpr double rounding = 1e-4;  // of floats along a path, relative
        constexpr double outliers = 2e-3;  // of pixels: their errors are no normal ones at these counts
        double const n = film.width() * film.height();
        double const variance = mean_variance(film);
        double mean = 0, beyond = 0;
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) mean += film.mean(x, y).Y / n;
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x)
                beyond += std::abs(film.mean(x, y).Y - expected) >
                          6 * std::sqrt(std::max(variance, film.variance(x, y).Y)) + rounding * expected;
        add(name + ": the mean is off, in standard errors",
            std::max(0.0, std::abs(mean - expected) - rounding * expected) / std::sqrt(variance / n + 1e-30), 4);
        add(name + ": share of pixels that are off", beyond / n, outliers);
    }

    void expect_black(std::string const& name, Film const& film) {
        double lit = 0;
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) lit += film.mean(x, y).Y != 0;
        add(name + ": pixels that light leaks into", lit, 0);
    }

    std::vector<StressCase> const& cases() const { return cases_; }

  private:
    int spp_;
    std::uint64_t samples_ = 0;
    std::vector<StressCase> cases_;
};

std::string vector_text(VectorDouble const& v) { return fmt::format("[{:.17g},{:.17g},{:.17g}]", v.x(), v.y(), v.z()); }

std::string scene_text(VectorDouble const& eye, VectorDouble const& target, double field_deg, std::string const& rest) {
    return fmt::format(R"({{ "camera": {{ "eye": {}, "target": {}, "field_deg": {} }}, "film": {{ "size": [24, 24] }},
  "render": {{ "sampler": "independent" }}, {} }})",
                       vector_text(eye), vector_text(target), field_deg, rest);
}

constexpr char const* furnace = R"("lights": [ { "type": "environment", "radiance": 1 } ])";
constexpr char const* white = R"({ "type": "diffuse", "reflectance": 1 })";

std::string sphere(VectorDouble const& centre, double radius, std::string const& material) {
    return fmt::format(R"({{ "type": "sphere", "centre": {}, "radius": {:.9g}, "material": {} }})", vector_text(centre),
                       radius, material);
}

// A closed box with a ball in it: the walls reflect 1/2 and emit 1, the ball is white, so L is 2 everywhere.
std::string glowing_box(double size, VectorDouble const& at) {
    auto const place = [&](double x, double y, double z) { return VectorDouble(at + size * VectorDouble(x, y, z)); };
    return scene_text(
        place(.5, .5, .02), place(.5, .5, 1), 90,
        fmt::format(
            R"("shapes": [ {{ "type": "box", "flip": true, "min": {}, "max": {}, "material": {{ "type": "diffuse", "reflectance": 0.5 }}, "emission": {{ "radiance": 1 }} }}, {} ])",
            vector_text(place(0, 0, 0)), vector_text(place(1, 1, 1)), sphere(place(.6, .4, .6), .2 * size, white)));
}

// A dark box in bright surroundings.
std::string closed_box(double size, VectorDouble const& at) {
    auto const place = [&](double x, double y, double z) { return VectorDouble(at + size * VectorDouble(x, y, z)); };
    return scene_text(place(.5, .5, .02), place(.5, .5, 1), 120,
                      fmt::format(R"("shapes": [ {{ "type": "box", "min": {}, "max": {}, "material": {} }} ], {})",
                                  vector_text(place(0, 0, 0)), vector_text(place(1, 1, 1)),
                                  R"({ "type": "diffuse", "reflectance": 0.9 })", furnace));
}

void scales_and_distances(Stress& s) {
    for (int power = -6; power <= 6; power += 3) {
        double const size = std::pow(10, power);
        std::string const name = fmt::format("1e{} m", power);
        s.expect_everywhere("glowing box of " + name, s.render_text(name, glowing_box(size, {0, 0, 0})), 2);
        s.expect_black("closed box of " + name, s.render_text(name, closed_box(size, {0, 0, 0})));
    }
    for (double const away : {1e2, 1e4, 1e8}) {
        VectorDouble const at(away, -away, 0.7 * away);
        std::string const name = fmt::format("{:g} sizes away", away);
        s.expect_everywhere("glowing box " + name, s.render_text(name, glowing_box(1, at)), 2);
        s.expect_black("closed box " + name, s.render_text(name, closed_box(1, at)));
    }
}

// White bodies that touch, coincide, hold one another, or hardly are.
void difficult_geometry(Stress& s) {
    std::string const two = sphere({-.5, 0, 0}, .5, white) + "," + sphere({.5, 0, 0}, .5, white);
    std::string const coincident = sphere({0, 0, 0}, .7, white) + "," + sphere({0, 0, 0}, .7, white) + "," +
                                   sphere({0, 0, 0}, .35, white) + "," +
                                   sphere({0, 0, 0}, std::nextafter(.7, 1), white);
    auto const mesh = [](std::string const& vertices, std::string const& triangles) {
        return fmt::format(R"({{ "type": "mesh", "vertices": [{}], "triangles": [{}], "material": {} }})", vertices,
                           triangles, white);
    };
    std::string const slivers =
        mesh("[-1,-0.5,0],[1,-0.5,0],[1,-0.4999999,0],[-1,0,0],[1,0,0.0000001],[1,0.0001,0]", "[0,1,2],[3,4,5]") + "," +
        sphere({0, .3, 0}, .3, white);
    std::string const no_area =
        mesh("[0,0,0],[1,1,0],[2,2,0],[0,0,0],[-1,-1,0],[1,-1,0],[0,1,0]", "[0,1,2],[0,0,1],[3,3,3],[4,5,6]");
    std::string const huge = mesh("[-1e6,-1,-1e6],[0,-1,1e6],[1e6,-1,-1e6]", "[0,1,2]");
    for (auto const& [name, shapes] :
         {std::pair("touching spheres", two),
          {"coincident and nested spheres", coincident},
          {"slivers", slivers},
          {"triangles without area", no_area},
          {"a triangle of 1e6 m below a sphere of 1 m", huge + "," + sphere({0, 0, 0}, 1, white)}})
        s.expect_everywhere(name,
                            s.render_text(name, scene_text({0, .3, -4}, {0, 0, 0}, 35,
                                                           fmt::format(R"("shapes": [ {} ], {})", shapes, furnace))),
                            1);
}

// In a furnace nothing gives back more than 1, and a lossless body exactly that.
void optical_constants(Stress& s) {
    auto const ball = [&](std::string const& material) {
        return scene_text({0, 0, -4}, {0, 0, 0}, 30,
                          fmt::format(R"("shapes": [ {} ], {})", sphere({0, 0, 0}, 1, material), furnace));
    };
    for (char const* roughness : {"", R"(, "roughness": 0.001)", R"(, "roughness": 0.3)", R"(, "roughness": 1)"}) {
        for (auto const& [n, k] : {std::pair(.01, 0.), {.01, 100.}, {1., 0.}, {1.5, .001}, {10., 0.}, {10., 100.}}) {
            std::string const name = fmt::format("a metal of n = {:g}, k = {:g}{}", n, k, roughness);
            Film const film = s.render_text(
                name,
                ball(fmt::format(R"({{ "type": "conductor", "ior": {{ "n": {}, "k": {} }}{} }})", n, k, roughness)));
            double most = 0;
            double const usual = mean_variance(film);
            for (int y = 0; y < film.height(); ++y)
                for (int x = 0; x < film.width(); ++x)
                    most = std::max(most, film.mean(x, y).Y - 6 * std::sqrt(std::max(usual, film.variance(x, y).Y)));
            s.add(name + ": brighter than its furnace", most, 1 + 1e-4);
        }
        for (double const n : {1.0001, 1.5, 4.0}) {
            std::string const name = fmt::format("glass of n = {:g}{}", n, roughness);
            s.expect_everywhere(
                name,
                s.render_text(name, ball(fmt::format(R"({{ "type": "dielectric", "ior": {}{} }})", n, roughness))), 1);
        }
    }
}

// A white floor seen at 89.9999 degrees, in a furnace.
void grazing(Stress& s) {
    double const height = 1000 * std::tan(1e-4 * pi_double / 180);
    s.expect_everywhere(
        "a floor seen at 89.9999 degrees",
        s.render_text(
            "a floor seen at 89.9999 degrees",
            scene_text(
                {0, height, -1000}, {0, 0, 0}, 1,
                fmt::format(
                    R"("shapes": [ {{ "type": "quad", "corners": [[-1e3,0,-1e3],[-1e3,0,1e3],[1e3,0,1e3],[1e3,0,-1e3]], "material": {} }} ], {})",
                    white, furnace))),
        1);
}

// A floor under a small lamp whose intensity is the same whatever its size and its radiance.
void lamps(Stress& s) {
    auto const floor_under = [](double size, double intensity) {
        return scene_text(
            {0, 2, -4}, {0, 0, 0}, 30,
            fmt::format(
                R"("shapes": [ {{ "type": "quad", "corners": [[-9,0,-9],[-9,0,9],[9,0,9],[9,0,-9]], "material": {} }},
 {{ "type": "quad", "corners": [[0,1,0],[{},1,0],[{},1,{}],[0,1,{}]], "material": {{ "type": "black" }}, "emission": {{ "radiance": {:.9g} }} }} ])",
                white, size, size, size, size, intensity / (size * size)));
    };
    auto const total = [](Film const& film) {
        double sum = 0;
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) sum += film.mean(x, y).Y;
        return sum;
    };
    double const usual = total(s.render_text("a lamp", floor_under(1e-2, 1)));
    for (double const intensity : {1e-8, 1e-4, 1e4, 1e8}) {
        std::string const name = fmt::format("a lamp {:g} times as bright", intensity);
        s.add(name + ": relative error",
              std::abs(total(s.render_text(name, floor_under(1e-2, intensity))) / (usual * intensity) - 1), 1e-5);
    }
    for (double const size : {1e-3, 1e-4, 1e-6}) {
        std::string const name = fmt::format("a lamp of {:g} m", size);
        // A lamp of 1 cm at 1 m is a point within some 1e-2 of the place, wavelengths add noise.
        s.add(name + ": relative error", std::abs(total(s.render_text(name, floor_under(size, 1))) / usual - 1), 0.03);
    }
}

void one_wavelength(Stress& s) {
    std::string const text = scene_text(
        {0, 0, -4}, {0, 0, 0}, 30,
        fmt::format(R"("wavelengths_nm": [550, 550.001], "shapes": [ {} ], {})", sphere({0, 0, 0}, 1, white), furnace));
    Film const film = s.render_text("one wavelength", text);
    double all = 0;  // of ybar, by the trapezoidal rule, as the table ends near 0
    for (double nm = visible_range.min_nm; nm <= visible_range.max_nm; ++nm) all += cie1931_2deg().at(nm).Y;
    double const expected = cie1931_2deg().at(550).Y * 0.001 / all;
    s.expect_everywhere("one wavelength", film, expected);
}

void shipped(Stress& s) {
    for (std::string const& name : all_scenes())
        for (char const* integrator : {"path", "reference_path"}) {
            auto const scene = load_scene(find_scene(name));
            scene->film.width = 48;
            scene->film.height = 36;
            s.render_scene(name + " by " + integrator, *scene, integrator);
        }
}

// A closed cube of reflectance .999 that emits 1: radiosity 1000 everywhere, from a system of condition 1e3.
void nearly_lossless_radiosity(Stress& s) {
    std::string const text = scene_text(
        {.5, .5, .02}, {.5, .5, 1}, 90,
        R"("shapes": [ { "type": "box", "flip": true, "min": [0,0,0], "max": [1,1,1], "material": { "type": "diffuse", "reflectance": 0.999 }, "emission": { "radiance": 1 } } ])");
    Film const film = s.render_text("radiosity at reflectance .999", text, "radiosity");
    double worst = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) worst = std::max(worst, std::abs(film.mean(x, y).Y / 1000 - 1));
    s.add("radiosity at reflectance .999: relative error", worst, 0.02);
}

// Distances to a sphere from rays all over, against double precision.
void single_against_double(Stress& s, int rays) {
    VectorDouble const centre(3, -2, 5);
    double const radius = 1.5;
    auto const scene = scene_from(scene_text(
        {0, 0, -4}, {0, 0, 0}, 30, fmt::format(R"("shapes": [ {} ], {})", sphere(centre, radius, white), furnace)));
    RayStatistics statistics;
    double worst = 0;
    for (int i = 0; i < rays; ++i) {
        Sampler sampler(SamplerKind::independent, 5, static_cast<std::uint32_t>(i), 0);
        Sample2 const a = sampler.next2(), b = sampler.next2();
        Vector const origin = (centre + 10 * to_sphere(a).cast<double>()).cast<float>();
        Direction const direction =
            (centre + radius * 0.9 * to_sphere(b).cast<double>() - origin.cast<double>()).normalized().cast<float>();
        auto const hit = scene->accelerator->closest({origin, direction}, statistics);
        VectorDouble const d = direction.cast<double>(), o = origin.cast<double>() - centre;
        double const along = o.dot(d) / d.squaredNorm(),
                     gap = square(along) - (o.squaredNorm() - square(radius)) / d.squaredNorm();
        double const exact = -along - std::sqrt(gap);
        worst = std::max(
            worst, hit ? std::abs(static_cast<double>(hit->distance) / exact - 1) : static_cast<double>(infinity));
    }
    s.add(fmt::format("{} rays to a sphere: relative error of the distance", rays), worst, 1e-5);
}

}  // namespace

std::vector<StressCase> stress(int spp) {
    Stress s(spp);
    scales_and_distances(s);
    difficult_geometry(s);
    optical_constants(s);
    grazing(s);
    lamps(s);
    one_wavelength(s);
    shipped(s);
    nearly_lossless_radiosity(s);
    single_against_double(s, 1000 * spp);
    return s.cases();
}

Rows run_stress(Settings const& settings) {
    constexpr int long_form_spp = 1024;
    settings.say("stress: a minute or more");
    Rows rows = Rows::array();
    for (StressCase const& c : stress(long_form_spp))
        rows.push_back(
            {{"case", c.name}, {"samples", c.samples}, {"value", c.value}, {"limit", c.limit}, {"ok", c.ok}});
    return rows;
}

}  // namespace iride::bench
