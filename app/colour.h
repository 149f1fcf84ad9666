// SPDX-License-Identifier: Apache-2.0
// The subcommands of iride colour, one per file: each adds its parser to the parent's.
#pragma once

#include "app/command.h"

namespace iride {

Command add_colour_spectrum(CLI::App& colour);
Command add_colour_convert(CLI::App& colour);
Command add_colour_difference(CLI::App& colour);
Command add_colour_check(CLI::App& colour);
Command add_colour_diagram(CLI::App& colour);

}  // namespace iride
