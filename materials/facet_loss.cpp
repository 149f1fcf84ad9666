// SPDX-License-Identifier: Apache-2.0
#include "materials/facet_loss.h"

#include <array>
#include <map>
#include <mutex>
#include <utility>

#include "base/random.h"
#include "materials/fresnel.h"

namespace iride {

namespace {

struct Node {
    double x, weight;
};

// Gauss-Legendre nodes on [-1, 1], the zeros of the Legendre polynomial by Newton's method. [Press 2007, sec. 4.6]
template <int count>
std::array<Node, count> gauss_legendre() {
    std::array<Node, count> nodes;
    for (int i = 0; i < count; ++i) {
        double x = std::cos(pi_double * (i + 0.75) / (count + 0.5)), derivative = 1;
        for (int newton = 0; newton < 8; ++newton) {
            double p = 1, before = 0;
            for (int k = 1; k <= count; ++k) before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
            derivative = count * (x * p - before) / (x * x - 1);
            x -= p / derivative;
        }
        nodes[static_cast<std::size_t>(i)] = {x, 2 / ((1 - x * x) * square(derivative))};
    }
    return nodes;
}

// Slopes (p, q) of stretched facets, along w and across it, as angles or lengths x in which their density is smooth:
//   GGX:       p = tan(x) of density cos(x) / 2,   q = sqrt(1 + p^2) tan(x) of density (2 / pi) cos^2(x)
//   Beckmann:  p = x, q = x of density exp(-x^2) / sqrt(pi)
struct SlopeMap {
    bool ggx;

    double widest() const { return ggx ? pi_double / 2 : 4.5; }  // of a Gaussian slope: exp(-4.5^2) = 2e-9
    double slope(double x) const { return ggx ? std::tan(x) : x; }
    double place(double slope) const { return ggx ? std::atan(slope) : std::clamp(slope, -widest(), widest()); }
    // What scales q.
    double spread(double p) const { return ggx ? std::sqrt(1 + p * p) : 1; }
    // Of p, times (cosine + p sine)+, which is the visible share.
    double visible_density(double x, double cosine, double sine) const {
        return ggx ? std::max(0.0, cosine * std::cos(x) + sine * std::sin(x)) / 2
                   : std::max(0.0, cosine + sine * x) * gaussian(x);
    }
    double density_beside(double x) const { return ggx ? 2 / pi_double * square(std::cos(x)) : gaussian(x); }

  private:
    static double gaussian(double x) { return std::exp(-x * x) / std::sqrt(pi_double); }
};

// Where an integrand over [start, end] has edges; in order.
class Pieces {
  public:
    Pieces(double start, double end) : place_{start, end}, count_(2) {}
    void split_at(double x) {
        if (!(x > place_[0] && x < place_[count_ - 1])) return;  // false for NaN
        std::size_t i = count_++;
        for (; place_[i - 1] > x; --i) place_[i] = place_[i - 1];
        place_[i] = x;
    }
    // By Gauss nodes in each piece.
    template <int count, class Function>
    double integral(Function&& function) const {
        static auto const nodes = gauss_legendre<count>();
        double sum = 0;
        for (std::size_t i = 0; i + 1 < count_; ++i) {
            double const middle = (place_[i] + place_[i + 1]) / 2, half = (place_[i + 1] - place_[i]) / 2;
            for (Node const& n : nodes) sum += half * n.weight * function(middle + half * n.x);
        }
        return sum;
    }

  private:
    std::array<double, 12> place_;
    std::size_t count_;
};

// 1 - G2 / G1, averaged over what the facet may do with the light.
double lost_at(Facets const& facets, Direction const& wo, Direction const& h, std::optional<double> eta,
               float lambda_o) {
    float const cosine = wo.dot(h);
    auto const blocked = [&](float kept) { return static_cast<double>(1 - kept); };
    Direction const reflected = 2 * cosine * h - wo;
    double const lost_reflected =
        reflected.z() > 0 ? blocked((1 + lambda_o) / (1 + facets.joint(lambda_o, facets.lambda(reflected, h)))) : 1;
    if (!eta) return lost_reflected;
    double const F = fresnel(std::clamp(static_cast<double>(cosine), 0.0, 1.0), *eta, 0.0).unpolarised();
    float const relative = static_cast<float>(1 / *eta), sine2 = (1 - square(cosine)) * square(relative);
    if (sine2 >= 1) return lost_reflected;
    Direction const refracted = (relative * cosine - std::sqrt(1 - sine2)) * h - relative * wo;
    double const lost_refracted = refracted.z() < 0 ? blocked(1 / (1 + facets.lambda(refracted, h))) : 1;
    return F * lost_reflected + (1 - F) * lost_refracted;
}

// The facets of one component as w sees them: in their stretched frame, where (1 + tangent p) is what shows of slope p.
struct StretchedView {
    double ax, ay;
    double ex, ey;         // direction of w
    double tangent, size;  // of stretched w, whose z is w.z / size
    double m11, m12, m22;  // tan^2 of the facet's slope = m11 p^2 + 2 m12 p q + m22 q^2

