// SPDX-License-Identifier: Apache-2.0
// The film: XYZ, their variance and spectral bands, by one estimator. Lane i of a sample with radiance L_i, drawn with
// density p_i, contributes
//   to XYZ:      L_i observer(lambda_i) / (N p_i integral of ybar)         N = number of lanes
//   to its band: L_i / (N p_i band width)
// so the two outputs cannot disagree, whatever the density. Pixels are means over their samples (reconstruction filters
// are importance sampled, every sample has weight 1). The lanes of a sample share their path, so the noise of bands
// that lie 1 / N of the sampling interval apart is correlated.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "colour/observer.h"
#include "film/image.h"
#include "film/splats.h"
#include "spectral/sampled.h"
#include "spectral/wavelengths.h"

namespace iride {

// `count` bands of equal width over `range`.
struct Bands {
    WavelengthRange range;
    int count = 0;
    double width_nm() const { return range.width() / count; }
    double centre_nm(int band) const { return range.min_nm + (band + 0.5) * width_nm(); }
};

// Why a sample was dropped; counted in the report and in the file.
enum class Rejection { not_finite, negative, path_too_long };
inline constexpr int rejection_count = 3;
inline constexpr std::array<char const*, rejection_count> rejection_names{"not_finite", "negative", "path_too_long"};

class Film {
  public:
    Film(int width, int height, Observer const& observer, WavelengthGrid const& grid, std::optional<Bands> bands = {});

    // Add one sample to pixel (x, y). Calls for different pixels may run at the same time.
    void add(int x, int y, Wavelengths const& wavelengths, Radiance const& radiance);
    // Light paths add to any pixel, from any thread, once there is a layer for it; means and variances then include it.
    void add_splat_layer() { splats_.emplace(width(), height(), bands_ ? bands_->count : 0); }
    void splat(int x, int y, Wavelengths const& wavelengths, Radiance const& radiance);
    void count_light_path() { splats_->count_path(); }
    // Count a sample that is dropped; the pixel's mean is over the samples added.
    void reject(int x, int y, Rejection cause);

    int width() const { return pixels_.width; }
    int height() const { return pixels_.height; }
    std::optional<Bands> const& bands() const { return bands_; }
    Observer const& observer() const { return observer_; }

    std::uint32_t sample_count(int x, int y) const { return pixels_.at(x, y).count; }
    Xyz mean(int x, int y) const;
    // Variance of mean(x, y), each component; of fewer than 2 samples: infinite.
    Xyz variance(int x, int y) const;
    // Spectral radiance of a band [W m^-2 sr^-1 nm^-1].
    double band(int x, int y, int band) const;

    std::array<std::uint64_t, rejection_count> rejected() const;
    // sqrt(mean over pixels and X, Y, Z of variance / (mean^2 + .01)): the root of the relMSE against the true picture.
    double relative_error() const;

  private:
    struct Pixel {
        std::array<double, 3> sum{}, sum_of_squares{};
        std::uint32_t count = 0;
        std::array<std::uint32_t, rejection_count> rejected{};
    };

    using Power = Sampled<dim::spectral_radiance / dim::per_nanometre>;  // L_i / p_i
    using Response = float __attribute__((vector_size(4 * sizeof(float))));  // to X, Y, Z; the 4th is 0

    Response response(double nm) const;
    Xyz colour_of(Wavelengths const& wavelengths, Power const& power) const;
    // add(band, value) for each lane that lies in one.
    template <class Add>
    void for_bands(Wavelengths const& wavelengths, Power const& power, Add&& add) const;
    std::size_t band_offset(int x, int y) const;

    Image<Pixel> pixels_;
    std::vector<double> band_sum_;    // [height][width][band]
    std::vector<Response> response_;  // [grid.count] xbar, ybar, zbar over the integral of ybar
    Observer const& observer_;
    std::optional<Bands> bands_;
    bool exact_observer_;  // an observer of steps (bands of a sensor) is not linear between whole nanometres
    std::optional<Splats> splats_;
};

}  // namespace iride
