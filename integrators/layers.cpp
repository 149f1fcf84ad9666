// SPDX-License-Identifier: Apache-2.0
#include "integrators/layers.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "base/diagnostics.h"
#include "colour/rgb_to_spectrum.h"
#include "film/cryptomatte.h"
#include "film/exr_layers.h"
#include "integrators/choice.h"
#include "integrators/scattering.h"

namespace iride {

namespace {

constexpr std::array<LayerEntry, 11> table{{
    {"depth", "distance of the nearest first hit along the camera's axis [m], infinite where there is none"},
    {"position", "that hit's place in the world [m]"},
    {"normal", "mean geometric (Ng) and shading (N) normal, towards the viewer"},
    {"albedo", "what the first surface reflects of light of the colour D65, in the file's colour space"},
    {"material", "Cryptomatte of materials"},
    {"object", "Cryptomatte of shapes"},
    {"direct", "light that was scattered at most once"},
    {"indirect", "the rest: direct + indirect is the picture"},
    {"groups", "light by the group of the lamp it came from: they add up to the picture"},
    {"count", "samples in the pixel's mean"},
    {"variance", "variance of X, Y and Z: in every file, asked for or not"},
}};

bool has(std::vector<std::string> const& names, char const* name) {
    return std::ranges::find(names, name) != names.end();
}

// The first hits of the picture's camera rays, pixel by pixel.
class FirstHits {
  public:
    FirstHits(Scene const& scene, RenderPlan const& plan, RenderSettings const& render, Film const& film)
        : scene_(scene),
          film_(film),
          first_sample_(render.first_sample),
          starter_(scene, plan, film.place().picture_width, film.place().picture_height, render.sampler, render.seed),
          day_(unit_d65(), scene.grid),
          axis_((scene.camera.target - scene.camera.eye).normalized().cast<float>()),
          eye_(scene.camera.eye.cast<float>()),
          depth(film.width(), film.height()),
          position(film.width(), film.height()),
          normal(film.width(), film.height()),
          geometric_normal(film.width(), film.height()),
          albedo(film.width(), film.height(), film.observer(), scene.grid),
          material("CryptoMaterial", material_names(scene), film.width(), film.height()),
          object("CryptoObject", object_names(scene), film.width(), film.height()),
          samples(film.width(), film.height()) {
        tbb::parallel_for(0, film.height(), [&](int y) {
            RayStatistics ignored;
            for (int x = 0; x < film.width(); ++x) find(x, y, ignored);
        });
    }

  private:
    static std::vector<std::string> material_names(Scene const& scene) {
        std::vector<std::string> names;
        for (NamedMaterial const& m : scene.materials) names.push_back(m.name.empty() ? m.key_path : m.name);
        return names;
    }
    // In the order of object_number().
    static std::vector<std::string> object_names(Scene const& scene) {
        std::vector<std::string> names;
        auto const add = [&](std::vector<Shape> const& shapes, std::string const& of) {
            for (std::size_t i = 0; i < shapes.size(); ++i)
                names.push_back(shapes[i].name.empty() ? fmt::format("{}.{}", of, i) : shapes[i].name);
        };
        add(scene.shapes, "shapes");
        for (std::size_t k = 0; k < scene.objects.size(); ++k)
            add(scene.objects[k].shapes, fmt::format("objects.{}", k));
        return names;
    }
    int object_number(Shape const* shape) const {
        auto const within = [&](std::vector<Shape> const& shapes) {
            return !shapes.empty() && !std::less<>{}(shape, shapes.data()) &&
                   std::less<>{}(shape, shapes.data() + shapes.size());
        };
        if (within(scene_.shapes)) return static_cast<int>(shape - scene_.shapes.data());
        std::size_t before = scene_.shapes.size();
        for (ObjectGeometry const& o : scene_.objects) {
            if (within(o.shapes)) return static_cast<int>(before) + static_cast<int>(shape - o.shapes.data());
            before += o.shapes.size();
        }
        return 0;
    }

    void find(int x, int y, RayStatistics& statistics) {
        std::uint32_t const count = first_hits(film_.pixel(x, y));
        samples.at(x, y) = count;
        depth.at(x, y) = infinity;
        position.at(x, y) = normal.at(x, y) = geometric_normal.at(x, y) = Vector(0, 0, 0);
        CameraPath path;
        for (std::uint32_t s = 0; s < count; ++s) {
            starter_.start(x + film_.place().x0, y + film_.place().y0, first_sample_ + s, path);
            std::optional<Hit> hit = scene_.accelerator->closest(path.ray, statistics);
            if (hit)
                use(x, y, *hit, path, 1 / static_cast<float>(count));
            else
                albedo.add(x, y, path.wavelengths, Radiance());
        }
    }

