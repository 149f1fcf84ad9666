// SPDX-License-Identifier: Apache-2.0
#include "film/exr_layers.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <span>

#include "film/cryptomatte.h"

namespace iride {

namespace {

using Names = std::vector<std::string>;
using Planes = std::vector<std::vector<float>>;
constexpr float infinite = std::numeric_limits<float>::infinity();

// A part's pixel of one layer.
struct Here {
    std::vector<std::vector<float> const*> const& planes;
    MatrixDouble const& to_output;  // of its colour
    FilmPixel const& pixel;
    std::size_t index;
    float operator[](std::size_t channel) const { return (*planes[channel])[index]; }
};
using Covering = std::vector<Here>;  // the parts' pixels at one place, in the order of their first samples

std::uint32_t samples_in_mean(FilmPixel const& pixel) { return pixel.count; }

// The rules: each fills pixel `to` of a merged layer.
template <std::uint32_t weight(FilmPixel const&)>
void mean(Covering const& parts, Planes& out, std::size_t to) {
    VectorDouble sum = VectorDouble::Zero();
    double total = 0;
    for (Here const& here : parts) {
        double const w = weight(here.pixel);
        sum += w * (here.to_output * VectorDouble(here[0], here[1], here[2]));
        total += w;
    }
    for (std::size_t c = 0; c < 3; ++c)
        out[c][to] = total > 0 ? static_cast<float>(sum[static_cast<Eigen::Index>(c)] / total) : 0;
}

void nearest(Covering const& parts, Planes& out, std::size_t to) {
    out[0][to] = infinite;
    for (Here const& here : parts)
        if (here[0] < out[0][to])
            for (std::size_t c = 0; c < out.size(); ++c) out[c][to] = here[c];
}

void ranked_again(Covering const& parts, Planes& out, std::size_t to) {
    SamplesById seen;
    std::uint32_t samples = 0;
    for (Here const& here : parts) {
        RankedCoverage channels;
        for (std::size_t c = 0; c < channels.size(); ++c) channels[c] = here[c];
        add_ranked(seen, channels, first_hits(here.pixel));
        samples += first_hits(here.pixel);
    }
    RankedCoverage const all = ranked(seen, samples);
    for (std::size_t c = 0; c < all.size(); ++c) out[c][to] = all[c];
}

enum class Holds { depth, position, vectors, albedo, light, coverage };
struct Kind {
    std::string_view layer;  // its name, or with a dot at the end how it begins
    Holds holds;
    void (*rule)(Covering const&, Planes&, std::size_t);
};
constexpr std::array<Kind, 10> kinds{{
    {"depth", Holds::depth, nearest},
    {"position", Holds::position, nearest},
    {"N", Holds::vectors, mean<first_hits>},
    {"Ng", Holds::vectors, mean<first_hits>},
    {"albedo", Holds::albedo, mean<first_hits>},
    {"direct", Holds::light, mean<samples_in_mean>},
    {"indirect", Holds::light, mean<samples_in_mean>},
    {"group.", Holds::light, mean<samples_in_mean>},
    {"CryptoMaterial", Holds::coverage, ranked_again},
    {"CryptoObject", Holds::coverage, ranked_again},
}};

Kind const* kind_of(std::string const& layer) {
    auto const found = std::ranges::find_if(
        kinds, [&](Kind const& k) { return k.layer.ends_with('.') ? layer.starts_with(k.layer) : layer == k.layer; });
    return found == kinds.end() ? nullptr : &*found;
}

// "N" of "N.X", "group.lamp" of "group.lamp.R", "CryptoObject" of "CryptoObject00.R".
std::string layer_of(std::string const& channel) {
    std::string layer = channel.substr(0, channel.rfind('.'));
    if (layer.starts_with("Crypto")) layer.erase(layer.find_last_not_of("0123456789") + 1);
    return layer;
}

// What a layer is made of, in a file whose colours are RGB or not; positions want to know the depth.
Names channels_of(std::string const& layer, bool rgb) {
    Holds const holds = kind_of(layer)->holds;
    if (holds == Holds::coverage) return cryptomatte_channels(layer);
    if (holds == Holds::depth) return {layer + ".Z"};
    Names names;
    if (holds == Holds::position) names.emplace_back("depth.Z");
    for (char const c : std::string_view(rgb && (holds == Holds::albedo || holds == Holds::light) ? "RGB" : "XYZ"))
        names.push_back(layer + "." + c);
    return names;
}

// Absent if the part has none of that name.
std::vector<float> const* plane(PartLayers const& part, std::string const& channel) {
    auto const found =
        std::ranges::find(part.read.channels, channel, &std::pair<std::string, std::vector<float>>::first);
    return found == part.read.channels.end() ? nullptr : &found->second;
}

std::set<std::string> layers_of(PartLayers const& part) {
    std::set<std::string> layers;
    for (auto const& channel : part.read.channels) {
        std::string const layer = layer_of(channel.first);
        if (std::ranges::all_of(channels_of(layer, part.rgb.has_value()),
                                [&](std::string const& name) { return plane(part, name) != nullptr; }))
            layers.insert(layer);
    }
    return layers;
}

// Name, manifest and so on of a Cryptomatte layer; other layers have none.
std::vector<std::pair<std::string, std::string>> attributes_of(std::string const& layer, PartLayers const& part) {
    std::vector<std::pair<std::string, std::string>> found;
    std::ranges::copy_if(part.read.attributes, std::back_inserter(found), [&](auto const& attribute) {
        return kind_of(layer)->holds == Holds::coverage && attribute.first.starts_with(cryptomatte_key(layer));
    });
    return found;
}

std::set<std::string> common_layers(std::vector<PartLayers> const& parts) {
    std::set<std::string> common = layers_of(parts.front());
    for (PartLayers const& part : parts) {
        std::set<std::string> const here = layers_of(part);
        std::erase_if(common, [&](std::string const& layer) {
            return !here.contains(layer) || attributes_of(layer, part) != attributes_of(layer, parts.front());
        });
    }
    return common;
}

Names left_out(PartLayers const& part, std::set<std::string> const& merged) {
    std::set<std::string> used;
    for (std::string const& layer : merged)
        for (std::string& name : channels_of(layer, part.rgb.has_value())) used.insert(std::move(name));
    Names names;
    std::ranges::copy_if(part.channels, std::back_inserter(names),
                         [&](std::string const& channel) { return !used.contains(channel); });
    return names;
}

class Merging {
  public:
    Merging(std::vector<Checkpoint> const& parts, std::vector<PartLayers> const& layers, Film const& whole,
            ExrSettings const& settings)
        : parts_(parts), layers_(layers), whole_(whole), settings_(settings), order_(parts.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::ranges::stable_sort(order_, {}, [&](std::size_t i) { return parts[i].settings.first_sample; });
    }

