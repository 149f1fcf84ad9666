// SPDX-License-Identifier: Apache-2.0
#include "support/bsdf_models.h"
#include "support/dielectrics.h"

namespace iride::test {

std::vector<NamedModel> plastic_models() {
    Lanes const n = coat_indices(), rho = rising_lanes(.3f, .09f);
    std::vector<NamedModel> models{{"plastic", smooth_plastic(n, rho)},
                                   {"absorbing plastic", smooth_plastic(n, rho, rising_lanes(0, .3f))},
                                   {"absorbing rough plastic", rough_plastic(n, rho, .4f, rising_lanes(0, .3f))}};
    for (float alpha : {.1f, .5f, 1.0f}) models.push_back({"rough plastic", rough_plastic(n, rho, alpha), 64});
    return models;
}

}  // namespace iride::test
