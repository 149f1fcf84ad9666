// SPDX-License-Identifier: Apache-2.0
// iride merge A B ... -o OUT.exr: parts of one picture, rendered apart, as if they had been rendered together: from
// checkpoints to the precision of their doubles, from pictures to that of their floats.
#include <fmt/format.h>

#include <memory>

#include "app/command.h"
#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "film/exr_part.h"

namespace iride {

namespace {

struct Options {
    std::vector<std::string> parts;
    std::string output, colourspace = "ACEScg";
};

bool is_picture(std::string const& name) { return std::filesystem::path(name).extension() == ".exr"; }

ExrPart read_part(std::string const& name) {
    return is_picture(name) ? read_exr_part(name) : ExrPart{read_checkpoint(name)};
}

// A picture's means have lost which of its light came by camera and which by light paths; a checkpoint's have not.
void check_one_kind(std::vector<std::string> const& names) {
    for (std::string const& name : names)
        if (is_picture(name) != is_picture(names.front()))
            throw InputError({name}, "",
                             fmt::format("is a {} and {} is not: merge pictures or merge checkpoints",
                                         is_picture(name) ? "picture" : "checkpoint", names.front()));
}

void check_go_together(std::vector<std::string> const& names, std::vector<Checkpoint> const& parts) {
    std::vector<Diagnostic> wrong;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            for (std::string const& obstacle : obstacles_to_merging(parts[k], parts[i])) {
                Diagnostic& d = wrong.emplace_back();
                d.where.file = names[i];
                d.message = fmt::format("cannot be merged with {}: {}", names[k], obstacle);
            }
    if (!wrong.empty()) throw InputError(std::move(wrong));
}

int run_merge(Options const& o) {
    std::filesystem::path const out = o.output;
    check_output("--output", out, ".exr");
    std::vector<Checkpoint> parts;
    std::vector<PartLayers> layers;
    check_one_kind(o.parts);
    for (std::string const& name : o.parts) {
        ExrPart part = read_part(name);
        parts.push_back(std::move(part.state));
        layers.push_back(std::move(part.layers));
    }
    output_space(o.colourspace, parts.front().settings.scene_white);  // to refuse an unknown one
    check_go_together(o.parts, parts);
    ExrSettings settings = parts.front().settings;
    settings.colourspace = o.colourspace;
    settings.parts = static_cast<int>(parts.size());
    Film const film = picture_of(merged(parts));
    MergedLayers const beside = merged_layers(parts, layers, film, settings);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (!beside.left_out[i].empty())
            fmt::print(stderr, "note: {}: these channels are left out: {}\n", o.parts[i],
                       fmt::join(beside.left_out[i], ", "));
    write_exr(film, settings, out, beside.layers);
    return exit_done;
}

}  // namespace

Command add_merge(CLI::App& app) {
    CLI::App* const parser =
        app.add_subcommand("merge",
                           "Add up parts of a picture, checkpoints or EXR files, by sample count; EXR files "
                           "with the layers of --aov that all of them have");
    auto const o = std::make_shared<Options>();
    parser->add_option("PARTS", o->parts, "checkpoints, or EXR files: of other seeds, other samples or other crops")
        ->required();
    parser->add_option("-o,--output", o->output, "EXR file to write")->required();
    parser->add_option("--colourspace", o->colourspace, "of the EXR, as for iride render")->capture_default_str();
    return {parser, [o] { return run_merge(*o); }};
}

}  // namespace iride
