// SPDX-License-Identifier: Apache-2.0
// iride merge A B ... -o OUT.exr: parts of one picture, rendered apart, as if they had been rendered together.
#include <fmt/format.h>

#include <memory>

#include "app/command.h"
#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "film/checkpoint.h"

namespace iride {

namespace {

struct Options {
    std::vector<std::string> parts;
    std::string output, colourspace = "ACEScg";
};

int run_merge(Options const& o) {
    std::filesystem::path const out = o.output;
    check_output("--output", out, ".exr");
    std::vector<Checkpoint> parts;
    for (std::string const& name : o.parts) parts.push_back(read_checkpoint(name));
    output_space(o.colourspace, parts.front().settings.scene_white);  // to refuse an unknown one
    std::vector<Diagnostic> wrong;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            for (std::string const& obstacle : obstacles_to_merging(parts[k], parts[i])) {
                Diagnostic& d = wrong.emplace_back();
                d.where.file = o.parts[i];
                d.message = fmt::format("cannot be merged with {}: {}", o.parts[k], obstacle);
            }
    if (!wrong.empty()) throw InputError(std::move(wrong));
    ExrSettings settings = parts.front().settings;
    settings.colourspace = o.colourspace;
    write_exr(picture_of(merged(parts)), settings, out);
    return exit_done;
}

}  // namespace

Command add_merge(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("merge", "Add up checkpoints of parts of a picture, by sample count");
    auto const o = std::make_shared<Options>();
    parser->add_option("PARTS", o->parts, "checkpoints: of other seeds, other samples or other crops")->required();
    parser->add_option("-o,--output", o->output, "EXR file to write")->required();
    parser->add_option("--colourspace", o->colourspace, "of the EXR, as for iride render")->capture_default_str();
    return {parser, [o] { return run_merge(*o); }};
}

}  // namespace iride
