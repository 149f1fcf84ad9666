// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/reference.h"

#include <fmt/format.h>

namespace iride::bench {

namespace {

constexpr int most_spp = 1 << 20;

void make_half(Scene const& scene, std::uint64_t seed, Settings const& settings, std::filesystem::path const& file) {
    RenderPlan const plan = make_plan(scene);
    Film film = make_film(scene);
    RenderSettings const r{
        .spp = most_spp, .seconds = settings.reference_seconds, .seed = seed, .threads = settings.threads};
    render(scene, plan, *make_integrator("path", scene, plan), r, film);
    write_exr(film,
              {.colourspace = "XYZ", .scene = scene.name, .scene_hash = scene.hash, .integrator = "path", .seed = seed},
              file);
}

XyzPicture read_half(Scene const& scene, std::uint64_t seed, Settings const& settings) {
    std::filesystem::create_directories(settings.references);
    std::filesystem::path const file =
        settings.references /
        fmt::format("{}-{}x{}-{}-{}.exr", scene.name, scene.film.width, scene.film.height, scene.hash, seed);
    if (!std::filesystem::exists(file)) {
        settings.say(
            fmt::format("{}: a reference is missing, {:g} s for half of it", scene.name, settings.reference_seconds));
        make_half(scene, seed, settings, file);
    }
    return read_exr_as_xyz(file);
}

}  // namespace

std::unique_ptr<Scene> load_for_picture(std::string const& name) {
    auto scene = load_scene(find_scene(name));
    scene->film.width = scene->film.height = picture_size;
    return scene;
}

Reference reference_of(Scene const& scene, Settings const& settings) {
    constexpr std::uint64_t seeds[2] = {1000001, 1000002};  // no other run has these
    XyzPicture a = read_half(scene, seeds[0], settings);
    XyzPicture const b = read_half(scene, seeds[1], settings);
    Comparison const apart = compare(a, b);
    for (std::size_t i = 0; i < a.xyz.pixel.size(); ++i) {
        Xyz& p = a.xyz.pixel[i];
        Xyz const& q = b.xyz.pixel[i];
        p = {(p.X + q.X) / 2, (p.Y + q.Y) / 2, (p.Z + q.Z) / 2};
    }
    return {std::move(a), apart.relmse / 4, apart.delta_e_2000_mean / 2};
}

XyzPicture picture_of(Film const& film) {
    XyzPicture picture;
    picture.xyz = Image<Xyz>(film.width(), film.height());
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) picture.xyz.at(x, y) = film.mean(x, y);
    return picture;
}

Rows make_references(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, all_scenes())) {
        auto const scene = load_for_picture(name);
        Reference const r = reference_of(*scene, settings);
        rows.push_back({{"scene", scene->name}, {"relmse", r.relmse}, {"delta_e_2000", r.delta_e_2000}});
    }
    return rows;
}

}  // namespace iride::bench
