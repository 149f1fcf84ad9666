// SPDX-License-Identifier: Apache-2.0
// Textures of a scene file: pictures, checkers and formulas, of reflectances, numbers and normals.
#include <fmt/format.h>

#include "scene/texture_readers.h"

namespace iride {

namespace {

// A number for both directions, or one for each.
Vector2 read_pair(Fields& o, std::string const& key, Vector2 const& fallback) {
    JsonValue const* const value = o.find(key);
    if (!value) return fallback;
    if (double const* both = value->as<double>()) return Vector2::Constant(static_cast<float>(*both));
    auto const pair = o.numbers(key, 2);
    return pair ? Vector2(static_cast<float>((*pair)[0]), static_cast<float>((*pair)[1])) : fallback;
}

TextureMapping read_mapping(Fields& o) {
    TextureMapping m;
    m.scale = read_pair(o, "scale", {1, 1});
    if (m.scale.x() == 0 || m.scale.y() == 0) {
        o.error_at("scale", "found 0, but a picture is repeated some times, or fewer than once");
        m.scale = {1, 1};
    }
    m.offset = read_pair(o, "offset", {0, 0});
    auto const wrap = o.choice("wrap", {"repeat", "clamp", "mirror"}).value_or("repeat");
    m.wrap = wrap == "clamp" ? Wrap::clamp : wrap == "mirror" ? Wrap::mirror : Wrap::repeat;
    auto const filter = o.choice("filter", {"trilinear", "bilinear", "nearest"}).value_or("trilinear");
    m.filter = filter == "bilinear"  ? TextureFilter::bilinear
               : filter == "nearest" ? TextureFilter::nearest
                                     : TextureFilter::trilinear;
    return m;
}

// The picture's file, after the checks of its role and space that need no look into it.
std::optional<std::filesystem::path> read_picture_name(SceneBuilder& b, Fields& o, std::string const& role) {
    auto const name = o.text("image");
    o.choice("role", {role});
    if (role != "reflectance" && o.find("space"))
        o.error_at("space", fmt::format("a {} map holds numbers as they are stored: it has no colour space", role));
    if (!name) return std::nullopt;
    std::filesystem::path const path = b.context.folder / *name;
    b.context.files_read.push_back(path);
    return path;
}

std::optional<ScalarMap> read_scalar_object(SceneBuilder& b, Fields& o, ScalarRole const& role);

std::optional<ScalarMap> read_scalar_value(SceneBuilder& b, JsonValue const& value, std::string const& path,
                                           ScalarRole const& role) {
    if (double const* x = value.as<double>()) {
        if (role.limits.hold(*x)) return ScalarMap(static_cast<float>(*x));
        b.context.error(value, path, fmt::format("found {}, allowed: {}", *x, role.limits.text()));
        return std::nullopt;
    }
    if (!value.as<JsonObject>()) {
        b.context.error(value, path,
                        fmt::format("found {}, but a {} is a number or a texture", value.described(), role.name));
        return std::nullopt;
    }
    Fields o(b.context, value, path);
    auto map = read_scalar_object(b, o, role);
    o.finish();
    return map;
}

// One of "image", "checker", "waves"; the caller finishes, and may have keys of its own.
std::optional<ScalarMap> read_scalar_object(SceneBuilder& b, Fields& o, ScalarRole const& role) {
    std::optional<ScalarMap> map;
    std::size_t const before = b.context.diagnostics.size();
    auto const range = [&](char const* key) {
        auto const pair = o.numbers(key, 2).value_or(std::vector<double>{0, 1});
        return Vector2(static_cast<float>(pair[0]), static_cast<float>(pair[1]));
    };
    if (JsonValue const* const image = o.find("image")) {
        auto const path = read_picture_name(b, o, role.name);
        TextureMapping const mapping = read_mapping(o);
        Vector2 const ends = range("range");
        std::vector<std::string> const channels{"red", "green", "blue", "alpha"};
        auto const channel = o.choice("channel", channels);
        if (!path || b.context.diagnostics.size() > before) return std::nullopt;
        b.context.guarded(*image, o.path("image"), [&] {
            auto const number = channel ? std::ranges::find(channels, *channel) - channels.begin() + 1 : 0;
            auto const picture = b.textures.scalar(*path, static_cast<PictureChannel>(number));
            map.emplace(std::make_shared<PictureScalar>(
                            std::shared_ptr<PictureScalar::Pyramid const>(picture, &picture->pyramid), mapping,
                            picture->extent),
                        ends.x(), ends.y());
        });
    } else if (o.find("checker")) {
        Vector2 const ends = range("checker");
        map.emplace(std::make_shared<Checker>(read_pair(o, "scale", {8, 8})), ends.x(), ends.y());
    } else if (o.find("waves")) {
        Vector2 const periods = read_pair(o, "waves", {1, 1});
        Vector2 const ends = range("range");
        map.emplace(std::make_shared<Waves>(periods), ends.x(), ends.y());
    } else {
        o.error(fmt::format("a {} map has one of: image, checker, waves", role.name));
    }
    if (!map || b.context.diagnostics.size() > before) return std::nullopt;
    auto const [least, most] = map->range();
    if (!role.limits.hold(static_cast<double>(least)) || !role.limits.hold(static_cast<double>(most))) {
        o.error(fmt::format("the {} goes from {:g} to {:g}, allowed: {}", role.name, least, most, role.limits.text()));
        return std::nullopt;
    }
    return map;
}

std::optional<ReflectanceMap> read_reflectance_value(SceneBuilder& b, JsonValue const& value, std::string const& path);

// Two reflectances of an array.
std::optional<std::pair<ReflectanceMap, ReflectanceMap>> read_two(SceneBuilder& b, Fields& o, std::string const& key) {
    JsonValue const* const value = o.require(key);
    if (!value) return std::nullopt;
    JsonArray const* const array = value->as<JsonArray>();
    if (!array || array->size() != 2) {
        o.error_at(key, "found " + value->described() + ", but an array of two reflectances is wanted");
        return std::nullopt;
    }
    auto const first = read_reflectance_value(b, (*array)[0], o.path(key) + "[0]");
    auto const second = read_reflectance_value(b, (*array)[1], o.path(key) + "[1]");
    return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

std::optional<ReflectanceMap> reflectance_picture(SceneBuilder& b, Fields& o) {
    std::size_t const before = b.context.diagnostics.size();
    auto const path = read_picture_name(b, o, "reflectance");
    std::vector<std::string> names;
    for (RgbEncoding const& e : rgb_encodings()) names.emplace_back(e.name);
    auto const space = o.choice("space", names);
    if (!o.find("space")) o.error("a picture of reflectances needs its 'space'" + suggestion("", names));
    TextureMapping const mapping = read_mapping(o);
    if (!path || !space || b.context.diagnostics.size() > before) return std::nullopt;
    std::optional<ReflectanceMap> map;
    b.context.guarded(*o.find("image"), o.path("image"), [&] {
        auto const picture = b.textures.reflectance(*path, rgb_encoding(*space));
        if (picture->unreachable > 0)
            b.context.remark(o.path("image"),
                             fmt::format("{} of {} texels of '{}' have a colour that no smooth reflectance has: the "
                                         "nearest found is used, CIE 1976 difference up to {:.3g}",
                                         picture->unreachable, picture->texels, path->filename().string(),
                                         picture->worst_difference));
        map.emplace(std::make_shared<PictureReflectance>(
            std::shared_ptr<PictureReflectance::Pyramid const>(picture, &picture->pyramid), mapping));
    });
    return map;
}

std::optional<ReflectanceMap> reflectance_texture(SceneBuilder& b, Fields& o) {
    if (o.find("image")) return reflectance_picture(b, o);
    if (o.find("checker")) {
        auto const both = read_two(b, o, "checker");
        auto const squares = std::make_shared<Checker>(read_pair(o, "scale", {8, 8}));
        if (!both) return std::nullopt;
        return ReflectanceMap(std::make_shared<MixedReflectance>(ScalarMap(squares), both->first, both->second));
    }
    auto const weight = read_scalar_map(b, o, "weights", {"weight", between(0, 1)});
    auto const both = read_two(b, o, "spectra");
    if (!weight || !both) return std::nullopt;
    return ReflectanceMap(std::make_shared<MixedReflectance>(*weight, both->first, both->second));
}

std::optional<ReflectanceMap> read_reflectance_value(SceneBuilder& b, JsonValue const& value, std::string const& path) {
    bool const textured = has_key(value, "image") || has_key(value, "checker") || has_key(value, "weights");
    if (!textured) {
        auto const spectrum = read_spectrum_value(b, value, path, reflectance_kind);
        return spectrum ? std::optional<ReflectanceMap>(Reflectance(*spectrum, b.scene.grid)) : std::nullopt;
    }
    Fields o(b.context, value, path);
    auto map = reflectance_texture(b, o);
    o.finish();
    return map;
}

std::shared_ptr<Relief const> read_bump(SceneBuilder& b, Fields& f) {
    JsonValue const& value = *f.find("bump");
    Fields o(b.context, value, f.path("bump"));
    std::size_t const before = b.context.diagnostics.size();
    double const height = o.required_number("height") * b.length_unit_m;
    if (o.find("checker")) o.error_at("checker", "a checker has no slope but at its edges; allowed: image, waves");
    auto const map = read_scalar_object(b, o, {"height", {}});
    o.finish();
    if (!map || b.context.diagnostics.size() > before) return nullptr;
    return std::make_shared<BumpMap>(*map, static_cast<float>(height));
}

std::shared_ptr<Relief const> read_normal_map(SceneBuilder& b, Fields& f) {
    JsonValue const& value = *f.find("normal_map");
    Fields o(b.context, value, f.path("normal_map"));
    o.require("image");
    std::size_t const before = b.context.diagnostics.size();
    auto const path = read_picture_name(b, o, "normal");
    TextureMapping const mapping = read_mapping(o);
    o.finish();
    if (!path || b.context.diagnostics.size() > before) return nullptr;
    std::shared_ptr<Relief const> relief;
    b.context.guarded(*o.find("image"), o.path("image"),
                      [&] { relief = std::make_shared<NormalMap>(b.textures.normals(*path), mapping); });
    return relief;
}

}  // namespace

std::optional<ReflectanceMap> read_reflectance_map(SceneBuilder& b, Fields& fields, std::string const& key) {
    JsonValue const* const value = fields.require(key);
    return value ? read_reflectance_value(b, *value, fields.path(key)) : std::nullopt;
}

std::optional<ScalarMap> read_scalar_map(SceneBuilder& b, Fields& fields, std::string const& key,
                                         ScalarRole const& role) {
    JsonValue const* const value = fields.find(key);
    return value ? read_scalar_value(b, *value, fields.path(key), role) : std::nullopt;
}

SurfaceDetail read_surface_detail(SceneBuilder& b, Fields& f) {
    SurfaceDetail detail;
    bool const bump = f.find("bump"), normal_map = f.find("normal_map");
    if (bump && normal_map)
        f.error("a material has 'bump' or 'normal_map', not both");
    else if (bump)
        detail.relief = read_bump(b, f);
    else if (normal_map)
        detail.relief = read_normal_map(b, f);
    detail.alpha = read_scalar_map(b, f, "alpha", {"alpha", between(0, 1)});
    return detail;
}

}  // namespace iride
