// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/tessellation.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace iride::radiosity {

namespace {

constexpr int fewest_around = 12;

int pieces(double length, double size) { return std::max(1, static_cast<int>(std::ceil(length / size - 1e-9))); }
int around(double radius, double size) { return std::max(fewest_around, pieces(2 * pi_double * radius, size)); }

// Faces between rows of equally many points. Where a row is a single point (a pole, a centre, a tip) faces are
// triangles; `closed`: the last point of a row is followed by the first.
class Grid {
  public:
    void add_row(std::vector<VectorDouble> const& points) {
        std::vector<int> row;
        for (VectorDouble const& p : points) {
            row.push_back(static_cast<int>(faces_.position.size()));
            faces_.position.push_back(p);
        }
        rows_.push_back(std::move(row));
    }
    // Front: where rows run to the right and follow each other upwards.
    Faces finish(bool closed) {
        for (std::size_t r = 0; r + 1 < rows_.size(); ++r) {
            auto const &low = rows_[r], &high = rows_[r + 1];
            std::size_t const longest = std::max(low.size(), high.size()), count = closed ? longest : longest - 1;
            for (std::size_t k = 0; k < count; ++k) {
                int const a = point(low, k), b = point(low, k + 1), c = point(high, k + 1), d = point(high, k);
                if (a == b)
                    faces_.face.push_back({{a, c, d, d}, 3});
                else if (c == d)
                    faces_.face.push_back({{a, b, c, c}, 3});
                else
                    faces_.face.push_back({{a, b, c, d}, 4});
            }
        }
        return std::move(faces_);
    }

  private:
    static int point(std::vector<int> const& row, std::size_t k) { return row[k % row.size()]; }

    Faces faces_;
    std::vector<std::vector<int>> rows_;
};

Faces of(Quad const& quad, double size) {
    std::array<VectorDouble, 4> c;
    for (std::size_t k = 0; k < 4; ++k) c[k] = quad.corner[k].cast<double>();
    int const columns = pieces(std::max((c[1] - c[0]).norm(), (c[2] - c[3]).norm()), size),
              rows = pieces(std::max((c[3] - c[0]).norm(), (c[2] - c[1]).norm()), size);
    Grid grid;
    for (int j = 0; j <= rows; ++j) {
        double const v = static_cast<double>(j) / rows;
        std::vector<VectorDouble> row;
        for (int i = 0; i <= columns; ++i) {
            double const u = static_cast<double>(i) / columns;
            row.push_back((1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]));
        }
        grid.add_row(row);
    }
    return grid.finish(false);
}

struct Axes {
    VectorDouble x, y, z;
    explicit Axes(VectorDouble const& axis) : z(axis.normalized()) {
        x = z.unitOrthogonal();
        y = z.cross(x);
    }
    std::vector<VectorDouble> circle(VectorDouble const& centre, double radius, int count) const {
        if (radius == 0) return {centre};
        std::vector<VectorDouble> points;
        for (int k = 0; k < count; ++k) {
            double const t = 2 * pi_double * k / count;
            points.push_back(centre + radius * (std::cos(t) * x + std::sin(t) * y));
        }
        return points;
    }
};

Faces of(Sphere const& sphere, double size) {
    Axes const axes({0, 1, 0});
    double const r = static_cast<double>(sphere.radius);
    int const columns = around(r, size), rows = std::max(fewest_around / 2, pieces(pi_double * r, size));
    Grid grid;
    for (int j = 0; j <= rows; ++j) {
        double const t = pi_double * j / rows;
        bool const pole = j == 0 || j == rows;
        grid.add_row(
            axes.circle(sphere.centre.cast<double>() - r * std::cos(t) * axes.z, pole ? 0 : r * std::sin(t), columns));
    }
    return grid.finish(true);
}

Faces of(Disc const& disc, double size) {
    Axes const axes(disc.normal.cast<double>());
    double const r = static_cast<double>(disc.radius);
    int const columns = around(r, size), rows = pieces(r, size);
    Grid grid;
    for (int j = 0; j <= rows; ++j)
        grid.add_row(axes.circle(disc.centre.cast<double>(), r * (rows - j) / rows, columns));
    return grid.finish(true);
}

