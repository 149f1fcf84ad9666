// SPDX-License-Identifier: Apache-2.0
#include "support/bsdf_models.h"

std::vector<iride::test::NamedModel> iride::test::diffuse_models() {
    return {{"lambert", Lambert{rising_lanes(.3f, .1f)}}};
}
