// SPDX-License-Identifier: Apache-2.0
// What light paths add to the picture, at whatever pixel they reach. Sums are integers, so the picture does not depend
// on the order: a value v is kept as v = high 2^-12 + low 2^-44, two 64-bit counts that are added to on their own. A
// splat is exact to 2^-45 and sums hold to 2^51. With v the splat times the weight w of its light path (film/film.h)
// over the number of pixels n, and W = sum w over all light paths,
//   mean = n / W sum v,   covariance of the mean = (n / W)^2 (sum v v' - sum v sum v' sum w^2 / W^2)
// with v, v' of X, Y, Z,
// as if the splats of one light path to one pixel were independent of one another. A camera sample that no light path
// goes with lacks nothing that one would add: a pixel of which samples of weight a do, of W' together, has a / W' of
// this mean.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "colour/xyz.h"

namespace iride {

class Splats {
  public:
    Splats(int width, int height, int band_count);

    // Add to pixel (x, y) what a splat brings, times its weight; from any thread. False, and nothing is added, for a
    // value beyond the largest.
    bool add(int x, int y, Xyz const& value);
    void add_to_band(int x, int y, int band, double value);
    void count_paths(std::uint64_t count, std::uint32_t weight = 1);  // of this weight each
    // A sample of this pixel that a light path goes with; one thread for each pixel.
    void accompany(int x, int y, std::uint32_t weight) { pixels_[index(x, y)].accompanied += weight; }
    double accompanied(int x, int y) const { return pixels_[index(x, y)].accompanied; }  // weight together
    void reject();  // count a splat that is dropped
    std::uint64_t rejected() const { return static_cast<std::uint64_t>(rejected_); }

    Xyz mean(int x, int y) const;
    Xyz variance(int x, int y) const;
    MatrixDouble covariance(int x, int y) const;  // its diagonal is variance(x, y)
    double band(int x, int y, int band) const;

    // Add all that another film of the same size and bands holds: the same bits in any order.
    void add(Splats const& other);

    // All there is, to be kept in a file: use(data, bytes), block by block in one order.
    template <class Use>
    void for_each_block(Use&& use) {
        blocks(*this, use);
    }
    template <class Use>
    void for_each_block(Use&& use) const {
        blocks(*this, use);
    }
    // Bytes of all blocks together.
    static std::uintmax_t size_in_file(std::uintmax_t pixels, std::uintmax_t bands) {
        return pixels * (sizeof(Pixel) + bands * sizeof(Sum)) + 3 * sizeof(std::int64_t);
    }

    static constexpr double largest = 0x1p23;  // of a splat over the number of pixels: its square still fits

  private:
    struct Sum {
        std::int64_t high = 0, low = 0;
        void add(double value);
        void operator+=(Sum const& other) { high += other.high, low += other.low; }
        double total() const;
    };
    struct Pixel {
        std::array<Sum, 3> sum, sum_of_squares;  // X, Y, Z
        std::array<Sum, 3> sum_of_products;      // XY, YZ, ZX
        double accompanied = 0;
    };
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    double pixel_count() const { return static_cast<double>(pixels_.size()); }
    double pixels_per_weight() const;
    template <class Self, class Use>
    static void blocks(Self& self, Use& use) {
        use(self.pixels_.data(), self.pixels_.size() * sizeof(Pixel));
        use(self.band_sum_.data(), self.band_sum_.size() * sizeof(Sum));
        for (auto* count : {&self.weight_, &self.squared_weight_, &self.rejected_}) use(count, sizeof *count);
    }

    int width_;
    std::size_t band_count_;
    std::vector<Pixel> pixels_;
    std::vector<Sum> band_sum_;                     // [pixel][band]
    std::int64_t weight_ = 0, squared_weight_ = 0;  // sums over the light paths
    std::int64_t rejected_ = 0;
};

}  // namespace iride
