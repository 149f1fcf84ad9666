// SPDX-License-Identifier: Apache-2.0
// A picture that was interrupted, or made in parts, is the picture that was made at once.
#include <catch2/catch.hpp>
#include <numeric>

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

// Start the program, and once it has saved (again), send it a signal: its exit code.
int signalled(std::string const& arguments, std::string const& checkpoint, char const* signal) {
    // The checkpoint's inode is another after each saving.
    std::string const script =
        "inode() { stat -c %i " + checkpoint + " 2>/dev/null; }; before=$(inode); " IRIDE_PROGRAM " " + arguments +
        " & program=$!; while [ \"$(inode)\" = \"$before\" ] && kill -0 $program 2>/dev/null; do sleep 0.01; done; "
        "sleep 0.03; kill -" +
        std::string(signal) + " $program; wait $program";
    return test::run_command("bash -c '" + script + "'").code;
}

double mean_of(std::vector<float> const& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

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
    for (std::string const kind :
         {"cornell --spp 96", "cornell --adaptive --error 0.1", "cornell-gold --spp 24 --integrator auto",
          "cornell --spp 32 --integrator light-tracing", "cornell --spp 24 --integrator bidirectional-power",
          "cornell --spp 32 --integrator progressive-photon:photons=2000",
          "cornell --spp 16 --integrator final-gather:photons=2000"}) {
        std::string const render = "render --size 48x40 --quiet " + kind;
        REQUIRE(test::run_iride(render + " -o " + at("whole.exr")).code == 0);
        std::string const resumed = render + " --checkpoint " + at("c") + " --checkpoint-every 0 -o " + at("parts.exr");
        INFO(kind);
        for (int killed = 0; killed < 3; ++killed) signalled(resumed, at("c"), "KILL");
        CHECK(std::filesystem::exists(at("c")));
        signalled(resumed, at("c"), "INT");
        auto const last = test::run_iride(resumed);
        INFO(last.text);
        REQUIRE(last.code == 0);
        CHECK((test::content(at("parts.exr")) == test::content(at("whole.exr"))));
        std::filesystem::remove(at("c"));
    }
}

