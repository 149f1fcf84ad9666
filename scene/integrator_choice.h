// SPDX-License-Identifier: Apache-2.0
// Which integrator is wanted, and what is asked of it: in a scene file NAME or { "name": NAME, key: value, ... }, on
// the command line NAME[:key=value,...]. What the keys mean is the integrator's matter
// (integrators/integrator_options.h).
#pragma once

#include <filesystem>
#include <string>

#include "base/json.h"

namespace iride {

struct IntegratorChoice {
    std::string name = "auto";
    JsonValue options{JsonObject{}};
    std::filesystem::path file{};  // where it was read; empty: the command line
    std::string key_path = "integrator";
    int line = 0, column = 0;

    // As on the command line.
    std::string text() const;
};

// NAME[:key=value,...]; a value is a number, true, false or a word. Throws InputError.
IntegratorChoice parse_integrator(std::string const& text);

}  // namespace iride
