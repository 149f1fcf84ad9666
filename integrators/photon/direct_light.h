// SPDX-License-Identifier: Apache-2.0
// Light of a lamp at one point of a path: one lamp by power, one place on it; no other technique shares in it.
#pragma once

#include "integrators/photon/radiance_cache.h"

namespace iride {

// Weight and reach of the path included.
Radiance direct_light(CachedPoint const& point);

}  // namespace iride
