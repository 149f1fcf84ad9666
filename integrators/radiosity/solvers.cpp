// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/solvers.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>

namespace iride::radiosity {

namespace {

// Hierarchical patches are flat: they do not see themselves.
Eigen::ArrayXd own_factors(System const& s) {
    return s.transport ? Eigen::ArrayXd::Zero(s.patches()) : Eigen::ArrayXd(s.form_factors.diagonal().array());
}

class Jacobi final : public Solver {
  public:
    explicit Jacobi(System const& s) : s_(s), own_(own_factors(s)), b_(Spectra::Zero(s.patches(), s.wavelengths())) {}
    void step() override {
        Spectra const all = gathered(s_, b_);
        for (Eigen::Index i = 0; i < s_.patches(); ++i) {
            Row const rho = s_.reflectance.row(i), others = all.row(i) - own_[i] * b_.row(i);
            b_.row(i) = (s_.emission.row(i) + rho * others) / (1 - rho * own_[i]);
        }
    }
    Spectra radiosity() const override { return b_; }

  private:
    System const& s_;
    Eigen::ArrayXd own_;
    Spectra b_;
};

class GaussSeidel final : public Solver {
  public:
    GaussSeidel(System const& s, double omega)
        : s_(s), omega_(omega), own_(own_factors(s)), b_(Spectra::Zero(s.patches(), s.wavelengths())) {}
    void step() override {
        for (Eigen::Index i = 0; i < s_.patches(); ++i) {
            Row others = Row::Zero(s_.wavelengths());
            for (FormFactors::InnerIterator F(s_.form_factors, i); F; ++F)
                if (F.col() != i) others += F.value() * b_.row(F.col());
            Row const rho = s_.reflectance.row(i);
            Row const relaxed = (s_.emission.row(i) + rho * others) / (1 - rho * own_[i]);
            b_.row(i) += omega_ * (relaxed - b_.row(i));
        }
    }
    Spectra radiosity() const override { return b_; }

  private:
    System const& s_;
    double omega_;
    Eigen::ArrayXd own_;
    Spectra b_;
};

// By rows of F: K_ji = -rho_j F_ij, so one row says whom the power of a patch reaches.
class Southwell : public Solver {
  public:
    explicit Southwell(System const& s)
        : s_(s),
          shot_(Spectra::Zero(s.patches(), s.wavelengths())),
          unshot_(s.emission.colwise() * s.area),
          urgency_(unshot_.abs().rowwise().sum()) {}

    void step() override {
        Eigen::Index i;
        urgency_.maxCoeff(&i);
        Row const power = unshot_.row(i) / (1 - s_.reflectance.row(i) * s_.form_factors.coeff(i, i));
        shot_.row(i) += power;
        for (FormFactors::InnerIterator F(s_.form_factors, i); F; ++F) {
            Eigen::Index const j = F.col();
            if (j == i) continue;
            unshot_.row(j) += s_.reflectance.row(j) * (F.value() * power);
            urgency_[j] = unshot_.row(j).abs().sum();
        }
        unshot_.row(i).setZero();
        urgency_[i] = 0;
    }
    Spectra radiosity() const override { return shot_.colwise() / s_.area; }

  protected:
    System const& s_;
    Spectra shot_, unshot_;   // beta, sigma [W nm^-1]
    Eigen::ArrayXd urgency_;  // [patch] sum of |sigma| over wavelengths
};

class Shooting final : public Southwell {
  public:
    using Southwell::Southwell;
    Spectra radiosity() const override {
        return (shot_ + unshot_).colwise() / s_.area + s_.reflectance.rowwise() * ambient(s_, unshot_);
    }
};

// A wavelength has steps of its own; the product with F serves all of them.
class ConjugateGradients final : public Solver {
  public:
    explicit ConjugateGradients(System const& s)
        : s_(s), scale_((s.reflectance.colwise() / s.area).sqrt()), z_(Spectra::Zero(s.patches(), s.wavelengths())) {
        residual_ = scale_.colwise() * s.area * gathered(s, s.emission);
        direction_ = residual_;
        norm2_ = residual_.square().colwise().sum();
    }
    void step() override {
        Spectra const image = direction_ - scale_.colwise() * s_.area * gathered(s_, scale_ * direction_);
        Row const length = quotient(norm2_, (direction_ * image).colwise().sum());
        z_ += direction_.rowwise() * length;
        residual_ -= image.rowwise() * length;
        Row const next = residual_.square().colwise().sum();
        direction_ = residual_ + direction_.rowwise() * quotient(next, norm2_);
        norm2_ = next;
    }
    Spectra radiosity() const override { return s_.emission + scale_ * z_; }
    std::optional<Spectra> residual() const override { return scale_ * residual_; }

