#include "evaluate/springback.hpp"
#include "core/index.hpp"

#include "mechanics/kinematics.hpp"
#include "mechanics/statics/rigid_motion.hpp"
#include "mechanics/statics/statics.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace cnem {

namespace {

using Mode = Eigen::Vector3d; ///< translation along x and y, rotation times the radius of the part

/// G and h of the reference turned into those of the present configuration: b = F⁻ᵀ B, V = J V_0, h/F_θθ.
DiscreteOperators<2> pushed_forward(const DiscreteOperators<2>& reference, const PointState<2>& point) {
  DiscreteOperators<2> op = reference;
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    Mat2 F;
    F << point.deformation[0][p], point.deformation[1][p], point.deformation[2][p], point.deformation[3][p];
    const Mat2 inverse = F.inverse();
    op.volume[p] *= jacobian<2>(point.deformation, p);
    if (op.of_revolution()) op.radius[p] *= point.deformation[4][p];
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const Vec2 b = inverse.transpose() * Vec2(op.gradient[0][e], op.gradient[1][e]);
      op.gradient[0][e] = b.x();
      op.gradient[1][e] = b.y();
      if (op.of_revolution()) op.hoop[e] /= point.deformation[4][p];
    }
  }
  op.build_transpose();
  return op;
}

/// −f_int.
Fields<2> released_force(const StressedBody& body) {
  ColumnStress<2> stress;
  copy_stress_columns<2>(body.point.piola, stress);
  Fields<2> force;
  resize_all(force, body.mass.size(), 0.0);
  subtract_internal_force<2>(body.approximation.mechanics, stress, force, 0, body.mass.size());
  return force;
}

/// −3κα ΔT of each point, Pa.
Field cooling_stress(const StressedBody& body) {
  const DiscreteOperators<2>& op = body.approximation.mechanics;
  Field stress(body.point.material.size());
  if (!body.cooled_to) return stress;
  Field end(stress.size());
  if (op.nodal)
    end = *body.cooled_to;
  else
    interpolate<2>(op, *body.cooled_to, end, 0, end.size());
  for (std::size_t p = 0; p < stress.size(); ++p) {
    const plasticity::Material& material = body.materials[index_of(body.point.material[p])];
    stress[p] = 3.0 * material.elasticity.kappa() * material.expansion * (body.point.temperature[p] - end[p]);
  }
  return stress;
}

/// force −= Σ V s b of a stress s in all directions.
void subtract_force(const DiscreteOperators<2>& op, const Field& stress, Fields<2>& force) {
  for (std::size_t i = 0; i < force[0].size(); ++i)
    for (auto e = index_of(op.col_begin[i]); e < index_of(op.col_begin[i + 1]); ++e) {
      const double s = stress[index_of(op.point[e])];
      for (std::size_t k = 0; k < 2; ++k) force[k][i] -= s * op.weighted_gradient[k][e];
      if (op.of_revolution()) force[0][i] -= s * op.weighted_hoop[e];
    }
}

/// A connected part and the rigid motions that planes of symmetry leave it.
struct Part {
  Vec2 centre{0, 0};
  double nodes = 0.0, radius = 0.0;
  Eigen::Matrix3d held = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d free = Eigen::Matrix3d::Zero(); ///< projector on the free motions

  /// What a node at x moves along a direction in the three motions.
  Mode felt(const Vec2& x, const Vec2& direction) const {
    return {direction.x(), direction.y(), direction.dot(left_normal(x - centre)) / radius};
  }
};

class Parts {
public:
  Parts(const DiscreteOperators<2>& op, const std::vector<Vec2>& position, const Supports<2>& symmetry)
      : position_(position) {
    const std::vector<std::size_t> root = parts_of(op, position.size());
    std::vector<std::int32_t> number(position.size(), -1);
    for (std::size_t i = 0; i < position.size(); ++i) {
      if (root[i] == i) {
        number[i] = as<std::int32_t>(list_.size());
        list_.emplace_back();
      }
      of_node_.push_back(number[root[i]]);
      at(i).centre += position[i];
      at(i).nodes += 1.0;
    }
    for (Part& part : list_) part.centre /= part.nodes;
    for (std::size_t i = 0; i < position.size(); ++i)
      at(i).radius = std::max(at(i).radius, (position[i] - at(i).centre).norm());
    for (const auto& p : symmetry.prescribed()) {
      Part& part = at(index_of(p.node));
      const Mode felt = part.felt(position[index_of(p.node)], p.direction);
      part.held += felt * felt.transpose();
    }
    for (Part& part : list_) {
      if (op.of_revolution()) part.held += Mode(1.0, 0.0, 1.0).asDiagonal(); // only along the axis
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(part.held);
      for (Eigen::Index k = 0; k < 3; ++k)
        if (modes.eigenvalues()[k] <= 1e-9)
          part.free += modes.eigenvectors().col(k) * modes.eigenvectors().col(k).transpose();
    }
  }

  const std::vector<std::int32_t>& of_node() const { return of_node_; }
  int size() const { return static_cast<int>(list_.size()); }

