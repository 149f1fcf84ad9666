// SPDX-License-Identifier: Apache-2.0
// Reading spectrum files: our CSV, plain tables, and refractiveindex.info's CSV and YAML as they are pasted. CGATS
// tables have a reader of their own.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

#include "spectral/catalogue.h"
#include "spectral/cgats.h"
#include "spectral/table_text.h"

namespace iride {

using namespace table_text;

namespace {

constexpr double nm_per_micrometre = 1000;

// Cells of a line, separated by semicolons if it has one (a comma is then no separator), else by commas, else by
// blanks.
std::vector<std::string> cells(std::string const& line) {
    std::vector<std::string> result;
    char const separator = line.find(';') != std::string::npos ? ';' : ',';
    std::string cell;
    std::istringstream in(line);
    if (line.find(separator) == std::string::npos)
        while (in >> cell) result.push_back(cell);
    else
        for (std::istringstream row(line + separator); std::getline(row, cell, separator);)
            result.push_back(trimmed(cell));
    return result;
}

// Columns over the same wavelengths.
struct Block {
    std::vector<std::string> names;
    std::vector<double> nm;
    std::vector<std::vector<double>> values;  // [column][row]
};

void append_row(Block& block, std::filesystem::path const& path, int line, std::vector<double> const& row,
                double to_nm) {
    append_wavelength(block.nm, path, line, row[0] * to_nm);
    block.values.resize(block.names.size());
    for (std::size_t i = 0; i < block.names.size(); ++i) block.values[i].push_back(row[i + 1]);
}

// Blocks over different wavelengths meet on the knots of all of them, where they overlap: linear interpolation leaves
// the functions as they are.
void join(SpectrumFile& file, std::vector<Block> const& blocks) {
    double from = 0, to = std::numeric_limits<double>::infinity();
    std::set<double> knots;
    for (Block const& block : blocks) {
        if (block.nm.empty()) fail(file.path, 0, fmt::format("no rows of {}", fmt::join(block.names, ", ")));
        from = std::max(from, block.nm.front());
        to = std::min(to, block.nm.back());
        knots.insert(block.nm.begin(), block.nm.end());
    }
    if (!(from <= to)) fail(file.path, 0, "its columns have no wavelength in common");
    for (double nm : knots)
        if (from <= nm && nm <= to) file.wavelength_nm.push_back(nm);
    for (Block const& block : blocks)
        for (std::size_t i = 0; i < block.names.size(); ++i) {
            if (file.column.contains(block.names[i]))
                fail(file.path, 0, fmt::format("column '{}' is there twice", block.names[i]));
            SpectralFunction const function(TabulatedShape{block.nm, block.values[i]}, Outside::hold);
            std::vector<double>& column = file.column[block.names[i]];
            if (block.nm == file.wavelength_nm)
                column = block.values[i];  // to the bit
            else
                for (double nm : file.wavelength_nm) column.push_back(function.at(nm));
            file.column_order.push_back(block.names[i]);
        }
}

// "# formula: sellmeier: n^2 - 1 = c0 + sum c[2i+1] L^2/(L^2 - c[2i+2]^2) ..." -> which of the three.
std::optional<DispersionShape::Formula> formula_kind(std::string const& text) {
    if (text.starts_with("general")) return DispersionShape::Formula::general;
    if (!text.starts_with("sellmeier")) return std::nullopt;
    return text.find("c[2i+2]^2") != std::string::npos ? DispersionShape::Formula::sellmeier_squared
                                                       : DispersionShape::Formula::sellmeier;
}

// A formula that gives an index everywhere it claims to.
DispersionShape checked_formula(std::filesystem::path const& path, int line, DispersionShape shape) {
    std::size_t const count = shape.coefficients.size();
    bool const general = shape.formula == DispersionShape::Formula::general;
    if (general ? count != 5 && (count < 9 || count % 2 == 0) : count < 3 || count % 2 == 0)
        fail(path, line,
             fmt::format("a formula with {} coefficients, allowed: {}", count,
                         general ? "5, 9, 11, 13, ..." : "3, 5, 7, ..."));
    if (!(0 < shape.valid.min_nm && shape.valid.min_nm < shape.valid.max_nm))
        fail(path, line,
             fmt::format("a formula for {} .. {} nm: the range must be above 0 and increase", shape.valid.min_nm,
                         shape.valid.max_nm));
    SpectralFunction const n(shape, Outside::error);
    constexpr int steps = 1000;
    for (int i = 0; i <= steps; ++i) {
        double const nm = shape.valid.min_nm + shape.valid.width() * i / steps;
        if (!(n.at(nm) > 0) || !std::isfinite(n.at(nm)))
            fail(path, line, fmt::format("the formula gives no index at {:g} nm, within its range", nm));
    }
    return shape;
}

// Header "# key: value" lines; what is left is the table.
struct Header {
    std::string formula, valid_nm;
    int formula_line = 0, valid_line = 0;
};
Summation summation_of(std::filesystem::path const& path, int line, std::string const& text) {
    if (text == "tabulated") return Summation::tabulated;
    if (text == "interpolated") return Summation::interpolated;
    fail(path, line, fmt::format("unknown summation '{}'{}", text, suggestion(text, {"tabulated", "interpolated"})));
}
void read_header_line(SpectrumFile& file, Header& header, int line_number, std::string const& line) {
    auto const colon = line.find(':');
    if (colon == std::string::npos) return;
    std::string const key = trimmed(line.substr(1, colon - 1)), value = trimmed(line.substr(colon + 1));
    if (key == "quantity")
        file.quantity = value;
    else if (key == "unit")
        file.unit = value;
    else if (key == "source")
        file.source = value;
    else if (key == "summation")
        file.summation = summation_of(file.path, line_number, value);
    else if (key == "formula")
        header.formula = value, header.formula_line = line_number;
    else if (key == "valid_nm")
        header.valid_nm = value, header.valid_line = line_number;
}

// Rows "index, coefficient" under "# formula:" and "# valid_nm:".
void finish_formula(SpectrumFile& file, Header const& header,
                    std::vector<std::pair<int, std::vector<double>>> const& rows) {
    auto const kind = formula_kind(header.formula);
    auto const range = cells(header.valid_nm);
    if (!kind || range.size() != 2)
        fail(file.path, header.formula_line,
             "a formula needs '# formula: sellmeier|general ...' and '# valid_nm: from,to'");
    WavelengthRange const valid{number(file.path, header.valid_line, range[0]),
                                number(file.path, header.valid_line, range[1])};
    std::vector<double> coefficients;
    for (auto const& [line, row] : rows) {
        if (row.size() != 2 || row[0] != static_cast<double>(coefficients.size()))
            fail(file.path, line, fmt::format("coefficient {} is wanted: 'index,coefficient'", coefficients.size()));
        coefficients.push_back(row[1]);
    }
    file.formula.push_back(checked_formula(file.path, header.formula_line, {*kind, coefficients, valid}));
}

// A row of names: no cell is a number. It begins the table or, with the same first name, another block of it.
bool is_heading(std::vector<std::string> const& row) {
    return std::ranges::none_of(row, [](std::string const& c) { return to_number(c).has_value(); });
}

// Reads the rows below the header into blocks; wavelengths of refractiveindex.info's CSV ("wl") are micrometres, those
// of every other table nanometres.
class TableReader {
  public:
    TableReader(std::filesystem::path const& path, bool has_wavelengths)
        : path_(path), has_wavelengths_(has_wavelengths) {}