    StretchedView(FacetComponent const& c, Direction const& w);
    Direction normal(double p, double q) const {
        return VectorDouble(ax * (p * ex - q * ey), ay * (p * ey + q * ex), 1).normalized().cast<float>();
    }
    // Where w lies in a plane of symmetry, one half mirrors the other.
    bool is_symmetric() const { return m12 == 0; }
};

StretchedView::StretchedView(FacetComponent const& c, Direction const& w)
    : ax(static_cast<double>(c.alpha_x)), ay(static_cast<double>(c.alpha_y)) {
    auto const x = ax * static_cast<double>(w.x()), y = ay * static_cast<double>(w.y());
    auto const z = static_cast<double>(w.z()), length = std::hypot(x, y);
    tangent = length / z;
    size = std::hypot(length, z) / z;
    ex = length > 0 ? x / length : 1;
    ey = length > 0 ? y / length : 0;
    m11 = square(ax * ex) + square(ay * ey);
    m12 = ex * ey * (ay - ax) * (ay + ax);
    m22 = square(ax * ey) + square(ay * ex);
}

// The two q of facets (p, q) with this tan^2 of the slope; NaN if there are none.
std::pair<double, double> across_at(StretchedView const& v, double p, double tan2) {
    double const centre = -v.m12 * p, root = std::sqrt(centre * centre - v.m22 * (v.m11 * p * p - tan2));
    return {(centre - root) / v.m22, (centre + root) / v.m22};
}

// An edge of the integrand: facets (p, q) with tan^2 of the slope = c0 + c1 p + c2 p^2, an ellipse or hyperbola.
struct Edge {
    double c0, c1, c2;