  /// As few supports as hold all parts, each where it holds best.
  std::vector<Support<2>> pins() const {
    struct Best {
      double gain = 0.0;
      NodeIndex node{};
      Vec2 direction{0, 0};
      Mode felt = Mode::Zero();
    };
    std::vector<Eigen::Matrix3d> left;
    for (const Part& part : list_) left.push_back(part.free);
    std::vector<Support<2>> pins;
    for (int round = 0; round < 3; ++round) {
      std::vector<Best> best(list_.size());
      for (std::size_t i = 0; i < position_.size(); ++i) {
        const auto part = index_of(of_node_[i]);
        for (const Vec2& direction : {Vec2(1, 0), Vec2(0, 1)}) {
          const Mode felt = left[part] * list_[part].felt(position_[i], direction);
          if (felt.norm() > best[part].gain) best[part] = {felt.norm(), as<NodeIndex>(i), direction, felt};
        }
      }
      for (std::size_t part = 0; part < best.size(); ++part) {
        if (best[part].gain <= 1e-6) continue;
        left[part] -= best[part].felt * best[part].felt.transpose() / best[part].felt.squaredNorm();
        pins.push_back({"pin", Support<2>::Kind::symmetry, best[part].direction, {}, {best[part].node}});
      }
    }
    return pins;
  }

  /// Takes the mean rigid motion, as far as it is free, out of a displacement.
  void relieve(const Field& mass, Fields<2>& u) const {
    std::vector<Eigen::Matrix3d> inertia(list_.size(), Eigen::Matrix3d::Zero());
    std::vector<Mode> momentum(list_.size(), Mode::Zero());
    for (std::size_t i = 0; i < position_.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const Mode felt = at(i).free * at(i).felt(position_[i], Vec2::Unit(static_cast<Eigen::Index>(k)));
        inertia[index_of(of_node_[i])] += mass[i] * felt * felt.transpose();
        momentum[index_of(of_node_[i])] += mass[i] * u[k][i] * felt;
      }
    std::vector<Mode> mean;
    for (std::size_t part = 0; part < list_.size(); ++part) {
      // Held motions have no inertia here: their places are filled so that they stay zero.
      const double scale = std::max(inertia[part].trace(), 1e-300);
      const Eigen::Matrix3d filled = inertia[part] + scale * (Eigen::Matrix3d::Identity() - list_[part].free);
      mean.push_back(filled.ldlt().solve(momentum[part]));
    }
    for (std::size_t i = 0; i < position_.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const Mode felt = at(i).free * at(i).felt(position_[i], Vec2::Unit(static_cast<Eigen::Index>(k)));
        u[k][i] -= felt.dot(mean[index_of(of_node_[i])]);
      }
  }

private:
  Part& at(std::size_t node) { return list_[index_of(of_node_[node])]; }
  const Part& at(std::size_t node) const { return list_[index_of(of_node_[node])]; }

  const std::vector<Vec2>& position_;
  std::vector<std::int32_t> of_node_;
  std::vector<Part> list_;
};

double largest(const Fields<2>& f) {
  double most = 0.0;
  for (std::size_t i = 0; i < f[0].size(); ++i) most = std::max(most, std::hypot(f[0][i], f[1][i]));
  return most;
}

} // namespace

Springback springback(const StressedBody& body) {
  const std::size_t n = body.mass.size();
  std::vector<Vec2> position(n);
  for (std::size_t i = 0; i < n; ++i) position[i] = {body.position[0][i], body.position[1][i]};
  const DiscreteOperators<2> op = pushed_forward(body.approximation.mechanics, body.point);
  Fields<2> force = released_force(body);
  const Field cooling = cooling_stress(body);
  if (body.cooled_to) subtract_force(op, cooling, force);

  std::vector<Support<2>> held;
  for (const Support<2>& support : body.supports.list())
    if (support.kind == Support<2>::Kind::symmetry) held.push_back(support);
  const Parts parts(op, position, Supports<2>(held, n));
  const std::vector<Support<2>> pins = parts.pins();
  const auto first_pin = as<std::int32_t>(held.size());
  held.insert(held.end(), pins.begin(), pins.end());
  const Supports<2> supports(std::move(held), n);

  std::vector<plasticity::Elasticity> elasticity;
  for (const std::int32_t material : body.point.material)
    elasticity.push_back(body.materials[index_of(material)].elasticity);
  StaticSolution<2> solution = solve_statics<2>({.operators = op,
                                                 .position = position,
                                                 .links = body.approximation.links,
                                                 .link_points = op,
                                                 .elasticity = {},
                                                 .elasticity_of_point = elasticity,
                                                 .stabilisation = body.stabilisation,
                                                 .supports = supports,
                                                 .force = force});
  Springback result;
  result.displacement = solution.displacement;
  result.body = parts.of_node();
  result.bodies = parts.size();
  result.energy = solution.strain_energy + solution.stabilisation_energy;
  if (const double scale = largest(force); scale > 0.0)
    for (const auto& p : supports.prescribed()) {
      if (p.support < first_pin) continue;
      const auto i = index_of(p.node);
      const double along = p.direction.dot(Vec2(solution.reaction[0][i], solution.reaction[1][i]));
      result.residual = std::max(result.residual, std::abs(along) / scale);
    }
  result.stress_change = std::move(solution.stress);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t p = 0; p < cooling.size(); ++p) result.stress_change[k][p] += cooling[p];
  parts.relieve(body.mass, result.displacement);
  return result;
}

} // namespace cnem
