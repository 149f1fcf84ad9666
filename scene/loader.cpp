// SPDX-License-Identifier: Apache-2.0
// The scene file as a whole.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/random.h"
#include "colour/rgb_space.h"
#include "scene/bodies.h"
#include "scene/float_grid.h"
#include "scene/readers.h"

namespace iride {

namespace {

Chromaticity read_white(SceneBuilder& b, Fields& f) {
    Chromaticity white{0.3127, 0.3290};
    JsonValue const* const value = f.find("white");
    if (!value) return white;
    if (value->as<JsonArray>()) {
        auto const xy = f.numbers("white", 2);
        if (xy && !((*xy)[0] > 0 && (*xy)[1] > 0 && (*xy)[0] + (*xy)[1] < 1))
            f.error_at("white", "a chromaticity has x > 0, y > 0, x + y < 1");
        else if (xy)
            white = {(*xy)[0], (*xy)[1]};
    } else if (auto const name = f.text("white")) {
        b.context.guarded(*value, f.path("white"), [&] { white = named_white(*name); });
    }
    return white;
}

std::optional<WavelengthRange> read_range(Fields& f, std::string const& key) {
    auto const pair = f.numbers(key, 2);
    if (!pair) return std::nullopt;
    WavelengthRange const range{(*pair)[0], (*pair)[1]};
    if (range.min_nm >= 100 && range.max_nm <= 20000 && range.min_nm < range.max_nm) return range;
    f.error_at(key, "allowed: [from, to] in nanometres with 100 <= from < to <= 20000");
    return std::nullopt;
}

// Names alone: what layers there are, the integrators know.
std::vector<LayerRequest> read_aovs(SceneBuilder& b, Fields& f) {
    std::vector<LayerRequest> aovs;
    JsonValue const* const value = f.find("aovs");
    if (!value) return aovs;
    JsonArray const* const array = value->as<JsonArray>();
    if (!array) f.error_at("aovs", "found " + value->described() + ", but an array of names is wanted");
    for (std::size_t i = 0; array && i < array->size(); ++i) {
        JsonValue const& item = (*array)[i];
        std::string const path = fmt::format("{}[{}]", f.path("aovs"), i);
        if (std::string const* const name = item.as<std::string>())
            aovs.push_back({*name, {b.context.file.string(), item.line, item.column}, path});
        else
            b.context.error(item, path, "found " + item.described() + ", but a name is wanted");
    }
    return aovs;
}

void read_film(SceneBuilder& b, Fields& top) {
    JsonValue const* const value = top.find("film");
    if (!value) return;
    Fields f(b.context, *value, "film");
    FilmSettings& film = b.scene.film;
    if (auto const size = f.numbers("size", 2)) {
        constexpr double largest = 65536;
        bool good = true;
        for (double s : *size) good = good && s >= 1 && s <= largest && s == std::floor(s);
        if (good)
            film.width = static_cast<int>((*size)[0]), film.height = static_cast<int>((*size)[1]);
        else
            f.error_at("size",
                       fmt::format("found {} x {}, allowed: whole numbers 1 .. {}", (*size)[0], (*size)[1], largest));
    }
    auto const filter = f.choice("filter", {"box", "triangle", "gaussian"}).value_or("box");
    film.filter = filter == "triangle"   ? FilterKind::triangle
                  : filter == "gaussian" ? FilterKind::gaussian
                                         : FilterKind::box;
    double const usual = filter == "triangle" ? 1 : filter == "gaussian" ? 1.5 : 0.5;
    film.filter_radius =
        static_cast<float>(f.number("filter_radius", {.least = 0, .most = 16, .least_excluded = true}).value_or(usual));
    film.exposure = read_exposure(b, f);
    film.white = read_white(b, f);
    film.half = f.boolean("half").value_or(false);
    film.aovs = read_aovs(b, f);
    if (JsonValue const* const bands = f.find("bands")) {
        Fields g(b.context, *bands, "film.bands");
        g.require("count");
        film.band_count = g.integer("count", 1, 1000).value_or(1);
        film.band_range = read_range(g, "range_nm").value_or(b.scene.wavelengths);
        if (!b.scene.wavelengths.contains(film.band_range))
            g.error_at("range_nm", fmt::format("bands reach beyond wavelengths_nm, {:g}..{:g}",
                                               b.scene.wavelengths.min_nm, b.scene.wavelengths.max_nm));
        g.finish();
    }
    f.finish();
}

// A name, or an object with a name; the other keys are looked at by the integrator.
std::optional<IntegratorChoice> read_integrator(SceneBuilder& b, Fields& f) {
    JsonValue const* const value = f.find("integrator");
    if (!value) return std::nullopt;
    IntegratorChoice choice{{}, {JsonObject{}}, b.context.file, f.path("integrator"), value->line, value->column};
    if (JsonObject const* const object = value->as<JsonObject>()) {
        Fields g(b.context, *value, choice.key_path);
        g.require("name");
        choice.name = g.text("name").value_or(choice.name);
        JsonObject others = *object;
        std::erase_if(others, [](auto const& entry) { return entry.first == "name"; });
        choice.options = {std::move(others), value->line, value->column};
    } else {
        choice.name = f.text("integrator").value_or(choice.name);
    }
    return choice;
}

void read_render(SceneBuilder& b, Fields& top) {
    JsonValue const* const value = top.find("render");
    if (!value) return;
    Fields f(b.context, *value, "render");
    RenderDefaults& r = b.scene.render;
    r.integrator = read_integrator(b, f).value_or(r.integrator);
    r.spp = f.integer("spp", 1, 1 << 24).value_or(r.spp);
    if (auto const seed = f.number("seed", between(0, 0x1p53))) r.seed = static_cast<std::uint64_t>(*seed);
    std::vector<std::string> const samplers(sampler_names.begin(), sampler_names.end());
    if (auto const sampler = f.choice("sampler", samplers)) r.sampler = *sampler_of(*sampler);
    std::vector<std::string> const selections(light_selection_names.begin(), light_selection_names.end());
    if (auto const selection = f.choice("light_selection", selections))
        r.light_selection = static_cast<LightSelection>(std::ranges::find(selections, *selection) - selections.begin());
    r.max_bounces = f.integer("max_bounces", 0, 1 << 20);
    f.finish();
}

void read_materials(SceneBuilder& b, Fields& top) {
    JsonValue const* const value = top.find("materials");
    if (!value) return;
    JsonObject const* const object = value->as<JsonObject>();
    if (!object)
        return top.error_at("materials", "found " + value->described() + ", but an object of materials is wanted");
    for (auto const& [name, material] : *object) b.named_materials[name].value = &material;
    for (auto const& entry : *object) read_named_material(b, entry.first);
}

void read_objects(SceneBuilder& b, Fields& top) {
    std::map<std::string, int> by_name;
    if (JsonValue const* const value = top.find("objects")) {
        JsonObject const* const object = value->as<JsonObject>();
        if (!object)
            return top.error_at("objects", "found " + value->described() + ", but an object of shape lists is wanted");
        for (auto const& [name, shapes] : *object) {
            by_name[name] = static_cast<int>(b.scene.objects.size());
            read_shapes(b, shapes, "objects." + name, true, b.scene.objects.emplace_back().shapes);
        }
    }
    JsonValue const* const value = top.find("instances");
    if (!value) return;
    JsonArray const* const array = value->as<JsonArray>();
    if (!array) return top.error_at("instances", "found " + value->described() + ", but an array is wanted");
    std::vector<std::string> names;
    for (auto const& entry : by_name) names.push_back(entry.first);
    for (std::size_t i = 0; i < array->size(); ++i) {
        Fields f(b.context, (*array)[i], fmt::format("instances[{}]", i));
        f.require("object");
        auto const name = f.choice("object", names);
        Transform const transform = b.placed(read_transform(b, f, "transform"));
        if (name && by_name.contains(*name)) b.scene.instances.push_back({by_name[*name], transform});
        f.finish();
    }
}

// Hash of the bytes of every file the scene is made of, so that two pictures of one scene can be told to be that.
std::string hash_files(std::vector<std::filesystem::path> const& files) {
    std::uint64_t hash = 0;
    for (auto const& path : files) {
        std::ifstream in(path, std::ios::binary);
        std::vector<char> const bytes((std::istreambuf_iterator<char>(in)), {});
        for (char c : bytes) hash = mix_bits(hash * 31 + static_cast<unsigned char>(c));
        hash = hash_words(hash, bytes.size());
    }
    return fmt::format("{:016x}", hash);
}

// A medium that fills all space keeps out what comes from infinitely far.
void remark_on_infinity(SceneBuilder& b) {
    for (LightDescription const& light : b.scene.light_descriptions)
        if (light.type == "environment" || light.type == "distant")
            b.context.remark("medium", fmt::format("it has no end, and the '{}' light is infinitely far: none comes "
                                                   "through at wavelengths where the medium takes any; a body of "
                                                   "'ior' 1 has an end",
                                                   light.type));
}

void read_everything(SceneBuilder& b, JsonValue const& root) {
    Fields top(b.context, root, "");
    b.scene.description = top.text("description").value_or("");
    b.length_unit_m = top.number("length_unit_m", positive()).value_or(1);
    b.scene.wavelengths = read_range(top, "wavelengths_nm").value_or(visible_range);
    b.scene.grid = WavelengthGrid::covering(b.scene.wavelengths);
    read_camera(b, top);
    read_film(b, top);
    read_render(b, top);
    read_open_medium(b, top);
    read_materials(b, top);
    if (JsonValue const* const shapes = top.find("shapes")) read_shapes(b, *shapes, "shapes", false, b.scene.shapes);
    read_objects(b, top);
    if (JsonValue const* const lights = top.find("lights")) read_lights(b, *lights, "lights");
    if (b.scene.open_medium.attenuates()) remark_on_infinity(b);
    top.finish();
}

// What each shape's material asks of the intersector.
void ask_intersector(Scene& scene, std::vector<Shape>& shapes) {
    for (Shape& shape : shapes) {
        NamedMaterial const& m = scene.materials[static_cast<std::size_t>(shape.material)];
        shape.parametrised = m.looks_at_uv() || m.material->traits.anisotropic;
        shape.relief = m.relief.get();
        shape.alpha = m.alpha ? &*m.alpha : nullptr;
    }
}

// A file read, and what that took; places count from `origin` [m].
struct Reading {
    Reading(std::filesystem::path const& path, JsonValue const& root, VectorDouble const& origin)
        : context{path, path.parent_path(), {}, {}, {path}},
          builder{.context = context, .scene = *scene, .origin = origin} {
        scene->name = path.stem().string();
        scene->origin = origin;
        read_everything(builder, root);
    }

