// SPDX-License-Identifier: Apache-2.0
// Files that are cut, damaged, empty or far too large: read or refused with an InputError, never anything else. What
// would crash, hang or take the memory fails here (and under the sanitizers).
#include <catch2/catch.hpp>

#include "film/exr.h"
#include "spectral/catalogue.h"
#include "support/files.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

bool loads(fs::path const& path) {
    try {
        load_scene(path);
    } catch (InputError const& e) {
        CHECK(std::string(e.what()).size() > 10);
        return false;
    }
    return true;
}

// `count` copies of a text with one to four bytes replaced, dropped or doubled.
template <class Use>
void for_damaged(std::string const& text, std::uint32_t count, Use&& use) {
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string damaged = text;
        for (std::uint64_t k = 0; k <= hash_words(i, 1u) % 4; ++k) {
            std::size_t const at = hash_words(i, k, 2u) % damaged.size();
            char const byte = static_cast<char>(hash_words(i, k, 3u));
            std::uint64_t const kind = hash_words(i, k, 4u) % 4;
            if (kind == 0) damaged[at] = byte;
            if (kind == 1) damaged[at] = "0123456789-.eE[]{},\" \n"[hash_words(i, k, 5u) % 22];
            if (kind == 2) damaged.erase(at, 1 + hash_words(i, k, 6u) % 3);
            if (kind == 3) damaged.insert(at, damaged.substr(at, 1 + hash_words(i, k, 6u) % 8));
            if (damaged.empty()) damaged.push_back('x');
        }
        use(damaged);
    }
}

std::string const camera = R"("camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 })";

// Every kind of shape, light and spectrum, in few bytes.
std::string const small_scene = "{" + camera +
                                R"(, "film": { "size": [4,4], "bands": { "count": 2 } },
 "materials": { "a": { "type": "conductor", "ior": "Au", "roughness": 0.2 }, "g": { "type": "dielectric", "ior": 1.5 } },
 "shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": "a", "emission": { "radiance": 2 } },
 { "type": "box", "min": [0,0,0], "max": [1,1,1], "material": "g", "transform": [ { "scale": 2 }, { "rotate": [0,1,0], "angle_deg": 9 } ] },
 { "type": "mesh", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]], "material": { "type": "black" } } ],
 "objects": { "o": [ { "type": "cone", "from": [0,0,0], "to": [0,1,0], "radius": 1, "material": "a" } ] },
 "instances": [ { "object": "o", "transform": [ { "translate": [1,2,3] } ] } ],
 "lights": [ { "type": "spot", "position": [1,3,-1], "target": [0,0,0], "cone_deg": 40, "intensity": { "blackbody_K": 3000 } } ] })";

// A lat-long picture as this program writes it, with `width` x 8 pixels of noise.
std::string picture(int width, test::TemporaryFolder const& folder) {
    Film film(width, 8, cie1931_2deg(), WavelengthGrid::covering(visible_range));
    WavelengthSampler const wavelengths(visible_range, visible_importance(), WavelengthGrid::covering(visible_range));
    for (int i = 0; i < width * 8; ++i) {
        Sampler random(SamplerKind::independent, 1, static_cast<std::uint32_t>(i), 0);
        film.add(i % width, i / width, wavelengths.sample(random.next()), Radiance(random.next()));
    }
    ExrSettings settings;
    settings.colourspace = "linear-sRGB";
    write_exr(film, settings, folder.path() / "sky.exr");
    return test::content(folder.path() / "sky.exr");
}

std::string const with_sky = "{" + camera + R"(, "lights": [{ "type": "environment", "image": "sky.exr" }] })";

}  // namespace

TEST_CASE("a scene cut at any byte is refused", "[input]") {
    test::TemporaryFolder const folder;
    CHECK(loads(folder.write("a.json", small_scene)));
    for (std::size_t length = 0; length + 1 < small_scene.size(); ++length) {
        INFO(length << " bytes");
        CHECK(!loads(folder.write("a.json", small_scene.substr(0, length))));
    }
}

TEST_CASE("a scene damaged at random is read or refused", "[input]") {
    test::TemporaryFolder const folder;
    int read = 0;
    for_damaged(small_scene, 1000, [&](std::string const& text) { read += loads(folder.write("a.json", text)); });
    CHECK(read > 10);  // the damage is not always fatal: the readers behind the parser were reached
    CHECK(read < 700);
}

