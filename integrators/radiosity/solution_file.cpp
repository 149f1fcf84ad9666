// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/solution_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/atomic_file.h"
#include "colour/observer.h"
#include "colour/rgb_encoding.h"

namespace iride::radiosity {

static_assert(std::endian::native == std::endian::little, "solutions are written as the processor keeps numbers");

namespace {

template <class T>
void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<char const*>(&value), sizeof value);
}

std::array<std::uint8_t, 3> to_srgb_bytes(Xyz const& xyz) {
    static RgbConversion const conversion =
        RgbConversion::from_xyz(rgb_encoding("sRGB").space->white, rgb_encoding("sRGB"));
    VectorDouble const c = conversion({xyz.X, xyz.Y, xyz.Z});
    std::array<std::uint8_t, 3> bytes{};
    for (int k = 0; k < 3; ++k)
        bytes[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(c[k], 0.0, 1.0)));
    return bytes;
}

// XYZ of a row of radiosities: radiance b / pi, integrated by the trapezoidal rule over the integral of ybar.
class ToXyz {
  public:
    explicit ToXyz(std::vector<double> const& nm) {
        Observer const& observer = cie1931_2deg();
        double const step = nm.size() > 1 ? nm[1] - nm[0] : 1;
        for (std::size_t k = 0; k < nm.size(); ++k) {
            double const share = nm.size() > 1 && (k == 0 || k + 1 == nm.size()) ? 0.5 : 1;
            weight_.push_back((share * step / (pi_double * observer.ybar_integral)) * observer.at(nm[k]));
        }
    }
    template <class Row>
    Xyz operator()(Row const& b) const {
        Xyz sum{};
        for (std::size_t k = 0; k < weight_.size(); ++k)
            sum = sum + static_cast<double>(b[static_cast<Eigen::Index>(k)]) * weight_[k];
        return sum;
    }

  private:
    std::vector<Xyz> weight_;
};

std::string header(Scene const& scene, RadiosityField const& field) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment iride radiosity\n";
    text += fmt::format("comment scene {}\ncomment wavelengths_nm", scene.hash);
    for (double nm : field.wavelengths_nm()) text += fmt::format(" {:.17g}", nm);
    text += fmt::format("\nelement vertex {}\n", field.mesh().position.size());
    for (char const* axis : {"x", "y", "z"}) text += fmt::format("property double {}\n", axis);
    for (char const* axis : {"X", "Y", "Z"}) text += fmt::format("property float {}\n", axis);
    for (char const* name : {"red", "green", "blue"}) text += fmt::format("property uchar {}\n", name);
    for (std::size_t k = 0; k < field.wavelengths_nm().size(); ++k)
        text += fmt::format("property float radiosity_{}\n", k);
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", field.mesh().patch.size());
    text += "property int shape\nproperty uchar back\nproperty int opposite\nend_header\n";
    return text;
}

}  // namespace

void save_solution(std::filesystem::path const& path, Scene const& scene, RadiosityField const& field) {
    std::string bytes = header(scene, field);
    ToXyz const to_xyz(field.wavelengths_nm());
    PatchMesh const& mesh = field.mesh();
    for (std::size_t v = 0; v < mesh.position.size(); ++v) {
        auto const b = field.at_vertex().row(static_cast<Eigen::Index>(v));
        for (double x : mesh.position[v] + scene.origin) append(bytes, x);
        Xyz const xyz = to_xyz(b);
        for (double c : {xyz.X, xyz.Y, xyz.Z}) append(bytes, static_cast<float>(c));
        for (std::uint8_t c : to_srgb_bytes(xyz)) append(bytes, c);
        for (float value : b) append(bytes, value);
    }
    for (Patch const& p : mesh.patch) {
        append(bytes, static_cast<std::uint8_t>(p.corners));
        for (int k = 0; k < p.corners; ++k)
            append(bytes, static_cast<std::int32_t>(p.vertex[static_cast<std::size_t>(k)]));
        append(bytes, static_cast<std::int32_t>(p.shape));
        append(bytes, static_cast<std::uint8_t>(p.back));
        append(bytes, static_cast<std::int32_t>(p.opposite));
    }
    write_file(path, bytes);
}

namespace {

[[noreturn]] void refuse(std::filesystem::path const& path, std::string const& what) {
    throw InputError({path.string()}, "--solution", what);
}

// Reads what save_solution() wrote, and only that.
class Reader {
  public:
    Reader(std::filesystem::path path, std::string bytes) : path_(std::move(path)), bytes_(std::move(bytes)) {}

