// SPDX-License-Identifier: Apache-2.0
#include "spectral/table_text.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <locale>
#include <sstream>

#include "base/diagnostics.h"

namespace iride::table_text {

void fail(std::filesystem::path const& path, int line, std::string const& message) {
    throw InputError({path.string(), line, line > 0 ? 1 : 0}, "", message);
}

std::string trimmed(std::string const& text) {
    auto const first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::optional<double> to_number(std::string const& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    double x;
    if (!(in >> x) || !(in >> std::ws).eof()) return std::nullopt;
    return x;
}

double number(std::filesystem::path const& path, int line, std::string const& text) {
    auto const x = to_number(text);
    if (!x || !std::isfinite(*x))
        fail(path, line, fmt::format("found '{}', but a finite number is wanted", text.substr(0, 40)));
    return *x;
}

std::vector<std::string> lines_of(std::filesystem::path const& path) {
    constexpr std::uintmax_t largest_file = 64ull << 20;  // bytes
    std::error_code error;
    if (!std::filesystem::exists(path, error)) fail(path, 0, "no such file");
    if (!std::filesystem::is_regular_file(path, error)) fail(path, 0, "is not a regular file");
    if (std::filesystem::file_size(path, error) > largest_file)
        fail(path, 0, fmt::format("larger than {} MiB", largest_file >> 20));
    std::ifstream in(path);
    if (!in) fail(path, 0, "cannot be read");
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    constexpr char const* byte_order_mark = "\xef\xbb\xbf";
    if (!lines.empty() && lines[0].starts_with(byte_order_mark)) lines[0].erase(0, 3);
    return lines;
}

void append_wavelength(std::vector<double>& nm, std::filesystem::path const& path, int line, double next_nm) {
    if (!(next_nm > 0)) fail(path, line, fmt::format("wavelength {}: it must be above 0", next_nm));
    if (!nm.empty() && next_nm == nm.back()) fail(path, line, fmt::format("wavelength {} is there twice", next_nm));
    if (!nm.empty() && next_nm < nm.back())
        fail(path, line, fmt::format("wavelength {} after {}: they must increase", next_nm, nm.back()));
    nm.push_back(next_nm);
}

}  // namespace iride::table_text
