// SPDX-License-Identifier: Apache-2.0
// The readers of the material families, for the table in material_reader.cpp. Null after an error.
#pragma once

#include "materials/plane_stack.h"
#include "scene/readers.h"

namespace iride {

using MaterialPointer = std::unique_ptr<Material>;

// Keys "roughness" or "facets", "distribution", "masking", "rotation_deg"; without the first two: smooth.
std::optional<RoughSurface> read_rough_surface(Fields& fields);

MaterialPointer read_diffuse(SceneBuilder& builder, Fields& fields);
MaterialPointer read_black(SceneBuilder& builder, Fields& fields);
MaterialPointer read_conductor(SceneBuilder& builder, Fields& fields);
MaterialPointer read_dielectric(SceneBuilder& builder, Fields& fields);
MaterialPointer read_slab(SceneBuilder& builder, Fields& fields);
MaterialPointer read_film(SceneBuilder& builder, Fields& fields);
MaterialPointer read_oren_nayar(SceneBuilder& builder, Fields& fields);
MaterialPointer read_plastic(SceneBuilder& builder, Fields& fields);
MaterialPointer read_mixture(SceneBuilder& builder, Fields& fields);
MaterialPointer read_two_sided(SceneBuilder& builder, Fields& fields);
MaterialPointer read_phong(SceneBuilder& builder, Fields& fields);
MaterialPointer read_blinn_phong(SceneBuilder& builder, Fields& fields);
MaterialPointer read_modified_blinn_phong(SceneBuilder& builder, Fields& fields);

// Light that falls to 1/e within 80 wavelengths does not make a transparent body: metals have k of 1 and more, glass of
// 1e-8, ink of 1e-4. Up to here the Fresnel equations take n alone; what that leaves out is in
// tests/materials/fresnel_closed_forms.cpp: 2e-6 from outside, for n >= 1.3.
inline constexpr double largest_transparent_k = 1e-3;

// What fills a transparent body: the index under `key`, its k and the keys "absorption", "absorption_per_m".
std::optional<Medium> read_medium(SceneBuilder& builder, Fields& fields, std::string const& key);
// How it scatters: the keys "scattering_per_m" and "asymmetry". The coefficient [1/m], if there is one.
std::optional<SpectralFunction> read_scattering(SceneBuilder& builder, Fields& fields, Medium& medium);
// The same of the index alone.
std::optional<Medium> read_medium_of_index(SceneBuilder& builder, Fields& fields, std::string const& key);

// Thin films from outside to inside; nothing after an error.
std::optional<std::vector<CoatingLayer>> read_films(SceneBuilder& builder, Fields& fields, std::string const& key);
// Where a plane wave is to be followed through, n = 0 is no medium.
void refuse_zero_index(SceneBuilder& builder, Fields& fields, ComplexIndex const& index);
// A dielectric with "coating".
MaterialPointer read_coated_dielectric(SceneBuilder& builder, Fields& fields);

}  // namespace iride
