// SPDX-License-Identifier: Apache-2.0
#include "scene/texture_cache.h"

#include <fmt/format.h>

#include <cmath>

#include "base/diagnostics.h"
#include "base/picture.h"
#include "colour/reflectance_table.h"

namespace iride {

namespace {

using RgbLevel = TextureLevel<Eigen::Array3f>;

InputError refusal(std::filesystem::path const& path, std::string const& message) {
    return InputError({path.string()}, "", message);
}

// Calls make(x, y) for every texel of a picture, row by row.
template <class Texel, class Make>
TextureLevel<Texel> level_of(Picture const& picture, Make&& make) {
    TextureLevel<Texel> level{picture.width, picture.height, {}};
    level.texel.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) level.texel.push_back(make(x, y));
    return level;
}

template <class Texel>
TexturePyramid<Texel> pyramid_of(TextureLevel<Texel> level) {
    TexturePyramid<Texel> pyramid;
    pyramid.level.push_back(std::move(level));
    while (pyramid.level.back().width > 1 || pyramid.level.back().height > 1)
        pyramid.level.push_back(halved(pyramid.level.back()));
    return pyramid;
}

void check_finite(std::filesystem::path const& path, Picture const& picture) {
    for (float value : picture.value)
        if (!std::isfinite(value)) throw refusal(path, "holds a texel that is not finite");
}

// Encoded value -> linear light; those of 8 and 16 bits by a table.
class Decoder {
  public:
    Decoder(TransferFunction transfer, bool integers) : transfer_(transfer) {
        if (!integers) return;
        table_.reserve(steps + 1);
        for (int i = 0; i <= steps; ++i) table_.push_back(linear(static_cast<float>(i) / steps));
    }
    float operator()(float value) const {
        return table_.empty() ? linear(value) : table_[static_cast<std::size_t>(std::lround(value * steps))];
    }

  private:
    static constexpr int steps = 65535;
    float linear(float value) const { return static_cast<float>(decode(transfer_, static_cast<double>(value))); }

    TransferFunction transfer_;
    std::vector<float> table_;
};

void check_bounded(std::filesystem::path const& path, RgbLevel const& level) {
    constexpr float slack = 1e-3f;  // half floats near 1 are that far apart
    std::size_t above = 0;
    float most = 0;
    for (Eigen::Array3f const& rgb : level.texel) {
        above += rgb.maxCoeff() > 1 + slack;
        most = std::max(most, rgb.maxCoeff());
    }
    if (above > 0)
        throw refusal(path, fmt::format("{} of {} texels reflect more than 1, up to {:g}; a reflectance is 0 .. 1 (is "
                                        "this a picture of light?)",
                                        above, level.texel.size(), most));
}

ReflectancePicture load_reflectance(std::filesystem::path const& path, RgbEncoding const& encoding) {
    Picture const picture = read_picture(path, {.most_channels = 3});
    check_finite(path, picture);
    Decoder const decoded(encoding.transfer, picture.integers);
    bool const grey = picture.channels < 3;  // a second one is alpha
    RgbLevel level = level_of<Eigen::Array3f>(picture, [&](int x, int y) {
        return Eigen::Array3f(decoded(picture.at(x, y, 0)), decoded(picture.at(x, y, grey ? 0 : 1)),
                              decoded(picture.at(x, y, grey ? 0 : 2)));
    });
    check_bounded(path, level);
    // Colours are averaged as light, and each level then uplifted: coefficients do not average.
    ReflectancePicture result{{}, level.texel.size(), 0, 0};
    for (RgbLevel const& rgb : pyramid_of(std::move(level)).level) {
        UpliftedColours const uplifted = uplift_reflectances(rgb.texel, *encoding.space);
        if (result.pyramid.level.empty()) {
            result.unreachable = uplifted.unreachable;
            result.worst_difference = uplifted.worst_difference;
        }
        auto& sigmoids = result.pyramid.level.emplace_back(TextureLevel<SigmoidTexel>{rgb.width, rgb.height, {}});
        sigmoids.texel.reserve(rgb.texel.size());
        for (auto const& [a, b, c] : uplifted.sigmoid) sigmoids.texel.push_back({a, b, c});
    }
    return result;
}

int channel_number(std::filesystem::path const& path, Picture const& picture, PictureChannel wanted) {
    bool const grey = picture.channels < 3;
    int const alpha = picture.channels == 2 ? 1 : picture.channels == 4 ? 3 : -1;
    if (wanted == PictureChannel::alpha) {
        if (alpha < 0) throw refusal(path, fmt::format("has {} channels and no alpha", picture.channels));
        return alpha;
    }
    if (wanted != PictureChannel::only) {
        if (grey) throw refusal(path, fmt::format("has {} channels: no red, green, blue", picture.channels));
        return static_cast<int>(wanted) - static_cast<int>(PictureChannel::red);
    }
    if (grey) return 0;
    float most = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 1; c < 3; ++c) most = std::max(most, std::abs(picture.at(x, y, c) - picture.at(x, y, 0)));
    if (most > 0)
        throw refusal(path, fmt::format("is a colour picture (its channels differ by up to {:.3g}), but numbers are "
                                        "wanted: say which \"channel\", allowed: red, green, blue, alpha",
                                        most));
    return 0;
}

