// SPDX-License-Identifier: Apache-2.0
#include "support/bsdf_models.h"

std::vector<iride::test::NamedModel> iride::test::diffuse_models() {
    std::vector<NamedModel> models{{"lambert", Lambert{rising_lanes(.3f, .09f)}}};
    for (float roughness : {0.0f, .3f, 1.0f})
        models.push_back({"oren-nayar", OrenNayar{rising_lanes(.3f, .09f), roughness}});
    return models;
}
