// SPDX-License-Identifier: Apache-2.0
// A picture on a surface: texels in levels of half the size each, and how uv finds them.
//   texel coordinates   x = u' w - 1/2,  y = (1 - v') h - 1/2  with  (u', v') = scale (u, v) + offset; row 0 is the
//   top, v = 1 level               log2 of the shorter axis of the ray's footprint in texels; linear between two levels
// The longer axis, at grazing angles, is left to the samples of the pixel: nothing is blurred across. [Williams 1983]
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/surface_point.h"

namespace iride {

enum class Wrap { repeat, clamp, mirror };
enum class TextureFilter { trilinear, bilinear, nearest };  // the last two look at the picture itself alone

struct TextureMapping {
    Vector2 scale{1, 1}, offset{0, 0};
    Wrap wrap = Wrap::repeat;
    TextureFilter filter = TextureFilter::trilinear;

    Vector2 place(Vector2 const& uv) const { return uv.cwiseProduct(scale) + offset; }
};

template <class Texel>
struct TextureLevel {
    int width = 0, height = 0;
    std::vector<Texel> texel;  // [height][width], row 0 at v = 1

    Texel const& at(int x, int y) const {
        return texel[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

// The next level: each texel the mean of what it covers, so that the mean of the picture stays. Texel needs + and *.
template <class Texel>
TextureLevel<Texel> halved(TextureLevel<Texel> const& fine) {
    struct Share {
        int first;
        float weight[3];  // of texels first, first + 1, first + 2
    };
    auto const shares = [](int size, int half) {
        std::vector<Share> all;
        double const step = static_cast<double>(size) / half;  // 1 .. 3
        for (int i = 0; i < half; ++i) {
            double const begin = i * step, end = begin + step;
            Share s{static_cast<int>(begin), {}};
            for (int k = 0; k < 3; ++k)
                s.weight[k] = static_cast<float>(
                    std::max(0.0, std::min(end, s.first + k + 1.0) - std::max(begin, s.first + k + 0.0)) / step);
            all.push_back(s);
        }
        return all;
    };
    TextureLevel<Texel> coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    coarse.texel.reserve(static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height));
    auto const columns = shares(fine.width, coarse.width), rows = shares(fine.height, coarse.height);
    for (Share const& row : rows)
        for (Share const& column : columns) {
            Texel sum = fine.at(column.first, row.first) * (column.weight[0] * row.weight[0]);
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i) {
                    float const weight = column.weight[i] * row.weight[j];
                    if (i + j > 0 && weight > 0) sum = sum + fine.at(column.first + i, row.first + j) * weight;
                }
            coarse.texel.push_back(sum);
        }
    return coarse;
}

template <class Texel>
struct TexturePyramid {
    std::vector<TextureLevel<Texel>> level;  // from the picture itself down to one texel

    // Calls visit(texel, weight) for the texels that make the value at `point`; the weights sum to 1.
    template <class Visit>
    void visit_texels(SurfacePoint const& point, TextureMapping const& mapping, Visit&& visit) const {
        Vector2 const place = mapping.place(point.uv);
        if (mapping.filter == TextureFilter::nearest) return visit(nearest(place, mapping.wrap), 1.0f);
        float const wanted = mapping.filter == TextureFilter::trilinear ? level_of(point, mapping) : 0;
        auto const fine = static_cast<std::size_t>(wanted);
        float const coarser = wanted - static_cast<float>(fine);
        visit_level(level[fine], place, mapping.wrap, 1 - coarser, visit);
        if (coarser > 0) visit_level(level[fine + 1], place, mapping.wrap, coarser, visit);
    }

    // 0 .. the last level.
    float level_of(SurfacePoint const& point, TextureMapping const& mapping) const {
        Vector2 const texels = mapping.scale.cwiseProduct(
            Vector2(static_cast<float>(level[0].width), static_cast<float>(level[0].height)));
        float const shorter2 = std::min(point.across_ray.cwiseProduct(texels).squaredNorm(),
                                        point.along_ray.cwiseProduct(texels).squaredNorm());
        if (!(shorter2 > 1)) return 0;
        return std::min(0.5f * std::log2(shorter2), static_cast<float>(level.size() - 1));
    }

    // Into 0 .. 1; the fraction of a large u is kept before it is multiplied by the size.
    static float wrapped(float u, Wrap wrap) {
        if (wrap == Wrap::repeat) return u - std::floor(u);
        if (wrap == Wrap::clamp) return std::clamp(u, 0.0f, 1.0f);
        float const t = u - 2 * std::floor(u / 2);
        return t > 1 ? 2 - t : t;
    }

  private:
    static int index(int i, int size, Wrap wrap) {
        if (wrap == Wrap::repeat) return i < 0 ? size - 1 : i < size ? i : 0;
        return std::clamp(i, 0, size - 1);
    }

    Texel const& nearest(Vector2 const& place, Wrap wrap) const {
        auto const& l = level[0];
        auto const pick = [](float u, int size) {
            return std::clamp(static_cast<int>(u * static_cast<float>(size)), 0, size - 1);
        };
        return l.at(pick(wrapped(place.x(), wrap), l.width), pick(1 - wrapped(place.y(), wrap), l.height));
    }

    template <class Visit>
    static void visit_level(TextureLevel<Texel> const& l, Vector2 const& place, Wrap wrap, float weight,
                            Visit&& visit) {
        float const x = wrapped(place.x(), wrap) * static_cast<float>(l.width) - 0.5f;
        float const y = (1 - wrapped(place.y(), wrap)) * static_cast<float>(l.height) - 0.5f;
        float const left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
        int const i = static_cast<int>(left), j = static_cast<int>(top);
        int const x0 = index(i, l.width, wrap), x1 = index(i + 1, l.width, wrap);
        int const y0 = index(j, l.height, wrap), y1 = index(j + 1, l.height, wrap);
        visit(l.at(x0, y0), weight * (1 - fx) * (1 - fy));
        visit(l.at(x1, y0), weight * fx * (1 - fy));
        visit(l.at(x0, y1), weight * (1 - fx) * fy);
        visit(l.at(x1, y1), weight * fx * fy);
    }
};

}  // namespace iride
