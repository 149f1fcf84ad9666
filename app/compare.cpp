// SPDX-License-Identifier: Apache-2.0
// iride compare A.exr B.exr: how far two pictures are apart, in XYZ.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "film/compare.h"

namespace iride {

namespace {

struct Options {
    std::string a, b;
    bool json = false;
};

int run_compare(Options const& o) {
    Comparison const c = compare(read_exr_as_xyz(o.a), read_exr_as_xyz(o.b));
    if (o.json) {
        nlohmann::ordered_json const out{{"width", c.width},
                                         {"height", c.height},
                                         {"mse", c.mse},
                                         {"rmse", c.rmse},
                                         {"relmse", c.relmse},
                                         {"delta_e_2000_mean", c.delta_e_2000_mean},
                                         {"delta_e_2000_max", c.delta_e_2000_max}};
        fmt::print("{}\n", out.dump());
        return exit_done;
    }
    fmt::print("{} x {} pixels\nMSE                 {:.6g}\nRMSE                {:.6g}\nrelMSE              {:.6g}\n",
               c.width, c.height, c.mse, c.rmse, c.relmse);
    fmt::print("CIEDE2000 mean, max {:.6g}, {:.6g}\n", c.delta_e_2000_mean, c.delta_e_2000_max);
    return exit_done;
}

}  // namespace

Command add_compare(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("compare", "How far two EXR files are apart, in XYZ");
    auto const o = std::make_shared<Options>();
    parser->add_option("A", o->a, "an OpenEXR file")->required();
    parser->add_option("B", o->b, "the reference: relMSE is relative to it")->required();
    parser->add_flag("--json", o->json, "print JSON");
    return {parser, [o] { return run_compare(*o); }};
}

}  // namespace iride
