// SPDX-License-Identifier: Apache-2.0
#include "film/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace iride {

namespace {

std::string json_text(std::string const& text) {
    std::string out = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", static_cast<int>(c));
        else
            out += c;
    }
    return out + "\"";
}

}  // namespace

std::uint32_t murmur3(std::string const& text) {
    auto const scrambled = [](std::uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; };
    auto const byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    std::uint32_t h = 0;
    std::size_t i = 0;
    for (; i + 4 <= text.size(); i += 4) {
        h ^= scrambled(byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24);
        h = std::rotl(h, 13) * 5 + 0xe6546b64u;
    }
    std::uint32_t rest = 0;
    for (std::size_t k = text.size(); k > i; --k) rest = rest << 8 | byte(k - 1);
    h ^= scrambled(rest);
    h ^= static_cast<std::uint32_t>(text.size());
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

std::uint32_t cryptomatte_id(std::string const& name) {
    std::uint32_t const hash = murmur3(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

float id_as_float(std::uint32_t id) { return std::bit_cast<float>(id); }

std::vector<std::string> cryptomatte_channels(std::string const& layer) {
    std::vector<std::string> names;
    for (std::size_t rank = 0; rank < cryptomatte_ranks; ++rank)
        for (char const* c : rank % 2 == 0 ? std::array{"R", "G"} : std::array{"B", "A"})
            names.push_back(fmt::format("{}{:02}.{}", layer, rank / 2, c));
    return names;
}

std::string cryptomatte_key(std::string const& layer) {
    return fmt::format("cryptomatte/{:.7}/", fmt::format("{:08x}", murmur3(layer)));
}

RankedCoverage ranked(SamplesById const& seen, std::uint32_t samples) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order(seen.begin(), seen.end());
    std::ranges::stable_sort(order, std::ranges::greater{}, &std::pair<std::uint32_t, std::uint32_t>::second);
    RankedCoverage channels{};
    for (std::size_t r = 0; r < std::min(cryptomatte_ranks, order.size()); ++r) {
        channels[2 * r] = id_as_float(order[r].first);
        channels[2 * r + 1] = static_cast<float>(order[r].second) / static_cast<float>(samples);
    }
    return channels;
}

void add_ranked(SamplesById& seen, RankedCoverage const& channels, std::uint32_t samples) {
    for (std::size_t r = 0; r < cryptomatte_ranks; ++r) {
        auto const count = std::lround(static_cast<double>(channels[2 * r + 1]) * samples);
        if (count > 0) seen[std::bit_cast<std::uint32_t>(channels[2 * r])] += static_cast<std::uint32_t>(count);
    }
}

Cryptomatte::Cryptomatte(std::string layer, std::vector<std::string> names, int width, int height)
    : layer_(std::move(layer)), names_(std::move(names)), seen_(width, height) {}

void Cryptomatte::append_to(ExtraLayers& layers, Image<std::uint32_t> const& samples) const {
    std::size_t const first = layers.channels.size(), pixels = seen_.pixel.size();
    for (std::string const& name : cryptomatte_channels(layer_))
        layers.channels.emplace_back(name, std::vector<float>(pixels));
    for (std::size_t p = 0; p < pixels; ++p) {
        SamplesById by_id;  // two objects of one name are one
        for (auto const& [object, count] : seen_.pixel[p])
            by_id[cryptomatte_id(names_[static_cast<std::size_t>(object)])] += count;
        RankedCoverage const here = ranked(by_id, samples.pixel[p]);
        for (std::size_t c = 0; c < here.size(); ++c) layers.channels[first + c].second[p] = here[c];
    }
    std::string manifest = "{";
    std::vector<std::string> sorted = names_;
    std::ranges::sort(sorted);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    for (std::string const& name : sorted)
        manifest +=
            fmt::format("{}{}:\"{:08x}\"", manifest.size() > 1 ? "," : "", json_text(name), cryptomatte_id(name));
    std::string const key = cryptomatte_key(layer_);
    layers.attributes.emplace_back(key + "name", layer_);
    layers.attributes.emplace_back(key + "hash", "MurmurHash3_32");
    layers.attributes.emplace_back(key + "conversion", "uint32_to_float32");
    layers.attributes.emplace_back(key + "manifest", manifest + "}");
}

}  // namespace iride
