// SPDX-License-Identifier: Apache-2.0
// iride depth-cue IN.exr -o OUT.exr: let what is further away fade to a colour.
#include "film/depth_cue.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/command.h"
#include "base/atomic_file.h"
#include "base/diagnostics.h"

namespace iride {

namespace {

struct Options {
    std::string in, out;
    DepthCue cue{0, 0};
    std::vector<double> colour;
};

int run_depth_cue(Options const& o) {
    DepthCue cue = o.cue;
    if (!(std::isfinite(cue.front) && std::isfinite(cue.back) && cue.front < cue.back))
        throw InputError({}, "--back",
                         fmt::format("found {:g} with a front of {:g}, allowed: beyond it", cue.back, cue.front));
    for (std::size_t c = 0; c < o.colour.size(); ++c) {
        if (!std::isfinite(o.colour[c])) throw InputError({}, "--colour", "allowed: three finite numbers");
        cue.colour[c] = o.colour[c];
    }
    check_output("--output", o.out, ".exr");
    apply_depth_cue(cue, o.in, o.out);
    return exit_done;
}

}  // namespace

Command add_depth_cue(CLI::App& app) {
    CLI::App* const parser =
        app.add_subcommand("depth-cue", "Fade an EXR that has a depth channel to a colour with distance");
    auto const o = std::make_shared<Options>();
    parser->add_option("IN", o->in, "an OpenEXR file with R G B or X Y Z and depth.Z, depth or Z [m]")->required();
    parser->add_option("-o,--output", o->out, "EXR file to write")->required();
    parser->add_option("--front", o->cue.front, "depth [m] up to which the picture stays as it is")->required();
    parser->add_option("--back", o->cue.back, "depth [m] from which on it is faded")->required();
    parser->add_option("--front-scale", o->cue.scale_front, "share of the picture before the front")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    parser->add_option("--back-scale", o->cue.scale_back, "share of the picture behind the back")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    parser->add_option("--colour", o->colour, "what it fades to, in the file's own channels (default: 0 0 0)")
        ->expected(3);
    return {parser, [o] { return run_depth_cue(*o); }};
}

}  // namespace iride
