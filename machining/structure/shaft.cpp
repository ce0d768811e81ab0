#include "machining/structure/shaft.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "machining/gauss.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <numbers>

namespace cnem::machining {

namespace {

using Eigen::Index;
using Row = Eigen::Matrix<double, 1, 4>;

/// Displacement and slope of the cross-section at a share x of an element of a length, of (w, θ) at both
/// ends: functions that solve the beam without loads (Friedman and Kosmatka 1993). Φ = 12 E I/(κ G A L²).
struct BeamFunctions {
  Row displacement, slope, curvature, shear; ///< shear: w' − θ
};

BeamFunctions beam_functions(double x, double length, double phi) {
  const double f = 1.0 / (1.0 + phi), l = length;
  BeamFunctions b;
  b.displacement << f * (2 * x * x * x - 3 * x * x - phi * x + 1 + phi),
      l * f * (x * x * x - (2 + phi / 2) * x * x + (1 + phi / 2) * x),
      f * (-2 * x * x * x + 3 * x * x + phi * x), l * f * (x * x * x - (1 - phi / 2) * x * x - phi / 2 * x);
  b.slope << 6 * f / l * (x * x - x), f * (3 * x * x - (4 + phi) * x + 1 + phi), -6 * f / l * (x * x - x),
      f * (3 * x * x - (2 - phi) * x);
  b.curvature << 6 * f / l * (2 * x - 1), f * (6 * x - 4 - phi), -6 * f / l * (2 * x - 1),
      f * (6 * x - 2 + phi);
  b.curvature /= l;
  b.shear << -phi * f / l, -phi * f / 2, phi * f / l, -phi * f / 2;
  return b;
}

/// Unknowns of (w, θ) at both ends in the plane of an axis, in the order of a node: x, y, x', y'.
std::array<std::pair<std::size_t, Index>, 4> in_plane(std::size_t element, Index axis) {
  return {{{element, axis}, {element, axis + 2}, {element + 1, axis}, {element + 1, axis + 2}}};
}

} // namespace

double circular_shear_correction(double poisson, double hollow) {
  const double m = hollow * hollow, a = (1.0 + m) * (1.0 + m);
  return 6.0 * (1.0 + poisson) * a / ((7.0 + 6.0 * poisson) * a + (20.0 + 12.0 * poisson) * m);
}

Shaft::Shaft(std::vector<ShaftSection> sections, std::vector<Bearing> bearings, double length) {
  std::sort(sections.begin(), sections.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
  const double all = sections.back().to - sections.front().from, same = 1e-9 * all;
  std::vector<double> stops{sections.front().from};
  for (const ShaftSection& section : sections) {
    if (std::abs(section.from - stops.back()) > same)
      throw InputError(
          fmt::format("a section begins at {:g} m, expected at {:g} m, where the one before ends",
                      section.from, stops.back()));
    stops.push_back(section.to);
  }
  std::vector<double> ends = stops;
  for (const Bearing& bearing : bearings) {
    if (bearing.at < stops.front() - same || bearing.at > stops.back() + same)
      throw InputError(
          fmt::format("a bearing stands at {:g} m, expected from {:g} to {:g} m, along the shaft", bearing.at,
                      stops.front(), stops.back()));
    ends.push_back(bearing.at);
  }
  std::sort(ends.begin(), ends.end());
  node_.push_back(ends.front());
  for (const double end : ends) {
    const double begin = node_.back();
    if (end - begin <= same) continue;
    const int count = static_cast<int>(std::ceil((end - begin) / length - 1e-9));
    for (int i = 1; i <= count; ++i) node_.push_back(begin + (end - begin) * i / count);
  }
  held_.assign(node_.size(), Eigen::Array<bool, 4, 1>::Constant(false));
  first_.resize(node_.size());
  const auto node_at = [&](double z) {
    return index_of(std::min_element(node_.begin(), node_.end(),
                                     [&](double a, double b) { return std::abs(a - z) < std::abs(b - z); }) -
                    node_.begin());
  };
  for (const Bearing& bearing : bearings) {
    auto& held = held_[node_at(bearing.at)];
    if (std::isinf(bearing.stiffness)) held.head<2>() = true;
    if (std::isinf(bearing.tilt_stiffness)) held.tail<2>() = true;
  }
  Index count = 0;
  for (std::size_t n = 0; n < node_.size(); ++n)
    for (Index k = 0; k < 4; ++k) first_[n][k] = held_[n][k] ? -1 : count++;
  for (Eigen::MatrixXd* matrix : {&mass_, &stiffness_, &damping_, &gyroscopic_})
    matrix->setZero(count, count);
  flexibility_.resize(node_.size() - 1);
  for (std::size_t e = 0; e + 1 < node_.size(); ++e) {
    const double middle = 0.5 * (node_[e] + node_[e + 1]);
    add_element(e, *std::find_if(sections.begin(), sections.end(),
                                 [&](const ShaftSection& section) { return middle < section.to; }));
  }
  for (const Bearing& bearing : bearings)
    for (Index k = 0; k < 4; ++k) {
      const Index i = unknown(node_at(bearing.at), k);
      if (i < 0) continue;
      stiffness_(i, i) += k < 2 ? bearing.stiffness : bearing.tilt_stiffness;
      damping_(i, i) += k < 2 ? bearing.damping : bearing.tilt_damping;
    }
}

void Shaft::add_element(std::size_t element, const ShaftSection& section) {
  const double length = node_[element + 1] - node_[element], d = section.diameter, b = section.bore;
  const double area = std::numbers::pi / 4.0 * (d * d - b * b),
               inertia = std::numbers::pi / 64.0 * (d * d * d * d - b * b * b * b);
  const ElasticSolid& solid = section.solid;
  const double shear = section.shear_correction.value_or(circular_shear_correction(solid.poisson, b / d)) *
                       0.5 * solid.young / (1.0 + solid.poisson) * area;
  const double phi = 12.0 * solid.young * inertia / (shear * length * length);
  flexibility_[element] = phi;
  using Block = Eigen::Matrix4d;
  Block stiffness = Block::Zero(), mass = Block::Zero(), slopes = Block::Zero();
  const GaussRule& rule = gauss_rule(4); // exact
  for (std::size_t q = 0; q < rule.node.size(); ++q) {
    const BeamFunctions f = beam_functions(rule.node[q], length, phi);
    const double weight = rule.weight[q] * length;
    stiffness += weight * (solid.young * inertia * f.curvature.transpose() * f.curvature +
                           shear * f.shear.transpose() * f.shear);
    slopes += weight * solid.density * inertia * f.slope.transpose() * f.slope;
    mass += weight * solid.density * area * f.displacement.transpose() * f.displacement;
  }
  mass += slopes;
  // The polar moment 2 ρ I couples the slopes of both planes: 2 ρ I Ω ẏ' in the equation of x', and against
  // it.
  const auto x = in_plane(element, 0), y = in_plane(element, 1);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const auto a = as<Eigen::Index>(i), c = as<Eigen::Index>(j);
      for (const auto* plane : {&x, &y}) {
        const Index row = unknown((*plane)[i].first, (*plane)[i].second),
                    column = unknown((*plane)[j].first, (*plane)[j].second);
        if (row < 0 || column < 0) continue;
        stiffness_(row, column) += stiffness(a, c);
        mass_(row, column) += mass(a, c);
      }
      const Index row = unknown(x[i].first, x[i].second), column = unknown(y[j].first, y[j].second);
      if (row < 0 || column < 0) continue;
      gyroscopic_(row, column) += 2.0 * slopes(a, c);
      gyroscopic_(column, row) -= 2.0 * slopes(a, c);
    }
}

Eigen::MatrixXd Shaft::displacement_at(double z) const {
  const double same = 1e-9 * (end() - begin());
  if (z < begin() - same || z > end() + same)
    throw InputError(fmt::format("found a place at {:g} m, expected from {:g} to {:g} m, along the shaft", z,
                                 begin(), end()));
  const auto after = std::upper_bound(node_.begin() + 1, node_.end() - 1, z);
  const auto element = index_of(after - node_.begin()) - 1;
  const double length = node_[element + 1] - node_[element];
  const double share = std::clamp((z - node_[element]) / length, 0.0, 1.0);
  const BeamFunctions f = beam_functions(share, length, flexibility_[element]);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, unknowns());
  for (Index axis = 0; axis < 2; ++axis) {
    const auto plane = in_plane(element, axis);
    for (std::size_t i = 0; i < 4; ++i)
      if (const Index column = unknown(plane[i].first, plane[i].second); column >= 0)
        rows(axis, column) = f.displacement[as<Eigen::Index>(i)];
  }
  return rows;
}

