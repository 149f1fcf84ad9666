// SPDX-License-Identifier: Apache-2.0
#include "colour/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/diagnostics.h"

namespace iride {

void check_factor(SpectralFunction const& factor, WavelengthRange const& domain) {
    constexpr double slack = 0.02;  // measured factors of bright whites exceed 1, of blacks fall below 0, by so much
    WavelengthRange const own = factor.defined_on();
    if (own.max_nm < domain.min_nm || own.min_nm > domain.max_nm)
        throw InputError({}, factor.name(),
                         fmt::format("wavelengths {:g} .. {:g} nm: none is within the observer's {:g} .. {:g} nm",
                                     own.min_nm, own.max_nm, domain.min_nm, domain.max_nm));
    double const most = factor.largest(domain), least = factor.smallest(domain);
    if (!std::isfinite(most) || !std::isfinite(least))
        throw InputError({}, factor.name(), "values that are not finite: a reflectance is 0..1");
    if (most > 1 + slack)
        throw InputError({}, factor.name(),
                         fmt::format("values up to {:g}: a reflectance is 0..1, is this percent?", most));
    if (least < -slack)
        throw InputError({}, factor.name(), fmt::format("values down to {:g}: a reflectance is 0..1", least));
}

ColourDescriber::ColourDescriber(SpectralFunction const& illuminant, Observer const& observer)
    : observer_(observer), weights_(illuminant, observer), spectral_locus_(observer), planckian_locus_(observer) {}

ColourDescription ColourDescriber::of_object(SpectralFunction const& factor, Between between) const {
    check_factor(factor, observer_.ybar.defined_on());
    return of(100 * (between == Between::astm ? weights_.of_measured(factor) : weights_.of(factor)));
}

ColourDescription ColourDescriber::of_light(SpectralFunction const& power) const {
    Xyz const c = xyz_of_light(power, observer_);
    return of(100 / c.Y * c);
}

ColourDescription ColourDescriber::of(Xyz const& c) const {
    ColourDescription d{c, {}, {}, to_luv(c, white()), to_lab(c, white()), {}, {}, 0, {}, {}};
    if (!(c.X + c.Y + c.Z > 0)) return d;
    d.xy = to_chromaticity(c);
    d.uv_prime = to_uv_prime(c);
    DominantWavelength const w = dominant_wavelength(*d.xy, to_chromaticity(white()), spectral_locus_);
    d.dominant_wavelength_nm = w.dominant_nm;
    d.complementary_wavelength_nm = w.complementary_nm;
    d.excitation_purity = w.excitation_purity;
    if (auto const t = planckian_locus_.nearest(to_uv_1960(*d.uv_prime))) {
        d.cct_K = t->cct_K;
        d.duv = t->duv;
    }
    return d;
}

}  // namespace iride
