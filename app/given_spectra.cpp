// SPDX-License-Identifier: Apache-2.0
#include "app/given_spectra.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "base/diagnostics.h"
#include "colour/illuminant.h"
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
    throw InputError({}, name,
                     "holds an index of refraction: a spectral power, reflectance or transmittance is wanted");
}

}  // namespace

std::vector<GivenSpectrum> given_spectra(std::vector<std::string> const& names, std::string const& quantity) {
    std::vector<GivenSpectrum> all;
    for (std::string const& name : names)
        for (GivenSpectrum& s : spectra_of(name, quantity)) all.push_back(std::move(s));
    return all;
}

}  // namespace iride