TEST_CASE("Ctrl-C ends with 130, a checkpoint, and a picture of what is finished with its layers", "[app]") {
    Work const at;
    std::string const render = "render cornell --size 48x40 --quiet --spp 400 --colourspace XYZ --aov direct,indirect ";
    int const code =
        signalled(render + "--checkpoint " + at("c") + " --checkpoint-every 0 -o " + at("part.exr"), at("c"), "INT");
    CHECK(code == 130);
    CHECK(test::file_count(at.folder.path()) == 2);  // and nothing temporary
    XyzPicture const part =
        read_exr_as_xyz(at("part.exr"), [](std::string const& c) { return c.ends_with("direct.Y"); });
    CHECK(std::stoi(part.facts.at("spp")) < 400);
    REQUIRE(part.layers.channels.size() == 2);
    double const direct = mean_of(part.layers.channels[0].second), rest = mean_of(part.layers.channels[1].second);
    CHECK(direct > rest);
    double whole = 0;
    for (Xyz const& c : part.xyz.pixel) whole += c.Y / static_cast<double>(part.xyz.pixel.size());
    CHECK(direct + rest == Approx(whole).epsilon(1e-5));
    CHECK(test::run_iride("merge " + at("c") + " -o " + at("of_checkpoint.exr") + " --colourspace XYZ").code == 0);
    CHECK(same_pixels(read_exr_as_xyz(at("of_checkpoint.exr")), part, 0));
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
                          Case{"--seed 1 --integrator reference_path", "integrator is auto, here reference_path"},
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

// A file system of 256 KiB, in which a checkpoint of 48 x 40 pixels, 170 KiB, does not fit twice. Where a test may
// mount none, only the limit of the case below is tried.
TEST_CASE("a disk that fills up loses nothing that was saved", "[app]") {
    Work const at;
    auto const on_small_disk = [&](std::string const& commands) {
        std::filesystem::create_directories(at("small"));
        return test::run_command("unshare -rm bash -c 'mount -t tmpfs -o size=256k none " + at("small") + " && { " +
                                 commands + "; }'");
    };
    if (on_small_disk("true").code != 0) {
        WARN("no file system can be mounted here");
        return;
    }
    REQUIRE(at.render("--spp 16", "whole.exr").code == 0);
    std::string const render = IRIDE_PROGRAM " render cornell --size 48x40 --quiet --checkpoint " + at("small/c");
    auto const r = on_small_disk(render + " --spp 8 -o " + at("p.exr") + " && cp " + at("small/c") + " " +
                                 at("before") + "; " + render + " --checkpoint-every 0 --spp 12 -o " + at("p.exr") +
                                 "; echo render $?; cmp " + at("small/c") + " " + at("before") + " && echo kept; ls " +
                                 at("small") + "; mount -o remount,size=1m " + at("small") + "; " + render +
                                 " --spp 16 -o " + at("resumed.exr"));
    INFO(r.text);
    CHECK_THAT(r.text, Contains("cannot be written") && Contains("the checkpoint of before stays") &&
                           Contains("render 0") && Contains("kept\nc\n"));
    CHECK((test::content(at("resumed.exr")) == test::content(at("whole.exr"))));
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
    // Windows that do not meet: the same pixels.
    REQUIRE(at.render("--spp 48 --crop 0,0,20,40 --checkpoint " + at("left"), "p.exr").code == 0);
    REQUIRE(at.render("--spp 48 --crop 20,0,48,40 --checkpoint " + at("right"), "p.exr").code == 0);
    REQUIRE(merged(at("right") + " " + at("left")).code == 0);
    CHECK(same_pixels(read_exr_as_xyz(at("merged.exr")), whole, 0));
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
    at.folder.write("text", "something else");
    CHECK_THAT(merged(at("text")).text, Contains("is no checkpoint of this program"));
    CHECK_THAT(merged(at("nothing")).text, Contains("no such file"));
}

// The mean and its variance of the parts' samples together, to the floats' precision: here of parts of 16 and 32
// samples, which a mean of means would weigh alike.
TEST_CASE("pictures merged by their numbers of samples are the picture that was made at once", "[app]") {
    Work const at;
    auto const merged = [&](std::string const& parts) {
        return test::run_iride("merge " + parts + " --colourspace XYZ -o " + at("merged.exr"));
    };
    for (std::string const how : {"", " --colourspace XYZ --aov depth", " --integrator bidirectional"}) {
        INFO(how);
        REQUIRE(at.render("--spp 48 --colourspace XYZ" + how.substr(0, how.find(" --colour")), "whole.exr").code == 0);
        REQUIRE(at.render("--spp 16" + how, "a.exr").code == 0);
        REQUIRE(at.render("--spp 32 --first-sample 16" + how, "b.exr").code == 0);
        auto const r = merged(at("a.exr") + " " + at("b.exr"));
        INFO(r.text);
        REQUIRE(r.code == 0);
        CHECK_THAT(r.text, !Contains("left out"));
        XyzPicture const whole = read_exr_as_xyz(at("whole.exr")), sum = read_exr_as_xyz(at("merged.exr"));
        CHECK(same_pixels(sum, whole, 2e-5));
        CHECK(sum.facts.at("spp") == "48");
        CHECK(sum.facts.at("parts") == "2");
        double worst = 0;
        for (std::size_t i = 0; i < sum.variance.pixel.size(); ++i) {
            double const v = whole.variance.pixel[i].Y;
            worst = std::max(worst, std::abs(sum.variance.pixel[i].Y - v) / (v + 1e-9));
        }
        // Of light paths a picture has no sum of squares: the parts' means, n = 48, then tell of the variance too, up
        // to (chi^2_1 - 1) / (n - 1), which is .3 in the worst of 1920 pixels.
        CHECK(worst < (how.find("bidirectional") == std::string::npos ? 1e-2 : 0.5));
    }
    // Windows that do not meet.
    REQUIRE(at.render("--spp 48", "whole.exr").code == 0);
    REQUIRE(at.render("--spp 48 --crop 0,0,20,40", "left.exr").code == 0);
    REQUIRE(at.render("--spp 48 --crop 20,0,48,40", "right.exr").code == 0);
    REQUIRE(merged(at("right.exr") + " " + at("left.exr")).code == 0);
    CHECK(same_pixels(read_exr_as_xyz(at("merged.exr")), read_exr_as_xyz(at("whole.exr")), 2e-5));
}

TEST_CASE("pictures of other scenes, sizes, versions or the same samples are not merged, and what differs is named",
          "[input]") {
    Work const at;
    REQUIRE(at.render("--spp 4", "a.exr").code == 0);
    auto const refused = [&](std::string const& parts, std::string const& why) {
        auto const r = test::run_iride("merge " + parts + " -o " + at("merged.exr"));
        INFO(parts << r.text);
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains(why));
        CHECK(!std::filesystem::exists(at("merged.exr")));
    };
    std::string const a = at("a.exr") + " ";
    refused(a + a, "both have the same samples of some pixels: seed 0, from 0 and from 0");
    REQUIRE(at.render("--spp 4 --first-sample 3", "b.exr").code == 0);
    refused(a + at("b.exr"), "both have the same samples of some pixels");
    REQUIRE(at.render("--spp 4 --seed 3", "b.exr", "47x40").code == 0);
    refused(a + at("b.exr"), "size is 48 40, here 47 40");
    REQUIRE(at.render("--spp 4 --seed 3 --integrator reference_path", "b.exr").code == 0);
    refused(a + at("b.exr"), "integrator is auto, here reference_path");
    REQUIRE(test::run_iride("render metals --quiet --spp 4 --seed 3 --size 48x40 -o " + at("b.exr")).code == 0);
    refused(a + at("b.exr"), "scene hash is ");
    REQUIRE(at.render("--time 0.1 --adaptive", "b.exr").code == 0);
    refused(a + at("b.exr"), "b.exr: has adaptive samples");
    REQUIRE(at.render("--spp 4 --seed 3 --checkpoint " + at("c"), "b.exr").code == 0);
    refused(a + at("c"), "is a checkpoint and " + at("a.exr") + " is not");
    REQUIRE(test::run_iride("merge " + a + at("b.exr") + " -o " + at("ab.exr")).code == 0);
    refused(at("ab.exr") + " " + at("b.exr"), "ab.exr: is merged already, of 2 parts");
    at.folder.write("text.exr", "no picture");
    refused(a + at("text.exr"), "is not an OpenEXR file");
    refused(a + at("none.exr"), "no such file");
    std::string const whole = test::content(at("a.exr"));
    at.folder.write("cut.exr", whole.substr(0, whole.size() / 2));
    refused(at("cut.exr"), "cut.exr: is truncated, damaged");
    std::string other = whole;
    auto const version = other.find("iride:version");
    REQUIRE(version != std::string::npos);
    other.replace(version + 25, 1, "9");  // after the names and the length, the first digit
    at.folder.write("other.exr", other);
    refused(at("other.exr"), "was written by version 9");
    other = whole;
    other[version] = 'j';
    at.folder.write("foreign.exr", other);
    refused(at("foreign.exr"), "is no picture of this program: it has no attribute 'iride:version'");
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
