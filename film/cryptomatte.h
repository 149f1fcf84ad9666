// SPDX-License-Identifier: Apache-2.0
// Which objects a pixel shows, and how much of each: Cryptomatte layers [Friedman 2015],
// specification 1.2. An id is the 32-bit MurmurHash3 of a name, as a float whose exponent is kept from denormals,
// infinities and NaN; a pixel has its ids in the order of their coverage, two in each layer's R G B A: id, coverage,
// id, coverage.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "film/exr.h"

namespace iride {

// MurmurHash3_x86_32 with seed 0.
std::uint32_t murmur3(std::string const& text);
// The id of a name: its hash with an exponent of neither 0 nor 255, and as the float with these bits.
std::uint32_t cryptomatte_id(std::string const& name);
float id_as_float(std::uint32_t id);

// A layer's channels: two of each rank; and what the names of its attributes begin with.
inline constexpr std::size_t cryptomatte_ranks = 6;
std::vector<std::string> cryptomatte_channels(std::string const& layer);
std::string cryptomatte_key(std::string const& layer);

// A pixel: how many of its samples showed each id, and what its channels say of that.
using SamplesById = std::map<std::uint32_t, std::uint32_t>;
using RankedCoverage = std::array<float, 2 * cryptomatte_ranks>;  // id, coverage, id, coverage ...
RankedCoverage ranked(SamplesById const& seen, std::uint32_t samples);
// The inverse: samples that these channels tell of, `samples` in all, are added.
void add_ranked(SamplesById& seen, RankedCoverage const& channels, std::uint32_t samples);

class Cryptomatte {
  public:
    // `layer`: "CryptoMaterial", e.g.; `names`: of all objects there are, for the manifest.
    Cryptomatte(std::string layer, std::vector<std::string> names, int width, int height);
    // One more sample of a pixel that shows an object, by its number in `names`; different pixels at the same time.
    void add(int x, int y, int object) { ++seen_.at(x, y)[object]; }
    // Coverage is over `samples` of each pixel, those included that showed nothing.
    void append_to(ExtraLayers& layers, Image<std::uint32_t> const& samples) const;

  private:
    std::string layer_;
    std::vector<std::string> names_;
    Image<std::map<int, std::uint32_t>> seen_;
};

}  // namespace iride