  private:
    // 0 where a wavelength is solved already.
    static Row quotient(Row const& a, Row const& b) { return (b > 0).select(a / b.max(1e-300), 0.0); }

    System const& s_;
    Spectra scale_;  // sqrt(rho / A); times A it is sqrt(rho A)
    Spectra z_, residual_, direction_;
    Row norm2_;
};

class Direct final : public Solver {
  public:
    explicit Direct(System const& s) : s_(s), b_(Spectra::Zero(s.patches(), s.wavelengths())) {}
    void step() override {
        Eigen::MatrixXd const F = s_.form_factors;
        for (Eigen::Index w = 0; w < s_.wavelengths(); ++w) {
            Eigen::MatrixXd M = -(s_.reflectance.col(w).matrix().asDiagonal() * F);
            M.diagonal().array() += 1;
            b_.col(w) = M.partialPivLu().solve(s_.emission.col(w).matrix()).array();
        }
    }
    Spectra radiosity() const override { return b_; }

  private:
    System const& s_;
    Spectra b_;
};

template <class S>
std::unique_ptr<Solver> make(System const& s) {
    return std::make_unique<S>(s);
}

constexpr std::array<SolverEntry, 7> table{{
    {"conjugate-gradients", "the fastest, where form factors are reciprocal", false, make<ConjugateGradients>},
    {"gauss-seidel", "sweeps with the latest values", true, [](System const& s) { return over_relaxation(s, 1); }},
    {"over-relaxation", "gauss-seidel's step times 1.15", true,
     [](System const& s) { return over_relaxation(s, 1.15); }},
    {"jacobi", "sweeps with the last sweep's values: a bounce of light each", false, make<Jacobi>},
    {"southwell", "the patch with the most unshot power first", true, make<Southwell>},
    {"shooting", "progressive refinement: southwell with the unshot and an ambient share shown", true, make<Shooting>},
    {"direct", "LU factors, for small scenes", true, make<Direct>},
}};

double relative(System const& system, Spectra const& residual) {
    Row const largest = residual.abs().colwise().maxCoeff(), emitted = system.emission.colwise().maxCoeff();
    return (emitted > 0).select(largest / emitted.max(1e-300), 0.0).maxCoeff();
}

}  // namespace

std::span<SolverEntry const> solvers() { return table; }

std::unique_ptr<Solver> over_relaxation(System const& system, double omega) {
    return std::make_unique<GaussSeidel>(system, omega);
}

Solution solve(System const& system, SolverEntry const& entry, Stop const& stop) {
    auto const solver = entry.make(system);
    Solution solution{solver->radiosity(), 0, 0};
    // A check may cost a product with F, as much as n steps of southwell: it is made at growing distances.
    int next_check = 1;
    while (solution.iterations < stop.iterations) {
        solver->step();
        if (++solution.iterations < next_check) continue;
        next_check = std::max(next_check + 1, next_check * 9 / 8);
        std::optional<Spectra> const known = solver->residual();
        if (relative(system, known ? *known : residual(system, solver->radiosity())) <= stop.tolerance) break;
    }
    solution.radiosity = solver->radiosity();
    solution.residual = relative(system, residual(system, solution.radiosity));
    return solution;
}

Rates spectral_radii(System const& system, Eigen::Index wavelength) {
    Eigen::MatrixXd M =
        -(system.reflectance.col(wavelength).matrix().asDiagonal() * Eigen::MatrixXd(system.form_factors));
    M.diagonal().array() += 1;
    Eigen::MatrixXd const D = M.diagonal().asDiagonal();
    Eigen::MatrixXd const lower = M.triangularView<Eigen::Lower>();
    auto const radius = [&](Eigen::MatrixXd const& split) -> double {
        Eigen::MatrixXd const Q = split.partialPivLu().solve(split - M);
        return Q.eigenvalues().cwiseAbs().maxCoeff();
    };
    return {radius(D), radius(lower)};
}

}  // namespace iride::radiosity
