// SPDX-License-Identifier: Apache-2.0
#include "materials/facets.h"

#include "materials/beckmann.h"

namespace iride {

namespace {

template <class Function>
auto with_component(FacetShape shape, FacetComponent const& c, Function&& function) {
    return shape == FacetShape::ggx ? function(Ggx{c.alpha_x, c.alpha_y}) : function(Beckmann{c.alpha_x, c.alpha_y});
}

float smith_lambda(FacetShape shape, FacetComponent const& c, Direction const& w) {
    return with_component(shape, c, [&](auto const& facets) { return facets.lambda(w); });
}

// The component in whose part of [0, 1) u.lobe lies, parts as `share` says; u.lobe becomes the place in it.
template <class Share>
FacetComponent const& choose(std::vector<FacetComponent> const& components, float total, Sample3& u, Share&& share) {
    float rest = u.lobe * total;
    std::size_t i = 0;
    float part = share(components[0]);
    for (; i + 1 < components.size() && rest >= part; part = share(components[++i])) rest -= part;
    u.lobe = std::min(rest / part, one_minus_epsilon);
    return components[i];
}

}  // namespace

bool Facets::is_anisotropic() const {
    return std::ranges::any_of(components, [](FacetComponent const& c) { return c.alpha_x != c.alpha_y; });
}

float Facets::smallest_alpha() const {
    float smallest = infinity;
    for (FacetComponent const& c : components) smallest = std::min({smallest, c.alpha_x, c.alpha_y});
    return smallest;
}

PerSteradian Facets::distribution(Direction const& h) const {
    PerSteradian sum;
    for (FacetComponent const& c : components)
        sum = sum + with_component(shape, c, [&](auto const& facets) { return facets.distribution(h) * c.weight; });
    return sum;
}

float Facets::lambda(Direction const& w, Direction const& h) const {
    if (masking == Masking::v_cavity) return std::max(0.0f, w.dot(h) / (2 * h.z() * w.z()) - 1);
    float sum = 0;
    for (FacetComponent const& c : components) sum += c.weight * smith_lambda(shape, c, w);
    return sum;
}

Direction Facets::visible_normal(Direction const& w, Sample3& u) const {
    bool const smith = masking == Masking::smith;
    FacetComponent const* component = &components[0];
    if (components.size() > 1)
        component = &choose(components, smith ? 1 + lambda(w, w) : 1, u, [&](FacetComponent const& c) {
            return smith ? c.weight * (1 + smith_lambda(shape, c, w)) : c.weight;
        });
    return with_component(shape, *component, [&](auto const& facets) {
        if (smith) return facets.visible_normal(w, u);
        Direction const h = facets.normal(u.direction), mirrored(-h.x(), -h.y(), h.z());
        float const seen = std::max(0.0f, w.dot(h)), other = std::max(0.0f, w.dot(mirrored));
        float const place = u.lobe * (seen + other);
        bool const first = place < seen;
        u.lobe = std::min(first ? place / seen : (place - seen) / other, one_minus_epsilon);
        return first ? h : mirrored;
    });
}

}  // namespace iride
