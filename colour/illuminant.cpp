// SPDX-License-Identifier: Apache-2.0
#include "colour/illuminant.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/diagnostics.h"
#include "base/vector.h"
#include "spectral/catalogue.h"

namespace iride {

namespace {

double rounded_to_thousandths(double x) { return std::round(x * 1000) / 1000; }

double kelvins(std::string const& name, std::string const& text) {
    double value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw InputError({}, "illuminant", fmt::format("'{}': a number of kelvins is wanted after the colon", name));
    return value;
}

}  // namespace

Chromaticity daylight_chromaticity(double T) {
    constexpr double coldest = 4000, joint = 7000, hottest = 25000;  // K, range of the formulas
    if (!(coldest <= T && T <= hottest))
        throw InputError({}, "illuminant",
                         fmt::format("daylight of {:g} K: allowed is {:g} .. {:g} K", T, coldest, hottest));
    double const x = T <= joint ? -4.6070e9 / (T * T * T) + 2.9678e6 / (T * T) + 0.09911e3 / T + 0.244063
                                : -2.0064e9 / (T * T * T) + 1.9018e6 / (T * T) + 0.24748e3 / T + 0.237040;
    return {x, -3 * square(x) + 2.870 * x - 0.275};
}

SpectralFunction daylight_illuminant(double cct_K) {
    auto const [x, y] = daylight_chromaticity(cct_K);
    double const M = 0.0241 + 0.2562 * x - 0.7341 * y;
    double const M1 = rounded_to_thousandths((-1.3515 - 1.7703 * x + 5.9114 * y) / M);
    double const M2 = rounded_to_thousandths((0.0300 - 31.4424 * x + 30.0717 * y) / M);
    static SpectrumFile const basis = read_spectrum_file(data_folder() / "cie" / "daylight_basis.csv");
    auto const &S0 = basis.column.at("S0"), &S1 = basis.column.at("S1"), &S2 = basis.column.at("S2");
    TabulatedShape sum{basis.wavelength_nm, {}};
    for (std::size_t i = 0; i < S0.size(); ++i) sum.value.push_back(S0[i] + M1 * S1[i] + M2 * S2[i]);
    return SpectralFunction(std::move(sum), Outside::zero, fmt::format("daylight:{:g}", cct_K));
}

SpectralFunction illuminant_a() {
    constexpr double reference_nm = 560;
    BlackbodyShape const body{illuminant_a_temperature.on_scale_of(second_radiation_constant)};
    return SpectralFunction(body, Outside::zero, "A").scaled(100 / planck_radiance(reference_nm, body.temperature_K));
}

SpectralFunction blackbody(double temperature_K) {
    constexpr double hottest = 1e8;  // K: far beyond, Planck's law overflows nothing but says nothing new either
    if (!(0 < temperature_K && temperature_K <= hottest))
        throw InputError({}, "illuminant",
                         fmt::format("blackbody of {:g} K: allowed is above 0, up to {:g} K", temperature_K, hottest));
    return SpectralFunction(BlackbodyShape{temperature_K}, Outside::zero, fmt::format("blackbody:{:g}", temperature_K));
}

SpectralFunction illuminant(std::string const& name, std::filesystem::path const& folder) {
    if (auto const colon = name.find(':'); !in_catalogue(name) && colon != std::string::npos) {
        std::string const family = name.substr(0, colon), rest = name.substr(colon + 1);
        if (family == "daylight") return daylight_illuminant(kelvins(name, rest));
        if (family == "blackbody") return blackbody(kelvins(name, rest));
    }
    SpectralFunction const light = load_spectrum(name, SpectralQuantity::power, folder);
    WavelengthRange const everywhere = light.defined_on();
    if (auto const* table = std::get_if<TabulatedShape>(&light.shape()); table && light.smallest(everywhere) < 0)
        throw InputError({}, name,
                         fmt::format("a spectral power of {:g}: it is not negative", light.smallest(everywhere)));
    return light;
}

}  // namespace iride
