// SPDX-License-Identifier: Apache-2.0
// The pictures of textures, read, checked, uplifted and halved once for a scene, however often it names them.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "colour/rgb_encoding.h"
#include "materials/relief.h"
#include "materials/textures.h"

namespace iride {

struct ReflectancePicture {
    PictureReflectance::Pyramid pyramid;
    std::size_t texels, unreachable;  // of the picture itself; unreachable: got the nearest reflectance found
    double worst_difference;          // CIE 1976, among those
};
struct ScalarPicture {
    PictureScalar::Pyramid pyramid;
    ScalarRange extent;
};

enum class PictureChannel { only, red, green, blue, alpha };

// All throw InputError: what read_picture refuses, and
//   reflectance  texels that are not finite, and above 1 in a picture of floats
//   scalar       texels that are not finite, a channel that is not there, several differing channels and none chosen
//   normals      fewer than 3 channels, decoded vectors whose lengths are far from 1, or that look into the surface
class TextureCache {
  public:
    std::shared_ptr<ReflectancePicture const> reflectance(std::filesystem::path const& path,
                                                          RgbEncoding const& encoding);
    std::shared_ptr<ScalarPicture const> scalar(std::filesystem::path const& path, PictureChannel channel);
    std::shared_ptr<NormalMap::Pyramid const> normals(std::filesystem::path const& path);

  private:
    std::map<std::pair<std::string, std::string_view>, std::shared_ptr<ReflectancePicture const>> reflectances_;
    std::map<std::pair<std::string, PictureChannel>, std::shared_ptr<ScalarPicture const>> scalars_;
    std::map<std::string, std::shared_ptr<NormalMap::Pyramid const>> normals_;
};

}  // namespace iride