    std::unique_ptr<Scene> scene = std::make_unique<Scene>();
    ReadContext context;
    SceneBuilder builder;
};

// Floats are finest near 0: what lies several times its size away from there counts from its centre.
std::optional<VectorDouble> finer_origin(Eigen::AlignedBox3d const& extent) {
    constexpr double sizes_away = 4;
    if (extent.isEmpty() || !(extent.center().norm() > sizes_away * extent.diagonal().norm())) return std::nullopt;
    return extent.center();
}

std::filesystem::path scene_folder() { return data_folder() / "scenes"; }

}  // namespace

std::unique_ptr<Scene> load_scene(std::filesystem::path const& path) {
    JsonValue const root = read_json(path);
    auto reading = std::make_unique<Reading>(path, root, VectorDouble::Zero());
    if (auto const origin = finer_origin(reading->builder.extent))
        reading = std::make_unique<Reading>(path, root, *origin);
    auto& [scene, context, builder] = *reading;
    if (!context.diagnostics.empty()) throw InputError(std::move(context.diagnostics));
    for (Remark const& remark : context.remarks) scene->remarks.push_back(remark.text());
    scene->hash = hash_files(context.files_read);
    ask_intersector(*scene, scene->shapes);
    for (ObjectGeometry& object : scene->objects) ask_intersector(*scene, object.shapes);
    prepare_nested_bodies(*scene);
    scene->accelerator = std::make_unique<Accelerator>(scene->shapes, scene->objects, scene->instances);
    if (auto wrong = check_nesting(*scene, path.string(), scene->remarks); !wrong.empty())
        throw InputError(std::move(wrong));
    if (auto remark = remark_on_float_grid(*scene)) scene->remarks.push_back(std::move(*remark));
    scene->lights = LightSet(std::move(builder.lights), scene->radius());
    return std::move(scene);
}

std::vector<ShippedScene> shipped_scenes() {
    std::vector<ShippedScene> scenes;
    for (auto const& entry : std::filesystem::directory_iterator(scene_folder())) {
        if (entry.path().extension() != ".json") continue;
        JsonValue const root = read_json(entry.path());
        std::string description;
        if (JsonObject const* object = root.as<JsonObject>())
            for (auto const& [key, value] : *object)
                if (std::string const* s = value.as<std::string>(); s && key == "description") description = *s;
        scenes.push_back({entry.path().stem().string(), description});
    }
    std::ranges::sort(scenes, {}, &ShippedScene::name);
    return scenes;
}

std::filesystem::path find_scene(std::string const& file_or_name) {
    std::error_code ignored;
    if (std::filesystem::exists(file_or_name, ignored)) return file_or_name;
    if (file_or_name.find('/') == std::string::npos) {
        std::filesystem::path const shipped = scene_folder() / (file_or_name + ".json");
        if (std::filesystem::exists(shipped, ignored)) return shipped;
    }
    std::vector<std::string> names;
    for (ShippedScene const& s : shipped_scenes()) names.push_back(s.name);
    throw InputError(
        {}, "",
        fmt::format("'{}' is neither a file nor a shipped scene{}", file_or_name, suggestion(file_or_name, names)));
}

}  // namespace iride
