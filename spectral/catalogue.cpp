// SPDX-License-Identifier: Apache-2.0
#include "spectral/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "base/diagnostics.h"

namespace iride {

namespace {

struct Entry {
    std::string file, column;  // column "nk": n and k
};

[[noreturn]] void fail(std::string const& message) { throw InputError({}, "", message); }

// catalogue.csv, read once.
std::map<std::string, Entry> const& catalogue() {
    static std::map<std::string, Entry> const entries = [] {
        std::map<std::string, Entry> all;
        std::filesystem::path const path = data_folder() / "catalogue.csv";
        std::ifstream in(path);
        if (!in) fail("the shipped data are missing: " + path.string());
        for (std::string line; std::getline(in, line);) {
            auto const first = line.find(','), second = line.rfind(',');
            if (line.empty() || line[0] == '#' || first == second || line.starts_with("name,")) continue;
            all[line.substr(0, first)] = {line.substr(first + 1, second - first - 1), line.substr(second + 1)};
        }
        return all;
    }();
    return entries;
}

bool is_index(std::string const& column) { return column == "nk" || column == "n" || column == "k"; }

char const* described(SpectralQuantity quantity) {
    switch (quantity) {
        case SpectralQuantity::complex_index:
            return "index of refraction";
        case SpectralQuantity::reflectance:
            return "reflectance";
        case SpectralQuantity::power:
            return "spectral power";
        case SpectralQuantity::radiance:
            return "radiance";
        case SpectralQuantity::matching_functions:
            return "set of matching functions";
        case SpectralQuantity::transmittance:
            return "transmittance";
        case SpectralQuantity::absorption:
            return "absorption coefficient";
    }
    return "";
}

// Illuminants and radiances serve as emissions alike.
bool serves(std::string const& column, SpectralQuantity quantity) {
    bool const emission = column == "power" || column == "radiance";
    if (quantity == SpectralQuantity::complex_index) return is_index(column);
    if (quantity == SpectralQuantity::power || quantity == SpectralQuantity::radiance) return emission;
    if (quantity == SpectralQuantity::absorption) return false;
    return !emission && !is_index(column);
}

std::string unknown(std::string const& name, char const* wanted, std::vector<std::string> const& candidates) {
    std::string const near = nearest_name(name, candidates);
    return fmt::format(
        "'{}' is neither a shipped {} nor a file{}", name, wanted,
        near.empty() ? std::string("; data/README.md lists the names") : fmt::format("; did you mean '{}'?", near));
}

std::string unknown(std::string const& name, SpectralQuantity quantity) {
    return unknown(name, described(quantity), catalogue_names(quantity));
}

// The path of a file named as "file" or "file:column"; `column` is empty for the former.
std::pair<std::filesystem::path, std::string> file_and_column(std::string const& name,
                                                              std::filesystem::path const& folder) {
    auto const colon = name.rfind(':');
    if (std::filesystem::exists(folder / name) || colon == std::string::npos) return {folder / name, ""};
    return {folder / name.substr(0, colon), name.substr(colon + 1)};
}

std::optional<SpectralQuantity> quantity_of_column(std::string const& column) {
    if (is_index(column)) return SpectralQuantity::complex_index;
    if (column == "power" || column == "radiance") return SpectralQuantity::power;
    if (column == "transmittance") return SpectralQuantity::transmittance;
    if (column == "reflectance") return SpectralQuantity::reflectance;
    return {};
}

std::optional<SpectralQuantity> quantity_of_file(SpectrumFile const& file) {
    if (!file.formula.empty() || file.column.contains("k")) return SpectralQuantity::complex_index;
    for (auto const& [word, quantity] : {std::pair{"reflect", SpectralQuantity::reflectance},
                                         {"transmit", SpectralQuantity::transmittance},
                                         {"power", SpectralQuantity::power},
                                         {"radian", SpectralQuantity::power},
                                         {"emission", SpectralQuantity::power}})
        if (file.quantity.find(word) != std::string::npos) return quantity;
    return file.column_order.size() == 1 ? quantity_of_column(file.column_order.front()) : std::nullopt;
}

TabulatedShape table_of(SpectrumFile const& file, std::string const& column) {
    auto const found = file.column.find(column);
    if (found == file.column.end())
        throw InputError({file.path.string()}, "",
                         fmt::format("no column '{}'{}", column, suggestion(column, file.column_order)));
    return {file.wavelength_nm, found->second, false, file.summation};
}

Outside outside_of(SpectralQuantity quantity) {
    switch (quantity) {
        case SpectralQuantity::complex_index:
            return Outside::error;
        case SpectralQuantity::reflectance:
        case SpectralQuantity::transmittance:
        case SpectralQuantity::absorption:
            return Outside::hold;
        default:
            return Outside::zero;
    }
}

// The file that holds an index of refraction.
std::filesystem::path index_path(std::string const& name, std::filesystem::path const& folder) {
    auto const entry = catalogue().find(name);
    if (entry != catalogue().end()) {
        if (!is_index(entry->second.column)) fail(fmt::format("'{}' is no index of refraction", name));
        if (entry->second.column == "k") fail(fmt::format("'{}' holds k alone, but n and k are wanted", name));
        return data_folder() / entry->second.file;
    }
    if (!std::filesystem::exists(folder / name)) fail(unknown(name, SpectralQuantity::complex_index));
    return folder / name;
}

}  // namespace

std::filesystem::path data_folder() {
    char const* const chosen = std::getenv("IRIDE_DATA");
    return chosen && *chosen ? chosen : IRIDE_DATA_DIR;
}

std::vector<std::string> catalogue_names(SpectralQuantity quantity) {
    std::vector<std::string> names;
    for (auto const& [name, entry] : catalogue())
        if (serves(entry.column, quantity) && entry.column != "k") names.push_back(name);
    return names;
}

bool in_catalogue(std::string const& name) { return catalogue().contains(name); }

std::optional<SpectralQuantity> stated_quantity(std::string const& name, std::filesystem::path const& folder) {
    for (auto const& [known, entry] : catalogue())
        if (known == name || (known.starts_with(name + ":") && !std::filesystem::exists(folder / name) &&
                              !is_index(entry.column) && !serves(entry.column, SpectralQuantity::power)))
            return quantity_of_column(entry.column).value_or(SpectralQuantity::reflectance);
    std::filesystem::path const path = file_and_column(name, folder).first;
    if (!std::filesystem::exists(path)) {
        std::vector<std::string> names;
        for (auto const& [known, entry] : catalogue()) names.push_back(known);
        fail(unknown(name, "spectrum", names));
    }
    return quantity_of_file(read_spectrum_file(path));
}

ComplexIndex load_complex_index(std::string const& name, std::filesystem::path const& folder) {
    SpectrumFile const file = read_spectrum_file(index_path(name, folder));
    ComplexIndex index;
    if (!file.formula.empty()) {
        index.n = SpectralFunction(file.formula.front(), Outside::error, name);
        return index;
    }
    index.n = SpectralFunction(table_of(file, "n"), Outside::error, name);
    if (file.column.contains("k")) index.k = SpectralFunction(table_of(file, "k"), Outside::error, name);
    return index;
}

std::string index_source(std::string const& name, std::filesystem::path const& folder) {
    std::filesystem::path const path = index_path(name, folder);
    std::string const source = read_spectrum_file(path).source;
    return source.empty() ? path.string() : source;
}

SpectralFunction load_spectrum(std::string const& name, SpectralQuantity quantity,
                               std::filesystem::path const& folder) {
    Outside const outside = outside_of(quantity);
    if (auto const entry = catalogue().find(name); entry != catalogue().end()) {
        if (!serves(entry->second.column, quantity)) fail(fmt::format("'{}' is no {}", name, described(quantity)));
        if (entry->second.column == "nk") fail(fmt::format("'{}' holds n and k, but one of them is wanted", name));
        SpectrumFile const file = read_spectrum_file(data_folder() / entry->second.file);
        if (!file.formula.empty()) return SpectralFunction(file.formula.front(), outside, name);
        return SpectralFunction(table_of(file, entry->second.column), outside, name);
    }
    auto const [path, column] = file_and_column(name, folder);
    if (!std::filesystem::exists(path)) fail(unknown(name, quantity));
    SpectrumFile const file = read_spectrum_file(path);
    if (!file.formula.empty()) return SpectralFunction(file.formula.front(), outside, name);
    if (column.empty() && file.column_order.size() != 1)
        throw InputError({path.string()}, "",
                         fmt::format("holds {} columns: choose one as '{}:{}'", file.column_order.size(), name,
                                     file.column_order.front()));
    return SpectralFunction(table_of(file, column.empty() ? file.column_order.front() : column), outside, name);
}

std::vector<SpectralFunction> load_spectra(std::string const& name, SpectralQuantity quantity,
                                           std::filesystem::path const& folder) {
    std::vector<SpectralFunction> all;
    if (std::filesystem::is_regular_file(folder / name) && !in_catalogue(name)) {
        SpectrumFile const file = read_spectrum_file(folder / name);
        if (file.column_order.size() > 1)
            for (std::string const& column : file.column_order)
                all.emplace_back(table_of(file, column), outside_of(quantity), column);
    } else if (!in_catalogue(name)) {
        for (std::string const& member : catalogue_names(quantity))
            if (member.starts_with(name + ":")) all.push_back(load_spectrum(member, quantity));
    }
    if (all.empty()) all.push_back(load_spectrum(name, quantity, folder));
    return all;
}

}  // namespace iride