    // The line that starts with `key`, without it; all header lines have their order.
    std::string line(std::string const& key) {
        std::size_t const end = bytes_.find('\n', at_);
        if (end == std::string::npos || bytes_.compare(at_, key.size(), key) != 0)
            refuse(path_, fmt::format("is no saved solution: '{}' was expected; allowed: what --save wrote", key));
        std::string const rest = bytes_.substr(at_ + key.size(), end - at_ - key.size());
        at_ = end + 1;
        return rest;
    }
    void skip_to(std::string const& mark) {
        std::size_t const found = bytes_.find(mark, at_);
        if (found == std::string::npos) refuse(path_, fmt::format("ends before '{}'", mark));
        at_ = found;
    }
    template <class T>
    T take() {
        T value;
        if (bytes_.size() - at_ < sizeof value) refuse(path_, "ends too early: it was not written whole");
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    // Whether `count` things of at least `size` bytes may follow.
    void check_room(double count, double size) const {
        if (!(count >= 0 && count * size <= static_cast<double>(bytes_.size())))
            refuse(path_, "says that it has more in it than it is long");
    }
    bool at_end() const { return at_ == bytes_.size(); }

  private:
    std::filesystem::path path_;
    std::string bytes_;
    std::size_t at_ = 0;
};

void read_faces(Reader& in, std::size_t count, std::filesystem::path const& path, PatchMesh& mesh) {
    auto const vertices = static_cast<std::int32_t>(mesh.position.size());
    for (std::size_t i = 0; i < count; ++i) {
        Patch p{};
        p.corners = in.take<std::uint8_t>();
        if (p.corners != 3 && p.corners != 4) refuse(path, fmt::format("face {} has {} corners", i, p.corners));
        for (int k = 0; k < p.corners; ++k) {
            int const v = in.take<std::int32_t>();
            if (v < 0 || v >= vertices) refuse(path, fmt::format("face {} has no vertex {}", i, v));
            p.vertex[static_cast<std::size_t>(k)] = v;
        }
        p.shape = in.take<std::int32_t>();
        p.back = in.take<std::uint8_t>() != 0;
        p.opposite = in.take<std::int32_t>();
        if (p.opposite < -1 || p.opposite >= static_cast<int>(count))
            refuse(path, fmt::format("face {} has no other side {}", i, p.opposite));
        measure(mesh, p);
        mesh.patch.push_back(p);
    }
}

}  // namespace

std::shared_ptr<RadiosityField const> load_solution(std::filesystem::path const& path, Scene const& scene) {
    std::ifstream file(path, std::ios::binary);
    if (!file) refuse(path, "cannot be read");
    std::ostringstream all;
    all << file.rdbuf();
    Reader in(path, all.str());
    in.line("ply");
    in.line("format binary_little_endian 1.0");
    in.line("comment iride radiosity");
    if (std::string const hash = in.line("comment scene "); hash != scene.hash)
        refuse(path, fmt::format("is the solution of another scene: found hash {}, allowed: {} of '{}'", hash,
                                 scene.hash, scene.name));
    std::istringstream numbers(in.line("comment wavelengths_nm"));
    std::vector<double> nm;
    for (double x = 0; numbers >> x;) nm.push_back(x);
    if (nm.empty()) refuse(path, "names no wavelengths");
    auto const vertices = std::strtoull(in.line("element vertex ").c_str(), nullptr, 10);
    in.skip_to("element face ");
    auto const faces = std::strtoull(in.line("element face ").c_str(), nullptr, 10);
    in.skip_to("end_header");
    in.line("end_header");
    auto const bands = static_cast<double>(nm.size());
    in.check_room(static_cast<double>(vertices), 39 + 4 * bands);
    in.check_room(static_cast<double>(faces), 22);
    PatchMesh mesh;
    for (Shape const& s : scene.shapes) mesh.shape.push_back(&s);
    RadiosityField::AtVertex at_vertex(static_cast<Eigen::Index>(vertices), static_cast<Eigen::Index>(nm.size()));
    for (Eigen::Index v = 0; v < at_vertex.rows(); ++v) {
        mesh.position.emplace_back();
        for (double& x : mesh.position.back()) x = in.take<double>();
        mesh.position.back() -= scene.origin;
        for (int k = 0; k < 3; ++k) in.take<float>();
        for (int k = 0; k < 3; ++k) in.take<std::uint8_t>();
        for (Eigen::Index k = 0; k < at_vertex.cols(); ++k) at_vertex(v, k) = in.take<float>();
        if (!mesh.position.back().allFinite() || !at_vertex.row(v).isFinite().all())
            refuse(path, fmt::format("vertex {} is not finite", v));
    }
    read_faces(in, faces, path, mesh);
    if (mesh.patch.empty() || !in.at_end()) refuse(path, "is damaged: its end is not where its header says");
    return std::make_shared<RadiosityField>(std::move(mesh), std::move(nm), std::move(at_vertex));
}

}  // namespace iride::radiosity
