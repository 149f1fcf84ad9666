// SPDX-License-Identifier: Apache-2.0
// Textures that are missing, damaged, of a wrong role, in a wrong space or on the wrong shape are refused at load, with
// place, what was found and what is allowed; the same file is read once.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <catch2/catch.hpp>

#include "base/picture.h"
#include "scene/texture_cache.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

using Bytes = std::vector<std::uint8_t>;

class Textures {
  public:
    // 8 x 4 pixels, each of channel values by `colour`.
    template <class Colour>
    void png(std::string const& name, Colour&& colour) const {
        Bytes bytes;
        for (int i = 0; i < 32; ++i)
            for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<std::uint8_t>(colour(i, c)));
        write_png(folder_.path() / name, 8, 4, bytes);
    }
    void floats(std::string const& name, std::vector<float> const& values) const {
        int const width = 2, height = static_cast<int>(values.size()) / (3 * width);
        Imf::Header header(width, height);
        Imf::FrameBuffer pixels;
        for (std::size_t c = 0; c < 3; ++c) {
            char const channel[] = {"RGB"[c], 0};
            header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
            auto* const first = reinterpret_cast<char*>(const_cast<float*>(values.data() + c));
            pixels.insert(channel, Imf::Slice(Imf::FLOAT, first, 3 * sizeof(float), 3 * width * sizeof(float)));
        }
        Imf::OutputFile output((folder_.path() / name).string().c_str(), header);
        output.setFrameBuffer(pixels);
        output.writePixels(height);
    }
    void file(std::string const& name, std::string const& content) const { folder_.write(name, content); }

    std::string refusal(std::string const& material, std::string const& shape = sphere) const {
        try {
            load(material, shape);
        } catch (InputError const& e) {
            return e.what();
        }
        return "(accepted)";
    }
    std::unique_ptr<Scene> load(std::string const& material, std::string const& shape = sphere) const {
        return load_scene(
            folder_.write("scene.json", R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 },
            "materials": { "m": )" + material +
                                            R"( },
            "shapes": [ { )" + shape + R"(, "material": "m" } ] })"));
    }
    static constexpr char const* sphere = R"("type": "sphere", "centre": [0,0,0], "radius": 1)";

  private:
    test::TemporaryFolder folder_;
};

std::string diffuse(std::string const& reflectance, std::string const& rest = "") {
    return R"({ "type": "diffuse", "reflectance": )" + reflectance + rest + "}";
}
Textures const& some() {
    static Textures const textures;
    static bool const written = [] {
        textures.png("wood.png", [](int i, int c) { return 40 + 5 * i + 10 * c; });
        textures.png("grey.png", [](int i, int) { return 8 * i; });
        textures.png("flat.png", [](int, int c) { return c == 2 ? 255 : 128; });
        // (.5, .5, 1) and neighbours through the sRGB curve.
        textures.png("encoded.png", [](int, int c) { return c == 2 ? 255 : 188; });
        return true;
    }();
    static_cast<void>(written);
    return textures;
}

}  // namespace

