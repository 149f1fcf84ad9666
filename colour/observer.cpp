// SPDX-License-Identifier: Apache-2.0
#include "colour/observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "base/diagnostics.h"
#include "spectral/catalogue.h"

namespace iride {

namespace {

Observer load(std::string const& name) {
    SpectrumFile const file = read_spectrum_file(data_folder() / "cie" / ("observer_" + name + ".csv"));
    auto const column = [&](char const* key) {
        return SpectralFunction(TabulatedShape{file.wavelength_nm, file.column.at(key)}, Outside::zero, name);
    };
    Observer result{name, column("x"), column("y"), column("z"), 0};
    result.ybar_integral = result.ybar.integral(result.ybar.defined_on());
    return result;
}

}  // namespace

Xyz Observer::integrate(SpectralFunction const& radiance) const {
    WavelengthRange const domain = ybar.defined_on();
    double const scale = 1 / ybar_integral;
    return {radiance.integral(domain, xbar) * scale, radiance.integral(domain, ybar) * scale,
            radiance.integral(domain, zbar) * scale};
}

std::vector<std::string> const& observer_names() {
    static std::vector<std::string> const names{"cie1931_2deg", "cie1964_10deg", "cie2015_2deg", "cie2015_10deg"};
    return names;
}

Observer const& observer(std::string const& name) {
    std::vector<std::string> const& known = observer_names();
    static std::map<std::string, Observer> loaded;
    static std::mutex guard;
    if (std::ranges::find(known, name) == known.end())
        throw InputError({}, "observer", fmt::format("unknown observer '{}'{}", name, suggestion(name, known)));
    std::lock_guard const lock(guard);
    auto const found = loaded.find(name);
    return found != loaded.end() ? found->second : loaded.emplace(name, load(name)).first->second;
}

SpectralFunction luminance_weighted(SpectralFunction const& radiance, double luminance, Observer const& observer) {
    return radiance.scaled(luminance / observer.integrate(radiance).Y);
}

double luminance_of_unit_Y(Observer const& observer) { return maximum_luminous_efficacy * observer.ybar_integral; }

}  // namespace iride
