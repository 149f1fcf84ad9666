// SPDX-License-Identifier: Apache-2.0
// Marks an integrator whose single samples may be below 0, as those of a control variate are; samples of all others are
// then dropped and counted.
#pragma once

namespace iride {

struct SignedSamples {};

}  // namespace iride
