// SPDX-License-Identifier: Apache-2.0
// The subcommands of iride, one per file. Each adds its options to the parser and returns what runs it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace iride {

// Exit codes: scripts depend on them.
inline constexpr int exit_done = 0, exit_bad_input = 2, exit_not_trustworthy = 3, exit_interrupted = 130;

// Runs the subcommand; returns the exit code.
using Action = std::function<int()>;

struct Command {
    CLI::App* parser;
    Action run;
};

Command add_render(CLI::App& app);
Command add_merge(CLI::App& app);
Command add_scenes(CLI::App& app);
Command add_plan(CLI::App& app);
Command add_radiosity(CLI::App& app);
Command add_compare(CLI::App& app);
Command add_colour(CLI::App& app);
Command add_material(CLI::App& app);
Command add_bench(CLI::App& app);
Command add_depth_cue(CLI::App& app);

// --plan-disable NAME, of render and plan.
void add_plan_disable(CLI::App& parser, std::vector<std::string>& disabled);

}  // namespace iride
