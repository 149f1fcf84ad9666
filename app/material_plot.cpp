// SPDX-License-Identifier: Apache-2.0
#include "app/material_plot.h"

#include <fmt/format.h>

#include <cmath>

#include "app/palette.h"
#include "app/plot.h"
#include "base/constants.h"
#include "colour/difference.h"

namespace iride {

namespace {

// The colours at even steps from 0 to 90 degrees: the exact ones, then those of each approximation.
struct Sweep {
    std::string title;
    std::vector<MaterialColour> colour;

    double angle_deg(std::size_t i) const { return 90 * static_cast<double>(i) / static_cast<double>(last()); }
    double place_of(double angle) const { return angle / 90 * static_cast<double>(last()); }
    std::size_t last() const { return colour.size() - 1; }
};

std::vector<Sweep> sweeps_of(GivenMaterial const& m, MaterialColorimetry const& colorimetry) {
    std::vector<Sweep> sweeps{{m.smooth() ? "exact" : "the material", {}}};
    std::optional<ApproximateColours> approximate;
    if (m.smooth()) approximate.emplace(m, colorimetry);
    int const steps_per_degree = m.smooth() ? 4 : 1;  // an albedo is dear
    for (int i = 0; i <= 90 * steps_per_degree; ++i) {
        double const angle = static_cast<double>(i) / steps_per_degree;
        sweeps[0].colour.push_back(colorimetry.of(m, angle));
        if (!approximate) continue;
        std::size_t at = 1;
        for (auto const& entry : approximate->at(angle)) {
            if (sweeps.size() == at) sweeps.push_back({entry.title, {}});
            sweeps[at++].colour.push_back(entry.colour);
        }
    }
    return sweeps;
}

Stroke stroke_of(std::size_t i, std::string const& legend) {
    return {line_palette[i % line_palette.size()], i == 0 ? 3.5 : 2.5, i > 0, legend};
}

Plot reflectance_panel(GivenMaterial const& m, std::vector<double> const& angles_deg) {
    double const from = std::max(visible_range.min_nm, m.defined_on.min_nm),
                 to = std::min(visible_range.max_nm, m.defined_on.max_nm);
    std::vector<double> nm;
    for (double x = from; x < to; ++x) nm.push_back(x);
    nm.push_back(to);
    Plot panel(820, 560, {visible_range.min_nm, visible_range.max_nm, 50, "Wavelength / nm"},
               {0, 1.02, 0.1, "Reflectance"}, 180);
    for (std::size_t i = 0; i < angles_deg.size(); ++i) {
        std::vector<double> const R = reflectances(m, angles_deg[i], nm);
        std::vector<PlotPoint> points;
        for (std::size_t j = 0; j < nm.size(); ++j) points.push_back({nm[j], R[j]});
        panel.line(points, {line_palette[i % line_palette.size()], 2.5, i / line_palette.size() % 2 == 1,
                            fmt::format("{:g}°", angles_deg[i])});
    }
    panel.legend();
    return panel;
}

// A ring sector from the normal, upwards, to the surface, to the right.
void draw_ring(Plot& panel, MaterialColorimetry const& colorimetry, Sweep const& sweep, double inner, double outer) {
    std::vector<VectorDouble> shown;
    for (MaterialColour const& c : sweep.colour) shown.push_back(colorimetry.shown(c));
    std::vector<PlotPoint> edge;
    auto const at = [](double radius, int degrees) {
        return PlotPoint{radius * std::sin(radians(degrees)), radius * std::cos(radians(degrees))};
    };
    for (int i = 0; i <= 90; ++i) edge.push_back(at(outer, i));
    for (int i = 90; i >= 0; --i) edge.push_back(at(inner, i));
    panel.fill(edge, [&](PlotPoint const& p) {
        double const angle = std::clamp(std::atan2(p.x, p.y) / radians(1), 0.0, 90.0), place = sweep.place_of(angle);
        std::size_t const cell = std::min(static_cast<std::size_t>(place), shown.size() - 2);
        VectorDouble const c = shown[cell] + (place - static_cast<double>(cell)) * (shown[cell + 1] - shown[cell]);
        return PlotColour{c[0], c[1], c[2]};
    });
    edge.push_back(edge.front());
    panel.line(edge, {{.4, .4, .4}, 1.5});
}

Plot strip_panel(MaterialColorimetry const& colorimetry, std::vector<Sweep> const& sweeps) {
    constexpr double extent = 1.2;
    bool const compared = sweeps.size() > 1;
    Plot panel(560, 560, {-.06, extent, 0, compared ? "Outside: exact. Inside: 1982" : "Colour by angle"},
               {-.06, extent, 0, ""});
    draw_ring(panel, colorimetry, sweeps[0], compared ? .68 : .4, 1);
    if (compared) draw_ring(panel, colorimetry, sweeps[1], .34, .66);
    for (int angle = 0; angle <= 90; angle += 15) {
        double const x = std::sin(radians(angle)), y = std::cos(radians(angle));
        panel.label(fmt::format("{}°", angle), {x, y}, std::max(x, .02), std::max(y, .02), false, 8);
    }
    return panel;
}

Plot chromaticity_panel(std::vector<Sweep> const& sweeps) {
    double x0 = 1, x1 = 0, y0 = 1, y1 = 0;
    for (Sweep const& s : sweeps)
        for (MaterialColour const& c : s.colour)
            if (c.xy) {
                x0 = std::min(x0, c.xy->x), x1 = std::max(x1, c.xy->x);
                y0 = std::min(y0, c.xy->y), y1 = std::max(y1, c.xy->y);
            }
    constexpr double least_extent = .01, margin = .08;
    auto const axis = [&](double low, double high, std::string title) {
        double const extent = std::max(high - low, least_extent), middle = (low + high) / 2,
                     half = extent * (.5 + margin);
        return PlotAxis{middle - half, middle + half, round_tick(2 * half, 8), std::move(title)};
    };
    bool const any = x0 <= x1;
    Plot panel(820, 560, any ? axis(x0, x1, "x") : PlotAxis{0, 1, .1, "x"},
               any ? axis(y0, y1, "y") : PlotAxis{0, 1, .1, "y"}, 180);
    for (std::size_t i = sweeps.size(); i-- > 0;) {
        std::vector<PlotPoint> points;
        for (MaterialColour const& c : sweeps[i].colour)
            if (c.xy) points.push_back({c.xy->x, c.xy->y});
        panel.line(points, stroke_of(i, ""));
    }
    for (int angle : {0, 30, 60, 75, 85})
        if (auto const& c = sweeps[0].colour[static_cast<std::size_t>(sweeps[0].place_of(angle))]; c.xy) {
            panel.disc({c.xy->x, c.xy->y}, 6, {0, 0, 0});
            panel.label(fmt::format("{}°", angle), {c.xy->x, c.xy->y}, 1, -1, true);
        }
    return panel;
}

Plot difference_panel(std::vector<Sweep> const& sweeps) {
    std::vector<std::vector<PlotPoint>> curves;
    double most = 1;
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        curves.emplace_back();
        for (std::size_t j = 0; j < sweeps[0].colour.size(); ++j) {
            Lab const& exact = sweeps[0].colour[j].lab;
            double const E = delta_e_2000(exact, i == 0 ? sweeps[0].colour[0].lab : sweeps[i].colour[j].lab);
            curves.back().push_back({sweeps[0].angle_deg(j), E});
            most = std::max(most, E);
        }
    }
    Plot panel(560, 560, {0, 90, 15, "Angle of incidence / degrees"},
               {0, most * 1.6, round_tick(most * 1.6, 8), "CIEDE2000"}, 40);
    for (std::size_t i = 0; i < curves.size(); ++i)
        panel.line(curves[i], stroke_of(i, i == 0 ? "from its colour at 0°" : sweeps[i].title));
    panel.legend(PlotPoint{1, most * 1.58});
    return panel;
}

}  // namespace

void plot_material(GivenMaterial const& m, MaterialColorimetry const& colorimetry,
                   std::vector<double> const& angles_deg, std::string const& illuminant, std::string const& file) {
    std::vector<Sweep> const sweeps = sweeps_of(m, colorimetry);
    constexpr int first_row = 60, row = 705, column = 1130, footer = 70;
    PlotPage page(column + 730, first_row + 2 * row + footer);
    page.text(fmt::format("{} under {}", m.name, illuminant), 130, 50);
    page.place(reflectance_panel(m, angles_deg), 0, first_row);
    page.place(strip_panel(colorimetry, sweeps), column, first_row);
    page.place(chromaticity_panel(sweeps), 0, first_row + row);
    page.place(difference_panel(sweeps), column, first_row + row);
    page.text(
        "Strip: sRGB; a colour outside its gamut is drawn as the nearest of the same L* (at most 100) and hue, with "
        "less "
        "chroma.",
        130, first_row + 2 * row + 24);
    page.write(file);
}

}  // namespace iride