    void use(int x, int y, Hit& hit, CameraPath& path, float share) {
        Direction const to_viewer = -path.ray.direction;
        float const along = axis_.dot(hit.point.position - eye_);
        if (along < depth.at(x, y)) {
            depth.at(x, y) = along;
            position.at(x, y) = hit.point.position + scene_.origin.cast<float>();
        }
        float const side = to_viewer.dot(hit.point.geometric_normal) < 0 ? -share : share;
        normal.at(x, y) += side * hit.point.normal;
        geometric_normal.at(x, y) += side * hit.point.geometric_normal;
        material.add(x, y, hit.shape->material);
        object.add(x, y, object_number(hit.shape));
        // A sample's weight f |cos| / p has the albedo for its mean; over the lanes, as a path's.
        path.sampler.begin_vertex(0);
        Sample2 const choices = path.sampler.next2(), direction = path.sampler.next2(), chances = path.sampler.next2();
        describe_meeting(hit.point, to_viewer, chances.y);
        Interaction const here(scene_, hit, to_viewer, path.wavelengths);
        auto const sample = here.bsdf.sample(here.wo, {choices.y, direction});
        Throughput const weight = sample ? sample->weight * (1 / float(mean(sample->reach))) : Throughput();
        albedo.add(x, y, path.wavelengths, weight * day_.at(path.wavelengths));
    }

    Scene const& scene_;
    Film const& film_;
    std::uint32_t first_sample_;
    PathStarter starter_;
    Emission day_;
    Vector axis_, eye_;

  public:
    Image<float> depth;
    Image<Vector> position, normal, geometric_normal;
    Film albedo;
    Cryptomatte material, object;
    Image<std::uint32_t> samples;
};

void append(ExtraLayers& layers, std::string const& name, Image<Vector> const& image) {
    for (Eigen::Index c = 0; c < 3; ++c) {
        std::vector<float> plane;
        for (Vector const& v : image.pixel) plane.push_back(v[c]);
        layers.channels.emplace_back(fmt::format("{}.{}", name, "XYZ"[c]), std::move(plane));
    }
}

void append(ExtraLayers& layers, std::string const& name, Image<std::array<float, 3>> const& image, bool rgb) {
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> plane;
        for (auto const& v : image.pixel) plane.push_back(v[c]);
        layers.channels.emplace_back(fmt::format("{}.{}", name, (rgb ? "RGB" : "XYZ")[c]), std::move(plane));
    }
}

void append_first_hits(ExtraLayers& layers, std::vector<std::string> const& names, FirstHits const& hits,
                       ExrSettings const& settings) {
    if (has(names, "depth")) layers.channels.emplace_back("depth.Z", hits.depth.pixel);
    if (has(names, "position")) append(layers, "position", hits.position);
    if (has(names, "normal")) {
        append(layers, "N", hits.normal);
        append(layers, "Ng", hits.geometric_normal);
    }
    if (has(names, "albedo")) {
        OutputSpace const space = output_space(settings.colourspace, named_white("D65"));
        append(layers, "albedo", to_image(hits.albedo, space, 1), space.rgb != nullptr);
    }
    if (has(names, "material")) hits.material.append_to(layers, hits.samples);
    if (has(names, "object")) hits.object.append_to(layers, hits.samples);
}

// A film's paths again: the same random numbers, so each term is one of the picture's. Nothing interrupts it.
Film repeated(Film const& film, Scene const& scene, RenderPlan const& plan, std::string const& integrator,
              RenderSettings settings, LightGroupFilms* groups = nullptr) {
    Film again(film.width(), film.height(), film.place(), film.observer(), scene.grid, {});
    Image<std::uint32_t> taken(film.width(), film.height());
    std::ranges::transform(film.pixels(), taken.pixel.begin(), &FilmPixel::taken);
    settings.goals = &taken;
    settings.seconds.reset();
    settings.stop_at.reset();
    settings.interrupted = nullptr;
    settings.on_progress = {};
    settings.on_pass = {};
    settings.groups = groups;
    render(scene, plan, *make_integrator(integrator, scene, plan), settings, again);
    return again;
}

void append_direct(ExtraLayers& layers, std::vector<std::string> const& names, Scene const& scene, RenderPlan plan,
                   std::string const& integrator, RenderSettings const& render, Film const& film,
                   ExrSettings const& settings) {
    plan.max_bounces = std::min(1, plan.max_bounces.value_or(1));
    Film const direct = repeated(film, scene, plan, integrator, render);
    OutputSpace const space = output_space(settings.colourspace, settings.scene_white);
    Image<std::array<float, 3>> const once = to_image(direct, space, settings.exposure);
    Image<std::array<float, 3>> rest = to_image(film, space, settings.exposure);
    for (std::size_t i = 0; i < rest.pixel.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) rest.pixel[i][c] -= once.pixel[i][c];
    if (has(names, "direct")) append(layers, "direct", once, space.rgb != nullptr);
    if (has(names, "indirect")) append(layers, "indirect", rest, space.rgb != nullptr);
}

void append_groups(ExtraLayers& layers, Scene const& scene, RenderPlan const& plan, std::string const& integrator,
                   RenderSettings const& render, Film const& film, ExrSettings const& settings) {
    LightGroupFilms groups(light_groups(scene), film, scene.grid);
    repeated(film, scene, plan, integrator, render, &groups);
    OutputSpace const space = output_space(settings.colourspace, settings.scene_white);
    for (std::size_t g = 0; g < groups.count(); ++g)
        append(layers, "group." + groups.name(g), to_image(groups.film(g), space, settings.exposure),
               space.rgb != nullptr);
}

// What hinders a layer; empty if nothing does.
std::string obstacle(std::string const& name, Scene const& scene, std::string const& integrator, bool adaptive) {
    std::vector<std::string> known;
    for (LayerEntry const& e : table) known.emplace_back(e.name);
    if (std::ranges::find(known, name) == known.end())
        return fmt::format("unknown layer '{}'{}", name, suggestion(name, known));
    if (!is_made_of_paths(name)) return {};
    if (integrator != "path" && integrator != "reference_path")
        return fmt::format("the integrator '{}' cannot give the layer '{}'; allowed: path, reference_path", integrator,
                           name);
    if (adaptive) return fmt::format("the layer '{}' is not to be had with --adaptive", name);
    if (name == "groups" && !light_groups(scene).named)
        return "the layer 'groups' wants lights that have a 'group', and this scene has none";
    return {};
}

}  // namespace

