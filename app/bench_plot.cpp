// SPDX-License-Identifier: Apache-2.0
#include "app/bench_plot.h"

#include <algorithm>
#include <cmath>

#include "app/palette.h"
#include "base/diagnostics.h"

namespace iride {

namespace {

struct Line {
    std::string integrator;
    std::vector<PlotPoint> points;  // log10 of seconds and of relMSE
};
struct Panel {
    std::string scene;
    std::vector<Line> lines;
};

std::vector<Panel> panels_of(nlohmann::ordered_json const& rows) {
    std::vector<Panel> panels;
    for (auto const& row : rows) {
        auto const scene = row["scene"].get<std::string>();
        if (panels.empty() || panels.back().scene != scene) panels.push_back({scene, {}});
        Line line{row["integrator"].get<std::string>(), {}};
        for (auto const& p : row["points"]) {
            double const seconds = p["seconds"].get<double>(), error = p["relmse"].get<double>();
            if (seconds > 0 && error > 0) line.points.push_back({std::log10(seconds), std::log10(error)});
        }
        panels.back().lines.push_back(std::move(line));
    }
    return panels;
}

PlotAxis axis_around(std::vector<Panel> const& panels, double PlotPoint::*coordinate, std::string title) {
    double least = 0, most = 0;
    bool first = true;
    for (Panel const& panel : panels)
        for (Line const& line : panel.lines)
            for (PlotPoint const& p : line.points) {
                least = first ? p.*coordinate : std::min(least, p.*coordinate);
                most = first ? p.*coordinate : std::max(most, p.*coordinate);
                first = false;
            }
    return {std::floor(least), std::max(std::floor(least) + 1, std::ceil(most)), 1, std::move(title)};
}

}  // namespace

void plot_errors(nlohmann::ordered_json const& results, std::filesystem::path const& path) {
    if (!results.contains("error") || results["error"].empty())
        throw InputError({}, "--plot", "there is nothing to plot: it shows the benchmark 'error'");
    std::vector<Panel> const panels = panels_of(results["error"]);
    PlotAxis const x = axis_around(panels, &PlotPoint::x, "log10 (time / s)"),
                   y = axis_around(panels, &PlotPoint::y, "log10 relMSE");
    std::vector<std::string> integrators;  // of all panels; each has a colour
    for (Panel const& panel : panels)
        for (Line const& line : panel.lines)
            if (std::ranges::find(integrators, line.integrator) == integrators.end())
                integrators.push_back(line.integrator);
    int const longest = static_cast<int>(std::ranges::max(integrators, {}, &std::string::size).size());
    int const legend = 80 + 13 * longest;  // pixels
    constexpr int columns = 3, width = 420, height = 340, right = 30, page_width = 600, page_height = 540;
    int const count = static_cast<int>(panels.size());
    int const used_columns = std::min(columns, count), rows = (count + columns - 1) / columns;
    PlotPage page(page_width * used_columns + legend, page_height * rows);
    for (int i = 0; i < count; ++i) {
        Panel const& panel = panels[static_cast<std::size_t>(i)];
        bool const has_legend = i == used_columns - 1;
        Plot plot(width, height, x, y, has_legend ? legend + right : right);
        for (std::size_t k = 0; k < integrators.size(); ++k) {
            Stroke const stroke{line_palette[k % line_palette.size()], 2.5, k >= line_palette.size(), integrators[k]};
            auto const line = std::ranges::find(panel.lines, integrators[k], &Line::integrator);
            std::vector<PlotPoint> const points = line == panel.lines.end() ? std::vector<PlotPoint>{} : line->points;
            plot.line(points, stroke);
            for (PlotPoint const& p : points) plot.disc(p, 4, stroke.colour);
        }
        if (has_legend) plot.legend();
        int const x0 = i % columns * page_width, y0 = i / columns * page_height;
        page.place(plot, x0, y0);
        page.text(panel.scene, x0 + 150, y0 + 30);
    }
    page.write(path);
}

}  // namespace iride
