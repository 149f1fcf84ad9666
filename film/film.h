// SPDX-License-Identifier: Apache-2.0
// The film: XYZ, their variance and spectral bands, by one estimator. Lane i of a sample with radiance L_i, drawn with
// density p_i, contributes
//   to XYZ:      L_i observer(lambda_i) / (N p_i integral of ybar)         N = number of lanes
//   to its band: L_i / (N p_i band width)
// so the two outputs cannot disagree, whatever the density. Pixels are means over their samples, as reconstruction
// filters are importance sampled. A sample's weight w is that of its pass, the same for all pixels: samples that an
// integrator takes more trouble over count as that many. With W = sum w and n samples, for variances as 1 / w:
//   mean m = sum w x / W,   variance of the mean = (sum w x^2 / W - m^2) / (n - 1)
// The lanes of a sample share their path, so the noise of bands that lie 1 / N of the sampling interval apart is
// correlated.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "base/vector.h"
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

// What is kept of a pixel: weighted sums over its samples, in the order in which they were taken.
struct FilmPixel {
    std::array<double, 3> sum{}, sum_of_squares{};  // X, Y, Z
    std::array<double, 3> sum_of_products{};        // XY, YZ, ZX
    double weight = 0;                              // of the samples in the sums, together
    std::uint32_t count = 0;                        // of the samples in the sums
    std::array<std::uint32_t, rejection_count> rejected{};

    // Samples taken, the rejected ones included: the number of the pixel's next one.
    std::uint32_t taken() const { return std::accumulate(rejected.begin(), rejected.end(), count); }
    // Of samples of weight `each`.
    static FilmPixel of(Xyz const& mean, MatrixDouble const& covariance, std::uint32_t count, double each = 1);
};

// The pixels x0 <= x < x1, y0 <= y < y1 of a picture.
struct Crop {
    int x0, y0, x1, y1;
};

// Where the film's pixels lie in the whole picture.
struct FilmPlace {
    int x0 = 0, y0 = 0;
    int picture_width, picture_height;
    bool operator==(FilmPlace const&) const = default;
};

class Film {
  public:
    Film(int width, int height, Observer const& observer, WavelengthGrid const& grid, std::optional<Bands> bands = {});
    Film(int width, int height, FilmPlace const& place, Observer const& observer, WavelengthGrid const& grid,
         std::optional<Bands> bands);

    // Add one sample to pixel (x, y). Calls for different pixels may run at the same time.
    void add(int x, int y, Wavelengths const& wavelengths, Radiance const& radiance, std::uint32_t weight = 1);
    // Light paths add to any pixel, from any thread, once there is a layer for it; means and variances then include it,
    // for the samples that one goes with. (The camera's means with and without differ, and as samples of both are in
    // one sum, its variance then is a little too high.)
    void add_splat_layer() {
        if (!splats_) splats_.emplace(width(), height(), bands_ ? bands_->count : 0);
    }
    // With the weight of the sample that the light path goes with.
    void splat(int x, int y, Wavelengths const& wavelengths, Radiance const& radiance, std::uint32_t weight = 1);
    // Of the sample that was added to pixel (x, y) last, and of light paths: what goes with what.
    void accompany(int x, int y, std::uint32_t weight = 1) { splats_->accompany(x, y, weight); }
    void count_light_paths(std::uint64_t count, std::uint32_t weight = 1) { splats_->count_paths(count, weight); }
    // Count a sample that is dropped; the pixel's mean is over the samples added.
    void reject(int x, int y, Rejection cause);
    // Add the sums of another film of the same picture, wherever in it that film lies inside this one; splats, which
    // belong to the whole picture, only from a film of the same place.
    void add(Film const& other);
    // The mean of two films with weight 1/2 each, whatever their numbers of samples, which add up: for halves whose
    // numbers of samples depend on each other's values. The variance is that of this mean of independent films.
    static Film half_and_half(Film const& a, Film const& b);

    int width() const { return pixels_.width; }
    int height() const { return pixels_.height; }
    std::optional<Bands> const& bands() const { return bands_; }
    Observer const& observer() const { return *observer_; }

    FilmPlace const& place() const { return place_; }

    std::uint32_t sample_count(int x, int y) const { return pixels_.at(x, y).count; }
    std::uint64_t total_samples() const;
    FilmPixel const& pixel(int x, int y) const { return pixels_.at(x, y); }
    FilmPixel& pixel(int x, int y) { return pixels_.at(x, y); }
    // All there is, to be kept in a file: pixels row by row, and the bands' sums of each.
    std::vector<FilmPixel>& pixels() { return pixels_.pixel; }
    std::vector<FilmPixel> const& pixels() const { return pixels_.pixel; }
    std::vector<double>& band_sums() { return band_sum_; }  // [height][width][band]
    std::vector<double> const& band_sums() const { return band_sum_; }
    std::optional<Splats>& splats() { return splats_; }
    std::optional<Splats> const& splats() const { return splats_; }
    Xyz mean(int x, int y) const;
    // Variance of mean(x, y), each component; of fewer than 2 samples: infinite.
    Xyz variance(int x, int y) const;
    // Covariance of X, Y and Z of mean(x, y), of camera and light paths as if they were independent; its diagonal is
    // variance(x, y).
    MatrixDouble covariance(int x, int y) const;
    // Spectral radiance of a band [W m^-2 sr^-1 nm^-1].
    double band(int x, int y, int band) const;

    std::array<std::uint64_t, rejection_count> rejected() const;
    // sqrt(mean over pixels and X, Y, Z of variance / (mean^2 + .01)): the root of the relMSE against the true picture.
    double relative_error() const;

  private:
    using Power = Sampled<dim::spectral_radiance / dim::per_nanometre>;      // L_i / p_i
    using Response = float __attribute__((vector_size(4 * sizeof(float))));  // to X, Y, Z; the 4th is 0

    Response response(double nm) const;
    Xyz colour_of(Wavelengths const& wavelengths, Power const& power) const;
    // add(band, value) for each lane that lies in one.
    template <class Add>
    void for_bands(Wavelengths const& wavelengths, Power const& power, Add&& add) const;
    std::size_t band_offset(int x, int y) const;
    // Of the mean of light paths, what the pixel's samples lack; without any, all.
    double share_of_splats(int x, int y) const;

    Image<FilmPixel> pixels_;
    FilmPlace place_;
    std::vector<double> band_sum_;    // [height][width][band]
    std::vector<Response> response_;  // [grid.count] xbar, ybar, zbar over the integral of ybar
    Observer const* observer_;
    std::optional<Bands> bands_;
    bool exact_observer_;  // an observer of steps (bands of a sensor) is not linear between whole nanometres
    std::optional<Splats> splats_;
};

}  // namespace iride
