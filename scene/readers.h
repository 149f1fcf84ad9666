// SPDX-License-Identifier: Apache-2.0
// The readers of the parts of a scene file. Each family is one constexpr table {name, summary, reader}; the loader, the
// help and the tests iterate it.
#pragma once

#include <map>
#include <span>

#include "scene/fields.h"
#include "scene/scene.h"
#include "scene/texture_cache.h"
#include "spectral/catalogue.h"

namespace iride {

// A named material of the file: read when it is first asked for, since others may be made of it.
struct NamedSource {
    JsonValue const* value;
    int index = -1;  // in the scene, once read
    bool under_way = false;
};

// What the readers share while a file is read.
struct SceneBuilder {
    ReadContext& context;
    Scene& scene;
    double length_unit_m = 1;
    VectorDouble origin = VectorDouble::Zero();  // [m] the place that becomes the scene's origin
    bool local = false;                          // what is read will be moved by a transform
    Eigen::AlignedBox3d extent{};                // [m] of the places met so far
    std::map<std::string, NamedSource> named_materials{};
    std::vector<std::unique_ptr<Light>> lights{};
    int material_depth = 0;  // of materials made of others
    TextureCache textures{};

    // A place of the file in the scene's coordinates [m].
    VectorDouble placed_exactly(VectorDouble const& v) {
        if (local) return v * length_unit_m;
        extent.extend(v * length_unit_m);
        return v * length_unit_m - origin;
    }
    Vector placed(VectorDouble const& v) { return placed_exactly(v).cast<float>(); }
    Transform placed(Transform const& t) {
        extent.extend(VectorDouble(t.translation()));
        return Transform(Eigen::Translation3d(-origin)) * t;
    }
};

// ---- cameras (camera_reader.cpp)
void read_camera(SceneBuilder& builder, Fields& top);
// The factor on XYZ: the film's "exposure", or that of its "photograph"; 1 without either.
double read_exposure(SceneBuilder& builder, Fields& film);

// ---- what fills the place that no body fills (medium_reader.cpp): the key "medium"
void read_open_medium(SceneBuilder& builder, Fields& top);

// ---- spectra (spectrum_reader.cpp)
struct SpectrumKind {
    SpectralQuantity quantity;
    Outside outside;  // beyond a table, unless the file says otherwise
    bool may_scale_luminance;
    double least, most;  // allowed values over the render range
};
extern SpectrumKind const reflectance_kind, emission_kind, transmittance_kind, absorption_kind, index_kind;

// The spectrum under `key` (required), checked over the render range.
std::optional<SpectralFunction> read_spectrum(SceneBuilder& builder, Fields& fields, std::string const& key,
                                              SpectrumKind const& kind);
// The same of a value that stands anywhere, at `path`.
std::optional<SpectralFunction> read_spectrum_value(SceneBuilder& builder, JsonValue const& value,
                                                    std::string const& path, SpectrumKind const& kind);
std::optional<ComplexIndex> read_complex_index(SceneBuilder& builder, Fields& fields, std::string const& key);
double luminance_of(SpectralFunction const& radiance);
WavelengthRange nonzero_range(SpectralFunction const& emission, WavelengthRange const& within);

// ---- materials (material_reader.cpp)
struct MaterialEntry {
    char const* name;
    char const* summary;
    std::unique_ptr<Material> (*reader)(SceneBuilder&, Fields&);
};
std::span<MaterialEntry const> material_entries();
// A material object; its index in the scene, where something stands even after an error.
int read_material(SceneBuilder& builder, JsonValue const& value, std::string const& path, std::string const& name);
// The same for a name of the file's materials, and for the name or object under a (required) key.
int read_named_material(SceneBuilder& builder, std::string const& name);
int read_material_under(SceneBuilder& builder, Fields& fields, std::string const& key);

// ---- shapes (shape_reader.cpp)
struct ShapeEntry {
    char const* name;
    char const* summary;
    void (*reader)(SceneBuilder&, Fields&, std::vector<ShapeGeometry>&);
};
std::span<ShapeEntry const> shape_entries();
// The shapes of an array; `in_object`: emitters are refused.
void read_shapes(SceneBuilder& builder, JsonValue const& value, std::string const& path, bool in_object,
                 std::vector<Shape>& shapes);
// transform_reader.cpp
Transform read_transform(SceneBuilder& builder, Fields& fields, std::string const& key);
// Apply a transform to a geometry; reports shapes that cannot take it.
void apply_transform(SceneBuilder& builder, Fields& fields, Transform const& transform, ShapeGeometry& geometry);

// ---- lights (light_reader.cpp)
struct LightEntry {
    char const* name;
    char const* summary;
    void (*reader)(SceneBuilder&, Fields&);
};
std::span<LightEntry const> light_entries();
void read_lights(SceneBuilder& builder, JsonValue const& value, std::string const& path);
// The key "group" of a light or an emission, empty without one.
std::string read_light_group(Fields& fields);
// Add a light with its description; its index in both lists.
int add_light(SceneBuilder& builder, std::unique_ptr<Light> light, std::string const& type,
              SpectralFunction const& spectrum, double luminance);

inline constexpr double largest_emission_exponent = 1e4;  // narrower than a degree: a lamp of another kind

// The type of an object by one of these tables; null after a diagnostic.
template <class Entry>
Entry const* find_entry(Fields& fields, std::span<Entry const> entries) {
    std::vector<std::string> names;
    for (Entry const& e : entries) names.emplace_back(e.name);
    if (!fields.require("type")) return nullptr;
    auto const type = fields.choice("type", names);
    if (!type) return nullptr;
    for (Entry const& e : entries)
        if (*type == e.name) return &e;
    return nullptr;
}

}  // namespace iride
