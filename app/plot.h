// SPDX-License-Identifier: Apache-2.0
// A plot for a page: two axes with numbers and titles, lines, points, labels that do not cover each other, a legend; as
// PNG. Positions are in the units of the axes. Drawn by Cairo, which only plot.cpp includes.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct _cairo;

namespace iride {

struct PlotPoint {
    double x, y;
};
struct PlotColour {
    double red, green, blue, alpha = 1;  // sRGB
};

struct PlotAxis {
    double min, max, tick;  // tick 0: no axis is drawn, only the title
    std::string title;
};

struct Stroke {
    PlotColour colour;
    double width = 2;  // pixels
    bool dashed = false;
    std::string legend = {};  // an entry of that name; empty: none
};

// A tick distance of 1, 2 or 5 times a power of ten that divides `length` into at most `most` parts.
double round_tick(double length, int most);

class Plot {
  public:
    // Width and height of the area between the axes, in pixels; `right` pixels of margin beside it for a legend.
    Plot(int width, int height, PlotAxis x, PlotAxis y, int right = 40);
    ~Plot();
    Plot(Plot&&) = default;

    // Fills a polygon with a colour that depends on the place, pixel by pixel.
    void fill(std::span<PlotPoint const> polygon, std::function<PlotColour(PlotPoint const&)> const& colour);
    // How many of many points fall on a pixel, as a black of growing density.
    void cloud(std::span<PlotPoint const> points, std::string const& legend);
    void line(std::span<PlotPoint const> points, Stroke const& stroke);
    void disc(PlotPoint const& at, double radius_px, PlotColour const& colour);
    void cross(PlotPoint const& at, Stroke const& stroke);

    // A stroke of a few pixels from a point in direction (dx, dy) of the page, y upwards.
    void tick(PlotPoint const& at, double dx, double dy, double length_px, Stroke const& stroke);

    // Text beside a point, `away_px` off in direction (dx, dy) of the page, y upwards, if it covers no other text
    // there, else a little farther or in one of the directions around it if `anywhere`; false if there is no room.
    bool label(std::string const& text, PlotPoint const& at, double dx, double dy, bool anywhere = false,
               double away_px = 14);
    // Keeps labels away from a point.
    void reserve(PlotPoint const& at, double radius_px);

    // The entries so far, in a box whose top left corner is here; beside the area if absent.
    void legend(std::optional<PlotPoint> const& top_left = {});
    // Throws InputError if the file cannot be written.
    void write(std::filesystem::path const& path);

  private:
    struct Box {
        double x0, y0, x1, y1;  // pixels
    };
    PlotPoint pixel(PlotPoint const& p) const;
    bool is_free(Box const& box) const;
    double text_width(std::string const& text) const;
    friend class PlotPage;
    void text(std::string const& text, double x, double y) const;
    void halo_text(std::string const& text, double x, double y) const;
    void path(std::span<PlotPoint const> points) const;
    void use(Stroke const& stroke) const;
    void clip_to_area() const;
    void axes();

    int width_, height_;
    PlotAxis x_, y_;
    std::shared_ptr<struct _cairo> cairo_;
    std::vector<Box> taken_;
    std::vector<Stroke> entries_;
};

// Several plots on one page, as PNG.
class PlotPage {
  public:
    PlotPage(int width, int height);
    // With the plot's top left corner at (x, y), in pixels from the page's.
    void place(Plot const& plot, int x, int y);
    void text(std::string const& words, double x, double y);
    void write(std::filesystem::path const& path);

  private:
    std::shared_ptr<struct _cairo> cairo_;
};

}  // namespace iride
