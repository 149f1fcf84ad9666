// SPDX-License-Identifier: Apache-2.0
#include "film/exr_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/diagnostics.h"
#include "base/numbers_in_text.h"

namespace iride {

namespace {

// The facts of a picture, asked for by key.
class Facts {
  public:
    Facts(std::filesystem::path const& path, XyzPicture const& picture) : path_(path), fact_(picture.facts) {}

    [[noreturn]] void refuse(std::string message) const { throw InputError({path_.string()}, "", std::move(message)); }
    bool has(std::string const& key) const { return fact_.contains(key); }
    std::string const& text(std::string const& key) const {
        auto const found = fact_.find(key);
        if (found == fact_.end())
            refuse(fmt::format("is no picture of this program: it has no attribute 'iride:{}'", key));
        return found->second;
    }
    template <class Number>
    std::vector<Number> numbers(std::string const& key, std::size_t count) const {
        std::string const& value = text(key);
        auto all = numbers_in<Number>(value, count);
        if (!all)
            refuse(fmt::format("its attribute 'iride:{}' is '{}', allowed: {}", key, value,
                               count == 1 ? "a number" : fmt::format("{} numbers", count)));
        return std::move(*all);
    }
    template <class Number>
    Number number(std::string const& key) const {
        return numbers<Number>(key, 1).front();
    }

  private:
    std::filesystem::path path_;
    std::map<std::string, std::string> const& fact_;
};

void check_kind(Facts const& facts, XyzPicture const& picture) {
    if (facts.text("version") != IRIDE_VERSION)
        facts.refuse(
            fmt::format("was written by version {}; this is version {}", facts.text("version"), IRIDE_VERSION));
    if (facts.has("adaptive"))
        facts.refuse("has adaptive samples, whose numbers follow from what they found: merge the checkpoints instead");
    if (facts.has("parts"))
        facts.refuse(fmt::format("is merged already, of {} parts: merge all parts at once", facts.text("parts")));
    if (facts.text("observer") != cie1931_2deg().name)
        facts.refuse(fmt::format("its observer is {}, allowed: {}", facts.text("observer"), cie1931_2deg().name));
    FilmPlace const& p = picture.place;
    if (p.x0 < 0 || p.y0 < 0 || p.x0 + picture.xyz.width > p.picture_width ||
        p.y0 + picture.xyz.height > p.picture_height)
        facts.refuse("its data window is not within its display window");
    if (picture.variance.pixel.empty()) facts.refuse("has no channels variance.X, variance.Y and variance.Z");
}

std::optional<Bands> bands_of(Facts const& facts, XyzPicture const& picture) {
    if (picture.bands.empty()) return std::nullopt;
    auto const n = facts.numbers<double>("bands", 3);
    Bands const bands{{n[1], n[2]}, static_cast<int>(picture.bands.size())};
    if (n[0] != bands.count || !(n[1] < n[2]))
        facts.refuse(
            fmt::format("its attribute 'iride:bands' is '{}', and it has {} bands", facts.text("bands"), bands.count));
    return bands;
}

bool is_finite(Xyz const& c) { return std::isfinite(c.X) && std::isfinite(c.Y) && std::isfinite(c.Z); }

// A pixel's sums; absent if no render gives such values.
std::optional<FilmPixel> pixel_of(Xyz const& mean, Xyz const& variance, double count, double each) {
    constexpr double most = 1 << 24;
    bool const known = count < 2 || (is_finite(variance) && std::min({variance.X, variance.Y, variance.Z}) >= 0);
    if (!(count >= 0 && count <= most && count == std::floor(count)) || !is_finite(mean) || !known) return std::nullopt;
    MatrixDouble covariance = MatrixDouble::Zero();
    covariance.diagonal() = to_vector(variance);
    return FilmPixel::of(mean, covariance, static_cast<std::uint32_t>(count), each);
}

void fill(Film& film, XyzPicture const& picture, Facts const& facts) {
    auto const of_all = static_cast<double>(facts.number<int>("spp"));
    double const each = facts.number<double>("weight");
    if (!(each > 0 && std::isfinite(each)))
        facts.refuse(fmt::format("its attribute 'iride:weight' is {}, allowed: a number above 0", each));
    std::size_t const bands = picture.bands.size();
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        double const count = picture.count.pixel.empty() ? of_all : static_cast<double>(picture.count.pixel[i]);
        auto const pixel =
            pixel_of((1 / picture.exposure) * picture.xyz.pixel[i], picture.variance.pixel[i], count, each);
        if (!pixel) facts.refuse(fmt::format("its pixel {} holds what no render gives", i));
        film.pixels()[i] = *pixel;
        for (std::size_t b = 0; b < bands; ++b)
            film.band_sums()[i * bands + b] = pixel->weight * static_cast<double>(picture.bands[b].second.pixel[i]);
    }
    // The file says how many samples were rejected for which cause, not where: in pixels that miss as many.
    auto pixel = film.pixels().begin();
    for (std::size_t cause = 0; cause < rejection_names.size(); ++cause) {
        auto left = facts.number<std::uint32_t>(fmt::format("rejected.{}", rejection_names[cause]));
        for (; left > 0 && pixel != film.pixels().end(); pixel += left > 0 ? 1 : 0) {
            auto const missing = static_cast<std::uint32_t>(std::max(0.0, of_all - pixel->taken()));
            std::uint32_t const here = std::min(left, missing);
            pixel->rejected[cause] += here;
            left -= here;
        }
        film.pixels().front().rejected[cause] += left;
    }
}

}  // namespace

ExrPart read_exr_part(std::filesystem::path const& path) {
    XyzPicture picture = read_exr_as_xyz(path, is_of_layer);
    Facts const facts(path, picture);
    check_kind(facts, picture);
    ExrSettings of;
    of.scene = facts.text("scene");
    of.scene_hash = facts.text("sceneHash");
    of.integrator = facts.text("integrator");
    of.sampler = facts.text("sampler");
    of.seed = facts.number<std::uint64_t>("seed");
    of.first_sample = facts.number<std::uint32_t>("firstSample");
    of.exposure = picture.exposure;
    of.scene_white = picture.white;
    of.half = picture.half;
    Film film(picture.xyz.width, picture.xyz.height, picture.place, cie1931_2deg(),
              WavelengthGrid::covering(visible_range), bands_of(facts, picture));
    fill(film, picture, facts);
    std::vector<Film> films;
    films.push_back(std::move(film));
    PartLayers layers{std::move(picture.layers), picture.rgb, std::move(picture.other_channels)};
    if (auto const wrong = impossible_value(layers)) facts.refuse(*wrong);
    return {{of, std::move(films), 0}, std::move(layers)};
}

}  // namespace iride
