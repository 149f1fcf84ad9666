// SPDX-License-Identifier: Apache-2.0
#include "materials/plane_stack.h"

namespace iride {

std::complex<double> index_at(ComplexIndex const& index, double nm) {
    return {index.n.at(nm), std::max(0.0, index.k.at(nm))};
}

StackPower<double> PlaneStack::power(double nm, double cosine) const {
    double const n0 = outside.n.at(nm);
    std::complex<double> const bulk = index_at(inside, nm);
    if (layers.empty()) {  // exact to the last digits, also where hardly anything is reflected
        auto const R = fresnel(cosine, bulk.real() / n0, bulk.imag() / n0);
        return {R, {1 - R.s, 1 - R.p}};
    }
    std::vector<ThinLayer<double>> stack;
    for (CoatingLayer const& l : layers) stack.push_back({index_at(l.index, nm), l.thickness_nm});
    return thin_film<double>(cosine, n0, stack, bulk, nm);
}

WavelengthRange PlaneStack::defined_on() const {
    WavelengthRange common{0, std::numeric_limits<double>::infinity()};
    auto const meet = [&](SpectralFunction const& f) {
        WavelengthRange const own = f.defined_on();
        common = {std::max(common.min_nm, own.min_nm), std::min(common.max_nm, own.max_nm)};
    };
    for (ComplexIndex const* const i : {&outside, &inside}) meet(i->n), meet(i->k);
    for (CoatingLayer const& l : layers) meet(l.index.n), meet(l.index.k);
    return common;
}

}  // namespace iride
