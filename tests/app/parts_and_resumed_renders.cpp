// SPDX-License-Identifier: Apache-2.0
// A picture that was interrupted, or made in parts, is the picture that was made at once.
#include <catch2/catch.hpp>

#include "film/exr.h"
#include "support/files.h"
#include "support/program.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

struct Work {
    test::TemporaryFolder folder;
    std::string operator()(std::string const& name) const { return (folder.path() / name).string(); }
    // Of cornell.
    test::RunResult render(std::string const& options, std::string const& exr,
                           std::string const& size = "48x40") const {
        return test::run_iride("render cornell --size " + size + " --quiet " + options + " -o " + (*this)(exr));
    }
};

bool same_pixels(XyzPicture const& a, XyzPicture const& b, double tolerance) {
    if (a.xyz.pixel.size() != b.xyz.pixel.size()) return false;
    auto const near = [&](double p, double q) { return std::abs(p - q) <= tolerance * std::abs(q); };
    for (std::size_t i = 0; i < a.xyz.pixel.size(); ++i)
        for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z})
            if (!near(a.xyz.pixel[i].*c, b.xyz.pixel[i].*c)) return false;
    return true;
}

}  // namespace

// Fails when a resumed pixel goes on from the samples that all pixels have, and not from its own.
TEST_CASE("a render killed again and again ends in the same bits", "[app]") {
    Work const at;
    for (std::string const kind : {"--spp 96", "--adaptive --error 0.1"}) {
        REQUIRE(at.render(kind, "whole.exr").code == 0);
        std::string const resumed = "render cornell --size 48x40 --quiet " + kind + " --checkpoint " + at("c") +
                                    " --checkpoint-every 0 -o " + at("parts.exr");
        for (char const* moment : {"0.25", "0.4", "0.6"})
            test::run_command("timeout -s KILL " + std::string(moment) + " " IRIDE_PROGRAM " " + resumed);
        test::run_command("timeout -s INT 0.4 " IRIDE_PROGRAM " " + resumed);
        auto const last = test::run_iride(resumed);
        INFO(kind << last.text);
        REQUIRE(last.code == 0);
        CHECK((test::content(at("parts.exr")) == test::content(at("whole.exr"))));
        std::filesystem::remove(at("c"));
    }
}

// Each difference is named, and the file is as it was.
TEST_CASE("a checkpoint of another render is refused", "[input]") {
    Work const at;
    REQUIRE(at.render("--spp 4 --seed 1 --checkpoint " + at("c"), "a.exr").code == 0);
    std::string const before = test::content(at("c"));
    struct Case {
        char const *options, *message, *size = "48x40";
    };
    for (Case const& c : {Case{"--seed 2", "seed is 1, here 2"}, Case{"--seed 1", "size is 48 40, here 49 40", "49x40"},
                          Case{"--seed 1 --integrator reference_path", "integrator is path, here reference_path"},
                          Case{"--seed 1 --crop 0,0,8,8", "crop is 0 0 48 40, here 0 0 8 8"},
                          Case{"--seed 1 --first-sample 3", "first sample is 0, here 3"},
                          Case{"--seed 1 --adaptive --time 1", "films is 1, here 4"}}) {
        auto const r = at.render(std::string(c.options) + " --checkpoint " + at("c"), "b.exr", c.size);
        INFO(c.options);
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains(c.message));
    }
    auto const other =
        test::run_iride("render metals --size 48x40 --seed 1 --checkpoint " + at("c") + " -o " + at("b.exr"));
    CHECK(other.code == 2);
    CHECK_THAT(other.text, Contains("scene hash is "));
    CHECK((test::content(at("c")) == before));
    CHECK(!std::filesystem::exists(at("b.exr")));
}

TEST_CASE("a truncated or damaged checkpoint gives one clear message", "[input]") {
    Work const at;
    REQUIRE(at.render("--spp 4 --checkpoint " + at("c"), "a.exr").code == 0);
    std::string const good = test::content(at("c"));
    std::string flipped = good;
    flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
    std::string many = good;
    many.replace(many.find("crop: 0 0 48 40"), 15, "crop: 0 0 99 40");
    for (std::string const& bad :
         {good.substr(0, 100), good.substr(0, good.size() - 1), good.substr(0, 2000), good + "x", flipped, many}) {
        at.folder.write("c", bad);
        auto const r = at.render("--spp 8 --checkpoint " + at("c"), "b.exr");
        INFO(r.text);
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains("is a truncated or damaged checkpoint"));
        CHECK((test::content(at("c")) == bad));
    }
    at.folder.write("c", "something else");
    CHECK_THAT(at.render("--spp 8 --checkpoint " + at("c"), "b.exr").text,
               Contains("is no checkpoint of this program"));
}

TEST_CASE("a full disk leaves the checkpoint of before", "[app]") {
    Work const at;
    REQUIRE(at.render("--spp 8 --checkpoint " + at("c"), "a.exr").code == 0);
    REQUIRE(at.render("--spp 16", "whole.exr").code == 0);
    std::string const before = test::content(at("c"));
    // Files of at most 16 KiB.
    auto const r = test::run_command("bash -c \"trap '' XFSZ; ulimit -f 16; " IRIDE_PROGRAM
                                     " render cornell --size 48x40 --quiet --spp 16 --checkpoint " +
                                     at("c") + " -o " + at("b.exr") + "\"");
    INFO(r.text);
    CHECK(r.code == 2);
    CHECK_THAT(r.text, Contains("cannot be written") && Contains("the checkpoint of before stays"));
    CHECK((test::content(at("c")) == before));
    REQUIRE(at.render("--spp 16 --checkpoint " + at("c"), "b.exr").code == 0);
    CHECK((test::content(at("b.exr")) == test::content(at("whole.exr"))));
}

