// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/photon_tracer.h"

#include <tbb/parallel_for.h>

#include "integrators/media.h"
#include "integrators/meeting.h"

namespace iride {

namespace {

constexpr int photons_per_task = 512;

// Photon `number` of packet `packet`.
class PhotonWalk {
  public:
    PhotonWalk(Scene const& scene, PacketSet const& packets, PhotonShot const& shot, PhotonHarvest& harvest,
               RayStatistics& statistics)
        : scene_(scene),
          packets_(packets),
          shot_(shot),
          ball_{scene.centre(), scene.radius()},
          harvest_(harvest),
          statistics_(statistics) {}

    void follow(int packet, int number) {
        Wavelengths const& wavelengths = packets_.packet(packet);
        Sampler sampler(SamplerKind::sobol, shot_.key, static_cast<std::uint32_t>(packet),
                        static_cast<std::uint32_t>(number));
        auto const choice = scene_.lights.choose(sampler.next());
        Light const& light = scene_.lights.light(choice.index);
        Sample2 const place = sampler.next2(), direction = sampler.next2();
        auto const emitted = light.emit(ball_, wavelengths, place, direction);
        if (!emitted) return;
        Flux const flux = emitted->flux() * (1 / (choice.probability * static_cast<float>(shot_.photons)));
        if (is_black(flux)) return;
        Ray ray = leaving_ray(light, *emitted);
        Surroundings in = shot_.lamps_in.at(scene_, choice.index, ray.origin).value_or(Surroundings());
        PathState state;
        state.weight = LightSurroundings::left(light, in, wavelengths);
        bool specular = true;
        for (int scattered = 0; scattered <= shot_.max_scatterings; ++scattered) {
            std::optional<Hit> hit;
            if (!reach_surface(scene_, wavelengths, ray, in, state.weight, hit, statistics_, [](Hit const&) {}) || !hit)
                return;
            sampler.begin_vertex(static_cast<std::uint32_t>(scattered));
            Sample2 const chances = sampler.next2();  // x: roulette, y: which part of a mixture
            float const lobe = sampler.next();
            describe_meeting(hit->point, -ray.direction, chances.y);
            Interaction const here(scene_, *hit, -ray.direction, wavelengths, &in);
            if (scattered > 0 && here.bsdf.has_density())
                store(specular ? harvest_.caustic : harvest_.indirect,
                      {packet, scattered, !specular || can_be_met(light)}, *hit, here, -ray.direction,
                      {flux, state.reach}, state.weight);
            auto const sample = here.bsdf.sample(here.wo, {lobe, sampler.next2()});
            if (!sample) return;
            Direction const on = here.frame.to_world(sample->wi);
            if (!here.is_consistent(on, sample->wi)) return;
            state.weight *= scattered_power(here, *hit, *sample, -ray.direction, on, in, wavelengths);
            state.reach *= sample->reach;
            specular = specular && !sample->density;
            in = behind(scene_, *hit, here, sample->wi, in);
            if (is_black(state.weight) || !survives<true>(state, chances.x)) return;
            ray = spawn_ray(hit->point, on);
        }
    }

  private:
    struct Origin {
        int packet, scattered;
        bool can_be_followed;
    };
    static bool can_be_met(Light const& light) {
        return light.extent() == LightExtent::area || light.extent() == LightExtent::environment;
    }
    static void store(PhotonList& list, Origin const& origin, Hit const& hit, Interaction const& here,
                      Direction const& wi, PhotonPower power, Throughput const& weight) {
        Direction const& n = here.geometric_normal;
        power.flux *= weight;
        list.photon.push_back({hit.point.position, wi.dot(n) < 0 ? Direction(-n) : n, wi, hit.shape,
                               static_cast<std::uint16_t>(origin.packet), static_cast<std::uint16_t>(origin.scattered),
                               origin.can_be_followed});
        list.power.push_back(power);
    }

    // Share of the power that goes on, over the density of doing so. `w`: back along the photon's way, `v`: on.
    Throughput scattered_power(Interaction const& here, Hit const& hit, BsdfSample const& sample, Direction const& w,
                               Direction const& v, Surroundings const& in, Wavelengths const& wavelengths) const {
        Direction const &g = here.geometric_normal, &n = here.frame.normal;
        float const v_n = std::abs(v.dot(n));
        if (!(std::abs(w.dot(g)) > 0 && v_n > 0)) return Throughput(0);
        float const shading = n == g ? 1.0f : shading_adjoint(w, v, n, g);
        if (sample.density) {
            BsdfValue const f = here.bsdf.evaluate(sample.wi, here.wo).value;
            return Throughput(f.lane * (v_n * shading / sample.density->value));
        }
        Throughput weight = sample.weight * shading;
        Body const* const body = body_at(scene_, hit);
        if (!body || (here.wo.z() > 0) == (sample.wi.z() > 0)) return weight;
        bool const front = here.wo.z() > 0;
        Lanes const ratio = body->inside.n.at(wavelengths) / in.in_front_of(*body, front).n.at(wavelengths);
        return front ? weight * ratio * ratio : weight / (ratio * ratio);
    }

    Scene const& scene_;
    PacketSet const& packets_;
    PhotonShot const& shot_;
    Ball ball_;
    PhotonHarvest& harvest_;
    RayStatistics& statistics_;
};

}  // namespace

PhotonHarvest shoot_photons(Scene const& scene, PacketSet const& packets, PhotonShot const& shot,
                            RayStatistics& statistics) {
    int const total = shot.photons * packets.count(), tasks = (total + photons_per_task - 1) / photons_per_task;
    std::vector<PhotonHarvest> part(static_cast<std::size_t>(tasks));
    std::vector<RayStatistics> rays(part.size());
    tbb::parallel_for(0, tasks, [&](int task) {
        auto const t = static_cast<std::size_t>(task);
        PhotonWalk walk(scene, packets, shot, part[t], rays[t]);
        int const last = std::min(total, (task + 1) * photons_per_task);
        for (int n = task * photons_per_task; n < last; ++n) walk.follow(n % packets.count(), n / packets.count());
    });
    PhotonHarvest all;
    for (std::size_t t = 0; t < part.size(); ++t) {
        all.caustic.append(part[t].caustic);
        all.indirect.append(part[t].indirect);
        statistics.add(rays[t]);
    }
    return all;
}

}  // namespace iride
