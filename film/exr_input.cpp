// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "base/diagnostics.h"
#include "film/exr.h"

namespace iride {

namespace {

constexpr int largest_side = 1 << 16;  // pixels

// Every picture as floats, channel by channel.
class Reader {
  public:
    explicit Reader(std::filesystem::path const& path) : path_(path), file_(path.c_str()) {
        Imath::Box2i const window = file_.header().dataWindow();
        origin_ = window.min;
        width_ = window.max.x - window.min.x + 1;
        height_ = window.max.y - window.min.y + 1;
        if (width_ < 1 || height_ < 1 || width_ > largest_side || height_ > largest_side)
            fail(fmt::format("has {} x {} pixels, allowed: 1 .. {} each", width_, height_, largest_side));
    }

    Imf::Header const& header() const { return file_.header(); }
    bool has(std::string const& name) const { return header().channels().findChannel(name) != nullptr; }

    Image<float> channel(std::string const& name) {
        Image<float> image(width_, height_);
        Imf::FrameBuffer buffer;
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, image.pixel.data(), header().dataWindow(), sizeof(float),
                                             sizeof(float) * static_cast<std::size_t>(width_)));
        file_.setFrameBuffer(buffer);
        file_.readPixels(origin_.y, origin_.y + height_ - 1);
        return image;
    }

    std::array<Image<float>, 3> triple(std::string const& a, std::string const& b, std::string const& c) {
        return {channel(a), channel(b), channel(c)};
    }

    [[noreturn]] void fail(std::string const& message) const {
        throw InputError(Diagnostic{{path_.string()}, "", message});
    }

  private:
    std::filesystem::path path_;
    Imf::InputFile file_;
    Imath::V2i origin_;
    int width_ = 0, height_ = 0;
};

Image<Xyz> combined(std::array<Image<float>, 3> const& c, MatrixDouble const& to_xyz_matrix) {
    Image<Xyz> image(c[0].width, c[0].height);
    for (std::size_t i = 0; i < image.pixel.size(); ++i)
        image.pixel[i] = to_xyz(to_xyz_matrix * VectorDouble(c[0].pixel[i], c[1].pixel[i], c[2].pixel[i]));
    return image;
}

// XYZ of the file's RGB, by its own primaries; adapted back to the scene's white if it says which that was.
MatrixDouble rgb_to_xyz(Imf::Header const& header) {
    RgbSpace space = rgb::rec709;
    if (Imf::hasChromaticities(header)) {
        Imf::Chromaticities const& c = Imf::chromaticities(header);
        auto const v = [](Imath::V2f const& p) { return Chromaticity{p.x, p.y}; };
        space = {"of the file", v(c.red), v(c.green), v(c.blue), v(c.white), ""};
    }
    MatrixDouble const plain = space.to_xyz_matrix();
    auto const* const white = header.findTypedAttribute<Imf::V2fAttribute>("sceneWhite");
    if (!white) return plain;
    return bradford_adaptation(space.white, {white->value().x, white->value().y}) * plain;
}

// The wavelength of "S0.550,000000nm", or nothing.
std::optional<double> band_centre(std::string name) {
    if (!name.starts_with("S0.") || !name.ends_with("nm")) return std::nullopt;
    name = name.substr(3, name.size() - 5);
    if (auto const comma = name.find(','); comma != std::string::npos) name[comma] = '.';
    double nm;
    auto const [end, error] = std::from_chars(name.data(), name.data() + name.size(), nm);
    return error == std::errc() && end == name.data() + name.size() ? std::optional(nm) : std::nullopt;
}

XyzPicture read(std::filesystem::path const& path) {
    Reader in(path);
    XyzPicture picture;
    if (in.has("X") && in.has("Y") && in.has("Z"))
        picture.xyz = combined(in.triple("X", "Y", "Z"), MatrixDouble::Identity());
    else if (in.has("R") && in.has("G") && in.has("B"))
        picture.xyz = combined(in.triple("R", "G", "B"), rgb_to_xyz(in.header()));
    else
        in.fail("has neither channels R G B nor X Y Z");
    if (in.has("variance.X") && in.has("variance.Y") && in.has("variance.Z"))
        picture.variance = combined(in.triple("variance.X", "variance.Y", "variance.Z"), MatrixDouble::Identity());
    if (auto const* e = in.header().findTypedAttribute<Imf::DoubleAttribute>("iride:exposure"))
        picture.exposure = e->value();
    std::vector<std::pair<double, std::string>> bands;
    for (auto c = in.header().channels().begin(); c != in.header().channels().end(); ++c)
        if (auto const nm = band_centre(c.name())) bands.emplace_back(*nm, c.name());
    std::ranges::sort(bands);
    for (auto const& [nm, name] : bands) picture.bands.emplace_back(nm, in.channel(name));
    return picture;
}

}  // namespace

XyzPicture read_exr_as_xyz(std::filesystem::path const& path) {
    auto const fail = [&](std::string const& message) { throw InputError(Diagnostic{{path.string()}, "", message}); };
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) fail("no such file");
    bool tiled = false, deep = false, multipart = false;
    if (!Imf::isOpenExrFile(path.c_str(), tiled, deep, multipart)) fail("is not an OpenEXR file");
    if (deep) fail("is a deep OpenEXR file; a flat one is wanted");
    try {
        return read(path);
    } catch (InputError const&) {
        throw;
    } catch (std::exception const& e) {
        fail(fmt::format("truncated or damaged: {}", e.what()));
    }
    return {};
}

}  // namespace iride
