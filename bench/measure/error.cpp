// SPDX-License-Identifier: Apache-2.0
// Error against time: relMSE without the reference's own and mean CIEDE2000 (as `iride compare` has it), at doubling
// sample counts, each an independent render; a power law fitted to what the reference tells well.
#include <fmt/format.h>

#include <cmath>

#include "bench/measure/clock.h"
#include "bench/measure/reference.h"

namespace iride::bench {

namespace {

// A difference of colours holds the reference's own error, which is to be at most a quarter of it.
constexpr double clearly_above = 4;

struct Errors {
    double relmse, delta_e_2000;
};
Errors errors_of(Film const& film, Reference const& reference) {
    XyzPicture const picture = picture_of(film);
    return {reference.relmse_of(picture), compare(picture, reference.picture).delta_e_2000_mean};
}

struct Point {
    int spp;
    double seconds;
    Errors error;
};

struct Curve {
    std::string scene, integrator;
    double setup_seconds;
    std::vector<Point> points;
};

// The time of sampling after which an error is reached: between two points where they bracket it, else by the power
// law; absent if there are too few points, if errors do not fall, or no longer half as steeply as the law says (a
// biased method's), or if it is more than an hour.
struct Reached {
    std::optional<double> seconds;
    bool measured;
};
using Curve2 = std::vector<std::pair<double, double>>;  // seconds of sampling, error

Reached time_to(double target, Curve2 const& all, Curve2 const& fitted) {
    if (!all.empty() && all.front().second <= target) return {all.front().first, true};
    for (std::size_t i = 1; i < all.size(); ++i)
        if (all[i].second <= target && all[i - 1].second > target) {
            std::array const pair{all[i - 1], all[i]};
            return {fit_power_law(pair).x_at(target), true};
        }
    if (fitted.size() < 3) return {std::nullopt, false};
    PowerLaw const law = fit_power_law(fitted);
    constexpr double too_long = 3600;
    double const seconds = law.x_at(target);
    std::array const latest{all[all.size() - 2], all.back()};
    if (fit_power_law(latest).slope > law.slope / 2) return {std::nullopt, false};
    if (!(law.slope < -0.05) || !(seconds > all.back().first && seconds < too_long)) return {std::nullopt, false};
    return {seconds, false};
}

nlohmann::ordered_json as_json(Reached const& r, double setup_seconds) {
    return r.seconds ? nlohmann::ordered_json(setup_seconds + *r.seconds) : nlohmann::ordered_json(nullptr);
}

Curve measure_curve(Scene const& scene, std::string const& name, Reference const& reference, Settings const& settings) {
    RenderPlan const plan = make_plan(scene);
    Clock::time_point const start = Clock::now();
    auto const integrator = make_integrator(name, scene, plan);
    Curve curve{scene.name, name, seconds_since(start), {}};
    double used = 0, last = 0;
    for (int spp = 1; spp <= 1 << 16 && used + 2 * last <= settings.error_seconds; spp *= 2) {
        Film film = make_film(scene);
        RenderSettings const r{.spp = spp, .seed = static_cast<std::uint64_t>(spp), .threads = settings.threads};
        last = render(scene, plan, *integrator, r, film).seconds;
        used += last;
        curve.points.push_back({spp, last + curve.setup_seconds, errors_of(film, reference)});
    }
    return curve;
}

nlohmann::ordered_json summary(Curve const& curve, Reference const& reference) {
    Curve2 relmse, colour, relmse_fitted, colour_fitted;
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (Point const& p : curve.points) {
        double const sampling = p.seconds - curve.setup_seconds;
        relmse.emplace_back(sampling, p.error.relmse);
        colour.emplace_back(sampling, p.error.delta_e_2000);
        constexpr int settled_spp = 4;  // fewer: the sampler's strata are not filled
        if (p.spp >= settled_spp && p.error.relmse > reference.relmse) relmse_fitted.push_back(relmse.back());
        if (p.spp >= settled_spp && p.error.delta_e_2000 > clearly_above * reference.delta_e_2000)
            colour_fitted.push_back(colour.back());
        points.push_back({{"spp", p.spp},
                          {"seconds", p.seconds},
                          {"relmse", p.error.relmse},
                          {"delta_e_2000", p.error.delta_e_2000}});
    }
    Reached const e2 = time_to(1e-2, relmse, relmse_fitted), e3 = time_to(1e-3, relmse, relmse_fitted),
                  e4 = time_to(1e-4, relmse, relmse_fitted), de = time_to(1, colour, colour_fitted);
    Point const& last = curve.points.back();
    nlohmann::ordered_json slope = nullptr;
    if (relmse_fitted.size() >= 3) slope = fit_power_law(relmse_fitted).slope;
    return {{"scene", curve.scene},
            {"integrator", curve.integrator},
            {"spp", last.spp},
            {"seconds", last.seconds},
            {"relmse", last.error.relmse},
            {"delta_e_2000", last.error.delta_e_2000},
            {"reference_relmse", reference.relmse},
            {"reference_delta_e", reference.delta_e_2000},
            {"slope", slope},
            {"s_to_relmse_1e-2", as_json(e2, curve.setup_seconds)},
            {"s_to_relmse_1e-3", as_json(e3, curve.setup_seconds)},
            {"s_to_relmse_1e-4", as_json(e4, curve.setup_seconds)},
            {"s_to_delta_e_1", as_json(de, curve.setup_seconds)},
            {"extrapolated", !(e2.measured && e3.measured && de.measured)},
            {"extrapolated_1e-4", !e4.measured},
            {"setup_seconds", curve.setup_seconds},
            {"points", points}};
}

// Every integrator, or those asked for; an integrator that cannot do the scene is left out.
std::vector<std::string> integrators_of(Settings const& settings) {
    if (!settings.integrators.empty()) return settings.integrators;
    std::vector<std::string> names;
    for (IntegratorEntry const& e : integrator_entries()) names.emplace_back(e.name);
    return names;
}

// As others have published it: 64 samples, 2 threads. Time is that of sampling and of what comes before it.
nlohmann::ordered_json beside_peers(Scene const& scene, std::string const& name, Reference const& reference,
                                    Settings const& settings) {
    constexpr int spp = 64, threads = 2;
    RenderPlan const plan = make_plan(scene);
    std::vector<double> seconds, relmse, colour;
    for (int round = 0; round < settings.rounds; ++round) {
        settings.say(fmt::format("peers: {} by {}, round {}", scene.name, name, round + 1));
        Clock::time_point const start = Clock::now();
        auto const integrator = make_integrator(name, scene, plan);
        double const setup = seconds_since(start);
        Film film = make_film(scene);
        RenderSettings const r{.spp = spp, .seed = static_cast<std::uint64_t>(round), .threads = threads};
        seconds.push_back(setup + render(scene, plan, *integrator, r, film).seconds);
        auto const [of_light, of_colour] = errors_of(film, reference);
        relmse.push_back(of_light);
        colour.push_back(of_colour);
    }
    Spread const t = spread_of(seconds), e = spread_of(relmse);
    double const paths = static_cast<double>(spp) * picture_size * picture_size;
    return {{"scene", scene.name},
            {"integrator", name},
            {"seconds", t.median},
            {"seconds_least", t.least},
            {"seconds_most", t.most},
            {"relmse", e.median},
            {"relmse_least", e.least},
            {"relmse_most", e.most},
            {"reference_relmse", reference.relmse},
            {"delta_e_2000", spread_of(colour).median},
            {"kpaths_per_s_core", paths / t.median / threads / 1000},
            {"seconds_times_relmse", t.median * e.median}};
}

}  // namespace

Rows measure_error(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, all_scenes())) {
        auto const scene = load_for_picture(name);
        Reference const reference = reference_of(*scene, settings);
        for (std::string const& integrator : integrators_of(settings)) {
            settings.say(fmt::format("error: {} by {}", name, integrator));
            try {
                rows.push_back(summary(measure_curve(*scene, integrator, reference, settings), reference));
            } catch (InputError const& e) {
                settings.say(fmt::format("error: {} is no scene for {}: {}", name, integrator, e.what()));
            }
        }
    }
    return rows;
}

Rows measure_peers(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name :
         scenes_of(settings, {"cornell", "cornell-gold", "metals", "metals-furnace", "prism", "glass-spheres"})) {
        auto const scene = load_for_picture(name);
        Reference const reference = reference_of(*scene, settings);
        for (char const* integrator : {"path", "auto"})
            rows.push_back(beside_peers(*scene, integrator, reference, settings));
    }
    return rows;
}

}  // namespace iride::bench