ScalarPicture load_scalar(std::filesystem::path const& path, PictureChannel wanted) {
    Picture const picture = read_picture(path, {});
    check_finite(path, picture);
    int const channel = channel_number(path, picture, wanted);
    auto level = level_of<float>(picture, [&](int x, int y) { return picture.at(x, y, channel); });
    auto const [least, most] = std::ranges::minmax(level.texel);
    return {pyramid_of(std::move(level)), {least, most}};
}

NormalMap::Pyramid load_normals(std::filesystem::path const& path) {
    Picture const picture = read_picture(path, {.least_channels = 3, .most_channels = 3});
    check_finite(path, picture);
    double length = 0, departure = 0, z = 0;
    auto level = level_of<Eigen::Array3f>(picture, [&](int x, int y) {
        Eigen::Array3f const n(2 * picture.at(x, y, 0) - 1, 2 * picture.at(x, y, 1) - 1, 2 * picture.at(x, y, 2) - 1);
        double const norm = static_cast<double>(n.matrix().norm());
        length += norm, departure += std::abs(norm - 1), z += static_cast<double>(n.z());
        return n;
    });
    auto const count = static_cast<double>(level.texel.size());
    constexpr double allowed = 0.1;  // 8 bits round a length by .005; smooth maps that were scaled down lose some
    if (departure > allowed * count || !(z > 0))
        throw refusal(path, fmt::format("is no map of normals: 2 rgb - 1 has mean length {:.3f} and mean z {:.3f}, the "
                                        "lengths depart from 1 by {:.3f} in the mean, allowed: {}; normals are stored "
                                        "as they are, not encoded as sRGB",
                                        length / count, z / count, departure / count, allowed));
    return pyramid_of(std::move(level));
}

// What is stored under the key, or made by `load` and stored.
template <class Map, class Key, class Load>
auto once(Map& map, Key const& key, Load&& load) {
    auto const found = map.find(key);
    if (found != map.end()) return found->second;
    using Value = std::decay_t<decltype(load())>;
    return map.emplace(key, std::make_shared<Value const>(load())).first->second;
}

}  // namespace

std::shared_ptr<ReflectancePicture const> TextureCache::reflectance(std::filesystem::path const& path,
                                                                    RgbEncoding const& encoding) {
    return once(reflectances_, std::pair(path.lexically_normal().string(), encoding.name),
                [&] { return load_reflectance(path, encoding); });
}
std::shared_ptr<ScalarPicture const> TextureCache::scalar(std::filesystem::path const& path, PictureChannel channel) {
    return once(scalars_, std::pair(path.lexically_normal().string(), channel),
                [&] { return load_scalar(path, channel); });
}
std::shared_ptr<NormalMap::Pyramid const> TextureCache::normals(std::filesystem::path const& path) {
    return once(normals_, path.lexically_normal().string(), [&] { return load_normals(path); });
}

}  // namespace iride