    void add(int line, std::vector<std::string> const& row) {
        bool const starts = !has_first_row_ || row[0] == first_name_;
        if (starts && is_heading(row))
            begin_block(line, row);
        else
            add_numbers(line, row);
        has_first_row_ = true;
    }
    std::vector<Block> const& blocks() const { return blocks_; }
    std::vector<std::pair<int, std::vector<double>>> const& rows() const { return rows_; }

  private:
    void begin_block(int line, std::vector<std::string> const& row) {
        if (row.size() < 2)
            fail(path_, line, fmt::format("found '{}', but columns of numbers are wanted", row[0].substr(0, 40)));
        first_name_ = row[0];
        if (first_name_ == "wl") to_nm_ = nm_per_micrometre;
        blocks_.push_back({{row.begin() + 1, row.end()}, {}, {}});
    }
    void add_numbers(int line, std::vector<std::string> const& row) {
        if (row.size() < 2) fail(path_, line, "found 1 column, but a wavelength and a value are wanted");
        if (blocks_.empty()) {
            blocks_.emplace_back();
            for (std::size_t i = 1; i < row.size(); ++i)
                blocks_[0].names.push_back(row.size() == 2 ? "value" : fmt::format("value{}", i));
        }
        Block& block = blocks_.back();
        std::vector<double> numbers;
        for (std::string const& cell : row) numbers.push_back(number(path_, line, cell));
        if (row.size() != block.names.size() + 1)
            fail(path_, line, fmt::format("found {} columns, but {} are wanted", row.size(), block.names.size() + 1));
        if (has_wavelengths_) append_row(block, path_, line, numbers, to_nm_);
        rows_.emplace_back(line, std::move(numbers));
    }

