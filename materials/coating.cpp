// SPDX-License-Identifier: Apache-2.0
#include "materials/coating.h"

#include <fmt/format.h>

#include "base/diagnostics.h"
#include "base/trigonometry.h"

namespace iride {

namespace {

struct LaneComplex {
    LaneRegister re, im;

    friend LaneComplex operator+(LaneComplex a, LaneComplex b) { return {a.re + b.re, a.im + b.im}; }
    friend LaneComplex operator-(LaneComplex a, LaneComplex b) { return {a.re - b.re, a.im - b.im}; }
    friend LaneComplex operator*(LaneComplex a, LaneComplex b) {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend LaneComplex operator*(LaneRegister s, LaneComplex a) { return {s * a.re, s * a.im}; }
};

LaneRegister norm(LaneComplex a) { return a.re * a.re + a.im * a.im; }
LaneRegister root(LaneRegister x) { return sqrt(Lanes(x)).lane; }

// sqrt(z), Im z >= 0, in the first quadrant: exactly real or imaginary for a real z.
LaneComplex root(LaneComplex z) {
    LaneRegister const size = z.re < 0.0f ? -z.re : z.re;
    LaneRegister const major = root(0.5f * (root(norm(z)) + size));
    LaneRegister const minor = major > 0.0f ? 0.5f * z.im / major : LaneRegister{};
    return {z.re < 0.0f ? minor : major, z.re < 0.0f ? major : minor};
}

// exp(x) for x <= 0, to 3e-7 of the value; 0 below exp(-80). 2^whole by its exponent bits, the rest by Taylor's series.
LaneRegister decay(LaneRegister x) {
    constexpr float per_e = 1.44269504f, least = -80;
    LaneRegister const t = (x < least ? LaneRegister{} + least : x) * per_e;
    LaneRegister const whole = nearest_whole(t), f = (t - whole) / per_e;
    LaneRegister const series =
        1 + f * (1 + f * (1.0f / 2 + f * (1.0f / 6 + f * (1.0f / 24 + f * (1.0f / 120 + f * (1.0f / 720))))));
    LaneIndex const exponent = __builtin_convertvector(whole, LaneIndex) * (1 << 23);
    LaneRegister const value = reinterpret_cast<LaneRegister>(reinterpret_cast<LaneIndex>(series) + exponent);
    return x < least ? LaneRegister{} : value;
}

template <class Register>
LaneComplex on_unit_circle(Register turns) {
    if constexpr (std::is_same_v<Register, Real8>) {
        auto const [sine, cosine] = sine_cosine_of_turns(turns);
        return {cosine, sine};
    } else {  // another number of lanes
        LaneComplex z{};
        for (int i = 0; i < lane_count; ++i) {
            auto const [sine, cosine] = sine_cosine_of_turns(turns[i]);
            z.re[i] = cosine;
            z.im[i] = sine;
        }
        return z;
    }
}

// One polarisation on its way up: r = P / Q, and |t Q|^2 but for the factors of the uppermost boundary.
struct Wave {
    LaneComplex P{}, Q{LaneRegister{} + 1, {}};
    LaneRegister passed = LaneRegister{} + 1;

