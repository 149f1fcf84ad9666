// SPDX-License-Identifier: Apache-2.0
// Affine transforms of a scene file, and what they do to shapes.
#include <fmt/format.h>

#include "scene/readers.h"

namespace iride {

namespace {

// A determinant below this share of the product of the column lengths means that a direction has collapsed.
constexpr double singular = 1e-9;

bool is_singular(Transform const& t) {
    MatrixDouble const m = t.linear();
    double const scale = m.col(0).norm() * m.col(1).norm() * m.col(2).norm();
    return !m.allFinite() || !(std::abs(m.determinant()) > singular * scale);
}

Transform read_step(SceneBuilder& b, JsonValue const& value, std::string const& path) {
    Fields step(b.context, value, path);
    Transform t = Transform::Identity();
    if (step.find("translate")) {
        if (auto const v = step.vector("translate")) t = Eigen::Translation3d(*v * b.length_unit_m);
    } else if (step.find("rotate")) {
        auto const axis = step.vector("rotate");
        double const angle = step.required_number("angle_deg");
        if (axis && axis->norm() == 0)
            step.error_at("rotate", "the axis has length 0");
        else if (axis)
            t = Eigen::AngleAxisd(radians(angle), axis->normalized());
    } else if (JsonValue const* const scale = step.find("scale")) {
        if (scale->as<double>())
            t = Eigen::Scaling(step.required_number("scale"));
        else if (auto const v = step.vector("scale"))
            t = Eigen::Scaling(*v);
    } else if (step.find("matrix")) {
        if (auto const n = step.numbers("matrix", 16)) {
            Eigen::Matrix4d const m = Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor> const>(n->data());
            if (m.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) step.error_at("matrix", "the last row must be 0 0 0 1");
            t.matrix() = m;
            t.translation() *= b.length_unit_m;
        }
    } else {
        step.error("a step is one of: translate, rotate, scale, matrix");
    }
    step.finish();
    return t;
}

struct Apply {
    Transform const& t;
    bool similarity;
    double scale;

    Vector point(Vector const& p) const { return (t * p.cast<double>()).cast<float>(); }
    Direction normal(Direction const& n) const {
        VectorDouble const v = t.linear().inverse().transpose() * n.cast<double>();
        return v.normalized().cast<float>();
    }
    float length(float x) const { return static_cast<float>(x * scale); }

    bool operator()(Sphere& s) const {
        s = {point(s.centre), length(s.radius)};
        return similarity;
    }
    bool operator()(Disc& d) const {
        d = {point(d.centre), normal(d.normal), length(d.radius)};
        return similarity;
    }
    bool operator()(Frustum& f) const {
        f = {point(f.from), point(f.to), length(f.radius), length(f.top_radius)};
        return similarity;
    }
    bool operator()(Quad& q) const {
        for (Vector& c : q.corner) c = point(c);
        if (t.linear().determinant() < 0) std::swap(q.corner[1], q.corner[3]);  // keep the front in front
        q = Quad::through(q.corner);
        return true;
    }
    bool operator()(MeshShape& m) const {
        auto mesh = std::make_shared<Mesh>(*m.mesh);
        for (Vector& p : mesh->position) p = point(p);
        for (Vector& n : mesh->normal) n = normal(n);
        if (t.linear().determinant() < 0)
            for (auto& triangle : mesh->triangle) std::swap(triangle[1], triangle[2]);
        m.mesh = std::move(mesh);
        return true;
    }
};

}  // namespace

Transform read_transform(SceneBuilder& b, Fields& fields, std::string const& key) {
    Transform t = Transform::Identity();
    JsonValue const* const value = fields.find(key);
    if (!value) return t;
    JsonArray const* const steps = value->as<JsonArray>();
    if (!steps) {
        fields.error_at(key, "found " + value->described() + ", but an array of steps is wanted");
        return t;
    }
    for (std::size_t i = 0; i < steps->size(); ++i)
        t = read_step(b, (*steps)[i], fmt::format("{}[{}]", fields.path(key), i)) * t;
    if (is_singular(t)) {
        fields.error_at(key, "the transform is singular: it squeezes space flat and cannot be inverted");
        return Transform::Identity();
    }
    return t;
}

void apply_transform(SceneBuilder&, Fields& fields, Transform const& t, ShapeGeometry& geometry) {
    double const scale = std::cbrt(std::abs(t.linear().determinant()));
    MatrixDouble const gram = t.linear().transpose() * t.linear() / square(scale);
    bool const similarity = (gram - MatrixDouble::Identity()).norm() < 1e-6;
    if (!std::visit(Apply{t, similarity, scale}, geometry))
        fields.error_at("transform",
                        "this shape takes moves, turns and even scaling only; put it into an object and "
                        "transform its instance");
}

}  // namespace iride
