// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ: `v x y z`, `vt u v`, `vn x y z` and faces `f v/vt/vn ...` with indices from 1, or from the end if
// negative. Grouping, smoothing and material statements are passed over; curves and surfaces are refused.
// [Wavefront 1995]
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/mesh_formats.h"

namespace iride {

namespace {

// Statements without influence on the triangles.
constexpr std::array passed_over{"o", "g",  "s",   "mg",    "usemtl",   "mtllib",   "usemap",     "maplib",   "p",
                                 "l", "vp", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

// One corner of a face: numbers of its position, texture coordinate and normal, from 0; none = -1.
struct Corner {
    std::int64_t position, uv, normal;
};

class ObjParser {
  public:
    ObjParser(std::string_view text, std::string const& file, VectorDouble const& origin)
        : cursor_(text), file_(file), origin_(origin) {}

    Mesh parse() {
        for (; !cursor_.at_end(); cursor_.skip_line()) statement();
        return joined();
    }

  private:
    // The next word of the statement; a comment ends it, a backslash at the line's end carries it on.
    Token argument() {
        Token token = cursor_.next_on_line();
        while (token.text == "\\") {
            cursor_.skip_line();
            token = cursor_.next_on_line();
        }
        if (token.text.starts_with('#')) token.text = {};
        return token;
    }

    void statement() {
        Token const keyword = argument();
        if (keyword.text.empty()) return;
        if (keyword.text == "v") {
            // A weight or a colour may follow; neither is used.
            position_.push_back((vector("a vertex") - origin_).cast<float>());
        } else if (keyword.text == "vn") {
            normal();
        } else if (keyword.text == "vt") {
            texture_coordinate();
        } else if (keyword.text == "f") {
            face(keyword);
        } else if (std::find(passed_over.begin(), passed_over.end(), keyword.text) == passed_over.end()) {
            fail_at(file_, keyword,
                    fmt::format("unknown statement '{}'; allowed: v, vt, vn, f and {}", keyword.text,
                                fmt::join(passed_over, ", ")));
        }
    }

    double number(Token const& token, char const* what) const {
        if (token.text.empty()) fail_at(file_, token, fmt::format("the line ends inside {}", what));
        auto const value = to_number(token.text);
        if (!value) fail_at(file_, token, fmt::format("'{}' in {}; a number is allowed", token.text, what));
        if (!std::isfinite(static_cast<float>(*value)))
            fail_at(file_, token, fmt::format("{} in {} is not finite", token.text, what));
        return *value;
    }

    VectorDouble vector(char const* what) {
        double const x = number(argument(), what), y = number(argument(), what);
        return {x, y, number(argument(), what)};
    }

    void normal() {
        Token const first = argument();
        double const x = number(first, "a normal"), y = number(argument(), "a normal");
        auto const unit = unit_vector(x, y, number(argument(), "a normal"));
        if (!unit) fail_at(file_, first, "a normal of length 0");
        normal_.push_back(*unit);
    }

    void texture_coordinate() {
        double const u = number(argument(), "a texture coordinate");
        Token const second = argument();  // absent in a one-dimensional texture
        double const v = second.text.empty() ? 0 : number(second, "a texture coordinate");
        uv_.emplace_back(static_cast<float>(u), static_cast<float>(v));
    }

    // One index of a corner, as a number from 0.
    std::int64_t index(Token const& token, std::string_view text, std::size_t count, char const* what) const {
        auto const value = to_integer(text);
        if (!value)
            fail_at(file_, token, fmt::format("'{}' in a face; v, v/vt, v//vn or v/vt/vn is allowed", token.text));
        auto const size = static_cast<std::int64_t>(count);
        if (*value == 0 || *value > size || *value < -size)
            fail_at(
                file_, token,
                fmt::format("{} {} of {} read so far; allowed: 1 .. {} and -{} .. -1", what, *value, size, size, size));
        return *value > 0 ? *value - 1 : size + *value;
    }

    Corner corner(Token const& token) const {
        std::string_view const text = token.text;
        std::size_t const first = std::min(text.find('/'), text.size());
        Corner corner{index(token, text.substr(0, first), position_.size(), "vertex"), -1, -1};
        if (first == text.size()) return corner;
        std::size_t const second = std::min(text.find('/', first + 1), text.size());
        std::string_view const uv = text.substr(first + 1, second - first - 1);
        if (!uv.empty() || second == text.size()) corner.uv = index(token, uv, uv_.size(), "texture coordinate");
        if (second < text.size()) corner.normal = index(token, text.substr(second + 1), normal_.size(), "normal");
        return corner;
    }

    void face(Token const& keyword) {
        std::size_t const begin = corner_.size();
        for (Token token = argument(); !token.text.empty(); token = argument()) corner_.push_back(corner(token));
        if (corner_.size() - begin < 3)
            fail_at(file_, keyword, fmt::format("a face of {} corners; at least 3 are needed", corner_.size() - begin));
        face_begin_.push_back(begin);
    }

    // The normal of a face's plane (Newell's sum, which no single bad corner spoils); z for a face without area.
    Vector plane_normal(std::size_t begin, std::size_t end) const {
        VectorDouble sum = VectorDouble::Zero();
        for (std::size_t i = begin; i < end; ++i) {
            std::size_t const j = i + 1 < end ? i + 1 : begin;
            sum += position(i).cross(position(j));
        }
        return unit_vector(sum.x(), sum.y(), sum.z()).value_or(Vector::UnitZ());
    }
    VectorDouble position(std::size_t corner) const {
        return position_[static_cast<std::size_t>(corner_[corner].position)].cast<double>();
    }

    // Corners that agree in all their numbers become one vertex. In a file that has normals, a face without gets its
    // plane's; in one that has texture coordinates, a corner without gets (0, 0), which no texture of it will look at.
    Mesh joined() const {
        Mesh mesh;
        bool const normals = std::any_of(corner_.begin(), corner_.end(), [](Corner const& c) { return c.normal >= 0; });
        bool const uvs = std::any_of(corner_.begin(), corner_.end(), [](Corner const& c) { return c.uv >= 0; });
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        if (corner_.size() >= none)
            fail_at(file_, {}, fmt::format("{} corners; allowed: fewer than 2^32", corner_.size()));
        std::vector<std::uint32_t> first(position_.size(), none), next;  // vertices that share a position, as a list
        std::vector<Corner> key;
        std::vector<std::uint32_t> polygon;
        for (std::size_t f = 0; f < face_begin_.size(); ++f) {
            std::size_t const end = f + 1 < face_begin_.size() ? face_begin_[f + 1] : corner_.size();
            polygon.clear();
            for (std::size_t i = face_begin_[f]; i < end; ++i) {
                Corner c = corner_[i];
                if (normals && c.normal < 0) c.normal = -2 - static_cast<std::int64_t>(f);  // this face's own
                std::uint32_t v = first[static_cast<std::size_t>(c.position)];
                while (v != none && (key[v].uv != c.uv || key[v].normal != c.normal)) v = next[v];
                if (v == none) {
                    v = static_cast<std::uint32_t>(key.size());
                    key.push_back(c);
                    next.push_back(std::exchange(first[static_cast<std::size_t>(c.position)], v));
                    mesh.position.push_back(position_[static_cast<std::size_t>(c.position)]);
                    if (uvs) mesh.uv.push_back(c.uv < 0 ? Vector2(0, 0) : uv_[static_cast<std::size_t>(c.uv)]);
                    if (normals)
                        mesh.normal.push_back(c.normal < 0 ? plane_normal(face_begin_[f], end)
                                                           : normal_[static_cast<std::size_t>(c.normal)]);
                }
                polygon.push_back(v);
            }
            append_polygon(mesh, polygon);
        }
        return mesh;
    }

    TextCursor cursor_;
    std::string const& file_;
    VectorDouble origin_;
    std::vector<Vector> position_, normal_;
    std::vector<Vector2> uv_;
    std::vector<Corner> corner_;
    std::vector<std::size_t> face_begin_;  // [face] number of its first corner
};

}  // namespace

Mesh parse_obj(std::string_view text, std::string const& file, VectorDouble const& origin) {
    return ObjParser(text, file, origin).parse();
}

}  // namespace iride
