// SPDX-License-Identifier: Apache-2.0
#include "film/depth_cue.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "film/exr.h"

namespace iride {

double DepthCue::share(double depth) const {
    double const place = depth < back ? std::max(0.0, (depth - front) / (back - front)) : 1;
    return scale_front + (scale_back - scale_front) * (place <= 1 ? place : 1);
}

namespace {

using Names = std::vector<std::string>;

[[noreturn]] void fail(std::filesystem::path const& path, std::string message) {
    throw InputError({path.string()}, "", std::move(message));
}

// Planes of 32 bits a pixel, of floats or whole numbers.
class Planes {
  public:
    explicit Planes(std::filesystem::path const& path) : file_(path.c_str()), header_(file_.header()) {
        Imath::Box2i const w = header_.dataWindow();
        width_ = w.max.x - w.min.x + 1;
        count_ = static_cast<std::size_t>(width_) * static_cast<std::size_t>(w.max.y - w.min.y + 1);
        Imf::ChannelList kept;
        for (auto c = file_.header().channels().begin(); c != file_.header().channels().end(); ++c) {
            std::string const name = c.name();
            if (name.starts_with("variance.") || name.starts_with("S0.")) continue;
            if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
                fail(path, "its channel " + name + " is subsampled, allowed: one value for each pixel");
            auto const type = c.channel().type == Imf::UINT ? Imf::UINT : Imf::FLOAT;
            kept.insert(name, Imf::Channel(type));
            plane_[name].resize(count_);
        }
        header_.channels() = kept;
        for (char const* bands : {"spectralLayoutVersion", "emissiveUnits"}) header_.erase(bands);
        file_.setFrameBuffer(buffer());
        file_.readPixels(w.min.y, w.max.y);
    }

    bool has(Names const& names) const {
        return std::ranges::all_of(names, [&](std::string const& n) { return plane_.contains(n); });
    }
    std::vector<float>& plane(std::string const& name) { return plane_.at(name); }

    void write(std::filesystem::path const& path) {
        AtomicFile target(path);
        {
            Imf::OutputFile out(target.temporary().c_str(), header_);
            out.setFrameBuffer(buffer());
            out.writePixels(static_cast<int>(count_ / static_cast<std::size_t>(width_)));
        }
        target.commit();
    }

  private:
    Imf::FrameBuffer buffer() {
        Imf::FrameBuffer all;
        for (auto c = header_.channels().begin(); c != header_.channels().end(); ++c)
            all.insert(c.name(), Imf::Slice::Make(c.channel().type, plane_.at(c.name()).data(), header_.dataWindow()));
        return all;
    }

    Imf::InputFile file_;
    Imf::Header header_;
    std::map<std::string, std::vector<float>> plane_;
    int width_ = 0;
    std::size_t count_ = 0;
};

}  // namespace

void apply_depth_cue(DepthCue const& cue, std::filesystem::path const& in, std::filesystem::path const& out) {
    check_exr(in);
    try {
        Planes picture(in);
        Names const depths{"depth.Z", "depth", "Z"};
        auto const depth = std::ranges::find_if(depths, [&](std::string const& n) { return picture.has({n}); });
        Names const colours[] = {{"R", "G", "B"}, {"X", "Y", "Z"}};
        auto const colour = std::ranges::find_if(colours, [&](Names const& n) { return picture.has(n); });
        if (colour == std::end(colours)) fail(in, "has neither channels R G B nor X Y Z");
        // Of a picture in X Y Z the Z is no depth.
        if (depth == depths.end() || (*depth == "Z" && colour == colours + 1))
            fail(in, "has no depth: none of the channels depth.Z, depth, Z; render it with '--aov depth'");
        std::vector<float> const z = picture.plane(*depth);
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<float>& plane = picture.plane((*colour)[c]);
            for (std::size_t i = 0; i < plane.size(); ++i) {
                double const s = cue.share(static_cast<double>(z[i]));
                plane[i] = static_cast<float>(s * static_cast<double>(plane[i]) + (1 - s) * cue.colour[c]);
            }
        }
        picture.write(out);
    } catch (InputError const&) {
        throw;
    } catch (std::exception const& e) {
        fail(in, fmt::format("is truncated, damaged or of a kind that is not read: {}", e.what()));
    }
}

}  // namespace iride
