// SPDX-License-Identifier: Apache-2.0
// iride colour convert: three numbers, or a stream of lines, from one colour space to another.
//   CIE space --(its formulas, white)--> XYZ under the white --(adaptation, matrix, curve)--> RGB, and every other way
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/colour.h"
#include "app/numbers.h"
#include "base/diagnostics.h"
#include "colour/chromaticity.h"
#include "colour/cie_space.h"
#include "colour/rgb_encoding.h"

namespace iride {

namespace {

using Triple = CieSpace::Triple;

struct Options {
    std::string from, to, white = "D65", adaptation = "bradford";
    std::vector<std::string> numbers;
    bool json = false;
};

constexpr std::array<std::pair<char const*, Adaptation>, 5> adaptations{{{"bradford", Adaptation::bradford},
                                                                         {"cat02", Adaptation::cat02},
                                                                         {"cat16", Adaptation::cat16},
                                                                         {"von_kries", Adaptation::von_kries},
                                                                         {"none", Adaptation::none}}};

Adaptation adaptation_of(std::string const& name) {
    std::vector<std::string> names;
    for (auto const& [known, method] : adaptations) {
        if (name == known) return method;
        names.emplace_back(known);
    }
    throw InputError({}, "--adaptation", fmt::format("unknown method '{}'{}", name, suggestion(name, names)));
}

Chromaticity white_of(std::string const& text) {
    if (text.find(',') == std::string::npos) return named_white(text);
    std::array<double, 2> v{};
    if (read_numbers(text, v) != NumbersFound::all || !(v[0] > 0 && v[1] > 0 && v[0] + v[1] < 1))
        throw InputError({}, "--white",
                         fmt::format("found '{}': a name or x,y with x > 0, y > 0, x + y < 1 is wanted", text));
    return {v[0], v[1]};
}

// One side of a conversion: `cie` or else `rgb`.
struct Space {
    CieSpace const* cie;
    RgbEncoding const* rgb;
};

std::vector<std::string> space_names() {
    std::vector<std::string> names;
    for (CieSpace const& s : cie_spaces()) names.emplace_back(s.name);
    for (RgbEncoding const& e : rgb_encodings()) names.emplace_back(e.name);
    return names;
}

Space space_of(std::string const& name, char const* option) {
    if (CieSpace const* const cie = find_cie_space(name)) return {cie, nullptr};
    for (RgbEncoding const& e : rgb_encodings())
        if (e.name == name) return {nullptr, &e};
    throw InputError({}, option, fmt::format("unknown space '{}'{}", name, suggestion(name, space_names())));
}

class Converter {
  public:
    explicit Converter(Options const& o)
        : from_(space_of(o.from, "--from")),
          to_(space_of(o.to, "--to")),
          white_xy_(white_of(o.white)),
          white_(iride::to_xyz(white_xy_, 1)),
          rgb_(conversion(adaptation_of(o.adaptation))) {}

    Chromaticity const& white() const { return white_xy_; }

    // Throws InputError with `place` for what is no colour.
    Triple operator()(Triple const& t, std::string const& place) const {
        if (from_.cie == to_.cie && from_.rgb == to_.rgb && from_.rgb) return finite(t, t, place);
        Triple result;
        if (from_.cie) {
            Xyz const c = checked_xyz(*from_.cie, t, white_, place);
            result = to_.cie ? in_cie_space(c, t, place) : triple(rgb_(to_vector(c)));
        } else {
            VectorDouble const v = rgb_(VectorDouble(t[0], t[1], t[2]));
            result = to_.cie ? in_cie_space(iride::to_xyz(v), t, place) : triple(v);
        }
        return finite(result, t, place);
    }

  private:
    RgbConversion conversion(Adaptation method) const {
        if (from_.rgb && to_.rgb) return {*from_.rgb, *to_.rgb, method};
        if (from_.rgb) return RgbConversion::to_xyz(*from_.rgb, white_xy_, method);
        return RgbConversion::from_xyz(white_xy_, to_.rgb ? *to_.rgb : rgb_encodings().front(), method);
    }
    // The library gives black the white's chromaticity; a person who asks for one must hear that there is none.
    Triple in_cie_space(Xyz const& c, Triple const& given, std::string const& place) const {
        if (is_black(c) && (to_.cie->name == "xyY" || to_.cie->name == "uvY"))
            throw InputError({}, place,
                             fmt::format("{} {} {} is black: X + Y + Z = 0 has no chromaticity; XYZ, Luv and Lab "
                                         "have a black",
                                         given[0], given[1], given[2]));
        return to_.cie->from_xyz(c, white_);
    }
    static Triple triple(VectorDouble const& v) { return {v[0], v[1], v[2]}; }
    static Triple const& finite(Triple const& result, Triple const& given, std::string const& place) {
        for (Triple const* t : {&given, &result})
            for (double const value : *t)
                if (!std::isfinite(value))
                    throw InputError({}, place,
                                     fmt::format("{} {} {} has no finite value there: finite numbers of a colour "
                                                 "are wanted",
                                                 given[0], given[1], given[2]));
        return result;
    }

