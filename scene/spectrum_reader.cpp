// SPDX-License-Identifier: Apache-2.0
// Spectra as a scene file gives them: a number, a name, a file, pairs, a blackbody, an RGB.
#include <fmt/format.h>

#include <cmath>

#include "colour/observer.h"
#include "colour/rgb_encoding.h"
#include "colour/rgb_to_spectrum.h"
#include "scene/readers.h"

namespace iride {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
// A table's own rounding may exceed 1 by this much without being an error.
constexpr double reflectance_slack = 1e-9;

std::optional<SpectralFunction> from_name(SceneBuilder& b, JsonValue const& at, std::string const& path,
                                          std::string const& name, SpectrumKind const& kind) {
    std::optional<SpectralFunction> result;
    b.context.guarded(at, path, [&] {
        result = load_spectrum(name, kind.quantity, b.context.folder);
        if (!in_catalogue(name)) b.context.files_read.push_back(b.context.folder / name.substr(0, name.find(':')));
    });
    return result;
}

std::optional<SpectralFunction> from_pairs(SceneBuilder& b, JsonValue const& value, std::string const& path,
                                           SpectrumKind const& kind) {
    JsonArray const* const array = value.as<JsonArray>();
    if (!array || array->empty()) {
        b.context.error(value, path,
                        "found " + value.described() + ", but an array of [wavelength_nm, value] is wanted");
        return std::nullopt;
    }
    TabulatedShape table;
    for (JsonValue const& element : *array) {
        auto const pair = read_numbers(b.context, element, path, 2);
        if (!pair) return std::nullopt;
        if (!table.nm.empty() && (*pair)[0] <= table.nm.back()) {
            b.context.error(element, path,
                            fmt::format("wavelength {} after {}: they must increase", (*pair)[0], table.nm.back()));
            return std::nullopt;
        }
        table.nm.push_back((*pair)[0]);
        table.value.push_back((*pair)[1]);
    }
    return SpectralFunction(std::move(table), kind.outside, "pairs");
}

std::optional<SpectralFunction> from_rgb(SceneBuilder& b, Fields& o, SpectrumKind const& kind) {
    auto const rgb = o.vector("rgb");
    std::vector<std::string> names;
    for (RgbEncoding const& e : rgb_encodings()) names.emplace_back(e.name);
    auto const space = o.choice("space", names);
    if (!space && !o.find("space")) o.error("an 'rgb' needs its 'space'");
    if (!rgb || !space) return std::nullopt;
    RgbEncoding const& encoding = rgb_encoding(*space);
    Eigen::Vector3d const linear = rgb->unaryExpr([&](double v) { return decode(encoding.transfer, v); });
    RgbRole const role = kind.most <= 1 + reflectance_slack ? RgbRole::reflectance : RgbRole::emission;
    std::optional<SpectralFunction> result;
    b.context.guarded(*o.find("rgb"), o.path("rgb"), [&] { result = rgb_to_spectrum(linear, *encoding.space, role); });
    return result;
}

std::optional<SpectralFunction> from_object(SceneBuilder& b, JsonValue const& value, std::string const& path,
                                            SpectrumKind const& kind) {
    Fields o(b.context, value, path);
    JsonValue const *const data = o.find("data"), *const pairs = o.find("pairs"), *const rgb = o.find("rgb");
    JsonValue const* const blackbody = o.find("blackbody_K");
    std::optional<SpectralFunction> result;
    if ((data != nullptr) + (pairs != nullptr) + (rgb != nullptr) + (blackbody != nullptr) != 1) {
        o.error("a spectrum has exactly one of: data, pairs, blackbody_K, rgb");
    } else if (data) {
        if (auto const name = o.text("data")) result = from_name(b, *data, o.path("data"), *name, kind);
    } else if (pairs) {
        result = from_pairs(b, *pairs, o.path("pairs"), kind);
    } else if (blackbody) {
        if (kind.quantity != SpectralQuantity::radiance)
            o.error_at("blackbody_K", "only an emission can be a blackbody");
        else if (auto const T = o.number("blackbody_K", between(100, 1e6)))
            result = SpectralFunction(BlackbodyShape{*T}, Outside::hold, fmt::format("blackbody {} K", *T));
    } else {
        if (kind.quantity == SpectralQuantity::complex_index)
            o.error_at("rgb", "an index of refraction has no RGB");
        else if (kind.quantity == SpectralQuantity::absorption)
            o.error_at("rgb", "an absorption has no RGB: say the colour at a distance, \"absorption\"");
        else
            result = from_rgb(b, o, kind);
    }
    if (auto const s = o.number("scale", at_least(0)); s && result) result = result->scaled(*s);
    if (auto const Y = o.number("luminance_weighted", at_least(0))) {
        if (!kind.may_scale_luminance)
            o.error_at("luminance_weighted", "is for emissions only");
        else if (result && luminance_of(*result) <= 0)
            o.error_at("luminance_weighted", "this spectrum has no luminance");
        else if (result)
            result = luminance_weighted(*result, *Y, cie1931_2deg());
    }
    if (auto const outside = o.choice("outside", {"hold", "zero", "extrapolate", "error"}); outside && result)
        result = result->with_outside(*outside == "hold"          ? Outside::hold
                                      : *outside == "zero"        ? Outside::zero
                                      : *outside == "extrapolate" ? Outside::extrapolate
                                                                  : Outside::error);
    o.finish();
    return result;
}

char const* outside_text(Outside outside) {
    switch (outside) {
        case Outside::hold:
            return "its end value is held";
        case Outside::zero:
            return "it is zero";
        case Outside::extrapolate:
            return "it is extrapolated";
        case Outside::error:
            break;
    }
    return "an error";
}

// Coverage and bounds over the render range.
void check_spectrum(SceneBuilder& b, JsonValue const& at, std::string const& path, SpectralFunction const& s,
                    SpectrumKind const& kind) {
    WavelengthRange const range = b.scene.wavelengths, table = s.defined_on();
    if (!table.contains(range)) {
        std::string const gap = fmt::format("'{}' is given on {:g}..{:g} nm, the render range is {:g}..{:g} nm",
                                            s.name(), table.min_nm, table.max_nm, range.min_nm, range.max_nm);
        if (s.outside() == Outside::error) {
            b.context.error(at, path,
                            gap +
                                "; narrow \"wavelengths_nm\", or say {\"data\": ..., \"outside\": \"hold\" or "
                                "\"extrapolate\"}");
            return;
        }
        b.context.remark(path, gap + ": outside, " + outside_text(s.outside()));
    }
    double const least = s.smallest(range), most = s.largest(range);
    if (!(least >= kind.least && most <= kind.most))
        b.context.error(at, path,
                        fmt::format("values {:g} .. {:g} over the render range, allowed: {}", least, most,
                                    between(kind.least, kind.most == 1 + reflectance_slack ? 1 : kind.most).text()));
}

}  // namespace

