// SPDX-License-Identifier: Apache-2.0
// Lights of a scene file that are no shapes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>

#include "base/picture.h"
#include "colour/rec709_basis.h"
#include "colour/rgb_to_spectrum.h"
#include "scene/readers.h"

namespace iride {

namespace {

// A lat-long picture in linear Rec.709. Throws InputError.
EnvironmentPicture read_environment_picture(std::filesystem::path const& path, double scale,
                                            WavelengthGrid const& grid) {
    auto const fail = [&](std::string const& message) { return InputError({path.string()}, "", message); };
    Picture const file =
        read_picture(path, {.scene_linear_only = true, .least_channels = 3, .most_channels = 3, .least_width = 2});
    EnvironmentPicture picture{file.width, file.height, {}, {}, 0};
    picture.texel.resize(file.value.size() / 3);
    std::memcpy(picture.texel.data(), file.value.data(), file.value.size() * sizeof(float));
    double brightest = 0;
    for (auto& texel : picture.texel)
        for (float& c : texel) {
            if (!std::isfinite(c) || c < 0)
                throw fail("holds a texel that is negative or not finite: radiance is neither");
            c *= static_cast<float>(scale);
            brightest = std::max(brightest, static_cast<double>(c));
        }
    if (brightest == 0) throw fail("is black everywhere");
    for (std::size_t k = 0; k < 3; ++k) {
        // The basis times D65 of luminance 1.
        SpectralFunction const &basis = rec709_basis()[k], &light = unit_d65();
        TabulatedShape product;
        for (double nm = visible_range.min_nm; nm <= visible_range.max_nm; ++nm) {
            product.nm.push_back(nm);
            product.value.push_back(basis.at(nm) * light.at(nm));
        }
        picture.basis[k] = Emission(SpectralFunction(std::move(product), Outside::zero), grid);
    }
    return picture;
}

void read_environment(SceneBuilder& b, Fields& f) {
    JsonValue const* const image = f.find("image");
    if (!image) {
        if (!f.find("radiance")) return f.error("an environment has 'radiance' or 'image'");
        auto const radiance = read_spectrum(b, f, "radiance", emission_kind);
        if (!radiance) return;
        double const luminance = luminance_of(*radiance);
        add_light(b, make_constant_environment(Emission(*radiance, b.scene.grid), luminance), "environment", *radiance,
                  luminance);
        return;
    }
    auto const name = f.text("image");
    double const scale = f.number("scale", positive()).value_or(1), rotation = f.number("rotation_deg").value_or(0);
    if (!name) return;
    std::filesystem::path const path = b.context.folder / *name;
    b.context.files_read.push_back(path);
    b.context.guarded(*image, f.path("image"), [&] {
        EnvironmentPicture picture = read_environment_picture(path, scale, b.scene.grid);
        picture.rotation_rad = static_cast<float>(radians(rotation));
        add_light(b, make_picture_environment(std::move(picture)), "environment picture", unit_d65(), 1);
    });
}

void read_point(SceneBuilder& b, Fields& f) {
    Vector const position = b.placed(f.required_vector("position"));
    auto const intensity = read_spectrum(b, f, "intensity", emission_kind);
    if (!intensity) return;
    double const luminance = luminance_of(*intensity);
    Spectrum<dim::spectral_intensity> const I(*intensity, b.scene.grid);
    add_light(b, make_point_light(position, I, luminance), "point", *intensity, luminance);
}

// Barn doors of a lamp with the given beam: limits of angle towards its right (x) and up (y), seen from behind it.
std::optional<SpotFlaps> read_flaps(SceneBuilder& b, Fields& f, VectorDouble const& beam) {
    VectorDouble const up = f.vector("up").value_or(VectorDouble(0, 1, 0)), right = beam.cross(up);
    JsonValue const* const value = f.find("flaps");
    if (!value) return std::nullopt;
    if (!(right.norm() > 1e-6 * up.norm())) {
        f.error("'flaps' need an 'up' that is not parallel to the beam");
        return std::nullopt;
    }
    Fields g(b.context, *value, f.path("flaps"));
    SpotFlaps flaps{right.normalized().cast<float>(), right.cross(beam).normalized().cast<float>(), {}, {}};
    for (auto const& [axis, key] : {std::pair(0, "x_deg"), {1, "y_deg"}}) {
        auto const limits = g.numbers(key, 2);
        double const least = limits ? (*limits)[0] : -90, most = limits ? (*limits)[1] : 90;
        if (!(least >= -90 && least < most && most <= 90))
            g.error_at(key, "allowed: [from, to] in degrees with -90 <= from < to <= 90");
        flaps.least[axis] = static_cast<float>(std::tan(radians(least)));
        flaps.most[axis] = static_cast<float>(std::tan(radians(most)));
    }
    g.finish();
    return flaps;
}

void read_spot(SceneBuilder& b, Fields& f) {
    VectorDouble const position = f.required_vector("position"), target = f.required_vector("target");
    double const end = f.required_number("cone_deg", {.least = 0, .most = 180, .least_excluded = true});
    double const full = f.number("full_deg", between(0, 180)).value_or(0);
    auto const intensity = read_spectrum(b, f, "intensity", emission_kind);
    double const exponent = f.number("exponent", between(0, largest_emission_exponent)).value_or(0);
    VectorDouble const beam = (target - position).normalized();
    auto const flaps = read_flaps(b, f, beam);
    if ((target - position).norm() == 0) return f.error("'position' and 'target' are the same point");
    if (full > end) return f.error("'full_deg' must not be above 'cone_deg'");
    if (!intensity) return;
    double const luminance = luminance_of(*intensity);
    SpotCone const cone{beam.cast<float>(), static_cast<float>(std::cos(radians(full))),
                        static_cast<float>(std::cos(radians(end))), static_cast<float>(exponent), flaps};
    Spectrum<dim::spectral_intensity> const I(*intensity, b.scene.grid);
    add_light(b, make_spot_light(b.placed(position), cone, I, luminance), "spot", *intensity, luminance);
}

void read_distant(SceneBuilder& b, Fields& f) {
    VectorDouble const direction = f.required_vector("direction");
    auto const irradiance = read_spectrum(b, f, "irradiance", emission_kind);
    if (direction.norm() == 0) return f.error_at("direction", "the direction has length 0");
    if (!irradiance) return;
    double const luminance = luminance_of(*irradiance);
    Spectrum<dim::spectral_irradiance> const E(*irradiance, b.scene.grid);
    add_light(b, make_distant_light(direction.normalized().cast<float>(), E, luminance), "distant", *irradiance,
              luminance);
}

constexpr std::array<LightEntry, 4> table{{
    {"environment", "from infinity: constant radiance or a lat-long picture", read_environment},
    {"point", "position, intensity", read_point},
    {"spot", "position, target, cone, intensity", read_spot},
    {"distant", "direction, irradiance", read_distant},
}};

}  // namespace

std::span<LightEntry const> light_entries() { return table; }

std::string read_light_group(Fields& f) {
    constexpr std::size_t longest = 64;
    std::string const group = f.text("group").value_or("");
    bool const is_good =
        std::ranges::all_of(group, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
    if (!f.find("group") || (is_good && !group.empty() && group.size() <= longest)) return group;
    f.error_at("group", fmt::format("found '{}', allowed: 1 .. {} letters, digits, '_' and '-', as in a channel's name",
                                    group, longest));
    return {};
}

int add_light(SceneBuilder& b, std::unique_ptr<Light> light, std::string const& type, SpectralFunction const& spectrum,
              double luminance) {
    b.lights.push_back(std::move(light));
    b.scene.light_descriptions.push_back({type, spectrum, nonzero_range(spectrum, b.scene.wavelengths), luminance});
    return static_cast<int>(b.lights.size()) - 1;
}

void read_lights(SceneBuilder& b, JsonValue const& value, std::string const& path) {
    JsonArray const* const array = value.as<JsonArray>();
    if (!array)
        return b.context.error(value, path, "found " + value.described() + ", but an array of lights is wanted");
    for (std::size_t i = 0; i < array->size(); ++i) {
        Fields f(b.context, (*array)[i], fmt::format("{}[{}]", path, i));
        LightEntry const* const entry = find_entry(f, light_entries());
        if (!entry) continue;
        std::size_t const first = b.scene.light_descriptions.size();
        std::string const group = read_light_group(f);
        entry->reader(b, f);
        for (std::size_t k = first; k < b.scene.light_descriptions.size(); ++k)
            b.scene.light_descriptions[k].group = group;
        f.finish();
    }
}

}  // namespace iride
