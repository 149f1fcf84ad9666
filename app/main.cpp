// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <exception>

#include "app/command.h"
#include "base/diagnostics.h"

namespace {

int run(int argc, char** argv) {
    using namespace iride;
    CLI::App app("iride: a spectral renderer with a colour pipeline", "iride");
    app.set_version_flag("--version", std::string("iride ") + IRIDE_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 2 bad input, 3 result not trustworthy, 130 interrupted after saving.\n"
        "JSON goes to stdout, everything else to stderr. 'iride COMMAND --help' lists a command's options.");
    std::array const commands{add_render(app),  add_merge(app),    add_scenes(app),   add_plan(app),
                              add_compare(app), add_colour(app),   add_material(app), add_radiosity(app),
                              add_bench(app),   add_depth_cue(app)};
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        fmt::print(stderr, "iride: {}\n", e.what());
        return exit_bad_input;
    }
    for (Command const& command : commands)
        if (command.parser->parsed()) return command.run();
    return exit_bad_input;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (iride::InputError const& e) {
        for (iride::Diagnostic const& d : e.diagnostics()) fmt::print(stderr, "iride: {}\n", d.text());
        return iride::exit_bad_input;
    } catch (std::bad_alloc const&) {
        fmt::print(stderr, "iride: not enough memory for this input\n");
        return iride::exit_bad_input;
    } catch (std::exception const& e) {
        fmt::print(stderr, "iride: {}\n", e.what());
        return iride::exit_bad_input;
    }
}
