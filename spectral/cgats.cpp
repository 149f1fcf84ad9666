// SPDX-License-Identifier: Apache-2.0
#include "spectral/cgats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "spectral/table_text.h"

namespace iride {

using table_text::fail, table_text::number;

namespace {

struct Word {
    std::string text;
    int line;
};

// Words are separated by blanks; quotes hold one together; '#' begins a comment.
std::vector<Word> words_of(std::filesystem::path const& path, std::vector<std::string> const& lines) {
    std::vector<Word> words;
    for (std::size_t row = 0; row < lines.size(); ++row) {
        std::string const& line = lines[row];
        int const number = static_cast<int>(row) + 1;
        for (std::size_t i = 0; i < line.size();) {
            if (line[i] == '#') break;
            if (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') {
                ++i;
                continue;
            }
            bool const quoted = line[i] == '"';
            std::size_t const end = quoted ? line.find('"', i + 1) : line.find_first_of(" \t\r", i);
            if (quoted && end == std::string::npos) fail(path, number, "a quotation mark is not closed");
            std::size_t const from = i + (quoted ? 1 : 0), to = std::min(end, line.size());
            words.push_back({line.substr(from, to - from), number});
            i = to + (quoted ? 1 : 0);
        }
    }
    return words;
}

// One table: the keywords before it, its fields and its values, row by row.
struct Table {
    std::map<std::string, Word> keyword;
    std::vector<Word> fields, values;
    int line = 0;  // of BEGIN_DATA

    std::optional<double> number_of(std::filesystem::path const& path, char const* name) const {
        auto const found = keyword.find(name);
        if (found == keyword.end()) return std::nullopt;
        return number(path, found->second.line, found->second.text);
    }
};

// The words between position `i`, on BEGIN_..., and the word `end`; leaves `i` on the latter.
std::vector<Word> section(std::filesystem::path const& path, std::vector<Word> const& words, std::size_t& i,
                          char const* end) {
    std::vector<Word> inside;
    int const begun = words[i].line;
    for (++i; i < words.size() && words[i].text != end; ++i) inside.push_back(words[i]);
    if (i == words.size()) fail(path, begun, fmt::format("no {} follows", end));
    return inside;
}

std::vector<Table> tables_of(std::filesystem::path const& path, std::vector<Word> const& words) {
    std::vector<Table> tables;
    Table next;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i].text == "BEGIN_DATA_FORMAT") {
            next.fields = section(path, words, i, "END_DATA_FORMAT");
        } else if (words[i].text == "BEGIN_DATA") {
            next.line = words[i].line;
            next.values = section(path, words, i, "END_DATA");
            tables.push_back(std::exchange(next, {}));
        } else if (i + 1 < words.size() && words[i + 1].line == words[i].line) {
            next.keyword[words[i].text] = words[i + 1];
        }
    }
    return tables;
}

// "SPEC_380" -> 380.
std::optional<double> band_nm(std::string name) {
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    for (std::string const prefix : {"SPECTRAL_NM_", "SPECTRAL_NM", "SPECTRAL_", "SPEC_", "NM_", "NM", "R_", "R"})
        if (name.starts_with(prefix))
            if (auto const nm = table_text::to_number(name.substr(prefix.size()))) return nm;
    return std::nullopt;
}

struct Bands {
    std::vector<std::size_t> field;  // index of each band's field
    std::vector<double> nm;
    double norm = 1;  // value that means 1
};

// The older form: a field SPECTRAL_NM, the wavelength itself, before each SPECTRAL_PCT (per cent) or SPECTRAL_DEC
// (parts of one). Every sample must have the same wavelengths.
Bands bands_beside_their_wavelengths(std::filesystem::path const& path, Table const& table) {
    Bands bands;
    std::size_t const width = table.fields.size();
    for (std::size_t i = 0; i < width; ++i) {
        if (table.fields[i].text != "SPECTRAL_NM") continue;
        std::string const quantity = i + 1 < width ? table.fields[i + 1].text : "";
        double const norm = quantity == "SPECTRAL_PCT" ? 100 : 1;
        if (norm == 1 && quantity != "SPECTRAL_DEC")
            fail(path, table.fields[i].line, "SPECTRAL_NM is followed by neither SPECTRAL_PCT nor SPECTRAL_DEC");
        if (!bands.field.empty() && bands.norm != norm)
            fail(path, table.fields[i].line, "holds both SPECTRAL_PCT and SPECTRAL_DEC");
        bands.norm = norm;
        bands.field.push_back(i + 1);
        for (std::size_t at = i; at < table.values.size(); at += width) {
            double const nm = number(path, table.values[at].line, table.values[at].text);
            if (at == i)
                table_text::append_wavelength(bands.nm, path, table.values[at].line, nm);
            else if (nm != bands.nm.back())
                fail(path, table.values[at].line,
                     fmt::format("found {:g} nm where the first sample has {:g}", nm, bands.nm.back()));
        }
    }
    return bands;
}

