// SPDX-License-Identifier: Apache-2.0
#include "materials/coating.h"

#include "base/diagnostics.h"
#include "base/vector.h"

namespace iride {

namespace {

std::complex<double> at(ComplexIndex const& index, double nm) {
    return {index.n.at(nm), std::max(0.0, index.k.at(nm))};
}

std::vector<ThinLayer<double>> stack_at(std::span<CoatingLayer const> layers, double nm) {
    std::vector<ThinLayer<double>> stack;
    for (CoatingLayer const& l : layers) stack.push_back({at(l.index, nm), l.thickness_nm});
    return stack;
}

// Reflectances on an even grid of wavelengths and sqrt(cosine), [columns][rows].
struct Tabulation {
    double first_nm;
    int cells_nm, rows_per_nm, cells_x;
    std::vector<double> value{};

    int rows() const { return cells_nm * rows_per_nm + 1; }
    int columns() const { return cells_x + 1; }
    std::size_t place(int column, int row) const {
        return static_cast<std::size_t>(column) * static_cast<std::size_t>(rows()) + static_cast<std::size_t>(row);
    }
    double operator()(int column, int row) const { return value[place(column, row)]; }
    void fill(std::span<CoatingLayer const> layers, ComplexIndex const& substrate);
};

void Tabulation::fill(std::span<CoatingLayer const> layers, ComplexIndex const& substrate) {
    value.resize(place(columns(), 0));
    for (int row = 0; row < rows(); ++row) {
        double const nm = first_nm + static_cast<double>(row) / rows_per_nm;
        std::vector<ThinLayer<double>> const stack = stack_at(layers, nm);
        std::complex<double> const bulk = at(substrate, nm);
        for (int column = 0; column < columns(); ++column) {
            double const x = static_cast<double>(column) / cells_x;
            value[place(column, row)] = thin_film<double>(x * x, 1, stack, bulk, nm).R.unpolarised();
        }
    }
}

// How far the odd points lie from the straight lines between their even neighbours, along each axis.
double error_in_wavelength(Tabulation const& t) {
    double largest = 0;
    for (int c = 0; c < t.columns(); ++c)
        for (int r = 1; r + 1 < t.rows(); r += 2)
            largest = std::max(largest, std::abs(t(c, r) - (t(c, r - 1) + t(c, r + 1)) / 2));
    return largest;
}
double error_in_angle(Tabulation const& t) {
    double largest = 0;
    for (int c = 1; c + 1 < t.columns(); c += 2)
        for (int r = 0; r < t.rows(); ++r)
            largest = std::max(largest, std::abs(t(c, r) - (t(c - 1, r) + t(c + 1, r)) / 2));
    return largest;
}

}  // namespace

double coated_reflectance(std::span<CoatingLayer const> layers, ComplexIndex const& substrate, double wavelength_nm,
                          double cosine) {
    return thin_film<double>(cosine, 1, stack_at(layers, wavelength_nm), at(substrate, wavelength_nm), wavelength_nm)
        .R.unpolarised();
}

// With x = sqrt(mu): int 4 x^3 R(x) dx, R linear in every cell.
double CoatingTable::mean_reflectance(double nm) const {
    auto const row = static_cast<std::size_t>(std::lround(nm * rows_per_nm_));
    auto const at_column = [&](int c) {
        return static_cast<double>(value_[static_cast<std::size_t>(c) * static_cast<std::size_t>(rows_) + row]);
    };
    double sum = 0;
    for (int c = 0; c + 1 < columns_; ++c) {
        double const cells = columns_ - 1, a = c / cells, b = (c + 1) / cells,
                     slope = (at_column(c + 1) - at_column(c)) * cells;
        auto const primitive = [&](double x) {
            double const x4 = square(square(x));
            return x4 * (at_column(c) - slope * a) + 0.8 * x4 * x * slope;
        };
        sum += primitive(b) - primitive(a);
    }
    return sum;
}

CoatingTable::CoatingTable(std::span<CoatingLayer const> layers, ComplexIndex const& substrate,
                           WavelengthGrid const& grid) {
    // A table twice as fine in both directions tells the error of every other point; then every other point is kept.
    constexpr int coarsest_cells_x = 64;
    constexpr std::size_t most_points = 1 << 22;  // 4 MB in the end, and at most seconds to fill
    Tabulation fine{static_cast<double>(grid.first_nm), grid.count - 1, 2, 2 * coarsest_cells_x};
    for (bool good = false; !good;) {
        if (fine.place(fine.columns(), 0) > most_points)
            throw InputError(
                {}, "",
                "the reflectance of these layers changes too fast with wavelength or angle to be tabulated: make them "
                "thinner");
        fine.fill(layers, substrate);
        bool const wavelength_good = error_in_wavelength(fine) <= coating_tolerance;
        bool const angle_good = error_in_angle(fine) <= coating_tolerance;
        if (!wavelength_good) fine.rows_per_nm *= 2;
        if (!angle_good) fine.cells_x *= 2;
        good = wavelength_good && angle_good;
    }
    // A table twice as fine in both directions told the error of every other point, and every other point is kept.
    rows_per_nm_ = fine.rows_per_nm / 2;
    rows_ = (fine.rows() + 1) / 2;
    columns_ = (fine.columns() + 1) / 2;
    value_.reserve(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_));
    for (int c = 0; c < fine.columns(); c += 2)
        for (int r = 0; r < fine.rows(); r += 2) value_.push_back(static_cast<float>(fine(c, r)));
}

}  // namespace iride