std::vector<Whirl> whirls(const Shaft& shaft, double speed, std::size_t count) {
  const Index n = shaft.unknowns();
  // With the Cholesky factor of M: x = L⁻ᵀ y makes matrices of one size, and λ of a well-scaled problem.
  const Eigen::LLT<Eigen::MatrixXd> mass(shaft.mass());
  const auto scaled = [&](const Eigen::MatrixXd& matrix) {
    const Eigen::MatrixXd half = mass.matrixL().solve(matrix);
    return Eigen::MatrixXd(mass.matrixL().solve(half.transpose()).transpose());
  };
  const Eigen::MatrixXd stiffness = scaled(shaft.stiffness()),
                        rates = scaled(shaft.damping() + speed * shaft.gyroscopic());
  const Eigen::MatrixXcd upper = Eigen::MatrixXd(mass.matrixU()).cast<std::complex<double>>();
  const double unit = std::sqrt(stiffness.norm());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * n, 2 * n); // of (y, ẏ/unit), times 1/unit
  system.topRightCorner(n, n).setIdentity();
  system.bottomLeftCorner(n, n) = -stiffness / (unit * unit);
  system.bottomRightCorner(n, n) = -rates / unit;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(system);
  Eigen::MatrixXd axis(2 * as<Eigen::Index>(shaft.nodes().size()), n); // x, y of each node
  for (std::size_t k = 0; k < shaft.nodes().size(); ++k)
    axis.middleRows(2 * as<Eigen::Index>(k), 2) = shaft.displacement_at(shaft.nodes()[k]);
  std::vector<Whirl> all;
  for (Index i = 0; i < 2 * n; ++i) {
    const std::complex<double> lambda = solver.eigenvalues()[i] * unit;
    if (!(lambda.imag() > 0.0)) continue; // overdamped, or the other of a pair
    const Eigen::VectorXcd y = solver.eigenvectors().col(i).head(n);
    Whirl whirl{.omega = std::abs(lambda), .damping = -lambda.real() / std::abs(lambda), .shape = {}};
    whirl.shape = upper.triangularView<Eigen::Upper>().solve(y).normalized();
    if (speed != 0.0) {
      const Eigen::Matrix2Xcd path =
          (axis.cast<std::complex<double>>() * whirl.shape).reshaped(2, axis.rows() / 2);
      const double turning = 2.0 * (path.row(0).conjugate() * path.row(1).transpose()).value().imag();
      whirl.direction = -std::copysign(1.0, speed) * turning / path.squaredNorm();
    }
    all.push_back(std::move(whirl));
  }
  std::sort(all.begin(), all.end(), [](const Whirl& a, const Whirl& b) { return a.omega < b.omega; });
  if (all.size() > count) all.resize(count);
  return all;
}

} // namespace cnem::machining