Faces of(Frustum const& f, double size) {
    VectorDouble const from = f.from.cast<double>(), to = f.to.cast<double>();
    Axes const axes(to - from);
    double const low = static_cast<double>(f.radius), high = static_cast<double>(f.top_radius);
    int const columns = around(std::max(low, high), size),
              rows = pieces(std::hypot((to - from).norm(), high - low), size);
    Grid grid;
    for (int j = 0; j <= rows; ++j) {
        double const t = static_cast<double>(j) / rows;
        grid.add_row(axes.circle(from + t * (to - from), low + t * (high - low), columns));
    }
    return grid.finish(true);
}

// One round: every edge longer than `size` gets its middle. Returns whether there was one.
bool cut_long_edges(Faces& faces, double size) {
    std::map<std::pair<int, int>, int> middle;
    auto const cut = [&](int a, int b) {
        auto const key = std::minmax(a, b);
        if (auto const known = middle.find(key); known != middle.end()) return known->second;
        VectorDouble const p = faces.position[static_cast<std::size_t>(a)],
                           q = faces.position[static_cast<std::size_t>(b)];
        if ((p - q).norm() <= size) return -1;
        faces.position.push_back((p + q) / 2);
        return middle[key] = static_cast<int>(faces.position.size()) - 1;
    };
    std::vector<Faces::Face> next;
    for (Faces::Face const& f : faces.face) {
        std::array<int, 3> v{f.vertex[0], f.vertex[1], f.vertex[2]}, m;
        for (std::size_t k = 0; k < 3; ++k) m[k] = cut(v[k], v[(k + 1) % 3]);
        auto const add = [&](int a, int b, int c) { next.push_back({{a, b, c, c}, 3}); };
        // Turn, so that the long edges come first.
        auto const count = std::ranges::count_if(m, [](int i) { return i >= 0; });
        while ((count == 1 && m[0] < 0) || (count == 2 && m[2] >= 0)) {
            std::ranges::rotate(v, v.begin() + 1);
            std::ranges::rotate(m, m.begin() + 1);
        }
        if (count == 0) {
            next.push_back(f);
        } else if (count == 1) {
            add(v[0], m[0], v[2]), add(m[0], v[1], v[2]);
        } else if (count == 2) {
            add(m[0], v[1], m[1]), add(v[0], m[0], m[1]), add(v[0], m[1], v[2]);
        } else {
            add(v[0], m[0], m[2]), add(v[1], m[1], m[0]), add(v[2], m[2], m[1]), add(m[0], m[1], m[2]);
        }
    }
    faces.face = std::move(next);
    return !middle.empty();
}

Faces of(MeshShape const& shape, double size) {
    Faces faces;
    for (Vector const& p : shape.mesh->position) faces.position.push_back(p.cast<double>());
    for (auto const& t : shape.mesh->triangle)
        faces.face.push_back(
            {{static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2]), static_cast<int>(t[2])}, 3});
    while (cut_long_edges(faces, size)) {
    }
    return faces;
}

double area_of(MeshShape const& shape) {
    double sum = 0;
    auto const& p = shape.mesh->position;
    for (auto const& t : shape.mesh->triangle)
        sum += static_cast<double>((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm()) / 2;
    return sum;
}

}  // namespace

Faces tessellate(ShapeGeometry const& geometry, double size_m) {
    return std::visit([&](auto const& shape) { return of(shape, size_m); }, geometry);
}

double expected_faces(ShapeGeometry const& geometry, double size_m) {
    auto const grid = [&](double a, double b) { return std::ceil(a / size_m) * std::ceil(b / size_m); };
    auto const round = [&](double r) { return std::max<double>(fewest_around, std::ceil(2 * pi_double * r / size_m)); };
    if (auto const* q = std::get_if<Quad>(&geometry))
        return grid(static_cast<double>((q->corner[1] - q->corner[0]).norm()),
                    static_cast<double>((q->corner[3] - q->corner[0]).norm()));
    if (auto const* s = std::get_if<Sphere>(&geometry)) {
        double const n = round(static_cast<double>(s->radius));
        return n * n / 2;
    }
    if (auto const* d = std::get_if<Disc>(&geometry)) {
        double const r = static_cast<double>(d->radius);
        return round(r) * std::ceil(r / size_m);
    }
    if (auto const* f = std::get_if<Frustum>(&geometry))
        return round(static_cast<double>(std::max(f->radius, f->top_radius))) *
               std::ceil(static_cast<double>(f->length()) / size_m);
    auto const& mesh = std::get<MeshShape>(geometry);
    // A round of cuts leaves triangles of some .3 size^2 on average.
    return std::max(static_cast<double>(mesh.mesh->triangle.size()), area_of(mesh) / (0.2 * size_m * size_m));
}

}  // namespace iride::radiosity