    double tan2(double p) const { return c0 + p * (c1 + p * c2); }
    // The p where its two q meet: a p^2 + 2 b p + c = 0.
    std::pair<double, double> along(StretchedView const& v) const {
        double const a = v.m12 * v.m12 - v.m22 * (v.m11 - c2), b = v.m22 * c1 / 2, c = v.m22 * c0;
        double const sum = -(b + std::copysign(std::sqrt(b * b - a * c), b));
        return {sum / a, c / sum};
    }
};

// Where the reflected ray lies in the horizon, and where refraction ends.
std::vector<Edge> edges(StretchedView const& view, double cosine, std::optional<double> eta) {
    std::vector<Edge> all{{1, 2 * view.tangent, 0}};
    if (eta && *eta < 1) {
        double const critical = square(cosine) / (1 - square(*eta));
        all.push_back({critical - 1, 2 * critical * view.tangent, critical * square(view.tangent)});
    }
    return all;
}

double lost_share(Facets const& facets, Direction const& wo, std::optional<double> eta) {
    SlopeMap const map{facets.shape == FacetShape::ggx};
    double sum = 0;
    for (FacetComponent const& c : facets.components) {
        StretchedView const view(c, wo);
        std::vector<Edge> const all_edges = edges(view, static_cast<double>(wo.z()), eta);
        auto const across = [&](double p) {
            double const spread = map.spread(p), end = map.widest();
            Pieces pieces(view.is_symmetric() ? 0 : -end, end);
            auto const split_at_slope = [&](double tan2) {
                auto const [low, high] = across_at(view, p, tan2);
                pieces.split_at(map.place(low / spread));
                pieces.split_at(map.place(high / spread));
            };
            for (Edge const& edge : all_edges) split_at_slope(edge.tan2(p));
            if (facets.masking == Masking::v_cavity) {  // where masking and, in reflection, shadowing begin
                double const shown = 1 + view.tangent * p;
                split_at_slope(2 / shown - 1);
                split_at_slope(4 * shown / (2 + shown) - 1);
            }
            if (!map.ggx) pieces.split_at(0);  // where a Gaussian is, in a piece that may be much wider
            double const half = pieces.integral<10>([&](double x) {
                Direction const h = view.normal(p, spread * map.slope(x));
                float const lambda_o = facets.lambda(wo, h);
                return map.density_beside(x) * lost_at(facets, wo, h, eta, lambda_o) /
                       static_cast<double>(1 + lambda_o);
            });
            return view.is_symmetric() ? 2 * half : half;
        };
        double const cosine = 1 / view.size, sine = view.tangent / view.size;
        Pieces pieces(view.tangent > 0 ? map.place(-1 / view.tangent) : -map.widest(), map.widest());
        for (Edge const& edge : all_edges) {
            auto const [first, second] = edge.along(view);
            pieces.split_at(map.place(first));
            pieces.split_at(map.place(second));
        }
        if (!map.ggx) pieces.split_at(0);
        double const part =
            pieces.integral<16>([&](double x) { return map.visible_density(x, cosine, sine) * across(map.slope(x)); });
        sum += static_cast<double>(c.weight) * part * view.size;
    }
    return std::clamp(sum, 0.0, 1.0);
}

// int of 2 mu loss(mu) over the first `width` of a cell where loss = first + slope (mu - start).
float weighted_area(float start, float first, float slope, float width) {
    return width * (2 * start * first + width * (start * slope + first + width * slope * (2.0f / 3)));
}

// Azimuths of the rows, in steps that shrink towards the axis of the smaller roughness: the roughness along them
// changes where the azimuth from there is about the ratio of the two.
std::vector<double> azimuths(Facets const& facets) {
    if (!facets.is_anisotropic()) return {0};
    double log_ratio = 0;  // of alpha_y to alpha_x
    for (FacetComponent const& c : facets.components) {
        double const one = std::log(static_cast<double>(c.alpha_y / c.alpha_x));
        if (std::abs(one) > std::abs(log_ratio)) log_ratio = one;
    }
    double const bend = 1 + std::abs(log_ratio);
    int const steps = 8 + static_cast<int>(2 * bend);
    std::vector<double> result;
    for (int i = 0; i <= steps; ++i) {
        double const t = static_cast<double>(i) / steps;
        result.push_back(log_ratio > 0 ? pi_double / 2 * std::sinh(bend * t) / std::sinh(bend)
                                       : pi_double / 2 * (1 - std::sinh(bend * (1 - t)) / std::sinh(bend)));
    }
    return result;
}

}  // namespace

FacetLoss::FacetLoss(Facets const& facets, std::optional<double> eta) {
    int const octaves = std::clamp(6 - std::ilogb(facets.smallest_alpha()), 6, 16);
    first_ = std::ldexp(1.0f, -octaves);
    first_bits_ = std::bit_cast<std::uint32_t>(first_);
    last_bits_ = std::bit_cast<std::uint32_t>(1.0f) - first_bits_ - 1;
    for (double const azimuth : azimuths(facets)) rows_.push_back(make_row(facets, eta, azimuth));
    // A row's share of the azimuths is the area of its triangle.
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        float const from = rows_[r > 0 ? r - 1 : 0].azimuth, to = rows_[std::min(r + 1, rows_.size() - 1)].azimuth;
        float const share = rows_.size() == 1 ? 1 : (to - from) / pi;
        mean_ += share * rows_[r].knots.back().cumulative;
        rows_[r].cumulative_share = mean_;
    }
    for (Row& row : rows_) row.cumulative_share = mean_ > 0 ? row.cumulative_share / mean_ : 1;
}

FacetLoss::Row FacetLoss::make_row(Facets const& facets, std::optional<double> eta, double azimuth) const {
    Row row{static_cast<float>(azimuth), 0, {}};
    std::size_t const knots = ((last_bits_ + 1) >> bits_of_place) + 1;
    for (std::size_t i = 0; i < knots; ++i) {
        constexpr float nearly_0 = 1e-5f;  // the limit at grazing incidence, without its division by 0
        float const cosine = cosine_of(i), z = std::max(cosine, nearly_0);
        double const sine = std::sqrt(static_cast<double>((1 - z) * (1 + z)));
        Direction const w(static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
                          z);
        Knot knot{static_cast<float>(lost_share(facets, w, eta)), 0};
        if (i > 0) {
            float const start = cosine_of(i - 1), width = cosine - start;
            Knot const& before = row.knots.back();
            knot.cumulative =
                before.cumulative + weighted_area(start, before.loss, (knot.loss - before.loss) / width, width);
        }
        row.knots.push_back(knot);
    }
    return row;
}

