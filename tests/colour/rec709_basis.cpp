// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include "colour/observer.h"
#include "colour/rec709_basis.h"
#include "colour/rgb_space.h"
#include "colour/rgb_to_spectrum.h"

using namespace iride;

TEST_CASE("the Rec.709 basis is a partition of unity with the right colours", "[law]") {
    auto const& basis = rec709_basis();
    for (double nm = 360; nm <= 830; nm += 2.5) {
        double sum = 0;
        for (auto const& b : basis) {
            CHECK(b.at(nm) >= 0);
            CHECK(b.at(nm) <= 1);
            sum += b.at(nm);
        }
        CHECK(sum == Approx(1).epsilon(1e-9));
    }
    // Each times D65 has its primary's colour, relative to the white's: published and tabulated.
    Xyz const white = cie1931_2deg().integrate(unit_d65());
    for (int k = 0; k < 3; ++k) {
        TabulatedShape product;
        for (double nm = 360; nm <= 830; ++nm) {
            product.nm.push_back(nm);
            product.value.push_back(basis[static_cast<std::size_t>(k)].at(nm) * unit_d65().at(nm));
        }
        Xyz const got = cie1931_2deg().integrate(SpectralFunction(std::move(product), Outside::zero));
        VectorDouble const wanted =
            rgb::rec709.to_xyz_matrix().col(k).cwiseQuotient(to_vector(to_xyz(named_white("D65"), 1)));
        CHECK((to_vector(got).cwiseQuotient(to_vector(white)) - wanted).norm() < 1e-5);
    }
}