Bands bands_of(std::filesystem::path const& path, Table const& table) {
    Bands bands = bands_beside_their_wavelengths(path, table);
    if (!bands.nm.empty()) return bands;
    for (std::size_t i = 0; i < table.fields.size(); ++i)
        if (auto const nm = band_nm(table.fields[i].text)) {
            bands.field.push_back(i);
            table_text::append_wavelength(bands.nm, path, table.fields[i].line, *nm);
        }
    auto const count = table.number_of(path, "SPECTRAL_BANDS"), first = table.number_of(path, "SPECTRAL_START_NM"),
               last = table.number_of(path, "SPECTRAL_END_NM");
    if (bands.nm.empty() || !count || !first || !last) return bands;
    if (*count != static_cast<double>(bands.nm.size()))
        fail(path, table.fields.front().line,
             fmt::format("found {} spectral fields, but SPECTRAL_BANDS is {}", bands.nm.size(), *count));
    constexpr double rounding_nm = 1;  // field names hold whole nanometres
    for (std::size_t i = 0; i < bands.nm.size(); ++i) {
        double const exact =
            bands.nm.size() == 1 ? *first : *first + (*last - *first) * static_cast<double>(i) / (*count - 1);
        if (!(std::abs(exact - bands.nm[i]) <= rounding_nm))
            fail(path, table.fields[bands.field[i]].line,
                 fmt::format("field {} should be {:g} nm by SPECTRAL_START_NM and SPECTRAL_END_NM",
                             table.fields[bands.field[i]].text, exact));
        bands.nm[i] = exact;
    }
    return bands;
}

std::vector<std::string> sample_names(Table const& table, std::size_t rows) {
    std::size_t const width = table.fields.size();
    for (char const* key : {"SAMPLE_NAME", "SAMPLE_ID", "SAMPLE_LOC"}) {
        auto const found = std::ranges::find(table.fields, key, &Word::text);
        if (found == table.fields.end()) continue;
        std::vector<std::string> names;
        for (std::size_t row = 0; row < rows; ++row)
            names.push_back(table.values[row * width + static_cast<std::size_t>(found - table.fields.begin())].text);
        if (std::set<std::string>(names.begin(), names.end()).size() == rows) return names;
    }
    std::vector<std::string> numbers;
    for (std::size_t row = 0; row < rows; ++row) numbers.push_back(std::to_string(row + 1));
    return numbers;
}

}  // namespace

bool is_cgats(std::vector<std::string> const& lines) {
    return std::ranges::any_of(
        lines, [](std::string const& line) { return table_text::trimmed(line) == "BEGIN_DATA_FORMAT"; });
}

SpectrumFile read_cgats(std::filesystem::path const& path, std::vector<std::string> const& lines) {
    for (Table const& table : tables_of(path, words_of(path, lines))) {
        Bands const bands = bands_of(path, table);
        if (bands.nm.empty()) continue;
        std::size_t const width = table.fields.size(), rows = table.values.size() / width;
        if (rows * width != table.values.size())
            fail(path, table.values.back().line,
                 fmt::format("found {} values, which are no rows of {} fields", table.values.size(), width));
        if (rows == 0) fail(path, table.line, "holds no samples");
        if (auto const sets = table.number_of(path, "NUMBER_OF_SETS"); sets && *sets != static_cast<double>(rows))
            fail(path, table.line, fmt::format("found {} samples, but NUMBER_OF_SETS is {}", rows, *sets));
        double const norm = table.number_of(path, "SPECTRAL_NORM").value_or(bands.norm);
        if (!(norm > 0)) fail(path, table.line, fmt::format("SPECTRAL_NORM {}: it must be above 0", norm));
        SpectrumFile file;
        file.path = path;
        file.wavelength_nm = bands.nm;
        file.column_order = sample_names(table, rows);
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t field : bands.field) {
                Word const& value = table.values[row * width + field];
                file.column[file.column_order[row]].push_back(number(path, value.line, value.text) / norm);
            }
        return file;
    }
    fail(path, 0, "holds no table with spectral fields (SPEC_380, SPECTRAL_NM_380, nm380, R_380, ...)");
}

}  // namespace iride
