// SPDX-License-Identifier: Apache-2.0
// A picture read back as a part to be merged. With n_i samples in the mean m_i of part i, and v_i the variance of that
// mean, the sums of its samples and of their squares are
//   n_i m_i   and   n_i ((n_i - 1) v_i + m_i^2),
// so parts add up by their numbers of samples as checkpoints do, to the precision of what the file holds.
#pragma once

#include "film/checkpoint.h"
#include "film/exr_layers.h"

namespace iride {

struct ExrPart {
    Checkpoint state;  // one film; covariances between X, Y and Z are not in the file and are 0
    PartLayers layers{};
};

// Throws InputError for what is no picture of this version of the program, is merged already, or has adaptive samples:
// their numbers follow from what they found, and only a checkpoint keeps its halves apart.
ExrPart read_exr_part(std::filesystem::path const& path);

}  // namespace iride
