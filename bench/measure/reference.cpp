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
    std::array<XyzPicture, 2> const half{read_half(scene, seeds[0], settings), read_half(scene, seeds[1], settings)};
    Comparison const apart = compare(half[0], half[1]);
    XyzPicture mean = half[0];
    for (std::size_t i = 0; i < mean.xyz.pixel.size(); ++i)
        mean.xyz.pixel[i] = 0.5 * (half[0].xyz.pixel[i] + half[1].xyz.pixel[i]);
    return {std::move(mean), half, apart.relmse / 4, apart.delta_e_2000_mean / 2};
}

double Reference::relmse_of(XyzPicture const& p) const {
    double sum = 0;
    for (std::size_t i = 0; i < p.xyz.pixel.size(); ++i)
        for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z}) {
            auto const of = [&](XyzPicture const& q) { return q.xyz.pixel[i].*c; };
            sum += (of(p) - of(half[0])) * (of(p) - of(half[1])) / (square(of(picture)) + relmse_floor);
        }
    return sum / (3 * static_cast<double>(p.xyz.pixel.size()));
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
