// SPDX-License-Identifier: Apache-2.0
#include "app/given_spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/diagnostics.h"
#include "colour/illuminant.h"
#include "materials/fresnel.h"
#include "spectral/catalogue.h"

namespace iride {

namespace {

constexpr std::array<std::pair<char const*, SpectralQuantity>, 3> quantities{
    {{"power", SpectralQuantity::power},
     {"reflectance", SpectralQuantity::reflectance},
     {"transmittance", SpectralQuantity::transmittance}}};

SpectralQuantity quantity_of(std::string const& name, std::string const& chosen) {
    std::vector<std::string> allowed;
    for (auto const& [word, quantity] : quantities) {
        if (chosen == word) return quantity;
        allowed.emplace_back(word);
    }
    if (!chosen.empty())
        throw InputError({}, "--quantity", fmt::format("unknown quantity '{}'{}", chosen, suggestion(chosen, allowed)));
    bool const spd = std::filesystem::path(name).extension() == ".spd";
    return stated_quantity(name).value_or(spd ? SpectralQuantity::power : SpectralQuantity::reflectance);
}

// What n + ik reflects at normal incidence in air, every nanometre where it is known.
GivenSpectrum normal_incidence(std::string const& name) {
    ComplexIndex const index = load_complex_index(name);
    WavelengthRange const n = index.n.defined_on(), k = index.k.defined_on();
    double const first = std::ceil(std::max({n.min_nm, k.min_nm, visible_range.min_nm})),
                 last = std::floor(std::min({n.max_nm, k.max_nm, visible_range.max_nm}));
    if (!(first < last)) throw InputError({}, name, "is an index of refraction that is not known in the visible");
    TabulatedShape table;
    for (double nm = first; nm <= last; ++nm) {
        table.nm.push_back(nm);
        table.value.push_back(fresnel(1.0, index.n.at(nm), index.k.at(nm)).unpolarised());
    }
    return {SpectralFunction(std::move(table), Outside::hold, name), false, "reflectance at normal incidence"};
}

std::vector<GivenSpectrum> spectra_of(std::string const& name, std::string const& chosen) {
    bool const made = name.starts_with("blackbody:") || name.starts_with("daylight:");
    if (made && !std::filesystem::exists(name)) return {{illuminant(name), true, quantities[0].first}};
    SpectralQuantity const quantity = quantity_of(name, chosen);
    for (auto const& [word, known] : quantities) {
        if (known != quantity) continue;
        std::vector<GivenSpectrum> all;
        for (SpectralFunction& f : load_spectra(name, quantity))
            all.push_back({std::move(f), quantity == SpectralQuantity::power, word});
        return all;
    }
    return {normal_incidence(name)};
}

}  // namespace

std::vector<GivenSpectrum> given_spectra(std::vector<std::string> const& names, std::string const& quantity) {
    std::vector<GivenSpectrum> all;
    for (std::string const& name : names)
        for (GivenSpectrum& s : spectra_of(name, quantity)) all.push_back(std::move(s));
    return all;
}

}  // namespace iride
