// SPDX-License-Identifier: Apache-2.0
// A solved scene as it is looked at: patches with a spectrum at every vertex. Radiance of a patch is b / pi in every
// direction, b between vertices by Wachspress coordinates and between wavelengths linear. [Wachspress 1975]
#pragma once

#include "integrators/radiosity/patches.h"
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

// Where the lanes of a packet lie among evenly spaced wavelengths: at(lane, value of column) is linear between them.
class WavelengthCells {
  public:
    WavelengthCells(std::vector<double> const& nm, Wavelengths const& wavelengths);
    template <class OfColumn>
    float at(int lane, OfColumn const& value) const {
        float const low = value(cell_[static_cast<std::size_t>(lane)]), high = value(next(lane));
        return low + fraction_[static_cast<std::size_t>(lane)] * (high - low);
    }

  private:
    Eigen::Index next(int lane) const { return std::min(cell_[static_cast<std::size_t>(lane)] + 1, last_); }
    std::array<Eigen::Index, lane_count> cell_;
    std::array<float, lane_count> fraction_;
    Eigen::Index last_;
};

class RadiosityField {
  public:
    using AtVertex = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // [vertex][wavelength]

    RadiosityField(PatchMesh mesh, std::vector<double> wavelengths_nm, AtVertex at_vertex);

    PatchMesh const& mesh() const { return mesh_; }
    PatchTracer const& tracer() const { return tracer_; }
    std::vector<double> const& wavelengths_nm() const { return nm_; }
    AtVertex const& at_vertex() const { return at_vertex_; }  // W m^-2 nm^-1

    // Radiance that leaves a place of a patch; none where there is no patch.
    Radiance radiance(PatchHit const& hit, Wavelengths const& wavelengths) const;

  private:
    PatchMesh mesh_;
    PatchTracer tracer_;
    std::vector<double> nm_;  // evenly spaced
    AtVertex at_vertex_;
};

// From what patches send out, [patch][wavelength].
std::shared_ptr<RadiosityField const> field_of_patches(PatchMesh mesh, std::vector<double> wavelengths_nm,
                                                       Spectra const& of_patches);

}  // namespace iride::radiosity
