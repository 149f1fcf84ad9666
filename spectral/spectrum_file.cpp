// SPDX-License-Identifier: Apache-2.0
// Reading spectrum files: our CSV, plain tables, and refractiveindex.info's CSV and YAML as they are pasted.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "spectral/catalogue.h"

namespace iride {

namespace {

constexpr std::uintmax_t largest_file = 64ull << 20;  // bytes
constexpr double nm_per_micrometre = 1000;

[[noreturn]] void fail(std::filesystem::path const& path, int line, std::string const& message) {
    throw InputError(Diagnostic{{path.string(), line, line > 0 ? 1 : 0}, "", message});
}

std::string trimmed(std::string const& s) {
    auto const first = s.find_first_not_of(" \t\r"), last = s.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : s.substr(first, last - first + 1);
}

// Cells of a line, separated by commas, semicolons or blanks.
std::vector<std::string> cells(std::string const& line) {
    std::vector<std::string> result;
    bool const by_blanks = line.find_first_of(",;") == std::string::npos;
    std::string cell;
    std::istringstream in(line);
    if (by_blanks) {
        while (in >> cell) result.push_back(cell);
        return result;
    }
    for (char c : line + ",") {
        if (c == ',' || c == ';')
            result.push_back(trimmed(cell)), cell.clear();
        else
            cell += c;
    }
    return result;
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

void append_wavelength(SpectrumFile& file, int line, double nm) {
    auto& all = file.wavelength_nm;
    if (!(nm > 0)) fail(file.path, line, fmt::format("wavelength {}: it must be above 0", nm));
    if (!all.empty() && nm == all.back()) fail(file.path, line, fmt::format("wavelength {} is there twice", nm));
    if (!all.empty() && nm < all.back())
        fail(file.path, line, fmt::format("wavelength {} after {}: they must increase", nm, all.back()));
    all.push_back(nm);
}

std::vector<std::string> lines_of(std::filesystem::path const& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) fail(path, 0, "no such file");
    if (std::filesystem::file_size(path, error) > largest_file)
        fail(path, 0, fmt::format("larger than {} MiB", largest_file >> 20));
    std::ifstream in(path);
    if (!in) fail(path, 0, "cannot be read");
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

// "# formula: sellmeier: n^2 - 1 = c0 + sum c[2i+1] L^2/(L^2 - c[2i+2]^2) ..." -> which of the three.
std::optional<DispersionShape::Formula> formula_kind(std::string const& text) {
    if (text.starts_with("general")) return DispersionShape::Formula::general;
    if (!text.starts_with("sellmeier")) return std::nullopt;
    return text.find("c[2i+2]^2") != std::string::npos ? DispersionShape::Formula::sellmeier_squared
                                                       : DispersionShape::Formula::sellmeier;
}

// Header "# key: value" lines; what is left is the table.
struct Header {
    std::string formula, valid_nm;
};
void read_header_line(SpectrumFile& file, Header& header, std::string const& line) {
    auto const colon = line.find(':');
    if (colon == std::string::npos) return;
    std::string const key = trimmed(line.substr(1, colon - 1)), value = trimmed(line.substr(colon + 1));
    if (key == "quantity")
        file.quantity = value;
    else if (key == "unit")
        file.unit = value;
    else if (key == "source")
        file.source = value;
    else if (key == "formula")
        header.formula = value;
    else if (key == "valid_nm")
        header.valid_nm = value;
}

void finish_formula(SpectrumFile& file, Header const& header) {
    auto const kind = formula_kind(header.formula);
    auto const range = cells(header.valid_nm);
    if (!kind || range.size() != 2)
        fail(file.path, 0, "a formula needs '# formula: sellmeier|general ...' and '# valid_nm: from,to'");
    WavelengthRange const valid{number(file.path, 0, range[0]), number(file.path, 0, range[1])};
    file.formula.push_back({*kind, file.column["coefficient"], valid});
    file.wavelength_nm.clear();
    file.column.clear();
    file.column_order.clear();
}

// Wavelengths of refractiveindex.info's CSV ("wl") are micrometres; every other table is nanometres.
SpectrumFile read_table(std::filesystem::path const& path, std::vector<std::string> const& lines) {
    SpectrumFile file{path, {}, {}, {}, {}, {}, {}, {}};
    Header header;
    double to_nm = 1;
    std::vector<std::string> names;
    std::size_t second_block_row = 0;
    bool second_block = false;
    int line_number = 0;
    for (std::string const& raw : lines) {
        ++line_number;
        std::string const line = trimmed(raw);
        if (line.empty()) continue;
        if (line[0] == '#') {
            read_header_line(file, header, line);
            continue;
        }
        auto const cell = cells(line);
        if (!to_number(cell[0])) {
            // A row of column names; a second one begins refractiveindex.info's block of k over the same wavelengths.
            if (cell.size() < 2)
                fail(path, line_number,
                     fmt::format("found '{}', but columns of numbers are wanted", line.substr(0, 40)));
            second_block = !names.empty();
            if (second_block && second_block_row != 0) fail(path, line_number, "a third block of columns");
            if (cell[0] == "wl") to_nm = nm_per_micrometre;
            if (second_block)
                names.resize(1), names[0] = cell[1];
            else
                names.assign(cell.begin() + 1, cell.end());
            for (std::string const& n : names) file.column_order.push_back(n);
            continue;
        }
        if (names.empty()) {
            for (std::size_t i = 1; i < cell.size(); ++i)
                names.push_back(cell.size() == 2 ? "value" : fmt::format("value{}", i));
            file.column_order = names;
        }
        if (cell.size() < names.size() + 1)
            fail(path, line_number, fmt::format("found {} columns, but {} are wanted", cell.size(), names.size() + 1));
        double const nm = number(path, line_number, cell[0]) * to_nm;
        if (second_block) {
            if (second_block_row >= file.wavelength_nm.size() ||
                std::abs(nm - file.wavelength_nm[second_block_row]) > 1e-6)
                fail(path, line_number, "the second block must have the wavelengths of the first");
            ++second_block_row;
        } else if (header.formula.empty()) {
            append_wavelength(file, line_number, nm);
        }
        for (std::size_t i = 0; i < names.size(); ++i)
            file.column[names[i]].push_back(number(path, line_number, cell[i + 1]));
    }
    if (file.column.empty()) fail(path, 0, "holds no rows of numbers");
    if (second_block && second_block_row != file.wavelength_nm.size())
        fail(path, line_number, "the second block is shorter than the first");
    if (!header.formula.empty()) finish_formula(file, header);
    return file;
}

std::vector<double> numbers_of(std::filesystem::path const& path, std::string const& text) {
    std::vector<double> all;
    std::istringstream in(text);
    for (std::string word; in >> word;) all.push_back(number(path, 0, word));
    return all;
}

void read_yaml_table(SpectrumFile& file, std::string const& type, std::string const& data) {
    std::vector<std::string> const names = type == "tabulated nk"  ? std::vector<std::string>{"n", "k"}
                                           : type == "tabulated n" ? std::vector<std::string>{"n"}
                                                                   : std::vector<std::string>{"k"};
    std::istringstream in(data);
    for (std::string line; std::getline(in, line);) {
        auto const row = numbers_of(file.path, line);
        if (row.empty()) continue;
        if (row.size() != names.size() + 1) fail(file.path, 0, fmt::format("{} row with {} numbers", type, row.size()));
        append_wavelength(file, 0, row[0] * nm_per_micrometre);
        for (std::size_t i = 0; i < names.size(); ++i) file.column[names[i]].push_back(row[i + 1]);
    }
    file.column_order = names;
}

// refractiveindex.info: DATA is a list of entries; the first that gives n counts.
SpectrumFile read_yaml(std::filesystem::path const& path) {
    SpectrumFile file{path, {}, {}, {}, {}, {}, {}, {}};
    try {
        YAML::Node const root = YAML::LoadFile(path.string());
        if (root["REFERENCES"]) file.source = root["REFERENCES"].as<std::string>();
        for (YAML::Node const& entry : root["DATA"]) {
            auto const type = entry["type"].as<std::string>();
            if (type == "tabulated nk" || type == "tabulated n" || (type == "tabulated k" && file.formula.empty())) {
                if (file.wavelength_nm.empty()) read_yaml_table(file, type, entry["data"].as<std::string>());
            } else if (type == "formula 1" || type == "formula 2" || type == "formula 4") {
                auto const range = numbers_of(
                    path, (entry["wavelength_range"] ? entry["wavelength_range"] : entry["range"]).as<std::string>());
                if (range.size() != 2) fail(path, 0, "wavelength_range wants two numbers");
                auto const kind = type == "formula 1"   ? DispersionShape::Formula::sellmeier_squared
                                  : type == "formula 2" ? DispersionShape::Formula::sellmeier
                                                        : DispersionShape::Formula::general;
                file.formula.push_back({kind,
                                        numbers_of(path, entry["coefficients"].as<std::string>()),
                                        {range[0] * nm_per_micrometre, range[1] * nm_per_micrometre}});
                if (file.formula.back().coefficients.size() < 3)
                    fail(path, 0, "a formula needs at least three coefficients");
            } else if (type != "tabulated k") {
                fail(path, 0, fmt::format("DATA of type '{}'; allowed: tabulated n, k, nk, formula 1, 2, 4", type));
            }
        }
    } catch (YAML::Exception const& e) {
        fail(path, e.mark.line + 1, fmt::format("not the YAML of refractiveindex.info: {}", e.msg));
    }
    if (file.formula.empty() && file.wavelength_nm.empty()) fail(path, 0, "holds no DATA");
    return file;
}

}  // namespace

SpectrumFile read_spectrum_file(std::filesystem::path const& path) {
    std::vector<std::string> const lines = lines_of(path);
    if (path.extension() == ".yml" || path.extension() == ".yaml") return read_yaml(path);
    return read_table(path, lines);
}

}  // namespace iride