    // Through the boundary with admittances a above and b below, over a layer with e^2 = echo.
    void cross(LaneComplex a, LaneComplex b, LaneComplex echo) {
        LaneComplex const sum = a + b, difference = a - b, eP = echo * P;
        LaneComplex const newP = difference * Q + sum * eP, newQ = sum * Q + difference * eP;
        // |P| <= |Q|: scaled to about 1, so that 32 layers do not overflow.
        LaneRegister const size = newQ.re * newQ.re + newQ.im * newQ.im;
        LaneRegister const scale = 1 / root(size > 1e-30f ? size : LaneRegister{} + 1e-30f);
        P = scale * newP;
        Q = scale * newQ;
        passed *= scale * scale;
    }
    LaneRegister R() const {
        LaneRegister const q = norm(Q);
        return q > 0.0f ? norm(P) / q : LaneRegister{} + 1;
    }
    LaneRegister T(LaneRegister above, LaneRegister below) const {
        LaneRegister const q = norm(Q);
        return q > 0.0f ? 4 * above * below * passed / q : LaneRegister{};
    }
};

LaneComplex quotient(LaneComplex a, LaneComplex b) {
    return (1 / norm(b)) * LaneComplex{a.re * b.re + a.im * b.im, a.im * b.re - a.re * b.im};
}

Reflectance tabulated(ComplexIndex const& index, WavelengthGrid const& grid, double (*part)(std::complex<double>)) {
    auto const value = [&](double nm) {
        std::complex<double> const N = index_at(index, nm);
        return part(N * N);
    };
    if (index.n.is_constant() && index.k.is_constant()) return Reflectance(static_cast<float>(value(0)));
    TabulatedShape table;
    for (int i = 0; i < grid.count; ++i) {
        table.nm.push_back(grid.first_nm + i);
        table.value.push_back(value(table.nm.back()));
    }
    return Reflectance(SpectralFunction(std::move(table), Outside::hold), grid);
}

// Light that crosses the layer and comes back, with k of the layer: exp(-4 pi k d / lambda).
bool is_opaque(CoatingLayer const& l, double nm) {
    constexpr double unseen = 1e-6;
    return std::exp(-4 * std::numbers::pi * std::max(0.0, l.index.k.at(nm)) * l.thickness_nm / nm) < unseen;
}

void check_coherent(CoatingLayer const& l, WavelengthGrid const& grid) {
    for (int i = 0; i < grid.count; ++i) {
        double const nm = grid.first_nm + i, optical = l.index.n.at(nm) * l.thickness_nm;
        if (optical > most_optical_thickness_nm && !is_opaque(l, nm))
            throw InputError(
                {}, "",
                fmt::format("a film of optical thickness {:g} um is not coherent: allowed up to {:g} um; a "
                            "thicker layer is a body of its own",
                            optical / 1000, most_optical_thickness_nm / 1000));
    }
}

}  // namespace

double coated_reflectance(std::span<CoatingLayer const> layers, ComplexIndex const& substrate, double wavelength_nm,
                          double cosine) {
    PlaneStack const stack{.layers = {layers.begin(), layers.end()}, .inside = substrate};
    return stack.power(wavelength_nm, cosine).R.unpolarised();
}

CoatingTable::CoatingTable(std::span<CoatingLayer const> layers, ComplexIndex const& substrate,
                           WavelengthGrid const& grid, ComplexIndex const& outside)
    : stack_{outside, {layers.begin(), layers.end()}, substrate},
      first_nm_(static_cast<float>(grid.first_nm)),
      last_cell_(grid.count - 2) {
    auto const add = [&](ComplexIndex const& index, double thickness_nm) {
        media_.push_back({tabulated(index, grid, [](std::complex<double> z) { return z.real(); }),
                          tabulated(index, grid, [](std::complex<double> z) { return z.imag(); }),
                          static_cast<float>(thickness_nm)});
    };
    add({outside.n, SpectralFunction::constant(0)}, 0);
    for (CoatingLayer const& l : layers) {
        check_coherent(l, grid);
        add(l.index, l.thickness_nm);
    }
    add(substrate, 0);
}

LanePower CoatingTable::power(LaneRegister row, float cosine, bool from_inside) const {
    float const c = cosine > 0 ? std::min(cosine, 1.0f) : 0;
    Wavelengths w{};
    LaneIndex const cell = __builtin_convertvector(row, LaneIndex), last = LaneIndex{} + last_cell_;
    w.cell = cell < last ? cell : last;
    w.fraction = row - __builtin_convertvector(w.cell, LaneRegister);
    LaneRegister const per_nm = 1 / (row + first_nm_);

    int const bottom = static_cast<int>(media_.size()) - 1;
    auto const medium = [&](int i) -> Medium const& {
        return media_[static_cast<std::size_t>(from_inside ? bottom - i : i)];
    };
    auto const square_of = [&](Medium const& m) { return LaneComplex{m.re.at(w).lane, m.im.at(w).lane}; };

    LaneRegister const N2 = medium(0).re.at(w).lane, S2 = N2 * ((1 - c) * (1 + c)), q0 = root(N2) * c;
    LaneComplex const below2 = square_of(medium(bottom));
    LaneComplex const q = root(below2 - LaneComplex{S2, LaneRegister{}});
    LaneComplex const below_s = q, below_p = quotient(q, below2);
    LaneComplex lower_s = below_s, lower_p = below_p, echo{};
    Wave s, p;
    for (int i = bottom - 1; i > 0; --i) {
        Medium const& layer = medium(i);
        LaneComplex const layer2 = square_of(layer), upper_s = root(layer2 - LaneComplex{S2, LaneRegister{}});
        LaneComplex const upper_p = quotient(upper_s, layer2);
        s.cross(upper_s, lower_s, echo);
        p.cross(upper_p, lower_p, echo);
        LaneRegister const once = layer.thickness_nm * per_nm, fading = decay(-4 * pi * once * upper_s.im);
        LaneComplex const turned = fading * on_unit_circle(2 * once * upper_s.re);
        auto const seen = fading > 0.0f;  // else the phase may be no number
        echo = {seen ? turned.re : LaneRegister{}, seen ? turned.im : LaneRegister{}};
        s.passed *= 4 * norm(upper_s) * fading;
        p.passed *= 4 * norm(upper_p) * fading;
        lower_s = upper_s;
        lower_p = upper_p;
    }
    LaneRegister const above_p = q0 / N2;
    s.cross({q0, LaneRegister{}}, lower_s, echo);
    p.cross({above_p, LaneRegister{}}, lower_p, echo);
    Lanes const one(1), R = min(one, Lanes(0.5f * (s.R() + p.R())));
    return {R, min(one - R, Lanes(0.5f * (s.T(q0, below_s.re) + p.T(above_p, below_p.re))))};
}

// With x = sqrt(mu), which is finest at grazing incidence: int 4 x^3 R dx by the midpoint rule.
double CoatingTable::mean_reflectance(double nm) const {
    constexpr int steps = 128;
    LaneRegister const row = LaneRegister{} + static_cast<float>(nm);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        double const x = (i + 0.5) / steps;
        sum += 4 * x * x * x * static_cast<double>(reflectance(row, static_cast<float>(x * x))[0]);
    }
    return sum / steps;
}

}  // namespace iride
