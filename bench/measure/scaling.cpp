// SPDX-License-Identifier: Apache-2.0
// How time grows: rays against bare Embree, start-up, threads, samples, pixels, triangles, lamps.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "bench/measure/benchmark.h"
#include "bench/measure/clock.h"
#include "bench/measure/rays.h"
#include "bench/measure/reference.h"
#include "bench/measure/scene_text.h"

namespace iride::bench {

namespace {

std::vector<std::string> const boxes_and_metals{"cornell", "cornell-gold", "metals"};

struct Rate {
    Spread paths_per_second;
    RenderReport last;
    double relative_error;
};

// Of several renders by `path`, in different seeds.
Rate rate_of(Scene const& scene, int spp, int threads, int rounds) {
    RenderPlan const plan = make_plan(scene);
    auto const integrator = make_integrator("path", scene, plan);
    std::vector<double> rates;
    Rate rate{};
    for (int round = 0; round < rounds; ++round) {
        Film film = make_film(scene);
        RenderSettings const r{.spp = spp, .seed = static_cast<std::uint64_t>(round), .threads = threads};
        rate.last = render(scene, plan, *integrator, r, film);
        rate.relative_error = film.relative_error();
        rates.push_back(static_cast<double>(rate.last.paths) / rate.last.seconds);
    }
    rate.paths_per_second = spread_of(rates);
    return rate;
}

int threads_of(Settings const& settings) {
    return settings.threads > 0 ? settings.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Resident memory of this process [bytes].
double resident_bytes() {
    std::ifstream in("/proc/self/status");
    for (std::string word; in >> word;)
        if (word == "VmRSS:") {
            double kilobytes = 0;
            in >> kilobytes;
            return kilobytes * 1024;
        }
    return 0;
}

// A ball with waves, its rows and columns of about equal cells: `count` triangles or a few less.
Mesh wavy_ball(double count) {
    int const rows = std::max(3, static_cast<int>(std::lround(std::sqrt(count / 4)))), columns = 2 * rows;
    Mesh mesh;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < columns; ++j) {
            double const theta = pi_double * i / rows, phi = 2 * pi_double * j / columns;
            double const r = 1 + 0.05 * std::sin(9 * theta) * std::cos(12 * phi);
            VectorDouble const p(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
            mesh.position.push_back((r * p).cast<float>());
        }
    auto const at = [&](int i, int j) { return static_cast<std::uint32_t>(i * columns + j % columns); };
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            mesh.triangle.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
            mesh.triangle.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
        }
    return mesh;
}

constexpr char const* ball_scene = R"({
  "camera": { "eye": [0, 0, -3], "target": [0, 0, 0], "field_deg": 40 },
  "shapes": [
    { "type": "sphere", "centre": [0, 0, 0], "radius": 1, "material": { "type": "diffuse", "reflectance": 0.5 } },
    { "type": "quad", "corners": [[-1,3,-3],[1,3,-3],[1,3,-1],[-1,3,-1]], "material": { "type": "black" }, "emission": { "radiance": 5 } } ],
  "lights": [ { "type": "environment", "radiance": 0.2 } ] })";

// `count` point lamps in a square above a floor.
std::string scene_of_lamps(int count) {
    std::string lights;
    int const side = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < count; ++i)
        lights +=
            fmt::format(R"({}{{ "type": "point", "position": [{:.6g}, 1, {:.6g}], "intensity": {:.6g} }})",
                        i ? "," : "", 8 * (i % side + 0.5) / side - 4, 8 * (i / side + 0.5) / side - 4, 10.0 / count);
    return fmt::format(R"({{
  "camera": {{ "eye": [0, 4, -8], "target": [0, 0, 0], "field_deg": 45 }},
  "shapes": [ {{ "type": "quad", "corners": [[-4,0,-4],[-4,0,4],[4,0,4],[4,0,-4]], "material": {{ "type": "diffuse", "reflectance": 0.5 }} }} ],
  "lights": [ {} ] }})",
                       lights);
}

nlohmann::ordered_json rate_row(nlohmann::ordered_json row, Rate const& r) {
    row["paths_per_second"] = r.paths_per_second.median;
    row["least"] = r.paths_per_second.least;
    row["most"] = r.paths_per_second.most;
    return row;
}

}  // namespace

