// SPDX-License-Identifier: Apache-2.0
// Reading is wary: sizes are held against the file's own before OpenEXR allocates what a damaged header claims.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <OpenEXR/ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <span>

#include "base/diagnostics.h"
#include "film/exr.h"

namespace iride {

namespace {

constexpr int largest_side = 1 << 16;  // pixels
constexpr int largest_tile = 1 << 13;  // pixels, each way

using Names = std::vector<std::string>;

[[noreturn]] void fail(std::filesystem::path const& path, std::string message) {
    throw InputError({path.string()}, "", std::move(message));
}

std::uint32_t little_endian_word(std::istream& in) {
    std::array<unsigned char, 4> b{};
    in.read(reinterpret_cast<char*>(b.data()), b.size());
    return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

// A header is a row of attributes, each a name and a type, both ended by zero, a size and so many bytes; an empty name
// ends it, and an empty header ends the headers of a file of several parts. Every attribute must fit into the file.
void check_attribute_sizes(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    std::uintmax_t const file_size = std::filesystem::file_size(path);
    little_endian_word(in);  // the magic number, known to be right
    bool const several_parts = little_endian_word(in) & Imf::MULTI_PART_FILE_FLAG;
    for (bool header_is_empty = true;;) {
        std::string name, type;
        std::getline(in, name, '\0');
        if (in && name.empty()) {
            if (header_is_empty || !several_parts) return;
            header_is_empty = true;
            continue;
        }
        header_is_empty = false;
        std::getline(in, type, '\0');
        std::uint32_t const size = little_endian_word(in);
        if (!in || size > file_size - static_cast<std::uintmax_t>(in.tellg()))
            fail(path, "is truncated or damaged: its header does not fit into the file");
        in.seekg(size, std::ios::cur);
    }
}

// Every picture as floats, channel by channel.
class Reader {
  public:
    explicit Reader(std::filesystem::path const& path) : path_(path), file_(path.c_str()) {
        Imath::Box2i const window = file_.header().dataWindow();
        origin_ = window.min;
        width_ = window.max.x - window.min.x + 1;
        height_ = window.max.y - window.min.y + 1;
    }

    Imf::Header const& header() const { return file_.header(); }
    bool has(std::span<std::string const> names) const {
        return std::ranges::all_of(names,
                                   [&](std::string const& n) { return header().channels().findChannel(n) != nullptr; });
    }

    // All at once, row by row: memory grows only as far as the file proves to hold the picture.
    std::vector<Image<float>> channels(Names const& names) {
        std::vector<std::vector<float>> row(names.size(), std::vector<float>(static_cast<std::size_t>(width_)));
        std::vector<Image<float>> images(names.size());
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < names.size(); ++c) {
            char* const base = reinterpret_cast<char*>(row[c].data() - origin_.x);
            constexpr std::size_t every_row_here = 0;
            buffer.insert(names[c], Imf::Slice(Imf::FLOAT, base, sizeof(float), every_row_here));
        }
        file_.setFrameBuffer(buffer);
        for (int y = 0; y < height_; ++y) {
            file_.readPixels(origin_.y + y);
            for (std::size_t c = 0; c < names.size(); ++c)
                images[c].pixel.insert(images[c].pixel.end(), row[c].begin(), row[c].end());
        }
        for (Image<float>& image : images) image.width = width_, image.height = height_;
        return images;
    }

    FilmPlace place() const {
        Imath::Box2i const& whole = header().displayWindow();
        return {origin_.x - whole.min.x, origin_.y - whole.min.y, whole.max.x - whole.min.x + 1,
                whole.max.y - whole.min.y + 1};
    }
    // Attributes "iride:KEY", and all others that are text.
    void read_attributes(XyzPicture& picture) const {
        std::string const ours = "iride:";
        for (auto a = header().begin(); a != header().end(); ++a) {
            std::string const name = a.name();
            auto const* const text = dynamic_cast<Imf::StringAttribute const*>(&a.attribute());
            auto const* const number = dynamic_cast<Imf::IntAttribute const*>(&a.attribute());
            if (!name.starts_with(ours)) {
                if (text) picture.layers.attributes.emplace_back(name, text->value());
            } else if (text || number) {
                picture.facts[name.substr(ours.size())] = text ? text->value() : std::to_string(number->value());
            }
        }
    }

    [[noreturn]] void refuse(std::string message) const { fail(path_, std::move(message)); }

  private:
    std::filesystem::path path_;
    Imf::InputFile file_;
    Imath::V2i origin_;
    int width_ = 0, height_ = 0;
};

Image<Xyz> combined(std::span<Image<float> const, 3> c, MatrixDouble const& to_xyz_matrix) {
    Image<Xyz> image(c[0].width, c[0].height);
    for (std::size_t i = 0; i < image.pixel.size(); ++i)
        image.pixel[i] = to_xyz(to_xyz_matrix * VectorDouble(c[0].pixel[i], c[1].pixel[i], c[2].pixel[i]));
    return image;
}

// The doubles of floats' shortest decimals: .3127 for .3127f.
Chromaticity as_written(Imath::V2f const& p) {
    auto const decimal = [](float value) { return std::stod(fmt::format("{}", value)); };
    return {decimal(p.x), decimal(p.y)};
}

// What the file's RGB are, by its own primaries.
RgbSpace rgb_of(Reader const& in) {
    if (!Imf::hasChromaticities(in.header())) return rgb::rec709;
    Imf::Chromaticities const& c = Imf::chromaticities(in.header());
    return {"of the file", as_written(c.red), as_written(c.green), as_written(c.blue), as_written(c.white), ""};
}

// Adapted back to the scene's white if the file says which that was.
MatrixDouble to_xyz_matrix(Reader const& in, XyzPicture& picture) {
    auto const* const white = in.header().findTypedAttribute<Imf::V2fAttribute>("sceneWhite");
    if (white) picture.white = as_written(white->value());
    MatrixDouble const matrix = xyz_of_output(picture.rgb, white || !picture.rgb ? picture.white : picture.rgb->white);
    if (!matrix.allFinite()) in.refuse("its chromaticities or its sceneWhite span no colour space");
    return matrix;
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

std::vector<std::pair<double, std::string>> band_channels(Imf::ChannelList const& channels) {
    std::vector<std::pair<double, std::string>> bands;
    for (auto c = channels.begin(); c != channels.end(); ++c)
        if (auto const nm = band_centre(c.name())) bands.emplace_back(*nm, c.name());
    std::ranges::sort(bands);
    return bands;
}

Names without(Names const& read, Imf::ChannelList const& channels) {
    Names others;
    for (auto c = channels.begin(); c != channels.end(); ++c)
        if (std::ranges::find(read, c.name()) == read.end()) others.emplace_back(c.name());
    return others;
}

// Planes from `first` on leave for `layers`, under their names.
void move_layers(std::vector<Image<float>>& planes, std::size_t first, Names const& names, ExtraLayers& layers) {
    for (std::size_t i = 0; i < names.size(); ++i)
        layers.channels.emplace_back(names[i], std::move(planes[first + i].pixel));
    planes.resize(first);
}

XyzPicture read(std::filesystem::path const& path, ChannelFilter wants_layer) {
    Reader in(path);
    static Names const count{"count"}, xyz{"X", "Y", "Z"}, rgb{"R", "G", "B"},
        variance{"variance.X", "variance.Y", "variance.Z"};
    bool const is_xyz = in.has(xyz), has_variance = in.has(variance);
    if (!is_xyz && !in.has(rgb)) in.refuse("has neither channels R G B nor X Y Z");
    Names wanted = is_xyz ? xyz : rgb;
    if (has_variance) wanted.insert(wanted.end(), variance.begin(), variance.end());
    auto const bands = band_channels(in.header().channels());
    for (auto const& band : bands) wanted.push_back(band.second);
    if (in.has(count)) wanted.push_back(count.front());

    XyzPicture picture;
    if (!is_xyz) picture.rgb = rgb_of(in);
    MatrixDouble const matrix = to_xyz_matrix(in, picture);
    picture.other_channels = without(wanted, in.header().channels());
    Names layers;
    std::ranges::copy_if(picture.other_channels, std::back_inserter(layers), wants_layer);
    std::size_t const first_layer = wanted.size();
    wanted.insert(wanted.end(), layers.begin(), layers.end());
    if (auto const* e = in.header().findTypedAttribute<Imf::DoubleAttribute>("iride:exposure"))
        picture.exposure = e->value();
    if (!(picture.exposure > 0 && picture.exposure < std::numeric_limits<double>::infinity()))
        in.refuse(fmt::format("its exposure is {}, allowed: above 0", picture.exposure));
    std::vector<Image<float>> planes = in.channels(wanted);
    move_layers(planes, first_layer, layers, picture.layers);
    if (in.has(count)) {
        picture.count = std::move(planes.back());
        planes.pop_back();
    }
    std::span<Image<float> const> const all(planes);
    picture.xyz = combined(all.first<3>(), matrix);
    if (has_variance) picture.variance = combined(all.subspan<3, 3>(), MatrixDouble::Identity());
    picture.place = in.place();
    picture.half = in.header().channels().findChannel(wanted.front())->type == Imf::HALF;
    in.read_attributes(picture);
    std::size_t const first_band = planes.size() - bands.size();
    for (std::size_t b = 0; b < bands.size(); ++b)
        picture.bands.emplace_back(bands[b].first, std::move(planes[first_band + b]));
    return picture;
}

}  // namespace

void check_exr(std::filesystem::path const& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) fail(path, "no such file");
    if (!std::filesystem::is_regular_file(path, error)) fail(path, "is not a regular file");
    bool tiled = false, deep = false, multipart = false;
    if (!Imf::isOpenExrFile(path.c_str(), tiled, deep, multipart)) fail(path, "is not an OpenEXR file");
    if (deep) fail(path, "is a deep OpenEXR file, allowed: flat ones");
    check_attribute_sizes(path);
    Imf::Header::setMaxImageSize(largest_side, largest_side);
    Imf::Header::setMaxTileSize(largest_tile, largest_tile);
}

MatrixDouble xyz_of_output(std::optional<RgbSpace> const& rgb, Chromaticity const& scene_white) {
    if (!rgb) return MatrixDouble::Identity();
    return bradford_adaptation(rgb->white, scene_white) * rgb->to_xyz_matrix();
}

XyzPicture read_exr_as_xyz(std::filesystem::path const& path, ChannelFilter wanted) {
    check_exr(path);
    try {
        return read(path, wanted);
    } catch (InputError const&) {
        throw;
    } catch (std::exception const& e) {
        fail(path, fmt::format("is truncated, damaged or of a kind that is not read: {}", e.what()));
    }
}

}  // namespace iride
