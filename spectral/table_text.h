// SPDX-License-Identifier: Apache-2.0
// What the readers of spectrum files share: the lines of a file, numbers in them, and complaints with file and line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace iride::table_text {

// Throws InputError at a line that counts from 1; line 0 is the file as a whole.
[[noreturn]] void fail(std::filesystem::path const& path, int line, std::string const& message);

// Without blanks, tabs and carriage returns at both ends.
std::string trimmed(std::string const& text);

// A number that is the whole text, in the classic locale; absent for anything else.
std::optional<double> to_number(std::string const& text);
// The same, finite, or InputError.
double number(std::filesystem::path const& path, int line, std::string const& text);

// The lines of a regular file of at most 64 MiB, without a byte order mark. Throws InputError.
std::vector<std::string> lines_of(std::filesystem::path const& path);

// The next wavelength of a table: above 0 and above the one before. Throws InputError.
void append_wavelength(std::vector<double>& nm, std::filesystem::path const& path, int line, double next_nm);

}  // namespace iride::table_text
