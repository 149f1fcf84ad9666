// SPDX-License-Identifier: Apache-2.0
// Prints data/ocio/config.ocio:  cmake --build --preset release --target ocio_config &&
//     build/release/scripts/ocio_config > data/ocio/config.ocio
#include <cstdio>

#include "colour/shipped_config.h"

int main() { std::fputs(iride::shipped_config().c_str(), stdout); }
