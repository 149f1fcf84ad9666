// SPDX-License-Identifier: Apache-2.0
// An EXR read back as a part: its sums are those of the film that was written, to the precision of its floats, whatever
// number of samples each pixel has.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "base/sampler.h"
#include "base/temporary_folder.h"
#include "film/exr_part.h"
#include "spectral/spectrum.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

constexpr Bands bands{{400, 700}, 3};

Film empty() { return Film(3, 2, {1, 2, 5, 4}, cie1931_2deg(), WavelengthGrid::covering(visible_range), bands); }

// Samples [first, last), in pixel (2, 1) only some of them.
void add_samples(Film& film, std::uint32_t first, std::uint32_t last) {
    WavelengthSampler const sampler(visible_range, visible_importance(), WavelengthGrid::covering(visible_range));
    for (std::uint32_t s = first; s < last; ++s)
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) {
                Sampler random(SamplerKind::independent, 9, static_cast<std::uint32_t>(y * 3 + x), s);
                Wavelengths const w = sampler.sample(random.next());
                if (x == 2 && y == 1 && s % 3 == 0)
                    film.reject(x, y, Rejection::negative);
                else
                    film.add(x, y, w, Radiance(1 + 3 * random.next()));
            }
}

ExrSettings settings(std::uint32_t first_sample) {
    ExrSettings s;
    s.scene = "made up";
    s.scene_hash = "0123";
    s.integrator = "path";
    s.exposure = 2;
    s.first_sample = first_sample;
    return s;
}

}  // namespace

// Pixel (2, 1) has rejected samples, which do not count for its weight.
TEST_CASE("parts read from pictures add up to the film of all samples", "[unit]") {
    TemporaryFolder const folder;
    Film whole = empty();
    add_samples(whole, 0, 48);
    std::vector<Checkpoint> parts;
    for (auto const& [first, last] : {std::pair(0u, 16u), {16u, 48u}}) {
        Film part = empty();
        add_samples(part, first, last);
        write_exr(part, settings(first), folder.path() / "part.exr");
        parts.push_back(read_exr_part(folder.path() / "part.exr").state);
    }
    CHECK(obstacles_to_merging(parts[0], parts[1]).empty());
    CHECK(obstacles_to_merging(parts[0], parts[0]).size() == 1);
    std::vector<Film> const films = merged(parts);
    REQUIRE(films.size() == 1);
    Film const& sum = films.front();
    CHECK(sum.place() == whole.place());
    CHECK(sum.rejected() == whole.rejected());
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            CHECK(sum.sample_count(x, y) == whole.sample_count(x, y));
            CHECK(sum.mean(x, y).X == Approx(whole.mean(x, y).X).epsilon(1e-5));
            CHECK(sum.mean(x, y).Z == Approx(whole.mean(x, y).Z).epsilon(1e-5));
            CHECK(sum.variance(x, y).Y == Approx(whole.variance(x, y).Y).epsilon(1e-4));
            for (int b = 0; b < 3; ++b) CHECK(sum.band(x, y, b) == Approx(whole.band(x, y, b)).epsilon(1e-5));
        }
}

TEST_CASE("pictures whose numbers no render gives are refused as parts", "[input]") {
    TemporaryFolder const folder;
    Film film = empty();
    add_samples(film, 1, 3);  // no pixel differs in its number of samples: the file has no such channel of its own
    for (float bad : {-1.0f, 0.5f, std::nanf(""), 1e9f}) {
        ExtraLayers counts;
        counts.channels.emplace_back("count", std::vector<float>{2, 2, 2, 2, bad, 2});
        write_exr(film, settings(1), folder.path() / "a.exr", counts);
        CHECK_THROWS_WITH(read_exr_part(folder.path() / "a.exr"),
                          Contains("a.exr") && Contains("its pixel 4 holds what no render gives"));
    }
    // Nor in its layers.
    for (auto const& [channel, bad] : {std::pair("depth.Z", std::nanf("")),
                                       {"N.X", INFINITY},
                                       {"CryptoObject01.A", 1.5f},
                                       {"group.a.R", -INFINITY}}) {
        ExtraLayers layers;
        layers.channels.emplace_back(channel, std::vector<float>{0, 0, 0, bad, 0, 0});
        write_exr(film, settings(1), folder.path() / "a.exr", layers);
        CHECK_THROWS_WITH(
            read_exr_part(folder.path() / "a.exr"),
            Contains("a.exr") && Contains(fmt::format("its channel {} holds {} in pixel 3", channel, bad)));
    }
}

// Normals are of all samples taken, light of those not rejected: in pixel (2, 1) of 16 and 32, and of 10 and 22. Fails
// with one weight for both.
TEST_CASE("layers weigh as many samples as made them, and others are left out", "[unit]") {
    TemporaryFolder const folder;
    std::vector<Checkpoint> parts;
    std::vector<PartLayers> layers;
    for (auto const& [first, last, value] : {std::tuple(0u, 16u, 1.0f), {16u, 48u, 4.0f}}) {
        Film part = empty();
        add_samples(part, first, last);
        ExtraLayers beside;
        for (char const* channel :
             {"N.W", "N.X", "N.Y", "N.Z", "direct.X", "direct.Y", "direct.Z", "heat.Z", "indirect.R"})
            beside.channels.emplace_back(channel, std::vector<float>(6, value));
        ExrSettings of = settings(first);
        of.colourspace = "XYZ";
        write_exr(part, of, folder.path() / "part.exr", beside);
        ExrPart read = read_exr_part(folder.path() / "part.exr");
        parts.push_back(std::move(read.state));
        layers.push_back(std::move(read.layers));
    }
    ExrSettings of = parts.front().settings;
    of.colourspace = "XYZ";
    MergedLayers const sum = merged_layers(parts, layers, picture_of(merged(parts)), of);
    std::vector<std::string> const others{"N.W", "heat.Z", "indirect.R"};
    CHECK(sum.left_out == std::vector{others, others});
    REQUIRE(sum.layers.channels.size() == 6);
    for (auto const& [channel, values] : sum.layers.channels) {
        INFO(channel);
        CHECK(values[0] == 3);
        CHECK(values[5] == (channel.starts_with("N") ? 3.0f : (10 * 1 + 22 * 4) / 32.0f));
    }
}
