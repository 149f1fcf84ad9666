// SPDX-License-Identifier: Apache-2.0
#include "film/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>
#include <half.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/atomic_file.h"
#include "base/diagnostics.h"

namespace iride {

namespace {

[[noreturn]] void fail(std::filesystem::path const& path, std::string const& message) {
    throw InputError({path.string()}, "", "cannot be written: " + message);
}

// A plane of floats waiting to be written under a channel name.
struct Plane {
    std::string name;
    Imf::PixelType type;
    std::vector<float> value;
    std::vector<half> value_half;
};

// "S0.550,000000nm": emissive Stokes component 0 at the band's centre. [Fichet 2021]
std::string band_channel(double centre_nm) {
    std::string name = fmt::format("S0.{:.6f}nm", centre_nm);
    std::ranges::replace(name, '.', ',');
    name[2] = '.';
    return name;
}

Imf::Chromaticities typed(RgbSpace const& s) {
    auto const v = [](Chromaticity const& c) { return Imath::V2f(static_cast<float>(c.x), static_cast<float>(c.y)); };
    return {v(s.red), v(s.green), v(s.blue), v(s.white)};
}

// Samples taken per pixel, the rejected ones included.
int samples_per_pixel(Film const& film) {
    std::uint64_t total = 0;
    for (std::uint64_t r : film.rejected()) total += r;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) total += film.sample_count(x, y);
    return static_cast<int>(std::llround(static_cast<double>(total) / film.width() / film.height()));
}

// Finite values stay finite.
half to_half(float value) {
    return half(std::isfinite(value) ? std::clamp(value, -float{HALF_MAX}, float{HALF_MAX}) : value);
}

template <class Value>
std::vector<float> plane_of(Film const& film, Value&& value) {
    std::vector<float> plane;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) plane.push_back(static_cast<float>(value(x, y)));
    return plane;
}

std::vector<Plane> planes_of(Film const& film, ExrSettings const& s, OutputSpace const& space) {
    std::vector<Plane> planes;
    Imf::PixelType const type = s.half ? Imf::HALF : Imf::FLOAT;
    Image<std::array<float, 3>> const image = to_image(film, space, s.exposure);
    for (std::size_t c = 0; c < 3; ++c)
        planes.push_back({std::string(1, (space.rgb ? "RGB" : "XYZ")[c]),
                          type,
                          plane_of(film, [&](int x, int y) { return image.at(x, y)[c]; }),
                          {}});
    double Xyz::*const component[] = {&Xyz::X, &Xyz::Y, &Xyz::Z};
    for (std::size_t c = 0; c < 3; ++c)
        planes.push_back({fmt::format("variance.{}", "XYZ"[c]),
                          Imf::FLOAT,
                          plane_of(film, [&](int x, int y) { return film.variance(x, y).*component[c]; }),
                          {}});
    if (film.bands())
        for (int b = 0; b < film.bands()->count; ++b)
            planes.push_back({band_channel(film.bands()->centre_nm(b)),
                              type,
                              plane_of(film, [&](int x, int y) { return film.band(x, y, b); }),
                              {}});
    return planes;
}

// Samples in each pixel's mean, where pixels differ in it or parts were merged.
std::optional<Plane> plane_of_counts(Film const& film, bool merged) {
    auto const [least, most] = std::ranges::minmax_element(film.pixels(), {}, &FilmPixel::count);
    if (!merged && least->count == most->count) return std::nullopt;
    return Plane{"count", Imf::FLOAT, plane_of(film, [&](int x, int y) { return film.sample_count(x, y); }), {}};
}

// What a sample counts, in the mean.
double mean_weight(Film const& film) {
    double weight = 0, count = 0;
    for (FilmPixel const& p : film.pixels()) weight += p.weight, count += p.count;
    return count > 0 ? weight / count : 1;
}

