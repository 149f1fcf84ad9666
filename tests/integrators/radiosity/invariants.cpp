// SPDX-License-Identifier: Apache-2.0
// Laws that hold for every radiosity system, by their numbers in the list of the design; 1, 2, 4 .. 6 stand beside the
// form factors too, 10 .. 13, 16 and 18 beside the solvers, 22 with the mirrors.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <Eigen/LU>

#include "base/constants.h"
#include "integrators/radiosity/closed_forms.h"
#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/form_factor_methods.h"
#include "integrators/radiosity/solvers.h"
#include "integrators/radiosity/substructure.h"
#include "integrators/radiosity/vertex_transfer.h"
#include "support/scenes.h"

using namespace iride;
using namespace iride::radiosity;

namespace {

SolverEntry const& solver(std::string const& name) {
    for (SolverEntry const& e : solvers())
        if (name == e.name) return e;
    throw std::logic_error(name);
}

System system_of(Eigen::MatrixXd const& F, Eigen::ArrayXd const& area, Eigen::ArrayXd const& rho,
                 Eigen::ArrayXd const& e) {
    return {area, F.sparseView(), rho, e};
}

// Floor, four walls, ceiling of a box of l x w x h; walls across w first.
System box(double l, double w, double h, Eigen::ArrayXd const& rho, Eigen::ArrayXd const& e) {
    double const floor_ceiling = opposite_rectangles(l, w, h), to_long = adjacent_rectangles(w, h, l),
                 to_short = adjacent_rectangles(l, h, w);
    Eigen::ArrayXd area(6);
    area << l * w, l * h, w * h, l * h, w * h, l * w;
    Eigen::MatrixXd F = Eigen::MatrixXd::Zero(6, 6);
    F(0, 5) = F(5, 0) = floor_ceiling;
    for (int f : {0, 5})
        for (int k = 1; k < 5; ++k) {
            F(f, k) = k % 2 == 1 ? to_long : to_short;
            F(k, f) = F(f, k) * area[f] / area[k];
        }
    F(1, 3) = F(3, 1) = opposite_rectangles(l, h, w);
    F(2, 4) = F(4, 2) = opposite_rectangles(w, h, l);
    for (int a : {1, 3})
        for (int b : {2, 4}) {
            F(a, b) = adjacent_rectangles(l, w, h);
            F(b, a) = F(a, b) * area[a] / area[b];
        }
    return system_of(F, area, rho, e);
}
Eigen::ArrayXd values(std::initializer_list<double> v) {
    Eigen::ArrayXd a(v.size());
    std::copy(v.begin(), v.end(), a.begin());
    return a;
}
System room() { return box(2, 2, 1, values({.3, .5, .5, .5, .5, .8}), values({0, 0, 0, 0, 0, 1})); }
System tent() {
    Eigen::MatrixXd F = Eigen::MatrixXd::Constant(4, 4, 1. / 3);
    F.diagonal().setZero();
    return system_of(F, values({1, 1, 1, 1}), values({0, .5, .5, .5}), values({1, 0, 0, 0}));
}
Eigen::MatrixXd matrix(System const& s) {
    Eigen::MatrixXd M = -(s.reflectance.col(0).matrix().asDiagonal() * Eigen::MatrixXd(s.form_factors));
    M.diagonal().array() += 1;
    return M;
}

std::unique_ptr<Scene> lit_corner() {
    return test::scene_from(R"({"camera":{"eye":[0.5,0.5,2],"target":[0.5,0.5,0],"field_deg":60},
        "materials":{"m":{"type":"diffuse","reflectance":0.6}},
        "shapes":[{"type":"quad","material":"m","corners":[[0,0,0],[1,0,0],[1,1,0],[0,1,0]]},
                  {"type":"quad","material":"m","corners":[[0,0,0],[0,1,0],[0,1,1],[0,0,1]]},
                  {"type":"quad","material":"m","corners":[[0.1,0.1,0.4],[0.1,0.3,0.4],[0.3,0.3,0.4],[0.3,0.1,0.4]],
                   "emission":{"radiance":5}}]})");
}

}  // namespace

