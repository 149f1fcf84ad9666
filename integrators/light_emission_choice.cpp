// SPDX-License-Identifier: Apache-2.0
#include "integrators/light_emission_choice.h"

#include <algorithm>
#include <array>

namespace iride {

namespace {

constexpr std::size_t most_targets = 32;  // a density looks at all of them

Ball ball_about(std::span<Vector const> points) {
    Eigen::AlignedBox3f const box = box_about(points);
    return {box.center(), box.diagonal().norm() / 2};
}
Ball ball_of(Sphere const& s) { return {s.centre, s.radius}; }
Ball ball_of(Quad const& q) { return ball_about(q.corner); }
Ball ball_of(Disc const& d) { return {d.centre, d.radius}; }
Ball ball_of(Frustum const& f) {
    return {(f.from + f.to) / 2, std::hypot(f.length() / 2, std::max(f.radius, f.top_radius))};
}
Ball ball_of(MeshShape const& m) { return ball_about(m.mesh->position); }
Ball ball_of(Shape const& s) {
    return std::visit([](auto const& geometry) { return ball_of(geometry); }, s.geometry);
}
Ball ball_of(Ball const& ball, Transform const& t) {
    auto const stretch = static_cast<float>(t.linear().colwise().norm().maxCoeff());
    return {(t * ball.centre.cast<double>()).cast<float>(), std::sqrt(3.0f) * stretch * ball.radius};
}

Ball united(std::span<Ball const> balls) {
    Eigen::AlignedBox3f box;
    for (Ball const& b : balls) box.extend(b.centre);
    Ball all{box.center(), 0};
    for (Ball const& b : balls) all.radius = std::max(all.radius, (b.centre - all.centre).norm() + b.radius);
    return all;
}

// At most `most` balls about all: halves along the longest side, until they are few.
void gather(std::span<Ball> balls, std::size_t most, std::vector<Ball>& out) {
    if (balls.size() <= most) {
        out.insert(out.end(), balls.begin(), balls.end());
    } else if (most == 1) {
        out.push_back(united(balls));
    } else {
        Eigen::AlignedBox3f box;
        for (Ball const& b : balls) box.extend(b.centre);
        Eigen::Index axis = 0;
        box.diagonal().maxCoeff(&axis);
        auto const middle = balls.begin() + static_cast<std::ptrdiff_t>(balls.size() / 2);
        std::ranges::nth_element(balls, middle, {}, [&](Ball const& b) { return b.centre[axis]; });
        gather({balls.begin(), middle}, most / 2, out);
        gather({middle, balls.end()}, most - most / 2, out);
    }
}

// Of the cone of directions that meet a ball, as in to_cone(); from inside: all.
float height_of_cone(float distance2, float radius2) {
    float const sine2 = radius2 / distance2;
    return sine2 < 1 ? cone_height(sine2) : 2;
}

}  // namespace

std::optional<LightStart> LampEmission::start(Scene const& scene, Ball const& ball, Wavelengths const& wavelengths,
                                              float choice, Sample2 place, Sample2 direction) const {
    if (!scene.lights.has_power()) return std::nullopt;
    auto const chosen = scene.lights.choose(choice);
    auto const emitted = scene.lights.light(chosen.index).emit(ball, wavelengths, place, direction);
    if (!emitted) return std::nullopt;
    return LightStart{chosen.index, chosen.probability, *emitted};
}

float LampEmission::density(Scene const& scene, Ball const& ball, int light, Vector const&, Direction const& travel,
                            float cosine) const {
    float const chosen = scene.lights.probability(light);
    return chosen > 0 ? chosen * scene.lights.light(light).emission_density(ball, travel, cosine).product() : 0;
}

bool throws_caustics(NamedMaterial const& m) { return m.type == "conductor" || m.type == "dielectric"; }

std::vector<Ball> caustic_targets(Scene const& scene) {
    auto const throws = [&](Shape const& s) {
        return throws_caustics(scene.materials[static_cast<std::size_t>(s.material)]);
    };
    std::vector<Ball> balls, few;
    for (Shape const& s : scene.shapes)
        if (throws(s)) balls.push_back(ball_of(s));
    for (InstancePlacement const& i : scene.instances)
        for (Shape const& s : scene.objects[static_cast<std::size_t>(i.object)].shapes)
            if (throws(s)) balls.push_back(ball_of(ball_of(s), i.to_world));
    gather(balls, most_targets, few);
    return few;
}

AimedEmission::AimedEmission(Scene const& scene) : targets_(caustic_targets(scene)) {
    auto const count = static_cast<int>(scene.lights.size());
    std::vector<double> lights;
    for (int first = 0; first < count; first += real_lanes) {
        int const together = std::min(real_lanes, count - first);
        LightClusters lamps;  // those that cannot be aimed have no intensity
        for (int i = 0; i < together; ++i)
            if (auto const bounds = scene.lights.light(first + i).bounds())
                if (scene.lights.probability(first + i) > 0) lamps.set(i, *bounds);
        std::vector<Real8> shares;
        for (Ball const& t : targets_) shares.push_back(lamps.importance({t.centre}) * square(t.radius));
        for (int i = 0; i < together; ++i) {
            std::vector<double> of_light;
            double sum = 0;
            for (Real8 const& share : shares) sum += of_light.emplace_back(static_cast<double>(share[i]));
            lights.push_back(sum);
            of_light_.push_back(sum > 0 ? DiscreteDistribution(of_light) : DiscreteDistribution());
        }
    }
    if (std::ranges::any_of(lights, [](double w) { return w > 0; })) lights_ = DiscreteDistribution(lights);
    for (std::size_t t = 0; t < targets_.size(); ++t) {
        std::size_t const i = t % real_lanes;
        if (i == 0) registers_.emplace_back();
        Ball const& ball = targets_[t];
        BallRegister& e = registers_.back();
        e.x[i] = ball.centre.x(), e.y[i] = ball.centre.y(), e.z[i] = ball.centre.z(),
        e.radius2[i] = square(ball.radius);
    }
}

// A direction w meets the ball of centre c and radius r, seen from outside, if w.c > 0 and (w.c)^2 >= c^2 - r^2.
float AimedEmission::direction_density(int light, Vector const& from, Direction const& travel) const {
    DiscreteDistribution const& choice = of_light_[static_cast<std::size_t>(light)];
    float density = 0;
    for (std::size_t first = 0; first < registers_.size() && choice.size() > 0; ++first) {
        BallRegister const& e = registers_[first];
        Real8 const x = e.x - from.x(), y = e.y - from.y(), z = e.z - from.z();
        Real8 const along = x * travel.x() + y * travel.y() + z * travel.z(), distance2 = x * x + y * y + z * z,
                    beyond2 = distance2 - e.radius2;
        auto const met = (beyond2 <= 0) | ((along > 0) & (along * along >= beyond2));
        if (!holds_somewhere(met)) continue;
        for (int i = 0; i < real_lanes; ++i) {
            int const t = static_cast<int>(first) * real_lanes + i;
            if (met[i] && t < choice.size())
                density += choice.probability(t) * cone_density(height_of_cone(distance2[i], e.radius2[i])).value;
        }
    }
    return density;
}

std::optional<LightStart> AimedEmission::start(Scene const& scene, Ball const& ball, Wavelengths const& wavelengths,
                                               float choice, Sample2 place, Sample2 direction) const {
    auto const chosen = lights_.sample(choice);
    Light const& light = scene.lights.light(chosen.index);
    // Of the lamp's own ray the place alone is kept. A direction at half its range may be none.
    auto start = light.emit(ball, wavelengths, place, {0.25f, 0.5f});
    if (!start) return std::nullopt;
    Vector const& from = start->from.position;
    auto const target = of_light_[static_cast<std::size_t>(chosen.index)].sample(chosen.rest);
    Ball const& at = targets_[static_cast<std::size_t>(target.index)];
    Vector const axis = at.centre - from;
    float const distance2 = axis.squaredNorm(), height = height_of_cone(distance2, square(at.radius));
    Frame const around = Frame::around(distance2 > 0 ? Direction(axis / std::sqrt(distance2)) : Direction(0, 0, 1));
    start->travel = around.to_world(to_cone(direction, height)).normalized();
    start->density.direction = PerSteradian(direction_density(chosen.index, from, start->travel));
    if (!(start->density.direction.value > 0)) return std::nullopt;
    if (light.extent() == LightExtent::area) {
        start->cosine = std::abs(start->travel.dot(start->from.geometric_normal));
        start->radiance = light.emitted(start->from, start->travel, wavelengths);
    } else {
        auto const seen = light.sample(from + start->travel, wavelengths, {});  // at 1 m
        start->radiance = seen ? seen->radiance : Radiance();
    }
    if (is_black(start->radiance) || !(start->cosine > 0)) return std::nullopt;
    return LightStart{chosen.index, chosen.probability, *start};
}

float AimedEmission::density(Scene const& scene, Ball const& ball, int light, Vector const& from,
                             Direction const& travel, float cosine) const {
    float const aimed = direction_density(light, from, travel);
    if (!(aimed > 0)) return 0;
    return lights_.probability(light) * aimed *
           scene.lights.light(light).emission_density(ball, travel, cosine).area.value;
}

}  // namespace iride