Imf::Header header_of(Film const& film, ExrSettings const& s, OutputSpace const& space) {
    FilmPlace const& place = film.place();
    Imath::Box2i const display({0, 0}, {place.picture_width - 1, place.picture_height - 1});
    Imath::V2i const corner(place.x0, place.y0);
    Imf::Header header(display, {corner, corner + Imath::V2i(film.width() - 1, film.height() - 1)});
    header.compression() = Imf::ZIP_COMPRESSION;
    if (space.rgb) Imf::addChromaticities(header, typed(*space.rgb));
    Imf::addWhiteLuminance(header, static_cast<float>(luminance_of_unit_Y(film.observer()) / s.exposure));
    auto const text = [&](char const* name, std::string const& value) {
        header.insert(name, Imf::StringAttribute(value));
    };
    bool const d65 = s.scene_white == named_white("D65");
    if (space.rgb)
        text("colorInteropID", std::string(space.rgb->interop_id));
    else if (d65)
        text("colorInteropID", "lin_ciexyzd65_scene");
    header.insert("sceneWhite", Imf::V2fAttribute(Imath::V2f(static_cast<float>(s.scene_white.x),
                                                             static_cast<float>(s.scene_white.y))));
    if (film.bands()) {
        text("spectralLayoutVersion", "1.0");
        text("emissiveUnits", "W.m^-2.sr^-1");
    }
    text("iride:version", IRIDE_VERSION);
    text("iride:scene", s.scene);
    text("iride:sceneHash", s.scene_hash);
    text("iride:integrator", s.integrator);
    text("iride:sampler", s.sampler);
    header.insert("iride:firstSample", Imf::IntAttribute(static_cast<int>(s.first_sample)));
    text("iride:seed", std::to_string(s.seed));  // 64 bits: no integer attribute holds them
    text("iride:observer", film.observer().name);
    if (film.bands())
        text("iride:bands",
             fmt::format("{} {} {}", film.bands()->count, film.bands()->range.min_nm, film.bands()->range.max_nm));
    if (s.adaptive) header.insert("iride:adaptive", Imf::IntAttribute(1));
    if (s.parts > 1) header.insert("iride:parts", Imf::IntAttribute(s.parts));
    header.insert("iride:exposure", Imf::DoubleAttribute(s.exposure));
    header.insert("iride:spp", Imf::IntAttribute(samples_per_pixel(film)));
    text("iride:weight", fmt::format("{}", mean_weight(film)));
    auto const rejected = film.rejected();
    for (std::size_t i = 0; i < rejected.size(); ++i)
        text(fmt::format("iride:rejected.{}", rejection_names[i]).c_str(), std::to_string(rejected[i]));
    return header;
}

}  // namespace

Image<std::array<float, 3>> to_image(Film const& film, OutputSpace const& space, double exposure) {
    Image<std::array<float, 3>> image(film.width(), film.height());
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            Eigen::Vector3f const c = (exposure * (space.from_xyz * to_vector(film.mean(x, y)))).cast<float>();
            image.at(x, y) = {c[0], c[1], c[2]};
        }
    return image;
}

void write_exr(Film const& film, ExrSettings const& settings, std::filesystem::path const& path,
               ExtraLayers const& extra) {
    OutputSpace const space = output_space(settings.colourspace, settings.scene_white);
    AtomicFile file(path);
    Imf::Header header = header_of(film, settings, space);
    std::vector<Plane> planes = planes_of(film, settings, space);
    for (auto const& [name, value] : extra.channels) planes.push_back({name, Imf::FLOAT, value, {}});
    auto counts = plane_of_counts(film, settings.parts > 1);
    if (counts && std::ranges::find(planes, counts->name, &Plane::name) == planes.end())
        planes.push_back(std::move(*counts));
    for (auto const& [name, value] : extra.attributes) header.insert(name, Imf::StringAttribute(value));
    Imf::FrameBuffer buffer;
    auto const width = static_cast<std::size_t>(film.width());
    for (Plane& p : planes) {
        header.channels().insert(p.name, Imf::Channel(p.type));
        bool const is_half = p.type == Imf::HALF;
        if (is_half) std::ranges::transform(p.value, std::back_inserter(p.value_half), to_half);
        void const* const pixels = is_half ? static_cast<void const*>(p.value_half.data()) : p.value.data();
        std::size_t const size = is_half ? sizeof(half) : sizeof(float);
        buffer.insert(p.name, Imf::Slice::Make(p.type, pixels, header.dataWindow(), size, size * width));
    }
    std::ofstream stream(file.temporary(), std::ios::binary);
    try {
        Imf::StdOFStream target(stream, file.temporary().c_str());
        Imf::OutputFile out(target, header);
        out.setFrameBuffer(buffer);
        out.writePixels(film.height());
    } catch (std::exception const& e) {
        fail(path, e.what());
    }
    // The library's destructor, which writes the last bytes, keeps silent about errors; the stream does not.
    stream.close();
    if (!stream) fail(path, "the disk took only a part of it");
    file.commit();
}

}  // namespace iride
