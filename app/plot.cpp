// SPDX-License-Identifier: Apache-2.0
#include "app/plot.h"

#include <cairo/cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/atomic_file.h"
#include "base/diagnostics.h"

namespace iride {

namespace {

// Pixels.
constexpr double left = 130, bottom = 105, top = 40, font_size = 22, title_size = 26, gap = 6;
constexpr double legend_row = 27, legend_line = 46, legend_margin = 16;

std::uint32_t premultiplied(PlotColour const& c) {
    auto const byte = [](double v) { return static_cast<std::uint32_t>(std::lround(255 * std::clamp(v, 0.0, 1.0))); };
    return byte(c.alpha) << 24 | byte(c.red * c.alpha) << 16 | byte(c.green * c.alpha) << 8 | byte(c.blue * c.alpha);
}

// A picture of our own pixels, [height][width], as Cairo wants it.
std::shared_ptr<cairo_surface_t> surface_of(std::vector<std::uint32_t>& pixels, int width, int height) {
    return {cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_ARGB32,
                                                width, height, width * 4),
            cairo_surface_destroy};
}

std::shared_ptr<cairo_t> white_page(int width, int height) {
    std::shared_ptr<cairo_surface_t> const surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height),
                                                   cairo_surface_destroy);
    std::shared_ptr<cairo_t> page{cairo_create(surface.get()), cairo_destroy};
    cairo_set_source_rgb(page.get(), 1, 1, 1);
    cairo_paint(page.get());
    cairo_select_font_face(page.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    return page;
}

void write_png(cairo_t* page, std::filesystem::path const& path) {
    AtomicFile file(path);
    cairo_surface_t* const surface = cairo_get_target(page);
    cairo_surface_flush(surface);
    cairo_status_t const status = cairo_surface_write_to_png(surface, file.temporary().c_str());
    if (status != CAIRO_STATUS_SUCCESS)
        throw InputError({path.string()}, "", fmt::format("cannot be written: {}", cairo_status_to_string(status)));
    file.commit();
}

std::string number(double value, double tick) {
    int const decimals = std::max(0, static_cast<int>(-std::floor(std::log10(tick) + 1e-9)));
    return fmt::format("{:.{}f}", std::abs(value) < tick / 2 ? 0.0 : value, decimals);
}

}  // namespace

double round_tick(double length, int most) {
    double const power = std::pow(10, std::floor(std::log10(length / most)));
    for (double const step : {1.0, 2.0, 5.0})
        if (length / (step * power) <= most) return step * power;
    return 10 * power;
}

Plot::Plot(int width, int height, PlotAxis x, PlotAxis y, int right)
    : width_(width), height_(height), x_(std::move(x)), y_(std::move(y)) {
    cairo_ = white_page(static_cast<int>(left) + width + right, static_cast<int>(top + bottom) + height);
    cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
    axes();
}

Plot::~Plot() = default;

PlotPoint Plot::pixel(PlotPoint const& p) const {
    return {left + (p.x - x_.min) / (x_.max - x_.min) * width_, top + (y_.max - p.y) / (y_.max - y_.min) * height_};
}

double Plot::text_width(std::string const& words) const {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_.get(), words.c_str(), &extents);
    return extents.x_advance;
}

void Plot::text(std::string const& words, double x, double y) const {
    cairo_move_to(cairo_.get(), x, y);
    cairo_show_text(cairo_.get(), words.c_str());
}

void Plot::halo_text(std::string const& words, double x, double y) const {
    cairo_t* const c = cairo_.get();
    constexpr double halo_px = 4;
    cairo_move_to(c, x, y);
    cairo_text_path(c, words.c_str());
    cairo_set_source_rgba(c, 1, 1, 1, 0.65);
    cairo_set_line_width(c, halo_px);
    cairo_set_dash(c, nullptr, 0, 0);
    cairo_stroke_preserve(c);
    cairo_set_source_rgb(c, 0, 0, 0);
    cairo_fill(c);
}