SpectrumKind const reflectance_kind{SpectralQuantity::reflectance, Outside::hold, false, 0, 1 + reflectance_slack};
SpectrumKind const emission_kind{SpectralQuantity::radiance, Outside::zero, true, 0, unbounded};
SpectrumKind const transmittance_kind{SpectralQuantity::transmittance, Outside::hold, false, 0, 1 + reflectance_slack};
SpectrumKind const absorption_kind{SpectralQuantity::absorption, Outside::hold, false, 0, unbounded};
SpectrumKind const index_kind{SpectralQuantity::complex_index, Outside::error, false, 0, 1000};

std::optional<SpectralFunction> read_spectrum_value(SceneBuilder& b, JsonValue const& value, std::string const& path,
                                                    SpectrumKind const& kind) {
    std::optional<SpectralFunction> result;
    if (double const* x = value.as<double>())
        result = SpectralFunction::constant(*x);
    else if (std::string const* s = value.as<std::string>())
        result = from_name(b, value, path, *s, kind);
    else if (value.as<JsonObject>())
        result = from_object(b, value, path, kind);
    else
        b.context.error(value, path,
                        "found " + value.described() + ", but a spectrum is a number, a name, a file or an object");
    if (result) check_spectrum(b, value, path, *result, kind);
    return result;
}

std::optional<SpectralFunction> read_spectrum(SceneBuilder& b, Fields& fields, std::string const& key,
                                              SpectrumKind const& kind) {
    JsonValue const* const value = fields.require(key);
    return value ? read_spectrum_value(b, *value, fields.path(key), kind) : std::nullopt;
}

std::optional<ComplexIndex> read_complex_index(SceneBuilder& b, Fields& fields, std::string const& key) {
    JsonValue const* const value = fields.require(key);
    if (!value) return std::nullopt;
    std::string const path = fields.path(key);
    ComplexIndex index;
    if (double const* x = value->as<double>()) {
        index.n = SpectralFunction::constant(*x);
    } else if (has_key(*value, "n")) {
        Fields o(b.context, *value, path);
        auto const n = read_spectrum(b, o, "n", index_kind);
        auto const k = o.find("k") ? read_spectrum(b, o, "k", index_kind) : SpectralFunction::constant(0);
        o.finish();
        if (!n || !k) return std::nullopt;
        return ComplexIndex{*n, *k};
    } else if (has_key(*value, "pairs")) {
        auto const n = from_object(b, *value, path, index_kind);
        if (!n) return std::nullopt;
        index.n = *n;
    } else {
        // A name or file holds both n and k; the object form adds "outside".
        std::optional<std::string> name;
        std::optional<std::string> outside;
        if (std::string const* s = value->as<std::string>())
            name = *s;
        else {
            Fields o(b.context, *value, path);
            o.require("data");
            name = o.text("data");
            outside = o.choice("outside", {"hold", "extrapolate", "error"});
            o.finish();
        }
        if (!name) return std::nullopt;
        bool loaded = false;
        b.context.guarded(*value, path, [&] {
            index = load_complex_index(*name, b.context.folder);
            if (!in_catalogue(*name)) b.context.files_read.push_back(b.context.folder / *name);
            loaded = true;
        });
        if (!loaded) return std::nullopt;
        if (outside && *outside != "error") {
            Outside const o = *outside == "hold" ? Outside::hold : Outside::extrapolate;
            index = {index.n.with_outside(o), index.k.with_outside(o)};
        }
    }
    std::size_t const before = b.context.diagnostics.size();
    check_spectrum(b, *value, path, index.n, {SpectralQuantity::complex_index, Outside::error, false, 1e-3, 1000});
    if (b.context.diagnostics.size() == before) check_spectrum(b, *value, path, index.k, index_kind);
    if (b.context.diagnostics.size() > before) return std::nullopt;
    return index;
}

double luminance_of(SpectralFunction const& radiance) { return cie1931_2deg().integrate(radiance).Y; }

WavelengthRange nonzero_range(SpectralFunction const& emission, WavelengthRange const& within) {
    // To a nanometre, outwards.
    double low = within.max_nm, high = within.min_nm;
    for (double nm = within.min_nm; nm <= within.max_nm; nm += 0.5)
        if (emission.at(nm) > 0) low = std::min(low, nm), high = std::max(high, nm);
    return {std::max(within.min_nm, std::floor(low) - 1), std::min(within.max_nm, std::ceil(high) + 1)};
}

}  // namespace iride
