// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "integrators/radiosity/stochastic.h"

namespace iride::radiosity {

namespace {

// What one walk says of the patches it came by: squares want the sum of a patch's scores first.
class Scores {
  public:
    void add(int patch, Row const& score) {
        for (std::size_t k = 0; k < used_; ++k)
            if (patch_[k] == patch) {
                score_[k] += score;
                return;
            }
        if (used_ == patch_.size()) {
            patch_.push_back(patch);
            score_.push_back(score);
        } else {
            patch_[used_] = patch;
            score_[used_] = score;
        }
        ++used_;
    }
    void move_to(Spectra& sums, Spectra& squares) {
        for (std::size_t k = 0; k < used_; ++k) {
            sums.row(patch_[k]) += score_[k];
            squares.row(patch_[k]) += score_[k].square();
        }
        used_ = 0;
    }

  private:
    std::vector<int> patch_;
    std::vector<Row> score_;
    std::size_t used_ = 0;
};

class Walker {
  public:
    Walker(System const& system, LineSource const& source, Walk kind)
        : s_(system), source_(source), kind_(kind), power_(system.emission.colwise() * system.area) {
        double sum = 0;
        for (Eigen::Index i = 0; i < power_.rows(); ++i) sum += power_.row(i).sum(), until_.push_back(sum);
    }
    bool is_dark() const { return !(until_.back() > 0); }

    // Lines of one walk.
    std::uint64_t walk(std::uint64_t number, std::uint64_t seed, Scores& scores) const {
        Sampler sampler(SamplerKind::independent, seed, static_cast<std::uint32_t>(number),
                        static_cast<std::uint32_t>(number >> 32));
        // Two numbers of 24 bits: patches may be many.
        Sample2 const u = sampler.next2();
        double const place = (static_cast<double>(u.x) + static_cast<double>(u.y) * 0x1p-24) * until_.back();
        auto i = static_cast<int>(std::upper_bound(until_.begin(), until_.end() - 1, place) - until_.begin());
        Row carried = power_.row(i) * (until_.back() / power_.row(i).sum());
        for (std::uint64_t lines = 1;; ++lines) {
            sampler.begin_vertex(static_cast<std::uint32_t>(lines));
            float const chance = sampler.next();
            i = source_.local(i, sampler);
            if (i < 0) return lines;
            Row const reflected = carried * s_.reflectance.row(i);
            double const q = std::min(1.0, reflected.sum() / carried.sum());
            if (kind_ == Walk::collision) scores.add(i, reflected / s_.area[i]);
            if (!(static_cast<double>(chance) < q)) {
                if (kind_ == Walk::absorption) scores.add(i, reflected / ((1 - q) * s_.area[i]));
                return lines;
            }
            carried = reflected / q;
            if (kind_ == Walk::survival) scores.add(i, carried / s_.area[i]);
        }
    }

  private:
    System const& s_;
    LineSource const& source_;
    Walk kind_;
    Spectra power_;              // emitted
    std::vector<double> until_;  // running sum over patches, all wavelengths
};

}  // namespace

StochasticSolution random_walks(System const& system, LineSource const& source, Walk kind, std::uint64_t walks,
                                std::uint64_t seed) {
    constexpr std::size_t parts = 8;  // each with sums of its own, added in order: the same for any number of threads
    Walker const walker(system, source, kind);
    Spectra const zero = Spectra::Zero(system.patches(), system.wavelengths());
    if (walker.is_dark()) return {system.emission, zero, 0, 1};
    std::vector<Spectra> sums(parts, zero), squares(parts, zero);
    std::vector<std::uint64_t> lines(parts, 0);
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
        Scores scores;
        for (std::uint64_t k = part; k < walks; k += parts) {
            lines[part] += walker.walk(k, seed, scores);
            scores.move_to(sums[part], squares[part]);
        }
    });
    for (std::size_t part = 1; part < parts; ++part) {
        sums[0] += sums[part];
        squares[0] += squares[part];
        lines[0] += lines[part];
    }
    auto const count = static_cast<double>(walks);
    Spectra const mean = sums[0] / count;
    return {system.emission + mean, ((squares[0] / count - mean.square()).max(0.0) / count).sqrt(), lines[0], 1};
}

}  // namespace iride::radiosity