Rows measure_rays(Settings const& settings) {
    constexpr int spp = 8;
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, boxes_and_metals)) {
        settings.say("rays: " + name);
        auto const scene = load_for_picture(name);
        RayRace const race(*scene, "path", spp);
        std::vector<double> ratio, rendered, bare, paths;
        for (int round = 0; round < settings.rounds; ++round) {
            RayRates const r = race.round();
            ratio.push_back(r.ratio());
            rendered.push_back(r.rendered);
            bare.push_back(r.bare);
            paths.push_back(r.paths_per_second);
        }
        Spread const s = spread_of(ratio);
        rows.push_back({{"scene", scene->name},
                        {"rays_per_second", spread_of(rendered).median},
                        {"bare_rays_per_second", spread_of(bare).median},
                        {"ratio", s.median},
                        {"least", s.least},
                        {"most", s.most},
                        {"paths_per_second", spread_of(paths).median}});
    }
    return rows;
}

Rows measure_start(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, all_scenes())) {
        std::vector<double> seconds;
        for (int round = 0; round < settings.rounds; ++round) {
            Clock::time_point const start = Clock::now();
            auto const scene = load_for_picture(name);
            RenderPlan const plan = make_plan(*scene);
            auto const integrator = make_integrator(scene->render.integrator, *scene, plan);
            PathStarter const starter(*scene, plan, picture_size, picture_size, scene->render.sampler, 0);
            seconds.push_back(seconds_since(start));
        }
        Spread const s = spread_of(seconds);
        rows.push_back({{"scene", name}, {"seconds", s.median}, {"least", s.least}, {"most", s.most}});
    }
    return rows;
}

Rows measure_threads(Settings const& settings) {
    constexpr int spp = 16;
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, boxes_and_metals)) {
        auto const scene = load_for_picture(name);
        double one = 0;
        for (int threads = 1; threads <= threads_of(settings); threads *= 2) {
            settings.say(fmt::format("threads: {}, {}", name, threads));
            Rate const r = rate_of(*scene, spp, threads, settings.rounds);
            if (threads == 1) one = r.paths_per_second.median;
            auto row = rate_row({{"scene", name}, {"threads", threads}}, r);
            row["against_one"] = r.paths_per_second.median / one;
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

Rows measure_spp(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, {"cornell"}))
        for (int spp : {1, 4, 16, 64}) {
            settings.say(fmt::format("spp: {}, {}", name, spp));
            rows.push_back(rate_row({{"scene", name}, {"spp", spp}},
                                    rate_of(*load_for_picture(name), spp, settings.threads, settings.rounds)));
        }
    return rows;
}

Rows measure_resolution(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, {"cornell"}))
        for (int size : {64, 256, 1024, 2048}) {
            settings.say(fmt::format("resolution: {}, {}", name, size));
            auto const scene = load_for_picture(name);
            scene->film.width = scene->film.height = size;
            rows.push_back(rate_row({{"scene", name}, {"width", size}, {"height", size}},
                                    rate_of(*scene, 4, settings.threads, settings.rounds)));
        }
    return rows;
}

Rows measure_triangles(Settings const& settings) {
    Rows rows = Rows::array();
    for (double const count : {1e3, 1e4, 1e5, 1e6, 1e7}) {
        settings.say(fmt::format("triangles: {:g}", count));
        auto const scene = scene_from(ball_scene);
        auto mesh = std::make_shared<Mesh const>(wavy_ball(count));
        auto const triangles = static_cast<double>(mesh->triangle.size());
        double const mesh_bytes = static_cast<double>(mesh->triangle.size() * sizeof(mesh->triangle[0]) +
                                                      mesh->position.size() * sizeof(mesh->position[0]));
        scene->shapes[0].geometry = MeshShape{std::move(mesh), false};
        double const before = resident_bytes();
        Clock::time_point const start = Clock::now();
        scene->accelerator = std::make_unique<Accelerator>(scene->shapes, scene->objects, scene->instances);
        double const build = seconds_since(start);
        double const tree_bytes = resident_bytes() - before;
        Rate const r = rate_of(*scene, 16, settings.threads, settings.rounds);
        auto row = rate_row({{"triangles", triangles}}, r);
        row["rays_per_second"] = static_cast<double>(r.last.rays.rays()) / r.last.seconds;
        row["build_seconds"] = build;
        row["mesh_bytes_per_triangle"] = mesh_bytes / triangles;
        row["embree_bytes_per_triangle"] = tree_bytes / triangles;
        rows.push_back(std::move(row));
    }
    return rows;
}

Rows measure_lamps(Settings const& settings) {
    Rows rows = Rows::array();
    for (int const count : {1, 10, 100, 1000, 10000, 100000}) {
        settings.say(fmt::format("lamps: {}", count));
        Clock::time_point const start = Clock::now();
        auto const scene = scene_from(scene_of_lamps(count));
        double const load = seconds_since(start);
        Rate const r = rate_of(*scene, 16, settings.threads, settings.rounds);
        auto row = rate_row({{"lamps", count}}, r);
        row["relative_error"] = r.relative_error;
        row["load_seconds"] = load;
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace iride::bench
