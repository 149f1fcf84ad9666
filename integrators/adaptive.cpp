// SPDX-License-Identifier: Apache-2.0
#include "integrators/adaptive.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "base/random.h"
#include "film/checkpoint.h"
#include "integrators/around.h"

namespace iride {

namespace {

constexpr std::uint32_t first_floor = 16;  // samples of each half: one in each 1/4 x 1/4 of a pixel
constexpr double most_per_floor = 16;      // a guess is trusted up to this many times the floor
constexpr double usual_per_floor = 3;      // with no target: samples per pixel and round over those of the floor
constexpr double one_in_hundred = 2.5758293035489004;  // |z| of a normal deviate beyond which 1 % lies

std::uint32_t floor_of(int round) { return first_floor << round; }

// Mean over 5 x 5 pixels, of those that are there.
Image<double> spread(Image<double> const& noise) {
    constexpr int reach = 2;
    Image<double> out(noise.width, noise.height);
    for (int y = 0; y < noise.height; ++y)
        for (int x = 0; x < noise.width; ++x) {
            double total = 0;
            int const count = for_each_around(noise, x, y, reach, [&](double n) { total += n; });
            out.at(x, y) = total / count;
        }
    return out;
}

// How many samples, beyond the floor, one half's floor calls for in the other half.
class Allocation {
  public:
    Allocation(Film const& floor, std::optional<ErrorTarget> const& target, std::uint32_t floor_samples)
        : noise_(floor.width(), floor.height()), floor_(floor_samples) {
        ErrorTarget const measure = target.value_or(ErrorTarget::relative(1));
        by_pixel_ = measure.kind() == ErrorTarget::Kind::colour_difference;
        for (int y = 0; y < floor.height(); ++y)
            for (int x = 0; x < floor.width(); ++x) {
                double const e = measure.error(floor.mean(x, y), floor.covariance(x, y));
                noise_.at(x, y) = std::isfinite(e) ? e * e * floor.sample_count(x, y) : 0;
            }
        Image<double> const around = spread(noise_);
        for (std::size_t i = 0; i < noise_.pixel.size(); ++i) {
            noise_.pixel[i] = std::sqrt(std::max(noise_.pixel[i], around.pixel[i]));
            mean_ += noise_.pixel[i] / static_cast<double>(noise_.pixel.size());
        }
        if (target) wanted_ = by_pixel_ ? target->target() / one_in_hundred : target->target();
    }

    Image<std::uint32_t> goals() const {
        Image<std::uint32_t> goal(noise_.width, noise_.height);
        for (std::size_t i = 0; i < noise_.pixel.size(); ++i) {
            double const beyond = std::clamp(samples(noise_.pixel[i]) - floor_, 0.0, most_per_floor * floor_);
            goal.pixel[i] = static_cast<std::uint32_t>(std::ceil(beyond));
        }
        return goal;
    }

  private:
    double samples(double noise) const {
        if (wanted_) return noise * (by_pixel_ ? noise : mean_) / (2 * square(*wanted_));
        return mean_ > 0 ? (1 + usual_per_floor) * floor_ * noise / mean_ : 0;
    }

    Image<double> noise_;  // standard deviation of one sample, in the measure of the target
    double mean_ = 0;
    std::optional<double> wanted_;
    bool by_pixel_;
    double floor_;
};

class Rounds {
  public:
    Rounds(Scene const& scene, RenderPlan const& plan, Integrator& integrator, RenderSettings const& settings,
           std::vector<Film>& films)
        : scene_(scene), plan_(plan), integrator_(integrator), settings_(settings), films_(films) {}

    // Bring a stream's film to a number of samples of every pixel, or of each; false: interrupted.
    bool sample(std::size_t stream, std::uint32_t all, Image<std::uint32_t> const* each) {
        RenderSettings s = settings_;
        s.seed = hash_words(settings_.seed, 0xadau, stream);
        s.spp = static_cast<int>(all);
        s.goals = each;
        s.seconds.reset();
        s.stop_at.reset();
        int const before = static_cast<int>(mean_spp());
        if (s.on_progress) s.on_progress = [this, before](int, double) { settings_.on_progress(before, share()); };
        RenderReport const done = render(scene_, plan_, integrator_, s, films_[stream]);
        report_.paths += done.paths;
        report_.rays.add(done.rays);
        report_.embree_share += done.embree_share * static_cast<double>(done.paths);
        report_.interrupted = done.interrupted;
        return !done.interrupted;
    }

    // One round; false: interrupted.
    bool run(int round, std::optional<ErrorTarget> const& target) {
        std::uint32_t const floor = floor_of(round);
        if (!sample(0, floor, nullptr) || !sample(1, floor, nullptr)) return false;
        for (std::size_t half : {0u, 1u}) {
            Image<std::uint32_t> const goals = Allocation(films_[1 - half], target, floor).goals();
            if (!sample(2 + half, 0, &goals)) return false;
        }
        return true;
    }

    double mean_spp() const {
        double total = 0;
        for (Film const& film : films_) total += static_cast<double>(film.total_samples());
        return total / static_cast<double>(films_.front().pixels().size());
    }
    double seconds() const { return seconds_since(start_); }
    RenderReport report() {
        if (report_.paths > 0) report_.embree_share /= static_cast<double>(report_.paths);
        report_.seconds = seconds();
        report_.spp = static_cast<int>(std::lround(mean_spp()));
        return report_;
    }

  private:
    double share() const { return settings_.seconds ? std::min(1.0, seconds() / *settings_.seconds) : 0; }

    Scene const& scene_;
    RenderPlan const& plan_;
    Integrator& integrator_;
    RenderSettings const& settings_;
    std::vector<Film>& films_;
    RenderReport report_;
    Clock::time_point start_ = Clock::now();
};

}  // namespace

AdaptiveState make_adaptive_state(Scene const& scene, std::optional<Crop> const& crop) {
    return {std::vector<Film>(4, make_film(scene, crop)), 0};
}

RenderReport render_adaptively(Scene const& scene, RenderPlan const& plan, Integrator& integrator,
                               RenderSettings const& settings, std::optional<ErrorTarget> const& target,
                               std::vector<Film>& films, int& round) {
    Rounds rounds(scene, plan, integrator, settings, films);
    constexpr int last_round = 18;  // 2^21 samples of the floor in each half
    while (rounds.run(round, target)) {
        if (target && target->is_reached(picture_of(films))) break;
        if (settings.seconds && rounds.seconds() >= *settings.seconds) break;
        if (rounds.mean_spp() >= settings.spp || round == last_round) break;
        ++round;
    }
    return rounds.report();
}

}  // namespace iride