TEST_CASE("invariant 3: factors lie in 0 .. 1, flat patches do not see themselves, hollow ones do", "[law]") {
    System const r = room();
    Eigen::MatrixXd const F = r.form_factors;
    CHECK(F.minCoeff() >= 0);
    CHECK(F.maxCoeff() <= 1);
    CHECK(F.diagonal().cwiseAbs().maxCoeff() == 0);
    for (double t : {.1, .8, 1.5}) CHECK(cap_to_itself(t) > 0);
    CHECK(cone_to_itself(1, 1) > 0);
    CHECK((F.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-14);  // 1
}

TEST_CASE("invariant 7: a surface under a flat lid sees itself by 1 - lid / surface", "[law]") {
    for (double t : {.2, 1., pi_double / 2})
        CHECK(cap_to_itself(t) == Approx(1 - std::pow(std::sin(t), 2) / (2 * (1 - std::cos(t)))).epsilon(1e-13));
    for (double h : {.3, 1., 4.}) CHECK(cone_to_itself(1, h) == Approx(1 - 1 / std::hypot(1, h)).epsilon(1e-14));
}

TEST_CASE("invariants 8 and 9: M and K dominate their diagonals by what is absorbed", "[law]") {
    System const s = room();
    Eigen::MatrixXd const M = matrix(s), K = s.area.matrix().asDiagonal() * M * s.area.inverse().matrix().asDiagonal();
    Eigen::MatrixXd const F = s.form_factors;
    for (Eigen::Index i = 0; i < 6; ++i) {
        double rest = 0, column = 0;
        for (Eigen::Index j = 0; j < 6; ++j) {
            if (i == j) continue;
            CHECK(M(i, j) <= 0);
            CHECK(K(i, j) == Approx(-s.reflectance(i, 0) * F(j, i)).epsilon(1e-13));
            rest += std::abs(M(i, j));
            column += std::abs(K(j, i));
        }
        CHECK(M(i, i) - rest == Approx(1 - s.reflectance(i, 0)).epsilon(1e-13));
        CHECK(column < K(i, i));
    }
    CHECK(M.inverse().minCoeff() >= 0);
    System even = s;
    even.reflectance.setConstant(.4);
    Eigen::MatrixXd const E = matrix(even);
    CHECK((even.area.matrix().asDiagonal() * E * even.area.inverse().matrix().asDiagonal() - E.transpose())
              .cwiseAbs()
              .maxCoeff() < 1e-15);
    // b grows with e and with rho.
    System brighter = s;
    brighter.reflectance += .1;
    Spectra const b = solve(s, solver("direct"), {}).radiosity;
    CHECK((solve(brighter, solver("direct"), {}).radiosity - b).minCoeff() >= 0);
    CHECK((b - s.emission).minCoeff() >= 0);
}

// The box's listed rates are those of its factors as the source rounds them.
TEST_CASE("invariant 14: tent, cube and box lose their errors at the listed rates", "[law]") {
    Rates const t = spectral_radii(tent(), 0);
    CHECK(t.jacobi == Approx(1. / 3).epsilon(1e-12));
    CHECK(t.gauss_seidel == Approx(1. / 8).epsilon(1e-12));
    Eigen::MatrixXd F(6, 6);
    F << 0, .145, .145, .145, .145, .42,  //
        .29, 0, .15, .12, .15, .29,       //
        .29, .15, 0, .15, .12, .29,       //
        .29, .12, .15, 0, .15, .29,       //
        .29, .15, .12, .15, 0, .29,       //
        .42, .145, .145, .145, .145, 0;
    Eigen::ArrayXd const rho = values({.25, .5, .5, .5, .5, .5}), e = values({0, 0, 0, 0, 0, 1});
    Rates const b = spectral_radii(system_of(F, values({4, 2, 2, 2, 2, 4}), rho, e), 0);
    CHECK(std::abs(b.jacobi - .43043) < 5e-6);
    CHECK(std::abs(b.gauss_seidel - .21126) < 5e-6);
    for (System const& s : {room(), tent(), box(2, 2, 1, rho, e)}) {
        Rates const r = spectral_radii(s, 0);
        CHECK(r.gauss_seidel < r.jacobi);
        CHECK(r.jacobi < s.reflectance.maxCoeff());
        // The last of many steps shrinks the error by them.
        Spectra const exact = solve(s, solver("direct"), {}).radiosity;
        for (auto const& [name, rate] : {std::pair("jacobi", r.jacobi), {"gauss-seidel", r.gauss_seidel}}) {
            auto const steps = solver(name).make(s);
            double before = 0, after = 0;
            for (int k = 0; k < 12; ++k) {
                steps->step();
                before = std::exchange(after, (steps->radiosity() - exact).matrix().norm());
            }
            CHECK(after / before == Approx(rate).epsilon(.02));
        }
    }
}

TEST_CASE("invariant 13: jacobi's iterates are light after so many bounces", "[law]") {
    System const s = room();
    auto const jacobi = solver("jacobi").make(s);
    Spectra bounce = s.emission, sum = bounce;
    for (int k = 0; k < 10; ++k) {
        jacobi->step();
        CHECK((jacobi->radiosity() - sum).abs().maxCoeff() < 1e-15);
        bounce = s.reflectance * gathered(s, bounce);
        sum += bounce;
    }
}

TEST_CASE("invariant 15: gauss-seidel's steps shrink by its bound", "[law]") {
    for (System const& s : {room(), tent()}) {
        Eigen::MatrixXd const M = matrix(s);
        double bound = 0;
        for (Eigen::Index i = 0; i < s.patches(); ++i) {
            double before = 0, after = 0;
            for (Eigen::Index j = 0; j < s.patches(); ++j)
                if (j != i) (j < i ? before : after) += std::abs(M(i, j) / M(i, i));
            bound = std::max(bound, after / (1 - before));
        }
        CHECK(bound < 1);
        auto const gauss = solver("gauss-seidel").make(s);
        Spectra last = gauss->radiosity();
        double step_before = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 12; ++k) {
            gauss->step();
            double const step = (gauss->radiosity() - last).abs().maxCoeff();
            CHECK(step <= bound * step_before + 1e-15);
            step_before = step;
            last = gauss->radiosity();
        }
    }
}

