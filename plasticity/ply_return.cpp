#include "plasticity/ply_return.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace cnem::plasticity {

namespace {

constexpr double rounding = 1e-13; ///< of the largest value of A, below which one is none

/// Normal components 11, 22 and 33; shear stands in the last place.
constexpr int shear_place = 3;

/// σ̄ of a mode-wise trial stress on its way back, λ = Δγ/σ̄.
class Path {
public:
  Path(int count, const double (&value)[4], const double (&trial)[4])
      : count_(count), value_(value), trial_(trial) {}

  void at(double lambda) {
    double square = 0.0, cube = 0.0;
    for (int k = 0; k < count_; ++k) {
      const double factor = 1.0 / (1.0 + lambda * value_[k]), stress = factor * trial_[k];
      const double part = value_[k] * stress * stress;
      square += part;
      cube += value_[k] * factor * part;
    }
    yield = std::sqrt(square);
    slope = square > 0.0 ? -cube / yield : 0.0;
  }

  double yield = 0.0; ///< σ̄
  double slope = 0.0; ///< dσ̄/dλ

private:
  int count_;
  const double (&value_)[4];
  const double (&trial_)[4];
};

/// λ at which σ̄ is the flow stress: σ_y/σ̄ rises with it, linearly where one mode flows and hardens linearly.
/// Newton's method within a bracket. Expects the path at 0. Negative: none was found.
double root(Path& path, const StepFlow& flow) {
  constexpr double accuracy = 1e-13; // of σ̄ over the flow stress
  constexpr int most_rounds = 200;
  const double least = 1e-12 * path.yield; // a flow stress below is none: broken matter
  double low = 0.0, high = infinite;
  double lambda = 0.0;
  const double start = std::max(flow.stress(0.0), least);
  lambda = -path.yield * (path.yield / start - 1.0) / path.slope; // as if it did not harden
  for (int k = 0; k < most_rounds; ++k) {
    path.at(lambda);
    const double increment = lambda * path.yield;
    const double hardened = flow.stress(increment), stress = std::max(hardened, least);
    const double over = stress / path.yield - 1.0;
    if (std::abs(over) <= accuracy) return lambda;
    (over < 0.0 ? low : high) = lambda;
    if (high < infinite && high - low <= 1e-16 * high) return lambda;
    const double harder = hardened > least ? flow.slope(increment) * (path.yield + lambda * path.slope) : 0.0;
    const double rise = (harder * path.yield - stress * path.slope) / (path.yield * path.yield);
    double next = lambda - over / rise;
    if (!(next > low && next < high) || k % 16 == 15)
      next = high == infinite ? 8.0 * lambda : low > 0.0 ? std::sqrt(low * high) : 0.125 * high;
    lambda = next;
  }
  return -1.0;
}

} // namespace

PlyReturn::PlyReturn(const Orthotropic& elastic, const HillCoefficients& yield, bool stress_free)
    : stress_free_(stress_free), shear_modulus_(elastic.G12), shear_(2.0 * yield.N) {
  const double s12 = -elastic.nu12 / elastic.E1, s13 = -elastic.nu13 / elastic.E1,
               s23 = -elastic.nu23 / elastic.E2;
  const double F = yield.F, G = yield.G, H = yield.H;
  compliance_.resize(3, 3);
  normal_.resize(3, 3);
  compliance_ << 1.0 / elastic.E1, s12, s13, s12, 1.0 / elastic.E2, s23, s13, s23, 1.0 / elastic.E3;
  normal_ << G + H, -H, -G, -H, F + H, -F, -G, -F, F + G;
  if (stress_free) {
    compliance_ = compliance_.topLeftCorner(2, 2).eval();
    normal_ = normal_.topLeftCorner(2, 2).eval();
  }
  all_ = modes(normal_);
}

template<int n> PlyReturn::Modes PlyReturn::modes_of(const Normals& normal) const {
  using Matrix = Eigen::Matrix<double, n, n>;
  const Eigen::LLT<Matrix> root(compliance_);
  Matrix own = root.matrixL().solve(Matrix(normal));
  own = root.matrixL().solve(own.transpose().eval());
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  if constexpr (n == 2)
    solver.computeDirect(own);
  else
    solver.compute(own);
  const Matrix vectors = root.matrixU().solve(solver.eigenvectors()),
               strains = root.matrixL() * solver.eigenvectors();
  const double greatest = solver.eigenvalues()[n - 1];
  Modes made;
  made.count = n + 1;
  for (int k = 0; k < n; ++k) {
    const double value = solver.eigenvalues()[k];
    made.value[k] = value > rounding * greatest ? value : 0.0; // that of a mean stress
    for (int i = 0; i < n; ++i) made.vector[k][i] = vectors(i, k), made.strain[k][i] = strains(i, k);
  }
  made.value[n] = shear_ * shear_modulus_;
  made.vector[n][shear_place] = std::sqrt(shear_modulus_);
  made.strain[n][shear_place] = 1.0 / std::sqrt(shear_modulus_);
  return made;
}