void Plot::axes() {
    cairo_t* const c = cairo_.get();
    constexpr double tick_px = 8;
    cairo_set_font_size(c, font_size);
    auto const grid = [&](double x0, double y0, double x1, double y1, double grey, double line) {
        cairo_set_source_rgb(c, grey, grey, grey);
        cairo_set_line_width(c, line);
        cairo_move_to(c, x0, y0);
        cairo_line_to(c, x1, y1);
        cairo_stroke(c);
    };
    double const right = left + width_, low = top + height_;
    auto const ticks = [](PlotAxis const& axis, auto const& draw) {
        if (!(axis.tick > 0)) return;
        constexpr double rounding = 1e-9;  // of a tick
        for (double i = std::ceil(axis.min / axis.tick - rounding); i * axis.tick <= axis.max + rounding * axis.tick;
             ++i)
            draw(i * axis.tick, number(i * axis.tick, axis.tick));
    };
    ticks(x_, [&](double value, std::string const& words) {
        double const x = pixel({value, 0}).x;
        grid(x, top, x, low, 0.9, 1);
        grid(x, low, x, low + tick_px, 0, 1.5);
        text(words, x - text_width(words) / 2, low + tick_px + font_size + 2);
    });
    ticks(y_, [&](double value, std::string const& words) {
        double const y = pixel({0, value}).y;
        grid(left, y, right, y, 0.9, 1);
        grid(left - tick_px, y, left, y, 0, 1.5);
        text(words, left - tick_px - gap - text_width(words), y + font_size * 0.36);
    });
    cairo_set_font_size(c, title_size);
    cairo_set_source_rgb(c, 0, 0, 0);
    text(x_.title, left + (width_ - text_width(x_.title)) / 2, low + bottom - 24);
    cairo_save(c);
    cairo_translate(c, title_size + 12, top + (height_ + text_width(y_.title)) / 2);
    cairo_rotate(c, -std::numbers::pi / 2);
    text(y_.title, 0, 0);
    cairo_restore(c);
    cairo_set_font_size(c, font_size);
    cairo_set_line_width(c, 1.5);
    if (!(x_.tick > 0 || y_.tick > 0)) return;
    cairo_rectangle(c, left, top, width_, height_);
    cairo_stroke(c);
}

void Plot::path(std::span<PlotPoint const> points) const {
    cairo_new_path(cairo_.get());
    for (PlotPoint const& p : points) {
        auto const [x, y] = pixel(p);
        cairo_line_to(cairo_.get(), x, y);
    }
}

void Plot::use(Stroke const& s) const {
    cairo_set_source_rgba(cairo_.get(), s.colour.red, s.colour.green, s.colour.blue, s.colour.alpha);
    cairo_set_line_width(cairo_.get(), s.width);
    std::array<double, 2> const dash{4 * s.width, 2.5 * s.width};
    cairo_set_dash(cairo_.get(), dash.data(), s.dashed ? 2 : 0, 0);
}

void Plot::clip_to_area() const {
    cairo_rectangle(cairo_.get(), left, top, width_, height_);
    cairo_clip(cairo_.get());
}

void Plot::fill(std::span<PlotPoint const> polygon, std::function<PlotColour(PlotPoint const&)> const& colour) {
    std::vector<std::uint32_t> pixels;
    for (int j = 0; j < height_; ++j)
        for (int i = 0; i < width_; ++i)
            pixels.push_back(premultiplied(colour(
                {x_.min + (i + 0.5) / width_ * (x_.max - x_.min), y_.max - (j + 0.5) / height_ * (y_.max - y_.min)})));
    auto const surface = surface_of(pixels, width_, height_);
    path(polygon);
    cairo_set_source_surface(cairo_.get(), surface.get(), left, top);
    cairo_fill(cairo_.get());
}

void Plot::cloud(std::span<PlotPoint const> points, std::string const& legend_name) {
    constexpr int dot_px = 2;
    int const columns = width_ / dot_px, rows = height_ / dot_px;
    std::vector<double> count(static_cast<std::size_t>(columns * rows), 0.0);
    for (PlotPoint const& p : points) {
        auto const [x, y] = pixel(p);
        double const i = std::floor((x - left) / dot_px), j = std::floor((y - top) / dot_px);
        if (i >= 0 && j >= 0 && i < columns && j < rows)
            ++count[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)];
    }
    double const most = std::log1p(*std::ranges::max_element(count));
    std::vector<std::uint32_t> pixels;
    constexpr double faintest = 0.35;  // opacity of a single point
    for (double const n : count)
        pixels.push_back(premultiplied({0, 0, 0, n > 0 ? faintest + (1 - faintest) * std::log1p(n) / most : 0}));
    auto const surface = surface_of(pixels, columns, rows);
    cairo_t* const c = cairo_.get();
    cairo_save(c);
    cairo_translate(c, left, top);
    cairo_scale(c, dot_px, dot_px);
    cairo_set_source_surface(c, surface.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(c), CAIRO_FILTER_NEAREST);
    cairo_rectangle(c, 0, 0, columns, rows);
    cairo_fill(c);
    cairo_restore(c);
    entries_.push_back({{0, 0, 0}, 8, false, legend_name});
}

void Plot::line(std::span<PlotPoint const> points, Stroke const& stroke) {
    cairo_save(cairo_.get());
    clip_to_area();
    path(points);
    use(stroke);
    cairo_stroke(cairo_.get());
    cairo_restore(cairo_.get());
    if (!stroke.legend.empty()) entries_.push_back(stroke);
}

void Plot::disc(PlotPoint const& at, double radius, PlotColour const& colour) {
    auto const [x, y] = pixel(at);
    cairo_t* const c = cairo_.get();
    cairo_new_path(c);
    cairo_arc(c, x, y, radius, 0, 2 * std::numbers::pi);
    cairo_set_source_rgba(c, colour.red, colour.green, colour.blue, colour.alpha);
    cairo_fill_preserve(c);
    use({{1, 1, 1}, 1.5});
    cairo_stroke(c);
    reserve(at, radius);
}

