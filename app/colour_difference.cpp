// SPDX-License-Identifier: Apache-2.0
// iride colour difference: how far two L*a*b* colours are apart.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/colour.h"
#include "app/numbers.h"
#include "base/diagnostics.h"
#include "colour/difference.h"

namespace iride {

namespace {

struct Options {
    std::string formula;
    std::vector<std::string> numbers;
    bool json = false;
};

Lab lab_of(std::span<double const, 3> v, char const* place) {
    constexpr double largest = 1e6;  // far beyond any colour; the seventh power of a chroma still has digits
    for (double const value : v)
        if (!(std::abs(value) <= largest))
            throw InputError({}, place,
                             fmt::format("{} {} {}: finite numbers are wanted, up to {:g}", v[0], v[1], v[2], largest));
    if (v[0] < 0)
        throw InputError({}, place, fmt::format("L* = {}: a lightness is not negative (0 is black, 100 white)", v[0]));
    return {v[0], v[1], v[2]};
}

int run_difference(Options const& o) {
    DifferenceFormula const& formula = difference_formula(o.formula);
    std::array<double, 6> v{};
    std::string const given = fmt::format("{}", fmt::join(o.numbers, " "));
    if (read_numbers(given, v) != NumbersFound::all)
        throw InputError({}, "L1 a1 b1 L2 a2 b2", fmt::format("found '{}': six numbers are wanted", given));
    std::span<double const, 6> const numbers(v);
    double const value =
        formula.of(lab_of(numbers.first<3>(), "first colour"), lab_of(numbers.last<3>(), "second colour"));
    if (o.json)
        fmt::print("{}\n", nlohmann::ordered_json{{"formula", formula.name}, {"value", value}}.dump());
    else
        fmt::print("{}\n", value);
    return exit_done;
}

}  // namespace

Command add_colour_difference(CLI::App& colour) {
    CLI::App* const parser = colour.add_subcommand("difference", "How far two L*a*b* colours are apart");
    auto const o = std::make_shared<Options>();
    std::string formulas;
    for (DifferenceFormula const& f : difference_formulas()) formulas += fmt::format("\n  {}: {}", f.name, f.summary);
    parser->add_option("--formula", o->formula, "one of" + formulas)->required();
    parser->add_option("L1 a1 b1 L2 a2 b2", o->numbers, "L*a*b* of the standard, then of the sample")->required();
    parser->add_flag("--json", o->json, "print JSON");
    parser->footer(
        "'--' before the numbers lets them be negative: iride colour difference --formula cie2000 -- 50 -1 2 50 0 0");
    return {parser, [o] { return run_difference(*o); }};
}

}  // namespace iride
