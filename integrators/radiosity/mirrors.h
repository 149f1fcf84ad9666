// SPDX-License-Identifier: Apache-2.0
// Perfect mirrors among patches: rays go on from them by reflection about the facet's normal, and keep at each
// wavelength what the mirror reflects at that angle. Light that comes from patch to patch by way of mirrors makes the
// extended form factors; these depend on the wavelength,
//   F_ij(lambda) = F_ij (1 - l_ij(lambda)),
// F_ij the share of i's light that comes to j directly or by any chain of mirrors that would lose nothing, l_ij the
// mean share lost on the way: one matrix and, only for pairs that see each other by mirrors, a spectrum each.
// [Sillion 1989]
#pragma once

#include <functional>
#include <map>

#include "integrators/radiosity/patches.h"
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

// Metals without roughness. Other Dirac lobes also let light through.
bool is_mirror(NamedMaterial const& material);

inline constexpr int most_mirrors = 64;  // on a ray's way; what is left then is lost

// Direction `way` reflected by a plane of that normal.
inline VectorDouble mirrored(VectorDouble const& way, VectorDouble const& normal) {
    return way - 2 * way.dot(normal) * normal;
}

Throughput mirror_reflectance(Material const& material, double cosine, Wavelengths const& wavelengths);

class Mirrors {
  public:
    Mirrors(Scene const& scene, PatchMesh const& mesh, std::vector<double> const& wavelengths_nm);
    bool any() const { return !table_.empty(); }
    bool is_one(std::size_t patch) const { return table_of(static_cast<int>(patch)); }

    using Kept = Eigen::ArrayXf;  // [wavelength]
    // What a ray from a patch meets beyond all mirrors; multiplies `kept`. None: nothing, or a mirror still.
    std::optional<PatchHit> follow(PatchTracer const& tracer, VectorDouble from, VectorDouble side, VectorDouble way,
                                   Kept& kept, bool& by_mirrors) const;

  private:
    using Table = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // [cosine][wavelength]
    Table const* table_of(int patch) const;

    PatchMesh const& mesh_;
    std::map<int, Table> table_;  // [material]
};

// The extended form factors of a mesh by rays: system.form_factors, reciprocal, and system.transport where mirrors take
// part. `found`: called with the factors as they came from the rays, before they are made reciprocal.
void extend_form_factors(System& system, PatchMesh const& mesh, PatchTracer const& tracer, Mirrors const& mirrors,
                         int rays, std::function<void()> const& found);

}  // namespace iride::radiosity