TEST_CASE("a picture that is missing or damaged is named", "[input]") {
    some().file("noise.png", "not a picture");
    some().file("cut.png", "\x89PNG\r\n\x1a\n");
    CHECK_THAT(
        some().refusal(diffuse(R"({ "image": "no.png", "space": "sRGB" })")),
        Contains("scene.json:2:") && Contains("materials.m.reflectance.image:") && Contains("no.png: no such file"));
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "noise.png", "space": "sRGB" })")), Contains("is no OpenEXR"));
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "cut.png", "space": "sRGB" })")), Contains("cut.png"));
}
TEST_CASE("a picture of reflectances has a space, a map of numbers has none", "[input]") {
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "wood.png" })")),
               Contains("materials.m.reflectance: a picture of reflectances needs its 'space'; allowed: ") &&
                   Contains("sRGB"));
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "wood.png", "space": "sRBG" })")),
               Contains("did you mean 'sRGB'?"));
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "wood.png", "space": "sRGB", "role": "roughness" })")),
               Contains("materials.m.reflectance.role: found 'roughness'; allowed: reflectance"));
    CHECK_THAT(some().refusal(
                   R"({ "type": "conductor", "ior": "Au", "roughness": { "image": "grey.png", "space": "sRGB" } })"),
               Contains("materials.m.roughness.space: a roughness map holds numbers"));
    CHECK_THAT(some().refusal(diffuse("0.5", R"(, "normal_map": { "image": "flat.png", "space": "sRGB" })")),
               Contains("materials.m.normal_map.space: a normal map holds numbers"));
    CHECK_THAT(some().refusal(R"({ "type": "conductor", "ior": { "image": "wood.png", "space": "sRGB" } })"),
               Contains("materials.m.ior"));
}
TEST_CASE("reflectances above 1 in a picture of floats are refused", "[input]") {
    some().floats("light.exr", {.5f, .5f, .5f, 0, 1, 0, 3, .2f, .2f, .1f, .1f, 1});
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "light.exr", "space": "linear-sRGB" })")),
               Contains("light.exr: 1 of 4 texels reflect more than 1, up to 3"));
    some().floats("nan.exr", {.5f, .5f, .5f, 0, std::numeric_limits<float>::quiet_NaN(), 0});
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "nan.exr", "space": "linear-sRGB" })")), Contains("not finite"));
}
TEST_CASE("texels that no reflectance has are counted in a remark", "[input]") {
    some().floats("green.exr", {0, 1, 0, .5f, .5f, .4f});
    auto const scene = some().load(diffuse(R"({ "image": "green.exr", "space": "ACEScg" })"));
    REQUIRE(scene->remarks.size() == 1);
    CHECK_THAT(scene->remarks[0],
               Contains("materials.m.reflectance.image: 1 of 2 texels of 'green.exr' have a colour that no"));
}
TEST_CASE("names of wraps, filters and channels are offered", "[input]") {
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "wood.png", "space": "sRGB", "wrap": "repeet" })")),
               Contains("did you mean 'repeat'?"));
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "wood.png", "space": "sRGB", "filter": "bilinaer" })")),
               Contains("did you mean 'bilinear'?"));
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "wood.png", "space": "sRGB", "scale": [2, 0] })")),
               Contains("materials.m.reflectance.scale: found 0"));
    CHECK_THAT(some().refusal(diffuse(R"({ "image": "wood.png", "space": "sRGB", "tile": 2 })")),
               Contains("tile: unknown key"));
    CHECK_THAT(some().refusal(diffuse("0.5", R"(, "alpha": { "image": "wood.png" })")),
               Contains("is a colour picture") && Contains("allowed: red, green, blue, alpha"));
    CHECK_THAT(some().refusal(diffuse("0.5", R"(, "alpha": { "image": "grey.png", "channel": "alpha" })")),
               Contains("has 3 channels and no alpha"));
}
TEST_CASE("a map of normals in the wrong space is recognised by its lengths", "[input]") {
    CHECK(some().refusal(diffuse("0.5", R"(, "normal_map": { "image": "flat.png" })")) == "(accepted)");
    CHECK_THAT(
        some().refusal(diffuse("0.5", R"(, "normal_map": { "image": "encoded.png" })")),
        Contains("materials.m.normal_map.image:") && Contains("mean length 1.204") && Contains("not encoded as sRGB"));
    CHECK_THAT(some().refusal(diffuse("0.5", R"(, "normal_map": { "image": "wood.png" })")),
               Contains("is no map of normals"));
}
TEST_CASE("values of maps keep their limits", "[input]") {
    CHECK_THAT(some().refusal(diffuse("0.5", R"(, "alpha": { "image": "grey.png", "range": [0, 2] })")),
               Contains("the alpha goes from 0 to 1.9"));
    CHECK_THAT(some().refusal(diffuse("0.5", R"(, "alpha": 1.5)")),
               Contains("materials.m.alpha: found 1.5, allowed: in 0 .. 1"));
    CHECK_THAT(some().refusal(R"({ "type": "conductor", "ior": "Au", "roughness": { "image": "grey.png" } })"),
               Contains("materials.m.roughness: the roughness goes from 0 to 0.97") && Contains("0.001 .. 1"));
    CHECK_THAT(some().refusal(diffuse(R"({ "weights": { "image": "grey.png" }, "spectra": [0.1] })")),
               Contains("spectra: found an array of 1, but an array of two reflectances is wanted"));
    CHECK_THAT(some().refusal(diffuse(R"({ "checker": [0.1, 1.5] })")),
               Contains("materials.m.reflectance.checker[1]: values 1.5"));
    CHECK_THAT(some().refusal(diffuse("0.5", R"(, "bump": { "image": "grey.png" })")),
               Contains("the key 'height' is missing"));
    CHECK_THAT(some().refusal(diffuse(
                   "0.5", R"(, "bump": { "waves": [1, 1], "height": 0.1 }, "normal_map": { "image": "flat.png" })")),
               Contains("not both"));
}
TEST_CASE("a texture on a mesh without uv, holes in a lamp and in glass are refused", "[input]") {
    CHECK_THAT(some().refusal(diffuse(R"({ "checker": [0, 1] })"),
                              R"("type": "mesh", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]])"),
               Contains("shapes[0].material: 'm' has a texture, but this mesh has no uv"));
    CHECK_THAT(some().refusal(diffuse("0.5", R"(, "alpha": 0.5)"),
                              std::string(Textures::sphere) + R"(, "emission": { "radiance": 1 })"),
               Contains("shapes[0].emission: a lamp has no holes"));
    CHECK_THAT(some().refusal(R"({ "type": "dielectric", "ior": 1.5, "alpha": 0.5 })"),
               Contains("materials.m.alpha: a transparent body has no holes"));
    CHECK_THAT(some().refusal(
                   diffuse("0.5"),
                   R"("type": "mesh", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]], "uv": [[0,0]])"),
               Contains("uv: found an array of 1, but a pair for each of the 3 vertices is wanted"));
}
TEST_CASE("a picture that is named twice is read once", "[unit]") {
    TextureCache cache;
    test::TemporaryFolder const folder;
    write_png(folder.path() / "a.png", 1, 1, Bytes{10, 20, 30});
    auto const& srgb = rgb_encoding("sRGB");
    auto const first = cache.reflectance(folder.path() / "a.png", srgb);
    CHECK(cache.reflectance(folder.path() / "." / "a.png", srgb) == first);
    CHECK(cache.reflectance(folder.path() / "a.png", rgb_encoding("linear-sRGB")) != first);
}
