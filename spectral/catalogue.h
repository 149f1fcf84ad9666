// SPDX-License-Identifier: Apache-2.0
// The shipped spectra, by name, and spectrum files of the user. A name stands for one quantity ("Au" for an n + ik,
// "D65" for a relative spectral power); data/README.md lists file, quantity, unit, source and licence of each.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics.h"

#include "spectral/complex_index.h"
#include "spectral/spectral_function.h"

namespace iride {

enum class SpectralQuantity {
    power,
    radiance,
    reflectance,
    complex_index,
    matching_functions,
    transmittance,
    absorption
};

// A spectrum file as read: its columns share one wavelength column; a dispersion formula has no columns.
struct SpectrumFile {
    std::filesystem::path path;
    std::string quantity, unit, source;                 // header lines; empty if the format has none
    std::vector<double> wavelength_nm;                  // strictly increasing
    std::map<std::string, std::vector<double>> column;  // e.g. "n", "k", "power", "white", "x", "y", "z"
    std::vector<std::string> column_order;              // as in the file
    std::vector<DispersionShape> formula;               // zero or one
    Summation summation = Summation::interpolated;      // header line "summation"
};

// Read a spectrum file: our CSV (`# key: value` header), any table with or without a row of column names, separated by
// commas, semicolons or blanks (.csv, .spd, .txt), a CGATS table (.ti3, .txt), a refractiveindex.info CSV ("wl,n" and
// "wl,k" blocks in micrometres) or YAML (tabulated n, k, nk; formulas 1, 2 and 4) as it is pasted. Columns over
// different wavelengths meet where they overlap; of a formula with a table of k the formula alone is taken. Throws
// InputError with file:line for anything else: not a number, NaN, unsorted or duplicate wavelengths, a missing or
// repeated column, a formula without an index somewhere in its range, an empty file, a file larger than 64 MiB.
SpectrumFile read_spectrum_file(std::filesystem::path const& path);

// Folder of the shipped data: $IRIDE_DATA if set, else the source tree's data/.
std::filesystem::path data_folder();

// Every name of the catalogue of the given quantity, for messages and listings.
std::vector<std::string> catalogue_names(SpectralQuantity quantity);
bool in_catalogue(std::string const& name);

// What a name of the catalogue, a group of it or a file says it holds, a light's kinds both as `power`: the catalogue's
// column, the header line "quantity" or the columns' names of a file. Absent if nothing says it. Throws InputError:
// neither name nor file (with the nearest name), or a file that cannot be read.
std::optional<SpectralQuantity> stated_quantity(std::string const& name, std::filesystem::path const& folder = {});

// By catalogue name ("Au", "Au:McPeak", "N-BK7", "D65", "cornell:white") or, if `name` is no catalogue name, by path
// (relative to `folder`), a column of a file with several as "file.csv:column". Throws InputError: unknown name (with
// the nearest), wrong quantity, missing file.
ComplexIndex load_complex_index(std::string const& name, std::filesystem::path const& folder = {});
// Where such an index comes from: the file's "source" line, or, if it has none, its path.
std::string index_source(std::string const& name, std::filesystem::path const& folder = {});
SpectralFunction load_spectrum(std::string const& name, SpectralQuantity quantity,
                               std::filesystem::path const& folder = {});
// Several at once: every column of a file, every name of a group of the catalogue ("colorchecker"), or one as above.
std::vector<SpectralFunction> load_spectra(std::string const& name, SpectralQuantity quantity,
                                           std::filesystem::path const& folder = {});

}  // namespace iride
