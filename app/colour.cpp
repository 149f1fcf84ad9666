// SPDX-License-Identifier: Apache-2.0
// iride colour ...: the parent of the colour commands.
#include "app/colour.h"

#include <array>
#include <vector>

namespace iride {

namespace {

constexpr std::array colour_commands{&add_colour_spectrum, &add_colour_convert, &add_colour_difference,
                                     &add_colour_check, &add_colour_diagram};

}  // namespace

Command add_colour(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("colour", "Colours, and what a colour configuration makes of them");
    parser->require_subcommand(1);
    std::vector<Command> children;
    for (auto const add : colour_commands) children.push_back(add(*parser));
    return {parser, [children] {
                for (Command const& child : children)
                    if (child.parser->parsed()) return child.run();
                return exit_bad_input;
            }};
}

}  // namespace iride