std::span<LayerEntry const> layer_entries() { return table; }

bool is_made_of_paths(std::string const& layer) {
    return layer == "direct" || layer == "indirect" || layer == "groups";
}

std::vector<LayerRequest> parse_layers(std::string const& text) {
    std::vector<LayerRequest> requests;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t const comma = std::min(text.find(',', at), text.size());
        requests.push_back({text.substr(at, comma - at)});
        at = comma + 1;
    }
    return requests;
}

std::vector<std::string> check_layers(std::vector<LayerRequest> const& requests, Scene const& scene,
                                      RenderPlan const& plan, std::string const& integrator, bool adaptive) {
    std::string const meant = integrator == "auto" ? choose_integrator(scene, plan).name : integrator;
    std::vector<std::string> names;
    std::vector<Diagnostic> wrong;
    for (LayerRequest const& r : requests) {
        names.push_back(r.name);
        std::string message = obstacle(r.name, scene, meant, adaptive);
        if (!message.empty()) wrong.push_back({r.where, r.key_path, std::move(message)});
    }
    if (!wrong.empty()) throw InputError(std::move(wrong));
    return names;
}

ExtraLayers make_layers(std::vector<std::string> const& names, Scene const& scene, RenderPlan const& plan,
                        std::string const& integrator, RenderSettings const& render, Film const& film,
                        ExrSettings const& settings) {
    ExtraLayers layers;
    bool const first_hits = std::ranges::any_of(
        names, [](std::string const& n) { return !is_made_of_paths(n) && n != "count" && n != "variance"; });
    if (first_hits) append_first_hits(layers, names, FirstHits(scene, plan, render, film), settings);
    if (has(names, "direct") || has(names, "indirect"))
        append_direct(layers, names, scene, plan, integrator, render, film, settings);
    if (has(names, "groups")) append_groups(layers, scene, plan, integrator, render, film, settings);
    if (has(names, "count")) {
        std::vector<float> count;
        for (FilmPixel const& p : film.pixels()) count.push_back(static_cast<float>(p.count));
        layers.channels.emplace_back("count", std::move(count));
    }
    return layers;
}

}  // namespace iride
