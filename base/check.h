// SPDX-License-Identifier: Apache-2.0
// check(condition, "law"): a programming error, named after the law it breaks. Bad *input* is an InputError instead.
// Verified only when the build asks for it (IRIDE_CHECKS: the dev preset), so it may stand in the sampling loop.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace iride {

#ifdef IRIDE_CHECKS
inline void check(bool condition, char const* law) {
    if (condition) return;
    std::fprintf(stderr, "iride: broken law: %s\n", law);
    std::abort();
}
#else
inline void check(bool, char const*) {}
#endif

}  // namespace iride
