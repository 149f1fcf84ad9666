// SPDX-License-Identifier: Apache-2.0
#include "film/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

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

Cryptomatte::Cryptomatte(std::string layer, std::vector<std::string> names, int width, int height)
    : layer_(std::move(layer)), names_(std::move(names)), seen_(width, height) {}

void Cryptomatte::append_to(ExtraLayers& layers, Image<std::uint32_t> const& samples) const {
    std::size_t const first = layers.channels.size(), pixels = seen_.pixel.size();
    for (int rank = 0; rank < ranks; ++rank)
        for (char const* c : rank % 2 == 0 ? std::array{"R", "G"} : std::array{"B", "A"})
            layers.channels.emplace_back(fmt::format("{}{:02}.{}", layer_, rank / 2, c), std::vector<float>(pixels));
    for (std::size_t p = 0; p < pixels; ++p) {
        std::map<std::uint32_t, std::uint32_t> by_id;  // two objects of one name are one
        for (auto const& [object, count] : seen_.pixel[p])
            by_id[cryptomatte_id(names_[static_cast<std::size_t>(object)])] += count;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> ranked(by_id.begin(), by_id.end());
        std::ranges::stable_sort(ranked, std::ranges::greater{}, &std::pair<std::uint32_t, std::uint32_t>::second);
        for (std::size_t r = 0; r < std::min<std::size_t>(ranks, ranked.size()); ++r) {
            layers.channels[first + 2 * r].second[p] = id_as_float(ranked[r].first);
            layers.channels[first + 2 * r + 1].second[p] =
                static_cast<float>(ranked[r].second) / static_cast<float>(samples.pixel[p]);
        }
    }
    std::string manifest = "{";
    std::vector<std::string> sorted = names_;
    std::ranges::sort(sorted);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    for (std::string const& name : sorted)
        manifest +=
            fmt::format("{}{}:\"{:08x}\"", manifest.size() > 1 ? "," : "", json_text(name), cryptomatte_id(name));
    std::string const key = fmt::format("cryptomatte/{:.7}/", fmt::format("{:08x}", murmur3(layer_)));
    layers.attributes.emplace_back(key + "name", layer_);
    layers.attributes.emplace_back(key + "hash", "MurmurHash3_32");
    layers.attributes.emplace_back(key + "conversion", "uint32_to_float32");
    layers.attributes.emplace_back(key + "manifest", manifest + "}");
}

}  // namespace iride
