// SPDX-License-Identifier: Apache-2.0
// Shapes of a scene file.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "scene/readers.h"

namespace iride {

namespace {

using Geometries = std::vector<ShapeGeometry>;

float metres(SceneBuilder const& b, double x) { return static_cast<float>(x * b.length_unit_m); }

void read_sphere(SceneBuilder& b, Fields& f, Geometries& out) {
    VectorDouble const centre = f.required_vector("centre");
    out.push_back(Sphere{b.placed(centre), metres(b, f.required_number("radius", positive()))});
}

void read_quad(SceneBuilder& b, Fields& f, Geometries& out) {
    JsonValue const* const value = f.require("corners");
    if (!value) return;
    JsonArray const* const array = value->as<JsonArray>();
    if (!array || array->size() != 4) {
        f.error_at("corners", "found " + value->described() + ", but an array of 4 points is wanted");
        return;
    }
    std::array<VectorDouble, 4> c;
    for (std::size_t i = 0; i < 4; ++i) {
        auto const p = read_vector(b.context, (*array)[i], fmt::format("{}[{}]", f.path("corners"), i));
        if (!p) return;
        c[i] = *p;
    }
    VectorDouble const normal = (c[2] - c[0]).cross(c[3] - c[1]);
    double const size = std::max((c[2] - c[0]).norm(), (c[3] - c[1]).norm());
    if (!(normal.norm() > 1e-12 * square(size))) return f.error_at("corners", "the quad has no area");
    if (std::abs((c[1] - c[0]).dot(normal.normalized())) > 1e-5 * size)
        return f.error_at("corners", "the four corners are not in one plane");
    out.push_back(Quad::through({b.placed(c[0]), b.placed(c[1]), b.placed(c[2]), b.placed(c[3])}));
}

void read_disc(SceneBuilder& b, Fields& f, Geometries& out) {
    VectorDouble const centre = f.required_vector("centre"), normal = f.required_vector("normal");
    float const radius = metres(b, f.required_number("radius", positive()));
    if (normal.norm() == 0) return f.error_at("normal", "the normal has length 0");
    out.push_back(Disc{b.placed(centre), normal.normalized().cast<float>(), radius});
}

void read_box(SceneBuilder& b, Fields& f, Geometries& out) {
    f.require("min");
    f.require("max");
    auto const low = f.vector("min"), high = f.vector("max");
    if (!low || !high) return;
    if (!((*high - *low).minCoeff() > 0)) return f.error("'max' must be above 'min' in every coordinate");
    // Corner i has bit k set where it takes max in coordinate k.
    auto const corner = [&](unsigned i) {
        return b.placed({i & 1 ? high->x() : low->x(), i & 2 ? high->y() : low->y(), i & 4 ? high->z() : low->z()});
    };
    constexpr unsigned faces[6][4] = {{0, 4, 6, 2}, {5, 1, 3, 7}, {0, 1, 5, 4},
                                      {6, 7, 3, 2}, {1, 0, 2, 3}, {4, 5, 7, 6}};
    for (auto const& face : faces)
        out.push_back(Quad::through({corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])}));
}

void read_frustum(SceneBuilder& b, Fields& f, double radius, double top, Geometries& out) {
    VectorDouble const from = f.required_vector("from"), to = f.required_vector("to");
    bool const caps = f.boolean("caps").value_or(true);
    if ((to - from).norm() == 0) return f.error("'from' and 'to' are the same point");
    Frustum const side{b.placed(from), b.placed(to), metres(b, radius), metres(b, top)};
    out.push_back(side);
    Direction const axis = (side.to - side.from).normalized();
    if (caps && side.radius > 0) out.push_back(Disc{side.from, -axis, side.radius});
    if (caps && side.top_radius > 0) out.push_back(Disc{side.to, axis, side.top_radius});
}

void read_cylinder(SceneBuilder& b, Fields& f, Geometries& out) {
    double const radius = f.required_number("radius", positive());
    read_frustum(b, f, radius, radius, out);
}

void read_cone(SceneBuilder& b, Fields& f, Geometries& out) {
    double const radius = f.required_number("radius", at_least(0));
    double const top = f.number("top_radius", at_least(0)).value_or(0);
    if (radius == 0 && top == 0) f.error("'radius' and 'top_radius' are both 0: the cone has no area");
    read_frustum(b, f, radius, top, out);
}