TEST_CASE("a mesh file damaged at random is read or refused", "[input]") {
    test::TemporaryFolder const folder;
    std::string obj,
        ply =
            "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
    std::string binary =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < 8; ++i) {
        std::string const point =
            std::to_string(i & 1) + " " + std::to_string(i >> 1 & 1) + " " + std::to_string(i >> 2);
        obj += "v " + point + "\nvt 0 " + std::to_string(i) + "\nvn 0 0 1\n";
        ply += point + "\n";
    }
    for (char const* face : {"0 4 6 2", "1 3 7 5", "0 1 5 4", "2 6 7 3", "0 2 3 1", "4 5 7 6"})
        ply += std::string("4 ") + face + "\n";
    obj += "f 1 2 3\nf 2/2 3/3 4/4\nf 4/4/4 5/5/5 6/6/6 7/7/7\nf -1//-1 -2//-2 -3//-3\n";
    float const corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    binary.append(reinterpret_cast<char const*>(corners), sizeof(corners));
    binary += std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
    for (auto const& [name, text] : {std::pair("a.obj", obj), {"a.ply", ply}, {"b.ply", binary}}) {
        CHECK_NOTHROW(read_mesh(folder.write(name, text)));
        int read = 0;
        for_damaged(text, 500, [&](std::string const& damaged) {
            try {
                check_mesh(read_mesh(folder.write(name, damaged)), name);  // what is read is good
                ++read;
            } catch (InputError const&) {
            }
        });
        INFO(name);
        CHECK(read > 5);
    }
}

TEST_CASE("a spectrum file damaged at random is read or refused", "[input]") {
    test::TemporaryFolder const folder;
    std::string const csv =
        "# quantity: reflectance\n# unit: 1\nwavelength_nm,red,green\n400,.1,.2\n500,.3,4e-1\n600,1,0\n";
    std::string const yaml =
        "REFERENCES: \"x\"\nDATA:\n  - type: tabulated nk\n    data: |\n        0.4 1 0.5\n        0.5 1.1 0.6\n";
    for (auto const& [name, text] : {std::pair("a.csv", csv), {"a.yml", yaml}})
        for_damaged(text, 500, [&](std::string const& damaged) {
            try {
                SpectrumFile const file = read_spectrum_file(folder.write(name, damaged));
                for (auto const& [column, values] : file.column) CHECK(values.size() == file.wavelength_nm.size());
            } catch (InputError const&) {
            }
        });
}

TEST_CASE("an environment picture cut at any length is refused", "[input]") {
    test::TemporaryFolder const folder;
    std::string const exr = picture(16, folder);
    auto const scene = folder.write("a.json", with_sky);
    CHECK(loads(scene));
    for (std::size_t length = 0; length < exr.size(); length += 37) {
        folder.write("sky.exr", exr.substr(0, length));
        INFO(length << " of " << exr.size() << " bytes");
        CHECK(!loads(scene));
    }
    CHECK_THROWS_WITH(load_scene(scene), Contains("lights[0].image") && Contains("sky.exr"));
}

TEST_CASE("an environment picture damaged at random is read or refused", "[input]") {
    test::TemporaryFolder const folder;
    std::string const exr = picture(16, folder);
    auto const scene = folder.write("a.json", with_sky);
    for (std::uint32_t i = 0; i < 200; ++i) {
        std::string damaged = exr;
        damaged[hash_words(i, 1u) % (i % 2 ? damaged.size() : std::size_t{600})] = static_cast<char>(hash_words(i, 2u));
        folder.write("sky.exr", damaged);
        loads(scene);
    }
}

// Sparse files: they take no room on the disk, and must take none in memory.
TEST_CASE("files of no byte and of two gigabytes are refused, whatever they are said to be", "[input]") {
    test::TemporaryFolder const folder;
    auto const scene = [&](std::string const& rest) {
        return folder.write("a.json", "{" + camera + ", " + rest + "}");
    };
    for (bool huge : {false, true}) {
        for (char const* name : {"a.ply", "a.obj", "a.csv", "a.spd", "a.yml", "sky.exr", "sky.hdr"}) {
            folder.write(name, "");
            if (huge) fs::resize_file(folder.path() / name, 2ull << 30);
        }
        std::string const found = huge ? "2048 MiB" : "empty";
        for (std::string const name : {"a.ply", "a.obj"})
            CHECK_THROWS_WITH(
                load_scene(scene(R"("shapes": [{ "type": "mesh", "material": { "type": "black" }, "file": ")" + name +
                                 R"(" }])")),
                Contains("shapes[0].file") && Contains(name) && Contains(found));
        for (std::string const name : {"a.csv", "a.spd", "a.yml"})
            CHECK_THROWS_WITH(
                load_scene(scene(R"("materials": { "m": { "type": "diffuse", "reflectance": ")" + name + R"(" } })")),
                Contains("materials.m.reflectance") && Contains(name) &&
                    Contains(huge ? "larger than 64 MiB" : "holds no"));
        for (std::string const name : {"sky.exr", "sky.hdr"})
            CHECK_THROWS_WITH(load_scene(scene(R"("lights": [{ "type": "environment", "image": ")" + name + R"(" }])")),
                              Contains("lights[0].image") && Contains(name) && Contains(found));
        CHECK_THROWS_WITH(read_exr_as_xyz(folder.path() / "sky.exr"), Contains("is not an OpenEXR file"));
    }
}
