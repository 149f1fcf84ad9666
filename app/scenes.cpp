// SPDX-License-Identifier: Apache-2.0
// iride scenes: the shipped scenes with a line each.
#include <fmt/format.h>

#include "app/command.h"
#include "scene/scene.h"

namespace iride {

Command add_scenes(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("scenes", "List the shipped scenes");
    return {parser, [] {
                for (ShippedScene const& s : shipped_scenes()) fmt::print("{:<28}{}\n", s.name, s.description);
                return exit_done;
            }};
}

}  // namespace iride