void read_inline_uv(SceneBuilder& b, Fields& f, Mesh& mesh) {
    JsonValue const& value = *f.find("uv");
    JsonArray const* const array = value.as<JsonArray>();
    if (!array || array->size() != mesh.position.size())
        return f.error_at("uv", fmt::format("found {}, but a pair for each of the {} vertices is wanted",
                                            value.described(), mesh.position.size()));
    for (std::size_t i = 0; i < array->size(); ++i) {
        auto const pair = read_numbers(b.context, (*array)[i], fmt::format("{}[{}]", f.path("uv"), i), 2);
        if (!pair) return;
        mesh.uv.emplace_back(static_cast<float>((*pair)[0]), static_cast<float>((*pair)[1]));
    }
}

std::optional<Mesh> inline_mesh(SceneBuilder& b, Fields& f) {
    JsonArray const* const vertices = f.require("vertices")->as<JsonArray>();
    JsonValue const* const triangle_value = f.require("triangles");
    JsonArray const* const triangles = triangle_value ? triangle_value->as<JsonArray>() : nullptr;
    if (!vertices || !triangles) {
        f.error("'vertices' and 'triangles' are arrays of triples");
        return std::nullopt;
    }
    Mesh mesh;
    for (std::size_t i = 0; i < vertices->size(); ++i) {
        auto const p = read_vector(b.context, (*vertices)[i], fmt::format("{}[{}]", f.path("vertices"), i));
        if (!p) return std::nullopt;
        mesh.position.push_back(b.placed(*p));
    }
    for (std::size_t i = 0; i < triangles->size(); ++i) {
        std::string const path = fmt::format("{}[{}]", f.path("triangles"), i);
        auto const t = read_vector(b.context, (*triangles)[i], path);
        if (!t) return std::nullopt;
        auto const count = static_cast<double>(vertices->size());
        for (double const v : *t)
            if (!(v >= 0 && v < count && v == std::floor(v))) {
                b.context.error((*triangles)[i], path,
                                fmt::format("found vertex {}, allowed: whole numbers 0 .. {}", v, count - 1));
                return std::nullopt;
            }
        mesh.triangle.push_back({static_cast<std::uint32_t>(t->x()), static_cast<std::uint32_t>(t->y()),
                                 static_cast<std::uint32_t>(t->z())});
    }
    if (f.find("uv")) read_inline_uv(b, f, mesh);
    return mesh;
}

Mesh read_placed_mesh(SceneBuilder& b, std::filesystem::path const& path) {
    VectorDouble const origin = b.local ? VectorDouble::Zero() : VectorDouble(b.origin / b.length_unit_m);
    Mesh mesh = read_mesh(path, origin);
    for (Vector& p : mesh.position) {
        if (!b.local) b.extent.extend((p.cast<double>() + origin) * b.length_unit_m);
        p *= static_cast<float>(b.length_unit_m);
    }
    return mesh;
}

void read_mesh_shape(SceneBuilder& b, Fields& f, Geometries& out) {
    bool const smooth = f.boolean("smooth").value_or(true);
    std::optional<Mesh> mesh;
    if (f.find("vertices")) {
        mesh = inline_mesh(b, f);
    } else if (f.require("file")) {
        auto const name = f.text("file");
        if (!name) return;
        std::filesystem::path const path = b.context.folder / *name;
        b.context.guarded(*f.find("file"), f.path("file"), [&] { mesh = read_placed_mesh(b, path); });
        b.context.files_read.push_back(path);
    }
    if (!mesh) return;
    if (f.find("vertices")) b.context.guarded(f.value(), f.key_path(), [&] { check_mesh(*mesh, {}); });
    out.push_back(MeshShape{std::make_shared<Mesh>(std::move(*mesh)), smooth});
}

constexpr std::array<ShapeEntry, 7> table{{
    {"sphere", "centre, radius", read_sphere},
    {"quad", "four corners of a plane", read_quad},
    {"disc", "centre, normal, radius", read_disc},
    {"box", "axis-aligned, min and max", read_box},
    {"cylinder", "from, to, radius", read_cylinder},
    {"cone", "from, to, radius, top_radius", read_cone},
    {"mesh", "triangles of a PLY or OBJ file", read_mesh_shape},
}};

double surface_area(ShapeGeometry const& geometry) {
    struct Area {
        double operator()(Sphere const& s) const { return 4 * pi_double * square(static_cast<double>(s.radius)); }
        double operator()(Quad const& q) const { return q.area(); }
        double operator()(Disc const& d) const { return pi_double * square(static_cast<double>(d.radius)); }
        double operator()(Frustum const& f) const { return f.area(); }
        double operator()(MeshShape const& m) const {
            double total = 0;
            for (auto const& t : m.mesh->triangle)
                total += 0.5 * (m.mesh->position[t[1]] - m.mesh->position[t[0]])
                                   .cross(m.mesh->position[t[2]] - m.mesh->position[t[0]])
                                   .norm();
            return total;
        }
    };
    return std::visit(Area{}, geometry);
}

