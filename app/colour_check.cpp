// SPDX-License-Identifier: Apache-2.0
// iride colour check: an OpenColorIO config's spaces against values derived from CIE definitions.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/colour.h"
#include "colour/config_check.h"

namespace iride {

namespace {

struct Options {
    std::string config;
    bool json = false;
};

void print_json(ColourConfig const& config, ConfigCheck const& check) {
    nlohmann::ordered_json spaces = nlohmann::ordered_json::array(), unchecked = nlohmann::ordered_json::array();
    for (SpaceCheck const& s : check.spaces) {
        spaces.push_back({{"name", s.name},
                          {"recognised_as", s.recognised_as},
                          {"max_error", s.max_error},
                          {"tolerance", s.tolerance},
                          {"white_error", s.white_error},
                          {"delta_e_2000_max", s.delta_e_2000_max},
                          {"round_trip_delta_e_2000_max", s.round_trip_delta_e_2000_max},
                          {"negative", s.negative},
                          {"nan", s.nan},
                          {"ok", s.ok}});
        if (!s.failure.empty()) spaces.back()["failure"] = s.failure;
    }
    for (UncheckedSpace const& s : check.unchecked) unchecked.push_back({{"name", s.name}, {"reason", s.reason}});
    nlohmann::ordered_json const out{
        {"config", config.path().string()}, {"spaces", spaces}, {"unchecked", unchecked}, {"ok", check.ok}};
    fmt::print("{}\n", out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_table(ColourConfig const& config, ConfigCheck const& check) {
    fmt::print("{}\n\n{:<28}{:<28}{:>10}{:>10}{:>10}{:>12}  {:<10}{:<6}\n", config.path().string(), "space",
               "recognised as", "error", "at white", "CIEDE2000", "round trip", "negative", "NaN");
    for (SpaceCheck const& s : check.spaces)
        fmt::print("{:<28}{:<28}{:>10.2g}{:>10.2g}{:>10.2g}{:>12.2g}  {:<10}{:<6}{}\n", s.name, s.recognised_as,
                   s.max_error, s.white_error, s.delta_e_2000_max, s.round_trip_delta_e_2000_max, s.negative, s.nan,
                   s.ok ? "" : "WRONG");
    if (!check.unchecked.empty()) fmt::print("\nnot checked:\n");
    for (UncheckedSpace const& s : check.unchecked) fmt::print("  {}: {}\n", s.name, s.reason);
}

int run_check(Options const& o) {
    ColourConfig const config(o.config);
    ConfigCheck const check = check_config(config);
    if (o.json)
        print_json(config, check);
    else
        print_table(config, check);
    if (check.ok) return exit_done;
    for (SpaceCheck const& s : check.spaces)
        if (!s.failure.empty())
            fmt::print(stderr, "iride: {}\n", s.failure);
        else if (!s.ok)
            fmt::print(stderr, "iride: '{}' is not {}: CIEDE2000 {:.3g}, error {:.3g} (tolerable: {:g}, {:g})\n",
                       s.name, s.recognised_as, std::max(s.delta_e_2000_max, s.round_trip_delta_e_2000_max),
                       std::max(s.max_error, s.white_error), tolerable_delta_e, s.tolerance);
    if (check.spaces.size() <= 1)
        fmt::print(stderr, "iride: no space of this config has a name that says what it must hold\n");
    return exit_not_trustworthy;
}

}  // namespace

Command add_colour_check(CLI::App& colour) {
    CLI::App* const parser =
        colour.add_subcommand("check", "Check an OpenColorIO config's spaces against CIE-derived values");
    auto const o = std::make_shared<Options>();
    parser->add_option("--config", o->config, "OpenColorIO config (default: $OCIO, else the shipped one)");
    parser->add_flag("--json", o->json, "print JSON");
    parser->footer(
        "Spaces are recognised by name, alias or interop identifier; errors are in each space's own numbers.\n"
        "Exit codes: 0 every recognised space is right; 2 the config does not load or has no role aces_interchange;\n"
        "3 a space is wrong, or none is recognised.");
    return {parser, [o] { return run_check(*o); }};
}

}  // namespace iride
