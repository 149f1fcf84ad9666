// SPDX-License-Identifier: Apache-2.0
// Microfacets as a scene describes them: several roughnesses side by side, sum w_j = 1, of one kind and one masking.
//   D(h) = sum w_j D_j(h)
//   Smith:     Lambda(w) = sum w_j Lambda_j(w), since it is linear in the distribution of slopes; visible normals come
//              from component j with probability w_j (1 + Lambda_j) / (1 + Lambda): exact
//   v-cavity:  1 + Lambda(w, h) = max(1, <w, h> / (2 h.z w.z)), the larger of two Lambdas counts: the classic G =
//              min(1, 2 h.z wo.z / <wo, h>, 2 h.z wi.z / <wi, h>). Each facet has its mirror image across the cavity;
//              of the two the one is seen in proportion to its projected area     [Cook 1982] [HeitzEon 2014]
#pragma once

#include <compare>
#include <vector>

#include "materials/microfacet.h"

namespace iride {

enum class FacetShape { ggx, beckmann };
enum class Masking { smith, v_cavity };

struct FacetComponent {
    float weight, alpha_x, alpha_y;
    auto operator<=>(FacetComponent const&) const = default;
};

inline constexpr double smallest_roughness = 1e-3;
inline constexpr std::size_t max_facet_components = 8;

struct Facets {
    std::vector<FacetComponent> components;  // empty: a smooth surface
    FacetShape shape = FacetShape::ggx;
    Masking masking = Masking::smith;
    auto operator<=>(Facets const&) const = default;

    static Facets ggx(float ax, float ay) { return {{{1, ax, ay}}}; }

    bool is_smooth() const { return components.empty(); }
    bool is_anisotropic() const;
    float smallest_alpha() const;
    // One component of Ggx with Smith's masking, which has closures of its own.
    bool is_plain() const { return components.size() == 1 && shape == FacetShape::ggx && masking == Masking::smith; }
    Ggx plain() const { return {components[0].alpha_x, components[0].alpha_y}; }

    PerSteradian distribution(Direction const& h) const;
    float lambda(Direction const& w, Direction const& h) const;
    float joint(float lambda_o, float lambda_i) const {
        return masking == Masking::smith ? lambda_o + lambda_i : std::max(lambda_o, lambda_i);
    }
    Direction visible_normal(Direction const& w, Sample3& u) const;
};

// Facets and how their x axis lies on the surface, anticlockwise from its tangent.
struct RoughSurface {
    Facets facets;
    double rotation_deg = 0;

    // Of MaterialTraits.
    Vector2 grain() const {
        return {static_cast<float>(std::cos(radians(rotation_deg))),
                static_cast<float>(std::sin(radians(rotation_deg)))};
    }
};

// Facets of a material, which outlives every path, in a closure.
struct FacetsOfMaterial {
    Facets const* facets;

    PerSteradian distribution(Direction const& h) const { return facets->distribution(h); }
    float lambda(Direction const& w, Direction const& h) const { return facets->lambda(w, h); }
    float joint(float lambda_o, float lambda_i) const { return facets->joint(lambda_o, lambda_i); }
    Direction visible_normal(Direction const& w, Sample3& u) const { return facets->visible_normal(w, u); }
};

}  // namespace iride
