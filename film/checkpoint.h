// SPDX-License-Identifier: Apache-2.0
// A render's full state in a file, to be gone on with or merged: the sums of every pixel as they are, in double, so
// that what is resumed ends in the same bits as what was never interrupted. Written whole or not at all.
//
// The file is a head of text lines "key: value" that say of what it is, an empty line, the films' pixels (FilmPixel,
// row by row), band sums and splats as the processor holds them, and a hash of all before it: docs/output.md.
#pragma once

#include <filesystem>
#include <vector>

#include "film/exr.h"

namespace iride {

struct Checkpoint {
    ExrSettings settings;     // of what: scene, seed, integrator ...
    std::vector<Film> films;  // one, or the four of adaptive sampling
    int round = 0;            // of adaptive sampling
};

// Throws InputError if the file cannot be written; what was there before then stays.
void write_checkpoint(Checkpoint const& checkpoint, std::filesystem::path const& path);

// Throws InputError: no such file, no checkpoint, of another byte order or number of lanes, truncated, damaged.
Checkpoint read_checkpoint(std::filesystem::path const& path);
bool is_checkpoint(std::filesystem::path const& path);

// What hinders going on from `found` as `wanted`: "key: found, wanted", each; empty if nothing does.
std::vector<std::string> differences(Checkpoint const& found, Checkpoint const& wanted);
// The same for adding up the samples of both: seeds, sample ranges and places in the picture may differ, but no sample
// may be in both.
std::vector<std::string> obstacles_to_merging(Checkpoint const& a, Checkpoint const& b);

// The parts of a picture together: all their samples, film by film, over the smallest window that holds them.
std::vector<Film> merged(std::vector<Checkpoint> const& parts);
// What the films of a checkpoint show together.
Film picture_of(std::vector<Film> const& films);

}  // namespace iride
