// SPDX-License-Identifier: Apache-2.0
// Spectral measurements in the CGATS text form (ANSI CGATS.17 and what instruments write: .ti3, .sp, .txt): one row per
// sample, one field per band, which become one column per sample here.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spectral/catalogue.h"

namespace iride {

// Whether the file has a line BEGIN_DATA_FORMAT.
bool is_cgats(std::vector<std::string> const& lines);

// The first table with spectral fields (SPEC_380, SPECTRAL_NM_380, SPECTRAL_NM380, SPECTRAL_380, NM_380, nm380, R_380,
// R380), or the older pairs SPECTRAL_NM, SPECTRAL_PCT or SPECTRAL_DEC. Wavelengths are SPECTRAL_START_NM ..
// SPECTRAL_END_NM in equal steps if the file gives them with SPECTRAL_BANDS (field names are then rounded), else the
// names' own; values are divided by SPECTRAL_NORM. Columns are called by SAMPLE_NAME, SAMPLE_ID or SAMPLE_LOC,
// whichever first tells the samples apart, else by row. Throws InputError.
SpectrumFile read_cgats(std::filesystem::path const& path, std::vector<std::string> const& lines);

}  // namespace iride