TEST_CASE("invariant 16: a shot takes away what is absorbed of it, and the ambient share fades", "[law]") {
    System const s = room();
    auto const shooting = solver("southwell").make(s);
    auto const unshot = [&] { return (residual(s, shooting->radiosity()).colwise() * s.area).eval(); };
    Spectra before = unshot(), shown = Spectra::Zero(6, 1);
    for (int k = 0; k < 40; ++k) {
        Eigen::Index i;
        before.col(0).maxCoeff(&i);
        double kept = 0;
        for (FormFactors::InnerIterator F(s.form_factors, i); F; ++F) kept += s.reflectance(F.col(), 0) * F.value();
        shooting->step();
        Spectra const after = unshot();
        CHECK(after.sum() == Approx(before.sum() - (1 - kept) * before(i, 0)).epsilon(1e-12));
        CHECK(after.minCoeff() >= -1e-15);
        Spectra const with_unshot = shooting->radiosity() + after.colwise() / s.area;
        CHECK((with_unshot - shown).minCoeff() >= -1e-14);
        shown = with_unshot;
        before = after;
    }
    CHECK(ambient(s, before)[0] < 1e-3 * ambient(s, s.emission.colwise() * s.area)[0]);
}

// What stands between the eye and the polygon on the same rays looks the same from there.
TEST_CASE("invariant 4: moving a polygon along the rays from a point leaves its factor alone", "[law]") {
    VectorDouble const from(.2, -.1, .3), normal = VectorDouble(.1, .2, 1).normalized();
    std::vector<VectorDouble> const polygon{{-1, -1, 2}, {1.5, -.8, 2.2}, {1, 1.2, 2.5}, {-.7, 1, 1.9}};
    std::vector<VectorDouble> moved;
    for (std::size_t k = 0; k < polygon.size(); ++k)
        moved.push_back(from + (.4 + static_cast<double>(k)) * (polygon[k] - from));
    CHECK(patch_to_polygon(from, normal, moved) == Approx(patch_to_polygon(from, normal, polygon)).epsilon(1e-13));
}