void Plot::cross(PlotPoint const& at, Stroke const& stroke) {
    auto const [x, y] = pixel(at);
    constexpr double arm_px = 9;
    use(stroke);
    for (double const slope : {1.0, -1.0}) {
        cairo_move_to(cairo_.get(), x - arm_px, y - slope * arm_px);
        cairo_line_to(cairo_.get(), x + arm_px, y + slope * arm_px);
        cairo_stroke(cairo_.get());
    }
    reserve(at, arm_px);
    if (!stroke.legend.empty()) entries_.push_back(stroke);
}

void Plot::tick(PlotPoint const& at, double dx, double dy, double length_px, Stroke const& stroke) {
    auto const [x, y] = pixel(at);
    double const scale = length_px / std::hypot(dx, dy);
    use(stroke);
    cairo_move_to(cairo_.get(), x, y);
    cairo_line_to(cairo_.get(), x + scale * dx, y - scale * dy);
    cairo_stroke(cairo_.get());
}

void Plot::reserve(PlotPoint const& at, double radius) {
    auto const [x, y] = pixel(at);
    taken_.push_back({x - radius, y - radius, x + radius, y + radius});
}

bool Plot::is_free(Box const& b) const {
    if (b.x0 < left || b.x1 > left + width_ || b.y0 < top || b.y1 > top + height_) return false;
    return std::ranges::none_of(taken_,
                                [&](Box const& t) { return b.x0 < t.x1 && t.x0 < b.x1 && b.y0 < t.y1 && t.y0 < b.y1; });
}

bool Plot::label(std::string const& words, PlotPoint const& at, double dx, double dy, bool anywhere, double away_px) {
    auto const [x, y] = pixel(at);
    double const w = text_width(words), h = font_size * 0.8, first = std::atan2(dy, dx);
    constexpr double step_px = 16;
    constexpr int directions = 12, rings = 10;
    for (int ring = 0; ring < (anywhere ? rings : 1); ++ring)
        for (int i = 0; i < (anywhere ? directions : 1); ++i) {
            // Alternately to both sides of the direction wished for.
            double const turn = (i % 2 ? 1 : -1) * ((i + 1) / 2) * 2 * std::numbers::pi / directions;
            double const away = away_px + ring * step_px, ux = std::cos(first + turn), uy = std::sin(first + turn);
            double const cx = x + ux * (away + w / 2), cy = y - uy * (away + h / 2);
            Box const box{cx - w / 2 - 3, cy - h / 2 - 3, cx + w / 2 + 3, cy + h / 2 + 3};
            if (!is_free(box)) continue;
            if (ring > 0) {
                use({{0, 0, 0, 0.7}, 1.2});
                cairo_move_to(cairo_.get(), x, y);
                cairo_line_to(cairo_.get(), std::clamp(x, box.x0, box.x1), std::clamp(y, box.y0, box.y1));
                cairo_stroke(cairo_.get());
            }
            halo_text(words, cx - w / 2, cy + h / 2);
            taken_.push_back(box);
            return true;
        }
    return false;
}

void Plot::legend(std::optional<PlotPoint> const& top_left) {
    cairo_t* const c = cairo_.get();
    double widest = 0;
    for (Stroke const& e : entries_) widest = std::max(widest, text_width(e.legend));
    auto const [x, y] = top_left ? pixel(*top_left) : PlotPoint{left + width_ + 24.0, top};
    double const rows = static_cast<double>(entries_.size());
    if (top_left) {
        taken_.push_back({x, y, x + legend_line + widest + 3 * legend_margin, y + legend_row * rows + legend_margin});
        cairo_rectangle(c, x, y, legend_line + widest + 3 * legend_margin, legend_row * rows + legend_margin);
        cairo_set_source_rgba(c, 1, 1, 1, 0.9);
        cairo_fill_preserve(c);
        use({{0, 0, 0}, 1});
        cairo_stroke(c);
    }
    double row = y + legend_margin / 2 + legend_row / 2;
    for (Stroke const& e : entries_) {
        use(e);
        cairo_move_to(c, x + legend_margin, row);
        cairo_line_to(c, x + legend_margin + legend_line, row);
        cairo_stroke(c);
        cairo_set_source_rgb(c, 0, 0, 0);
        text(e.legend, x + legend_margin * 2 + legend_line, row + font_size * 0.36);
        row += legend_row;
    }
}

void Plot::write(std::filesystem::path const& path) { write_png(cairo_.get(), path); }

PlotPage::PlotPage(int width, int height) : cairo_(white_page(width, height)) {}

void PlotPage::place(Plot const& plot, int x, int y) {
    cairo_set_source_surface(cairo_.get(), cairo_get_target(plot.cairo_.get()), x, y);
    cairo_paint(cairo_.get());
}

void PlotPage::text(std::string const& words, double x, double y) {
    cairo_set_font_size(cairo_.get(), title_size);
    cairo_set_source_rgb(cairo_.get(), 0, 0, 0);
    cairo_move_to(cairo_.get(), x, y);
    cairo_show_text(cairo_.get(), words.c_str());
}

void PlotPage::write(std::filesystem::path const& path) { write_png(cairo_.get(), path); }

}  // namespace iride
