// SPDX-License-Identifier: Apache-2.0
// What fills a transparent body, and the bodies around a point of a path.
//   radiance along d metres:  L exp(-sigma_t d),   sigma_t = sigma_a + sigma_s,  sigma_a = 4 pi k / lambda
//                                                                                          [Born 1999, sec. 14.1]
// What is scattered, sigma_s, goes on in the directions of the Henyey-Greenstein phase function (materials/phase.h).
// Of bodies that overlap the one of the highest priority fills the place, and the surfaces of the others are none
// there; in front of a body's surface is what fills the place without that body. [Schmidt 2002]
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "spectral/complex_index.h"
#include "spectral/spectrum.h"

namespace iride {

using Absorption = Spectrum<dim::per_metre>;
using Extinction = Sampled<dim::per_metre>;

struct Medium {
    Index n{1.0f};
    Absorption sigma_a{};
    bool absorbs = false;
    ComplexIndex index{};  // as it was given
    Absorption sigma_s{};
    float asymmetry = 0;  // g: mean cosine of scattering
    bool scatters = false;

    bool attenuates() const { return absorbs || scatters; }
    Extinction sigma_t(Wavelengths const& wavelengths) const {
        Extinction sum;
        if (absorbs) sum += sigma_a.at(wavelengths);
        if (scatters) sum += sigma_s.at(wavelengths);
        return sum;
    }
    // Of radiance, along `distance` metres, which may be infinite.
    Throughput transmittance(float distance, Wavelengths const& wavelengths) const {
        if (!attenuates()) return Throughput(1);
        float const finite = std::min(distance, std::numeric_limits<float>::max());
        return map(Throughput(sigma_t(wavelengths).lane * -finite), [](float x) { return std::exp(x); });
    }
};
inline Medium const vacuum{};

// With a priority a body finds by itself what it lies in. Without one its surface is an interface between two media
// that it knows, whatever else is there.
struct Body {
    Medium inside, outside{};
    std::optional<int> priority{};
    bool outside_is_stated = false;  // by the scene; else it is a guess, vacuum
};

// What a path is in, kept up to date at each surface that it meets or crosses. `front`: the body's outer side. A body
// without a closed surface cannot harm: what is met from behind is taken to have been around the path.
class Surroundings {
  public:
    static constexpr int capacity = 8;  // nested bodies; those beyond do not exist for the path

    // `open`: what fills the place that no body fills.
    explicit Surroundings(Medium const& open = vacuum) : open_(&open) {}

    friend bool operator==(Surroundings const&, Surroundings const&) = default;

    Medium const& medium() const { return told_ ? *told_ : filling(count_); }

    // A surface is met: be in what lies before it.
    void meet(Body const& body, bool front) {
        if (!body.priority) {
            if (!front || body.outside.absorbs) told_ = front ? &body.outside : &body.inside;
        } else if (!front && !contains(body)) {
            enter(body);
        }
    }
    // Whether a surface that was met is none, since the same fills both its sides.
    bool is_no_surface(Body const& body, bool front) const {
        if (!body.priority) return false;
        if (front) return count_ == capacity || (count_ > 0 && *nested(count_)->priority >= *body.priority);
        return nested(count_) != &body || (count_ > 1 && nested(count_ - 1) == &body);
    }
    // What lies in front of a surface that was met and is one.
    Medium const& in_front_of(Body const& body, bool front) const {
        if (!body.priority) return body.outside;
        return filling(front ? count_ : count_ - 1);
    }
    void cross(Body const& body, bool front) {
        if (!body.priority) {
            told_ = front ? &body.inside : body.outside.absorbs ? &body.outside : nullptr;
            return;
        }
        told_ = nullptr;
        if (front)
            enter(body);
        else
            leave(body);
    }

  private:
    Body const* nested(int number) const {
        return number > 0 ? nested_[static_cast<std::size_t>(number) - 1] : nullptr;
    }
    Medium const& filling(int number) const { return number > 0 ? nested(number)->inside : *open_; }
    bool contains(Body const& body) const { return std::find(begin(), end(), &body) != end(); }
    void enter(Body const& body) {
        if (count_ == capacity) return;
        auto const place = std::find_if(begin(), end(), [&](Body const* b) { return *b->priority >= *body.priority; });
        std::copy_backward(place, end(), end() + 1);
        *place = &body;
        ++count_;
    }
    void leave(Body const& body) {
        auto const place = std::find(begin(), end(), &body);
        if (place == end()) return;
        std::copy(place + 1, end(), place);
        nested_[static_cast<std::size_t>(--count_)] = nullptr;
    }
    using List = std::array<Body const*, capacity>;
    List::const_iterator begin() const { return nested_.begin(); }
    List::const_iterator end() const { return nested_.begin() + count_; }
    List::iterator begin() { return nested_.begin(); }
    List::iterator end() { return nested_.begin() + count_; }

    List nested_{};  // by rising priority; of equal ones the first entered is the last
    int count_ = 0;
    Medium const* told_ = nullptr;  // by the last interface without a priority
    Medium const* open_;
};

}  // namespace iride