    void append(std::string const& layer, ExtraLayers& merged) const {
        Kind const& kind = *kind_of(layer);
        std::vector<std::vector<std::vector<float> const*>> planes(parts_.size());
        std::vector<MatrixDouble> to_output;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            to_output.push_back(to_output_matrix(kind.holds, i));
            for (std::string const& name : channels_of(layer, layers_[i].rgb.has_value()))
                planes[i].push_back(plane(layers_[i], name));
        }
        Planes out(planes.front().size(), std::vector<float>(whole_.pixels().size()));
        Covering covering;
        std::size_t to = 0;
        for (int y = 0; y < whole_.height(); ++y)
            for (int x = 0; x < whole_.width(); ++x) {
                covering.clear();
                for (std::size_t const i : order_)
                    if (auto const index = index_in(i, x, y))
                        covering.push_back({planes[i], to_output[i], parts_[i].films.front().pixels()[*index], *index});
                kind.rule(covering, out, to++);
            }
        Names const names = channels_of(layer, output_space(settings_.colourspace, settings_.scene_white).rgb);
        for (std::size_t c = kind.holds == Holds::position ? 1 : 0; c < names.size(); ++c)
            merged.channels.emplace_back(names[c], std::move(out[c]));
        std::ranges::copy(attributes_of(layer, layers_.front()), std::back_inserter(merged.attributes));
    }

  private:
    // What takes a part's colours to the merged file's; 1 for what is no colour.
    MatrixDouble to_output_matrix(Holds holds, std::size_t part) const {
        if (holds != Holds::albedo && holds != Holds::light) return MatrixDouble::Identity();
        ExrSettings const& from = parts_[part].settings;
        bool const light = holds == Holds::light;
        Chromaticity const day = named_white("D65");
        MatrixDouble const to_xyz = xyz_of_output(layers_[part].rgb, light ? from.scene_white : day);
        OutputSpace const output = output_space(settings_.colourspace, light ? settings_.scene_white : day);
        return (light ? settings_.exposure / from.exposure : 1) * output.from_xyz * to_xyz;
    }

    // Where a part has the whole's pixel (x, y), if it covers it.
    std::optional<std::size_t> index_in(std::size_t part, int x, int y) const {
        Film const& film = parts_[part].films.front();
        x += whole_.place().x0 - film.place().x0;
        y += whole_.place().y0 - film.place().y0;
        if (x < 0 || y < 0 || x >= film.width() || y >= film.height()) return std::nullopt;
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width()) + static_cast<std::size_t>(x);
    }

    std::vector<Checkpoint> const& parts_;
    std::vector<PartLayers> const& layers_;
    Film const& whole_;
    ExrSettings const& settings_;
    std::vector<std::size_t> order_;  // of the parts, by their first samples
};

}  // namespace

bool is_of_layer(std::string const& channel) { return kind_of(layer_of(channel)) != nullptr; }

std::optional<std::string> impossible_value(PartLayers const& part) {
    for (auto const& [channel, values] : part.read.channels) {
        Holds const holds = kind_of(layer_of(channel))->holds;
        bool const share = holds == Holds::coverage && (channel.back() == 'G' || channel.back() == 'A');
        auto const possible = [&](float v) {
            return share ? v >= 0 && v <= 1 : std::isfinite(v) || (holds == Holds::depth && v == infinite);
        };
        auto const wrong = std::ranges::find_if_not(values, possible);
        if (wrong != values.end())
            return fmt::format("its channel {} holds {} in pixel {}, which no render gives", channel, *wrong,
                               wrong - values.begin());
    }
    return std::nullopt;
}

MergedLayers merged_layers(std::vector<Checkpoint> const& parts, std::vector<PartLayers> const& layers,
                           Film const& whole, ExrSettings const& settings) {
    std::set<std::string> const common = common_layers(layers);
    MergedLayers merged;
    for (PartLayers const& part : layers) merged.left_out.push_back(left_out(part, common));
    Merging const merging(parts, layers, whole, settings);
    for (std::string const& layer : common) merging.append(layer, merged.layers);
    return merged;
}

}  // namespace iride