TEST_CASE("invariant 15: southwell clears the patch it relaxes and keeps its bound", "[law]") {
    for (System const& s : {room(), tent()}) {
        auto const southwell = solver("southwell").make(s);
        double const bound = 1 - (1 - .8) / static_cast<double>(s.patches());
        auto const power = [&](Spectra const& b) { return (residual(s, b).colwise() * s.area).eval(); };
        Spectra before = southwell->radiosity();
        for (int k = 0; k < 30; ++k) {
            Spectra const unshot = power(before);
            Eigen::Index chosen;
            unshot.col(0).abs().maxCoeff(&chosen);
            southwell->step();
            Spectra const after = southwell->radiosity();
            CHECK(std::abs(power(after)(chosen, 0)) < 1e-14);
            CHECK(power(after).abs().sum() <= bound * unshot.abs().sum() + 1e-14);
            Eigen::ArrayXd change = (after - before).col(0).abs();
            change[chosen] = 0;
            CHECK(change.maxCoeff() == 0);
            before = after;
        }
    }
}

TEST_CASE("invariant 17: elements together have the power of their patch", "[law]") {
    auto const scene = lit_corner();
    PatchMesh const mesh = make_patches(*scene, .5);
    PatchTracer const tracer(mesh);
    Elements elements = whole_patches(mesh);
    for (int level = 0; level < 2; ++level) {
        std::vector<char> flagged(elements.mesh.patch.size());
        for (std::size_t i = 0; i < flagged.size(); ++i) flagged[i] = i % 3 == 0;
        elements = split(elements, flagged);
    }
    REQUIRE(elements.mesh.patch.size() > 2 * mesh.patch.size());
    auto const n = static_cast<Eigen::Index>(mesh.patch.size());
    System s;
    s.area.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) s.area[i] = mesh.patch[static_cast<std::size_t>(i)].area;
    s.reflectance = Spectra::Constant(n, 2, .6);
    s.emission = Spectra::Zero(n, 2);
    s.emission.row(n - 1) = 3;
    FormFactors const of_elements =
        assemble(elements.mesh, mesh.patch.size(), form_factor_methods()[0].rows(tracer, 256));
    s.form_factors = factors_of_patches(s, elements, of_elements);
    Spectra const b = solve(s, solver("gauss-seidel"), {.iterations = 1000, .tolerance = 1e-14}).radiosity,
                  of = radiosity_of_elements(s, elements, of_elements, b);
    Spectra power = Spectra::Zero(n, 2);
    Eigen::ArrayXd area = Eigen::ArrayXd::Zero(n);
    for (std::size_t e = 0; e < elements.parent.size(); ++e) {
        power.row(elements.parent[e]) += elements.mesh.patch[e].area * of.row(static_cast<Eigen::Index>(e));
        area[elements.parent[e]] += elements.mesh.patch[e].area;
    }
    CHECK((area - s.area).abs().maxCoeff() < 1e-14);
    CHECK((power - b.colwise() * s.area).abs().maxCoeff() < 1e-11);
}

