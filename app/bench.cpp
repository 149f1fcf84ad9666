// SPDX-License-Identifier: Apache-2.0
// iride bench: error against time, speed and scaling of this build on this machine, and the long stress test.
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <thread>

#include "app/bench_plot.h"
#include "app/command.h"
#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "integrators/integrator.h"
#include "scene/scene.h"

namespace iride {

namespace {

struct Options {
    std::vector<std::string> names;
    std::string json, plot, references;
    bench::Settings settings;
};

std::filesystem::path default_references() {
    for (auto const& [variable, below] :
         {std::pair("XDG_CACHE_HOME", "iride/references"), {"HOME", ".cache/iride/references"}})
        if (char const* const value = std::getenv(variable); value && *value)
            return std::filesystem::path(value) / below;
    return std::filesystem::temp_directory_path() / "iride/references";
}

std::string processor_name() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

// NAME is a benchmark or, to restrict benchmarks to it, a scene.
std::vector<bench::Benchmark> sort_out(Options& o) {
    std::vector<bench::Benchmark> chosen;
    std::vector<std::string> known;
    for (bench::Benchmark const& b : bench::benchmarks()) known.emplace_back(b.name);
    for (std::string const& scene : bench::all_scenes()) known.push_back(scene);
    for (std::string const& name : o.names) {
        auto const b = std::ranges::find(bench::benchmarks(), name, &bench::Benchmark::name);
        if (b != bench::benchmarks().end())
            chosen.push_back(*b);
        else if (std::filesystem::exists(name) || std::ranges::find(known, name) != known.end())
            o.settings.scenes.push_back(name);
        else
            throw InputError({}, "NAME",
                             fmt::format("'{}' is neither a benchmark nor a scene{}", name, suggestion(name, known)));
    }
    if (chosen.empty())
        for (bench::Benchmark const& b : bench::benchmarks())
            if (b.by_default) chosen.push_back(b);
    return chosen;
}

std::string cell(nlohmann::ordered_json const& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    if (value.is_null()) return "-";
    return value.dump();
}

void print_table(bench::Benchmark const& b, bench::Rows const& rows) {
    fmt::print("\n{}: {}\n", b.name, b.summary);
    if (rows.empty()) return;
    std::vector<std::string> keys;
    for (auto const& item : rows[0].items())
        if (!item.value().is_array()) keys.push_back(item.key());
    for (std::string const& key : keys) {
        std::size_t width = key.size();
        for (auto const& row : rows) width = std::max(width, cell(row[key]).size());
        fmt::print("  {:<{}}", key, width);
    }
    fmt::print("\n");
    for (auto const& row : rows) {
        for (std::string const& key : keys) {
            std::size_t width = key.size();
            for (auto const& other : rows) width = std::max(width, cell(other[key]).size());
            fmt::print("  {:<{}}", cell(row[key]), width);
        }
        fmt::print("\n");
    }
    std::fflush(stdout);
}

int run_bench(Options& o) {
    std::vector<bench::Benchmark> const chosen = sort_out(o);
    for (std::string const& text : o.settings.integrators) {
        std::string const name = parse_integrator(text).name;
        if (std::ranges::none_of(integrator_entries(), [&](IntegratorEntry const& e) { return name == e.name; }))
            throw InputError({}, "--integrator", fmt::format("unknown integrator '{}'", name));
    }
    if (!o.json.empty()) check_writable(o.json);
    if (!o.plot.empty()) check_output("--plot", o.plot, ".png");
    o.settings.references = o.references.empty() ? default_references() : std::filesystem::path(o.references);
    o.settings.say = [](std::string const& text) { fmt::print(stderr, "  {}\n", text); };
    nlohmann::ordered_json out{{"version", IRIDE_VERSION},
                               {"processor", processor_name()},
                               {"processors", std::thread::hardware_concurrency()},
                               {"rounds", o.settings.rounds}};
    bool all_well = true;
    for (bench::Benchmark const& b : chosen) {
        bench::Rows const rows = b.run(o.settings);
        print_table(b, rows);
        out[b.name] = rows;
        for (auto const& row : rows) all_well = all_well && row.value("ok", true);
    }
    if (!o.json.empty()) write_file(o.json, out.dump(2) + "\n");
    if (!o.plot.empty()) plot_errors(out, o.plot);
    return all_well ? exit_done : exit_not_trustworthy;
}

}  // namespace

Command add_bench(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("bench", "Measure speed, error against time and stability");
    auto const o = std::make_shared<Options>();
    std::string names;
    for (bench::Benchmark const& b : bench::benchmarks())
        names += fmt::format("\n  {}: {}{}", b.name, b.summary, b.by_default ? "" : " (only if named)");
    parser->add_option("NAME", o->names, "benchmarks, and scenes to restrict them to; none: all of" + names);
    parser->add_option("--json", o->json, "JSON file to write");
    parser->add_option("--plot", o->plot, "PNG file to write: error against time (benchmark 'error')");
    parser->add_option("--integrator", o->settings.integrators,
                       "of 'error' (default: every one that can do the scene)");
    parser->add_option("--references", o->references,
                       "folder of the converged pictures (default: iride/references in the user's cache)");
    parser->add_option("--reference-seconds", o->settings.reference_seconds, "for each of a reference's two halves")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    parser->add_option("--seconds", o->settings.error_seconds, "of 'error', for each scene and integrator")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    parser->add_option("--rounds", o->settings.rounds, "of what is quoted as median, least and most")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    parser->add_option("--threads", o->settings.threads, "threads (default: all)")->check(CLI::Range(1, 1024));
    return {parser, [o] { return run_bench(*o); }};
}

}  // namespace iride