struct EmissionRead {
    SpectralFunction radiance;
    bool two_sided;
    EmissionProfile profile;
    std::string group;
};

EmissionProfile read_profile(SceneBuilder& b, Fields& e) {
    JsonValue const* const value = e.find("profile");
    if (!value) return {};
    Fields f(b.context, *value, e.path("profile"));
    double const exponent = f.number("exponent", between(0, largest_emission_exponent)).value_or(0);
    double const cone = f.number("cone_deg", {.least = 0, .most = 90, .least_excluded = true}).value_or(90);
    f.finish();
    return {static_cast<float>(exponent), cone == 90 ? 0 : static_cast<float>(std::cos(radians(cone)))};
}

std::optional<EmissionRead> read_emission(SceneBuilder& b, Fields& f, bool in_object) {
    JsonValue const* const value = f.find("emission");
    if (!value) return std::nullopt;
    if (in_object) {
        f.error_at("emission", "a shape inside an object cannot emit: place the lamp in 'shapes'");
        return std::nullopt;
    }
    Fields e(b.context, *value, f.path("emission"));
    auto const radiance = read_spectrum(b, e, "radiance", emission_kind);
    bool const two_sided = e.boolean("two_sided").value_or(false);
    EmissionProfile const profile = read_profile(b, e);
    std::string const group = read_light_group(e);
    e.finish();
    return radiance ? std::optional(EmissionRead{*radiance, two_sided, profile, group}) : std::nullopt;
}

// The material of that number, if any was read.
NamedMaterial const* material_at(SceneBuilder const& b, int index) {
    auto const i = static_cast<std::size_t>(index);
    return i < b.scene.materials.size() ? &b.scene.materials[i] : nullptr;
}

void check_uv(SceneBuilder& b, Fields& f, int material, std::vector<ShapeGeometry> const& geometries) {
    NamedMaterial const* const m = material_at(b, material);
    if (!m || !m->looks_at_uv()) return;
    for (ShapeGeometry const& g : geometries) {
        auto const* const shape = std::get_if<MeshShape>(&g);
        if (shape && shape->mesh->uv.empty())
            f.error_at("material", fmt::format("'{}' has a texture, but this mesh has no uv to place it by", m->name));
    }
}

void read_shape(SceneBuilder& b, JsonValue const& value, std::string const& path, bool in_object,
                std::vector<Shape>& shapes) {
    Fields f(b.context, value, path);
    ShapeEntry const* const entry = find_entry(f, shape_entries());
    if (!entry) return;
    Geometries geometries;
    bool const moved = f.find("transform");
    b.local = in_object || moved;
    entry->reader(b, f, geometries);
    b.local = false;
    Transform const own = read_transform(b, f, "transform"), transform = moved && !in_object ? b.placed(own) : own;
    int const material = read_material_under(b, f, "material");
    bool const flipped = f.boolean("flip").value_or(false);
    auto const emission = read_emission(b, f, in_object);
    std::string const name = f.text("name").value_or("");
    check_uv(b, f, material, geometries);
    if (emission && material_at(b, material) && material_at(b, material)->alpha)
        f.error_at("emission", "a lamp has no holes: its material has 'alpha'");
    for (ShapeGeometry& g : geometries) {
        if (moved) apply_transform(b, f, transform, g);
        Shape& shape = shapes.emplace_back();
        shape.geometry = std::move(g);
        shape.material = material;
        shape.flipped = flipped;
        shape.name = name;
        if (emission && !(surface_area(shape.geometry) > 0)) {
            f.error_at("emission", "this emitter has no area");
        } else if (emission) {
            double const luminance = luminance_of(emission->radiance);
            Emitter emitter{Emission(emission->radiance, b.scene.grid), emission->two_sided, emission->profile};
            shape.light = add_light(b, make_area_light(shape, {std::move(emitter), luminance}), entry->name,
                                    emission->radiance, luminance);
            b.scene.light_descriptions[static_cast<std::size_t>(shape.light)].group = emission->group;
        }
    }
    f.finish();
}

}  // namespace

std::span<ShapeEntry const> shape_entries() { return table; }

void read_shapes(SceneBuilder& b, JsonValue const& value, std::string const& path, bool in_object,
                 std::vector<Shape>& shapes) {
    JsonArray const* const array = value.as<JsonArray>();
    if (!array)
        return b.context.error(value, path, "found " + value.described() + ", but an array of shapes is wanted");
    for (std::size_t i = 0; i < array->size(); ++i)
        read_shape(b, (*array)[i], fmt::format("{}[{}]", path, i), in_object, shapes);
}

}  // namespace iride