// Fails when the sampler numbers a part's pixels from the part's own corner.
TEST_CASE("a crop has the bits of the whole picture, and says where it lies", "[app]") {
    Work const at;
    REQUIRE(at.render("--spp 8 --colourspace XYZ", "whole.exr").code == 0);
    REQUIRE(at.render("--spp 8 --colourspace XYZ --crop 10,5,31,17", "part.exr").code == 0);
    XyzPicture const whole = read_exr_as_xyz(at("whole.exr")), part = read_exr_as_xyz(at("part.exr"));
    REQUIRE(part.xyz.width == 21);
    REQUIRE(part.xyz.height == 12);
    int different = 0;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 21; ++x) {
            Xyz const &p = part.xyz.at(x, y), &q = whole.xyz.at(x + 10, y + 5);
            different += p.X != q.X || p.Y != q.Y || p.Z != q.Z;
        }
    CHECK(different == 0);
    auto const header = test::run_command("exrheader " + at("part.exr"));
    CHECK_THAT(header.text, Contains("dataWindow (type box2i): (10 5) - (30 16)") &&
                                Contains("displayWindow (type box2i): (0 0) - (47 39)"));
    for (char const* bad : {"1,2,3", "0,0,0,5", "5,0,4,5", "-1,0,4,5", "0,0,49,5", "0,0,4,5x", "a"}) {
        auto const r = at.render("--crop=" + std::string(bad), "c.exr");
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains("--crop: found '" + std::string(bad) + "', allowed: X0,Y0,X1,Y1"));
    }
}

TEST_CASE("parts merged are the picture that was made at once", "[app]") {
    Work const at;
    REQUIRE(at.render("--spp 48", "whole.exr").code == 0);
    REQUIRE(at.render("--spp 16 --checkpoint " + at("first"), "p.exr").code == 0);
    REQUIRE(at.render("--spp 32 --first-sample 16 --checkpoint " + at("second"), "p.exr").code == 0);
    XyzPicture const whole = read_exr_as_xyz(at("whole.exr"));
    auto const merged = [&](std::string const& parts) {
        return test::run_iride("merge " + parts + " -o " + at("merged.exr"));
    };
    // The sums are of the same numbers in another order.
    REQUIRE(merged(at("first") + " " + at("second")).code == 0);
    CHECK(same_pixels(read_exr_as_xyz(at("merged.exr")), whole, 1e-5));
    // Windows that do not meet: the same bits.
    REQUIRE(at.render("--spp 48 --crop 0,0,20,40 --checkpoint " + at("left"), "p.exr").code == 0);
    REQUIRE(at.render("--spp 48 --crop 20,0,48,40 --checkpoint " + at("right"), "p.exr").code == 0);
    REQUIRE(merged(at("right") + " " + at("left")).code == 0);
    CHECK((test::content(at("merged.exr")) == test::content(at("whole.exr"))));
    // What may not be added up.
    auto const refused = [&](std::string const& parts, char const* why) {
        auto const r = merged(parts);
        INFO(r.text);
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains("cannot be merged with") && Contains(why));
    };
    refused(at("first") + " " + at("first"), "both have the same samples of some pixels");
    refused(at("first") + " " + at("left"), "both have the same samples of some pixels");
    REQUIRE(at.render("--spp 4 --checkpoint " + at("small"), "p.exr", "20x20").code == 0);
    refused(at("first") + " " + at("small"), "size is 48 40, here 20 20");
    REQUIRE(test::run_iride("render metals --quiet --spp 4 --size 48x40 --checkpoint " + at("metals") + " -o " +
                            at("p.exr"))
                .code == 0);
    refused(at("first") + " " + at("metals"), "scene hash is ");
    CHECK_THAT(merged(at("p.exr")).text, Contains("is no checkpoint of this program"));
    CHECK_THAT(merged(at("nothing")).text, Contains("no such file"));
}

TEST_CASE("targets and layers that make no sense are refused", "[input]") {
    Work const at;
    for (char const* bad : {"0", "-1", "nan", "inf", "de=", "de=0", "de=x", "x", "0.1%"}) {
        auto const r = at.render("--error=" + std::string(bad), "c.exr");
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains("--error: found '" + std::string(bad) + "', allowed: a relative error above 0"));
    }
    CHECK_THAT(at.render("--adaptive", "c.exr").text, Contains("--adaptive: needs --error or --time"));
    CHECK_THAT(at.render("--aov dept", "c.exr").text, Contains("unknown layer 'dept'; did you mean 'depth'?"));
    CHECK_THAT(at.render("--aov depth,direct --integrator radiosity", "c.exr").text,
               Contains("the integrator 'radiosity' cannot give the layer 'direct'"));
    CHECK(!std::filesystem::exists(at("c.exr")));
}