// A vertex of one element inside the edge of another would tear the interpolated surface there.
TEST_CASE("splitting leaves no T-junctions, and both sides of a surface alike", "[law]") {
    auto const scene = lit_corner();
    Elements elements = whole_patches(make_patches(*scene, .5));
    for (int level = 0; level < 3; ++level) {
        std::vector<char> flagged(elements.mesh.patch.size());
        for (std::size_t i = 0; i < flagged.size(); ++i) flagged[i] = hash_words(i) % 4 == 0;
        elements = split(elements, flagged);
    }
    int torn = 0;
    for (Patch const& p : elements.mesh.patch)
        for (int k = 0; k < p.corners; ++k) {
            VectorDouble const
                a = elements.mesh.position[static_cast<std::size_t>(p.vertex[static_cast<std::size_t>(k)])],
                b = elements.mesh
                        .position[static_cast<std::size_t>(p.vertex[static_cast<std::size_t>((k + 1) % p.corners)])];
            for (Patch const& q : elements.mesh.patch) {
                if (q.shape != p.shape || q.back != p.back) continue;
                for (VectorDouble const& v : elements.mesh.polygon(q))
                    torn += (v - a).norm() > 1e-9 && (v - b).norm() > 1e-9 &&
                            std::abs((v - a).norm() + (v - b).norm() - (b - a).norm()) < 1e-12;
            }
        }
    CHECK(torn == 0);
    for (std::size_t i = 0; i < elements.mesh.patch.size(); ++i) {
        Patch const& p = elements.mesh.patch[i];
        if (p.opposite < 0) continue;
        Patch const& q = elements.mesh.patch[static_cast<std::size_t>(p.opposite)];
        CHECK(q.opposite == static_cast<int>(i));
        CHECK((p.centre - q.centre).norm() < 1e-12);
        CHECK((p.normal + q.normal).norm() < 1e-12);
        CHECK(p.area == Approx(q.area).epsilon(1e-12));
    }
}

// A box of .3 x .3 stands on a floor of 2 x 2, across the edges of its patches.
TEST_CASE("parts of patches lie open where the patches do", "[law]") {
    auto const scene = test::scene_from(
        R"({"camera":{"eye":[0,1,-3],"target":[0,0,0],"field_deg":40},"shapes":[
        {"type":"quad","material":{"type":"diffuse","reflectance":0.5},"corners":[[-1,0,1],[1,0,1],[1,0,-1],[-1,0,-1]]},
        {"type":"box","material":{"type":"diffuse","reflectance":0.5},"min":[-0.1,0,-0.2],"max":[0.2,0.4,0.1]}]})");
    PatchMesh mesh = make_patches(*scene, 0.5);
    auto const open_floor = [&] {
        double area = 0;
        for (Patch const& p : mesh.patch)
            if (p.shape == 0) area += p.open_area();
        return area;
    };
    CHECK(open_floor() == Approx(4 - 0.09).epsilon(3e-3));
    for (int level = 0; level < 3; ++level) {
        mesh = split(whole_patches(mesh), std::vector<char>(mesh.patch.size(), true)).mesh;
        find_open_parts(mesh);
        INFO("level " << level);
        CHECK(open_floor() == Approx(4 - 0.09).epsilon(3e-3));
    }
}

TEST_CASE("invariant 19: equal walls are equally bright", "[law]") {
    for (SolverEntry const& e : solvers()) {
        INFO(e.name);
        Spectra const b = solve(room(), e, {.iterations = 5000, .tolerance = 1e-13}).radiosity;
        for (Eigen::Index k = 2; k < 5; ++k) CHECK(b(k, 0) == Approx(b(1, 0)).epsilon(1e-10));
    }
}