    std::filesystem::path const& path_;
    bool has_wavelengths_, has_first_row_ = false;
    std::string first_name_;
    double to_nm_ = 1;
    std::vector<Block> blocks_;
    std::vector<std::pair<int, std::vector<double>>> rows_;
};

SpectrumFile read_table(std::filesystem::path const& path, std::vector<std::string> const& lines) {
    SpectrumFile file;
    file.path = path;
    Header header;
    std::vector<std::pair<int, std::vector<std::string>>> table;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::string const line = trimmed(lines[i]);
        int const line_number = static_cast<int>(i) + 1;
        if (line.empty()) continue;
        if (line[0] == '#')
            read_header_line(file, header, line_number, line);
        else
            table.emplace_back(line_number, cells(line));
    }
    bool const is_formula = !header.formula.empty();
    TableReader reader(path, !is_formula);
    for (auto const& [line, row] : table) reader.add(line, row);
    if (reader.rows().empty()) fail(path, 0, "holds no rows of numbers");
    if (is_formula) {
        finish_formula(file, header, reader.rows());
        return file;
    }
    join(file, reader.blocks());
    constexpr double shortest_nm = 20;  // below, every medium is all but empty space: such a table is in micrometres
    if (file.wavelength_nm.back() < shortest_nm)
        fail(path, table.back().first,
             fmt::format("wavelengths up to {:g}: nanometres are wanted, or the heading 'wl' for micrometres",
                         file.wavelength_nm.back()));
    return file;
}

// A text of a YAML file with the line on which it begins.
struct YamlText {
    std::string text;
    int line;
};
YamlText yaml_text(YAML::Node const& node, std::vector<std::string> const& lines) {
    YamlText const result{node.as<std::string>(), node.Mark().line + 1};
    // The mark of a block stands at its '|', a line above the text.
    auto const line = static_cast<std::size_t>(node.Mark().line), column = static_cast<std::size_t>(node.Mark().column);
    bool const is_block = line < lines.size() && column < lines[line].size() && lines[line][column] == '|';
    return {result.text, result.line + (is_block ? 1 : 0)};
}

std::vector<double> numbers_of(std::filesystem::path const& path, int line, std::string const& text) {
    std::vector<double> all;
    std::istringstream in(text);
    for (std::string word; in >> word;) all.push_back(number(path, line, word));
    return all;
}

Block read_yaml_table(std::filesystem::path const& path, std::vector<std::string> names, YamlText const& data) {
    Block block{std::move(names), {}, {}};
    std::istringstream in(data.text);
    int line_number = data.line;
    for (std::string line; std::getline(in, line); ++line_number) {
        auto const row = numbers_of(path, line_number, line);
        if (row.empty()) continue;
        if (row.size() != block.names.size() + 1)
            fail(path, line_number,
                 fmt::format("found {} columns, but {} are wanted", row.size(), block.names.size() + 1));
        append_row(block, path, line_number, row, nm_per_micrometre);
    }
    return block;
}

DispersionShape read_yaml_formula(std::filesystem::path const& path, DispersionShape::Formula kind,
                                  YAML::Node const& entry, std::vector<std::string> const& lines) {
    YamlText const range_text =
        yaml_text(entry["wavelength_range"] ? entry["wavelength_range"] : entry["range"], lines);
    auto const range = numbers_of(path, range_text.line, range_text.text);
    if (range.size() != 2) fail(path, range_text.line, "wavelength_range wants two numbers");
    YamlText const coefficients = yaml_text(entry["coefficients"], lines);
    return checked_formula(path, coefficients.line,
                           {kind,
                            numbers_of(path, coefficients.line, coefficients.text),
                            {range[0] * nm_per_micrometre, range[1] * nm_per_micrometre}});
}

// refractiveindex.info: DATA is a list of tables and formulas. The absorption given beside a formula is a glass's: n
// alone is taken.
void read_yaml_data(SpectrumFile& file, YAML::Node const& data, std::vector<std::string> const& lines) {
    static std::map<std::string, std::vector<std::string>> const tables{
        {"tabulated nk", {"n", "k"}}, {"tabulated n", {"n"}}, {"tabulated k", {"k"}}};
    static std::map<std::string, DispersionShape::Formula> const formulas{
        {"formula 1", DispersionShape::Formula::sellmeier_squared},
        {"formula 2", DispersionShape::Formula::sellmeier},
        {"formula 4", DispersionShape::Formula::general}};
    std::vector<Block> blocks;
    bool has_n = false;
    for (YAML::Node const& entry : data) {
        YamlText const type = yaml_text(entry["type"], lines);
        auto const table = tables.find(type.text);
        auto const formula = formulas.find(type.text);
        if (table == tables.end() && formula == formulas.end())
            fail(file.path, type.line,
                 fmt::format("DATA of type '{}'; allowed: tabulated n, k, nk, formula 1, 2, 4", type.text));
        bool const gives_n = type.text != "tabulated k";
        if (gives_n && has_n) fail(file.path, type.line, "DATA gives n twice");
        has_n = has_n || gives_n;
        if (formula != formulas.end())
            file.formula.push_back(read_yaml_formula(file.path, formula->second, entry, lines));
        else
            blocks.push_back(read_yaml_table(file.path, table->second, yaml_text(entry["data"], lines)));
    }
    if (file.formula.empty() && blocks.empty()) fail(file.path, 0, "holds no DATA");
    if (file.formula.empty()) join(file, blocks);
}

SpectrumFile read_yaml(std::filesystem::path const& path, std::vector<std::string> const& lines) {
    SpectrumFile file;
    file.path = path;
    try {
        YAML::Node const root = YAML::LoadFile(path.string());
        if (!root.IsMap() || !root["DATA"].IsDefined()) fail(path, 0, "holds no DATA");
        if (root["REFERENCES"]) file.source = root["REFERENCES"].as<std::string>();
        read_yaml_data(file, root["DATA"], lines);
    } catch (YAML::Exception const& e) {
        fail(path, e.mark.line + 1, fmt::format("not the YAML of refractiveindex.info: {}", e.msg));
    }
    return file;
}

}  // namespace

SpectrumFile read_spectrum_file(std::filesystem::path const& path) {
    std::vector<std::string> const lines = lines_of(path);
    if (path.extension() == ".yml" || path.extension() == ".yaml") return read_yaml(path, lines);
    if (is_cgats(lines)) return read_cgats(path, lines);
    return read_table(path, lines);
}

}  // namespace iride