PlyReturn::Modes PlyReturn::modes(const Normals& normal) const {
  return stress_free_ ? modes_of<2>(normal) : modes_of<3>(normal);
}

PlyReturn::Result PlyReturn::solve(const Modes& modes, const double (&trial)[4], const StepFlow* flow) {
  double part[4] = {};
  for (int k = 0; k < modes.count; ++k)
    for (int i = 0; i < 4; ++i) part[k] += modes.vector[k][i] * trial[i];
  Path path(modes.count, modes.value, part);
  path.at(0.0);
  Result result;
  double lambda = 0.0;
  if (flow && path.yield > flow->stress(0.0)) {
    lambda = root(path, *flow);
    result.found = lambda >= 0.0;
    path.at(lambda);
    result.increment = lambda * path.yield;
  }
  result.yield = path.yield;
  double stress[4] = {}, flowed[4] = {};
  for (int k = 0; k < modes.count; ++k) {
    const double own = part[k] / (1.0 + lambda * modes.value[k]);
    result.energy += 0.5 * own * own;
    for (int i = 0; i < 4; ++i) {
      stress[i] += own * modes.vector[k][i];
      flowed[i] += lambda * modes.value[k] * own * modes.strain[k][i];
    }
  }
  const int place[] = {0, 1, shear_place};
  for (int i = 0; i < 3; ++i) result.stress[i] = stress[place[i]], result.flow[i] = flowed[place[i]];
  result.out = stress[2];
  return result;
}

PlyReturn::Result PlyReturn::operator()(const double (&strain)[3], const double (&plastic)[3],
                                        const StepFlow* flow, double softening) const {
  const double out = stress_free_ ? 0.0 : plastic[0] + plastic[1];
  const double trial[4] = {strain[0] - plastic[0], strain[1] - plastic[1], out, strain[2] - plastic[2]};
  const Result sound = solve(all_, trial, flow);
  if (softening == 0.0) return sound;
  assert(stress_free_);
  const Eigen::Vector2d out_of_plane = normal_ * Eigen::Vector2d::Ones();
  if (out_of_plane[0] * sound.stress[0] + out_of_plane[1] * sound.stress[1] >= 0.0) return sound;
  const double left = (1.0 - softening) * (1.0 - softening);
  const Normals broken =
      normal_ - (1.0 - left) / out_of_plane.sum() * out_of_plane * out_of_plane.transpose();
  return solve(modes(broken), trial, flow);
}

double PlyReturn::yield_stress(const double (&stress)[3], double out) const {
  const double normal[] = {stress[0], stress[1], out};
  double square = shear_ * stress[2] * stress[2];
  for (Eigen::Index i = 0; i < normal_.rows(); ++i)
    for (Eigen::Index j = 0; j < normal_.cols(); ++j) square += normal[i] * normal_(i, j) * normal[j];
  return std::sqrt(std::max(square, 0.0));
}

double PlyReturn::least_slope() const {
  double least = infinite;
  const double largest = *std::max_element(all_.value, all_.value + all_.count);
  for (int k = 0; k < all_.count; ++k) // a mean stress does not flow
    if (all_.value[k] > rounding * largest) least = std::min(least, all_.value[k]);
  return least;
}

double ply_yield_stress(const Orthotropic& elastic, const HillCoefficients& yield, const double (&s)[6]) {
  const double c = std::cos(elastic.angle), d = std::sin(elastic.angle);
  const double own[] = {c * c * s[0] + d * d * s[1] + 2.0 * c * d * s[3],
                        d * d * s[0] + c * c * s[1] - 2.0 * c * d * s[3],
                        c * d * (s[1] - s[0]) + (c * c - d * d) * s[3]};
  return PlyReturn(elastic, yield, false).yield_stress(own, s[2]);
}

double least_ply_slope(const Orthotropic& elastic, const HillCoefficients& yield) {
  return std::min(PlyReturn(elastic, yield, true).least_slope(),
                  PlyReturn(elastic, yield, false).least_slope());
}

} // namespace cnem::plasticity