TEST_CASE("invariant 20: constant patches make constant vertices, and the transfer is linear", "[law]") {
    auto const scene = lit_corner();
    PatchMesh const mesh = make_patches(*scene, .2);
    auto const n = static_cast<Eigen::Index>(mesh.patch.size());
    CHECK((to_vertices(mesh, Spectra::Constant(n, 1, 3)) - 3).abs().maxCoeff() < 1e-12);
    Spectra a(n, 1), b(n, 1);
    for (Eigen::Index i = 0; i < n; ++i) {
        a(i, 0) = std::sin(static_cast<double>(i));
        b(i, 0) = std::cos(3. * static_cast<double>(i));
    }
    CHECK((to_vertices(mesh, 2 * a - b) - (2 * to_vertices(mesh, a) - to_vertices(mesh, b))).abs().maxCoeff() < 1e-12);
}

// From the middle of the ceiling of a cylinder k wide and 1 high, the floor hides k^2 / (1 + k^2) of the sky.
TEST_CASE("invariant 21: what is not occluded is 1 - the sum of factors", "[law]") {
    for (double k : {1., 2., 3.}) {
        CHECK(1 - patch_to_disc(k, 1) == Approx(1 / (1 + k * k)).epsilon(1e-14));
        auto const scene = test::scene_from(fmt::format(
            R"({{"camera":{{"type":"orthographic","eye":[0,0,0.5],"target":[0,0,1],"up":[0,1,0],"window":0.0005}},
            "film":{{"size":[4,4]}},"lights":[{{"type":"environment","radiance":1}}],
            "materials":{{"m":{{"type":"diffuse","reflectance":0.5}}}},"shapes":[
            {{"type":"quad","material":"m","corners":[[-0.001,-0.001,1],[-0.001,0.001,1],[0.001,0.001,1],[0.001,-0.001,1]]}},
            {{"type":"disc","material":"m","centre":[0,0,0],"normal":[0,0,1],"radius":{}}}]}})",
            k));
        PatchMesh const mesh = make_patches(*scene, .1);
        PatchTracer const tracer(mesh);
        double const occluded = k * k / (1 + k * k);
        constexpr double facets = 2e-3;  // what the disc's rim lacks of a circle
        for (FormFactorMethod const& m : form_factor_methods()) {
            if (!m.rows) continue;
            INFO(m.name << " " << k);
            RowSums row(mesh.patch.size());
            m.rows(tracer, 128)(mesh, 0, row);
            double sum = 0;
            row.take([&](int, double value) { sum += value; });
            double const error = m.name == std::string("rays") ? 4 * std::sqrt(occluded * (1 - occluded) / 128) : .01;
            CHECK(std::abs(sum - occluded) < error + facets);
        }
        Film const open = test::rendered(*scene, "ambient-occlusion:sampling=cosine", {.spp = 1024});
        CHECK(std::abs(open.mean(1, 1).Y - (1 - occluded)) < 4 * std::sqrt(open.variance(1, 1).Y) + 1e-4);
    }
}

TEST_CASE("invariant 23: the numbers of patches do not matter to a solution", "[law]") {
    System const s = room();
    std::array<int, 6> const to{4, 0, 5, 2, 1, 3};
    Eigen::PermutationMatrix<6> P;
    for (int i = 0; i < 6; ++i) P.indices()[i] = to[static_cast<std::size_t>(i)];
    System const turned =
        system_of(P * Eigen::MatrixXd(s.form_factors) * P.transpose(), (P * s.area.matrix()).array(),
                  (P * s.reflectance.col(0).matrix()).array(), (P * s.emission.col(0).matrix()).array());
    for (SolverEntry const& e : solvers()) {
        INFO(e.name);
        Stop const stop{.iterations = 5000, .tolerance = 1e-13};
        Spectra const a = solve(s, e, stop).radiosity, b = solve(turned, e, stop).radiosity;
        for (int i = 0; i < 6; ++i) CHECK(b(to[static_cast<std::size_t>(i)], 0) == Approx(a(i, 0)).epsilon(1e-10));
    }
}
