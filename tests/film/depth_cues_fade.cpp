// SPDX-License-Identifier: Apache-2.0
// A depth cue is a straight line between two depths, and leaves a file's other channels alone.
#include "film/depth_cue.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>

#include <catch2/catch.hpp>
#include <map>

#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

using Channels = std::map<std::string, std::array<float, 4>>;  // of a 4 x 1 picture

void write(std::filesystem::path const& path, Channels channels) {
    Imf::Header header(4, 1);
    Imf::FrameBuffer buffer;
    for (auto& [name, value] : channels) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(value.data()), sizeof(float), 0));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(1);
}
Channels read(std::filesystem::path const& path) {
    Imf::InputFile file(path.c_str());
    Channels channels;
    Imf::FrameBuffer buffer;
    for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c)
        buffer.insert(c.name(),
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(channels[c.name()].data()), sizeof(float), 0));
    file.setFrameBuffer(buffer);
    file.readPixels(0);
    return channels;
}

}  // namespace

TEST_CASE("a depth cue keeps the front, mixes halfway evenly and takes what is behind", "[unit]") {
    DepthCue const cue{2, 6, .9, .1, {0, 0, 0}};
    CHECK(cue.share(-1) == Approx(.9));
    CHECK(cue.share(2) == Approx(.9));
    CHECK(cue.share(4) == Approx(.5));
    CHECK(cue.share(5) == Approx(.3));
    CHECK(cue.share(6) == Approx(.1));
    CHECK(cue.share(std::numeric_limits<double>::infinity()) == Approx(.1));
    CHECK(cue.share(std::nan("")) == Approx(.1));
}

TEST_CASE("a picture fades to the cue's colour by its depth channel", "[unit]") {
    test::TemporaryFolder const folder;
    auto const in = folder.path() / "in.exr", out = folder.path() / "out.exr";
    for (char const* depth : {"depth.Z", "Z"}) {
        write(in, {{"R", {1, 1, 1, 1}},
                   {"G", {2, 2, 2, 2}},
                   {"B", {4, 4, 4, 4}},
                   {depth, {1, 3, 4, INFINITY}},
                   {"normal.X", {.1f, .2f, .3f, .4f}},
                   {"variance.X", {1, 1, 1, 1}},
                   {"S0.550,000000nm", {1, 1, 1, 1}}});
        apply_depth_cue({2, 4, 1, 0, {.5, 0, 8}}, in, out);
        Channels const c = read(out);
        CHECK(c.at("R") == std::array{1.f, .75f, .5f, .5f});
        CHECK(c.at("G") == std::array{2.f, 1.f, 0.f, 0.f});
        CHECK(c.at("B") == std::array{4.f, 6.f, 8.f, 8.f});
        CHECK(c.at("normal.X") == std::array{.1f, .2f, .3f, .4f});
        CHECK(c.at(depth) == std::array{1.f, 3.f, 4.f, INFINITY});
        CHECK(c.size() == 5);
    }
}

TEST_CASE("a picture without depth or colour is not faded", "[input]") {
    test::TemporaryFolder const folder;
    auto const in = folder.path() / "in.exr", out = folder.path() / "out.exr";
    std::array const one{1.f, 1.f, 1.f, 1.f};
    auto const refusal = [&] {
        try {
            apply_depth_cue({2, 4, 1, 0, {0, 0, 0}}, in, out);
        } catch (InputError const& e) {
            return std::string(e.what());
        }
        return std::string("(accepted)");
    };
    CHECK_THAT(refusal(), Contains("no such file"));
    write(in, {{"R", one}, {"G", one}, {"B", one}});
    CHECK_THAT(refusal(), Contains("has no depth"));
    write(in, {{"X", one}, {"Y", one}, {"Z", one}});
    CHECK_THAT(refusal(), Contains("has no depth"));
    write(in, {{"R", one}, {"depth.Z", one}});
    CHECK_THAT(refusal(), Contains("neither channels"));
    CHECK_FALSE(std::filesystem::exists(out));
}