float FacetLoss::loss_between_rows(Direction const& w, Place place) const {
    float const azimuth = arctangent(std::abs(w.y()), std::abs(w.x()));
    auto const above = std::ranges::upper_bound(rows_.begin() + 1, rows_.end() - 1, azimuth, {}, &Row::azimuth);
    Row const &a = *(above - 1), &b = *above;
    float const t = std::clamp((azimuth - a.azimuth) / (b.azimuth - a.azimuth), 0.0f, 1.0f);
    return (1 - t) * loss_in(a, place) + t * loss_in(b, place);
}

Direction FacetLoss::sample(Sample2 u) const {
    float row_number = u.x;
    std::size_t row = 0;
    if (rows_.size() > 1) {
        auto const found = std::ranges::upper_bound(rows_.begin(), rows_.end() - 1, u.x, {}, &Row::cumulative_share);
        row = static_cast<std::size_t>(found - rows_.begin());
        float const before = row > 0 ? rows_[row - 1].cumulative_share : 0;
        row_number = (u.x - before) / (found->cumulative_share - before);
    }
    float const cosine = sample_cosine(rows_[row], row_number);
    auto const [y, x] = sine_cosine_of_turns(rows_.size() == 1 ? u.y : sample_azimuth(row, u.y));
    float const r = std::sqrt(std::max(0.0f, (1 - cosine) * (1 + cosine)));
    return {r * x, r * y, cosine};
}

float FacetLoss::sample_cosine(Row const& row, float u) const {
    std::vector<Knot> const& knots = row.knots;
    float const target = u * knots.back().cumulative;
    auto const above = std::ranges::upper_bound(knots.begin() + 1, knots.end() - 1, target, {}, &Knot::cumulative);
    auto const cell = static_cast<std::size_t>(above - knots.begin()) - 1;
    Knot const &a = knots[cell], &b = knots[cell + 1];
    float const start = cosine_of(cell), width = cosine_of(cell + 1) - start, slope = (b.loss - a.loss) / width;
    float const wanted = std::max(0.0f, target - a.cumulative);
    float x = width * std::cbrt(std::min(1.0f, wanted / (b.cumulative - a.cumulative)));  // good in the first cell
    for (int newton = 0; newton < 5; ++newton) {  // of a nearly straight cubic: to the last bits
        float const derivative = 2 * (start + x) * (a.loss + slope * x);
        if (!(derivative > 0)) break;
        x = std::clamp(x - (weighted_area(start, a.loss, slope, x) - wanted) / derivative, 0.0f, width);
    }
    return start + x;
}

// Turns, of a density that is a triangle over the neighbouring rows, in one of four mirror images.
float FacetLoss::sample_azimuth(std::size_t row, float u) const {
    float const quadrant = std::floor(4 * u), v = 4 * u - quadrant, centre = rows_[row].azimuth;
    float const below = row > 0 ? centre - rows_[row - 1].azimuth : 0;
    float const above = row + 1 < rows_.size() ? rows_[row + 1].azimuth - centre : 0;
    float const place = v * (below + above);
    float const azimuth = place < below ? centre - below * (1 - std::sqrt(place / below))
                                        : centre + above * (1 - std::sqrt((below + above - place) / above));
    float const turns = azimuth / (2 * pi);
    bool const mirrored = quadrant == 1 || quadrant == 3;
    return (quadrant >= 2 ? 0.5f : 0) + (mirrored ? 0.5f - turns : turns);
}

std::shared_ptr<FacetLoss const> shared_facet_loss(Facets const& facets, std::optional<double> eta) {
    static std::mutex mutex;
    static std::map<std::pair<Facets, std::optional<double>>, std::weak_ptr<FacetLoss const>> tables;
    std::lock_guard const lock(mutex);
    std::weak_ptr<FacetLoss const>& slot = tables[{facets, eta}];
    std::shared_ptr<FacetLoss const> table = slot.lock();
    if (!table) slot = table = std::make_shared<FacetLoss const>(facets, eta);
    return table;
}

Sample2 further_numbers(Sample3 const& u) {
    auto const bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
    std::uint64_t const mixed = hash_words(bits(u.lobe), bits(u.direction.x), bits(u.direction.y));
    return {to_unit_float(static_cast<std::uint32_t>(mixed >> 32)), to_unit_float(static_cast<std::uint32_t>(mixed))};
}

}  // namespace iride