    Space from_, to_;
    Chromaticity white_xy_;
    Xyz white_;
    RgbConversion rgb_;
};

Triple numbers_in(std::string_view text, std::string const& place) {
    Triple t{};
    if (read_numbers(text, t) != NumbersFound::all)
        throw InputError({}, place, fmt::format("found '{}': three numbers are wanted", text.substr(0, 80)));
    return t;
}

// Results, gathered into large writes to stdout.
class Printer {
  public:
    Printer(Options const& o, Chromaticity const& white) : json_(o.json) {
        nlohmann::ordered_json const head{{"from", o.from}, {"to", o.to}, {"white", {white.x, white.y}}};
        head_ = head.dump();
        head_.back() = ',';  // instead of the closing brace
    }
    ~Printer() { flush(); }
    Printer(Printer const&) = delete;
    Printer& operator=(Printer const&) = delete;

    void print(Triple const& t) {
        constexpr std::size_t block = 1 << 16;
        if (json_)
            fmt::format_to(std::back_inserter(out_), "{}\"value\":[{},{},{}]}}\n", head_, t[0], t[1], t[2]);
        else
            fmt::format_to(std::back_inserter(out_), "{} {} {}\n", t[0], t[1], t[2]);
        if (out_.size() >= block) flush();
    }
    void flush() {
        std::fwrite(out_.data(), 1, out_.size(), stdout);
        std::fflush(stdout);
        out_.clear();
    }

  private:
    bool json_;
    std::string head_;
    fmt::memory_buffer out_;
};

// Calls `line(text, number)` for every line of a file, numbers from 1; a line may be of any length.
template <class F>
void each_line(std::FILE* file, F const& line) {
    constexpr std::size_t block = 1 << 16;
    std::string text;
    std::size_t start = 0;
    std::int64_t number = 0;
    for (bool more = true; more;) {
        text.erase(0, start);
        start = 0;
        std::size_t const before = text.size();
        text.resize(before + block);
        std::size_t const got = std::fread(text.data() + before, 1, block, file);
        text.resize(before + got);
        more = got > 0;
        if (!more && !text.empty()) text += '\n';
        for (std::size_t end = text.find('\n', before); end != std::string::npos; end = text.find('\n', start)) {
            line(std::string_view(text).substr(start, end - start), ++number);
            start = end + 1;
        }
    }
}

void convert_stream(Converter const& convert, Printer& printer) {
    std::string place;
    each_line(stdin, [&](std::string_view line, std::int64_t number) {
        std::size_t const first = line.find_first_not_of(" \t\r");
        if (first == std::string_view::npos || line[first] == '#') return;
        place.clear();
        fmt::format_to(std::back_inserter(place), "line {}", number);
        printer.print(convert(numbers_in(line, place), place));
    });
}

int run_convert(Options const& o) {
    Converter const convert(o);
    Printer printer(o, convert.white());
    if (o.numbers.empty())
        convert_stream(convert, printer);
    else
        printer.print(convert(numbers_in(fmt::format("{}", fmt::join(o.numbers, " ")), "A B C"), "A B C"));
    return exit_done;
}

}  // namespace

Command add_colour_convert(CLI::App& colour) {
    CLI::App* const parser = colour.add_subcommand("convert", "Colours from one space to another");
    auto const o = std::make_shared<Options>();
    std::string spaces;
    for (CieSpace const& s : cie_spaces()) spaces += fmt::format("\n  {}: {}", s.name, s.summary);
    spaces += "\n ";
    for (RgbEncoding const& e : rgb_encodings()) spaces += fmt::format(" {}", e.name);
    parser->add_option("--from", o->from, "space of the numbers:" + spaces)->required();
    parser->add_option("--to", o->to, "space wanted, one of the same")->required();
    parser->add_option("--white", o->white, "white of the CIE spaces: a name (D65, D65:table) or x,y")
        ->capture_default_str();
    parser
        ->add_option("--adaptation", o->adaptation,
                     "between the white and that of an RGB space: bradford cat02 cat16 von_kries none")
        ->capture_default_str();
    parser->add_option("A B C", o->numbers, "the colour; without it, lines of three numbers on stdin");
    parser->add_flag("--json", o->json, "print JSON, an object a line");
    parser->footer(
        "XYZ is scaled so that the white has Y = 1. An RGB name means its encoded signal, linear-... its linear "
        "light.\n"
        "Numbers are separated by blanks or commas; '--' before them lets them be negative. On stdin, empty lines and\n"
        "lines that start with # are skipped; the first bad line ends the stream with its number on stderr and exit\n"
        "code 2, after the results of the lines before it have been printed.");
    return {parser, [o] { return run_convert(*o); }};
}

}  // namespace iride
