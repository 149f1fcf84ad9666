// SPDX-License-Identifier: Apache-2.0
// iride colour diagram: the chromaticity diagram, x, y or u', v' (CIE 1976), with the spectral locus, blackbodies, RGB
// gamuts, circles of equal u'v' distance, and the chromaticities of spectra or of a picture's pixels. [CIE 15:2018, 8]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "app/colour.h"
#include "app/given_spectra.h"
#include "app/plot.h"
#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "colour/description.h"
#include "colour/illuminant.h"
#include "colour/rgb_encoding.h"
#include "film/exr.h"

namespace iride {

namespace {

struct Options {
    std::string output, space = "xy", illuminant = "D65", observer = "cie1931_2deg";
    std::vector<std::string> names;
};

// The plane of the diagram.
struct Plane {
    PlotPoint (*at)(Chromaticity const&);
    Chromaticity (*from)(PlotPoint const&);
    PlotAxis x, y;
    int width, height;  // pixels; both axes have one scale
    PlotPoint legend;
};

Plane plane_of(std::string const& space) {
    if (space == "xy")
        return {[](Chromaticity const& c) {
                    return PlotPoint{c.x, c.y};
                },
                [](PlotPoint const& p) {
                    return Chromaticity{p.x, p.y};
                },
                {-0.08, 0.80, 0.1, "x"},
                {-0.02, 0.90, 0.1, "y"},
                1496,
                1564,
                {0.525, 0.885}};
    if (space == "uv")
        return {[](Chromaticity const& c) {
                    UvPrime const uv = to_uv_prime(c);
                    return PlotPoint{uv.u, uv.v};
                },
                [](PlotPoint const& p) {
                    return to_chromaticity(UvPrime{p.x, p.y});
                },
                {-0.06, 0.66, 0.1, "u′"},
                {-0.02, 0.62, 0.1, "v′"},
                1656,
                1472,
                {0.45, 0.23}};
    throw InputError({}, "--space", fmt::format("unknown diagram '{}'{}", space, suggestion(space, {"xy", "uv"})));
}

// The colour of a chromaticity as a screen can show it: linear sRGB with white added until no channel is negative,
// scaled to its largest, and lightened so that black lines stand out.
PlotColour shown(Chromaticity const& c) {
    static RgbConversion const to_linear = RgbConversion::from_xyz(rgb::rec709.white, rgb_encoding("linear-sRGB"));
    if (!(c.y > 0)) return {1, 1, 1};
    VectorDouble v = to_linear(to_vector(to_xyz(c, 1)));
    v.array() -= std::min(0.0, v.minCoeff());
    v /= v.maxCoeff();
    constexpr double lightened = 0.2;
    v = v.unaryExpr([](double linear) { return lightened + (1 - lightened) * encode(TransferFunction::srgb, linear); });
    return {v[0], v[1], v[2]};
}

std::vector<PlotPoint> on_plane(Plane const& plane, std::span<Chromaticity const> all) {
    std::vector<PlotPoint> points;
    for (Chromaticity const& c : all) points.push_back(plane.at(c));
    return points;
}

void draw_locus(Plot& page, Plane const& plane, SpectralLocus const& locus) {
    std::vector<PlotPoint> points = on_plane(plane, locus.points());
    page.fill(points, [&](PlotPoint const& p) { return shown(plane.from(p)); });
    points.push_back(points.front());
    page.line(points, {{0, 0, 0}, 3});
}

// Wavelengths outside the locus: tens, at the ends fewer, wherever there is room.
void label_locus(Plot& page, Plane const& plane, SpectralLocus const& locus) {
    std::vector<PlotPoint> const points = on_plane(plane, locus.points());
    std::vector<double> const& nm = locus.wavelengths_nm();
    constexpr std::size_t around = 3;  // nanometres to both sides that give the direction: the tables' ends are rounded
    constexpr int last_nm = 700;       // beyond, the locus stands still
    constexpr double tick_px = 12;
    for (int const step : {100, 50, 20, 10})
        for (std::size_t i = around; i + around < points.size(); ++i) {
            int const whole = static_cast<int>(std::lround(nm[i]));
            if (whole % step != 0 || whole > last_nm) continue;
            // Outwards: the locus runs from violet to red clockwise, so to the left of its direction.
            double const tx = points[i + around].x - points[i - around].x,
                         ty = points[i + around].y - points[i - around].y;
            if (page.label(fmt::format("{}{}", whole, whole == last_nm ? " nm" : ""), points[i], -ty, tx, false,
                           tick_px + 6))
                page.tick(points[i], -ty, tx, tick_px, {{0, 0, 0}, 2.5});
        }
}

void draw_gamuts(Plot& page, Plane const& plane) {
    struct Gamut {
        RgbSpace const* space;
        char const* name;
        PlotColour colour;
        bool dashed;
    };
    for (Gamut const& g : {Gamut{&rgb::rec709, "Rec.709, sRGB", {0, 0, 0}, false},
                           {&rgb::display_p3, "Display P3", {.15, .15, .75}, true},
                           {&rgb::rec2020, "Rec.2020", {.70, .05, .05}, false},
                           {&rgb::acescg, "ACEScg", {.35, .1, .4}, true}})
        page.line(on_plane(plane, std::array{g.space->red, g.space->green, g.space->blue, g.space->red}),
                  {g.colour, 2.2, g.dashed, g.name});
}

void draw_planckian(Plot& page, Plane const& plane, PlanckianLocus const& locus) {
    std::vector<PlotPoint> points;
    auto const at = [&](double mired) { return to_chromaticity(locus.at(1e6 / mired)); };
    for (double mired = 1e6 / PlanckianLocus::coldest_K; mired > 1e6 / PlanckianLocus::hottest_K; mired -= 2)
        points.push_back(plane.at(at(mired)));
    points.push_back(plane.at(at(1e6 / PlanckianLocus::hottest_K)));
    page.line(points, {{0, 0, 0}, 2.5, true, "blackbodies"});
}

void label_planckian(Plot& page, Plane const& plane, PlanckianLocus const& locus) {
    constexpr double half_tick = 0.008;  // in u, v (1960), along the isotherm
    for (int const T : {2000, 4000, 6500, 1500, 3000, 10000, 2500, 100000, 5000}) {
        Uv1960 const c = locus.at(T), a = locus.at(T * 0.999), b = locus.at(T * 1.001 > 1e5 ? 1e5 : T * 1.001);
        double const length = std::hypot(b.u - a.u, b.v - a.v);
        double const nu = -(b.v - a.v) / length * half_tick, nv = (b.u - a.u) / length * half_tick;
        auto const point = [&](double s) { return plane.at(to_chromaticity(Uv1960{c.u + s * nu, c.v + s * nv})); };
        PlotPoint const below = point(1), above = point(-1), low = below.y < above.y ? below : above,
                        high = below.y < above.y ? above : below;
        if (page.label(fmt::format("{} K", T), low, low.x - high.x, low.y - high.y))
            page.line(std::array{low, high}, {{0, 0, 0}, 2});
    }
}

// Circles of one u'v' distance on a grid over the diagram: how far equal steps of u', v' reach in this plane.
void draw_scale(Plot& page, Plane const& plane, SpectralLocus const& locus) {
    constexpr double radius = 0.01, grid = 0.1;
    constexpr int sides = 60;
    bool first = true;
    for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 7; ++j) {
            double const u = grid * i + 0.05, v = grid * j + 0.05;
            std::vector<Chromaticity> ring;
            for (int k = 0; k <= sides; ++k) {
                double const turn = 2 * std::numbers::pi * k / sides;
                ring.push_back(to_chromaticity(UvPrime{u + radius * std::cos(turn), v + radius * std::sin(turn)}));
            }
            if (!std::ranges::all_of(ring, [&](Chromaticity const& c) { return locus.contains(c); })) continue;
            page.line(on_plane(plane, ring), {{.35, .35, .35}, 1.5, false, first ? "Δu′v′ = 0.01 about a point" : ""});
            first = false;
        }
}

bool is_picture(std::string const& name) { return std::filesystem::path(name).extension() == ".exr"; }

std::vector<PlotPoint> cloud_of(Plane const& plane, std::string const& file) {
    std::vector<PlotPoint> points;
    for (Xyz const& c : read_exr_as_xyz(file).xyz.pixel)
        if (double const sum = c.X + c.Y + c.Z; std::isfinite(sum) && sum > 0)
            points.push_back(plane.at(to_chromaticity(c)));
    if (points.empty()) throw InputError({file}, "", "no pixel has a chromaticity: the picture is black");
    return points;
}

struct Mark {
    std::string name;
    PlotPoint at;
};

std::vector<Mark> marks_of(Plane const& plane, Options const& o) {
    std::vector<std::string> names;
    std::ranges::copy_if(o.names, std::back_inserter(names), [](std::string const& n) { return !is_picture(n); });
    ColourDescriber const describer(illuminant(o.illuminant), observer(o.observer));
    std::vector<Mark> marks;
    for (GivenSpectrum const& s : given_spectra(names)) {
        auto const xy = (s.is_light ? describer.of_light(s.function) : describer.of_object(s.function)).xy;
        if (!xy) throw InputError({}, s.function.name(), "is black: it has no chromaticity");
        std::string const& name = s.function.name();
        bool const member = !std::filesystem::exists(name) && name.find(':') != std::string::npos &&
                            !name.starts_with("blackbody:") && !name.starts_with("daylight:");
        marks.push_back({member ? name.substr(name.rfind(':') + 1) : std::filesystem::path(name).filename().string(),
                         plane.at(*xy)});
    }
    return marks;
}

int run_diagram(Options const& o) {
    check_output("--output", o.output, ".png");
    Plane const plane = plane_of(o.space);
    Observer const& eye = observer(o.observer);
    SpectralLocus const locus(eye);
    PlanckianLocus const planckian(eye);
    std::vector<Mark> const marks = marks_of(plane, o);
    std::vector<std::pair<std::string, std::vector<PlotPoint>>> clouds;
    for (std::string const& name : o.names)
        if (is_picture(name)) clouds.emplace_back(name, cloud_of(plane, name));

    Plot page(plane.width, plane.height, plane.x, plane.y);
    draw_locus(page, plane, locus);
    draw_scale(page, plane, locus);
    for (auto const& [name, points] : clouds) page.cloud(points, std::filesystem::path(name).filename().string());
    draw_gamuts(page, plane);
    draw_planckian(page, plane, planckian);
    page.cross(plane.at(rgb::rec709.white), {{0, 0, 0}, 2.5, false, ""});
    page.legend(plane.legend);
    label_locus(page, plane, locus);
    for (Mark const& m : marks) page.disc(m.at, 7, {0, 0, 0});
    label_planckian(page, plane, planckian);
    page.label("D65", plane.at(rgb::rec709.white), -1, 0.2, true);
    for (Mark const& m : marks)
        if (!page.label(m.name, m.at, 1, 0.3, true))
            fmt::print(stderr, "iride: no room for the name of '{}' in the diagram\n", m.name);
    page.write(o.output);
    return exit_done;
}

}  // namespace

Command add_colour_diagram(CLI::App& colour) {
    CLI::App* const parser = colour.add_subcommand("diagram", "Draw a chromaticity diagram as PNG");
    auto const o = std::make_shared<Options>();
    parser->add_option("-o,--output", o->output, "PNG file to write")->required();
    parser->add_option("--space", o->space, "xy (CIE 1931) or uv (CIE 1976 u', v')")->capture_default_str();
    parser->add_option(
        "SPECTRUM", o->names,
        "spectra, as for 'colour spectrum', drawn as points; or pictures (.exr), each as the cloud of its "
        "pixels");
    parser->add_option("--illuminant", o->illuminant, "light on reflectances")->capture_default_str();
    parser->add_option("--observer", o->observer, "whose locus")->capture_default_str();
    return {parser, [o] { return run_diagram(*o); }};
}

}  // namespace iride
