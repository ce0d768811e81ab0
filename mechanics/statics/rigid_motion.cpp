#include "mechanics/statics/rigid_motion.hpp"

#include "core/disjoint_sets.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace cnem {

namespace {

/// Translations, then rotations about the centre of a part times its radius.
template<int dim> inline constexpr int motions = dim == 2 ? 3 : 6;
template<int dim> using Motion = Eigen::Vector<double, motions<dim>>;

template<int dim> struct Part {
  Vec<dim> centre = Vec<dim>::Zero();
  double nodes = 0.0, radius = 0.0;
  /// Σ r rᵀ, r what a prescribed direction feels of each motion.
  Eigen::Matrix<double, motions<dim>, motions<dim>> held =
      Eigen::Matrix<double, motions<dim>, motions<dim>>::Zero();

  Motion<dim> felt(const Vec<dim>& x, const Vec<dim>& direction) const {
    const Vec<dim> arm = x - centre;
    if constexpr (dim == 2) {
      return {direction.x(), direction.y(), direction.dot(left_normal(arm)) / radius};
    } else {
      Motion<3> motion;
      motion << direction, arm.cross(direction) / radius;
      return motion;
    }
  }
};

constexpr double nothing = 1e-9; ///< eigenvalues below it are zero

std::string describe_translation(const auto& direction, const std::string& where) {
  Eigen::Index most = 0;
  direction.cwiseAbs().maxCoeff(&most);
  constexpr const char* names[] = {"x", "y", "z"};
  const auto shown = (direction.array() + 0.0).matrix().eval(); // no -0
  return fmt::format("nothing holds the translation{} along {}: expected a support with a displacement in {} "
                     "somewhere",
                     where, place_text(shown, 3), names[most]);
}

std::string describe_rotation(const Part<2>& part, const Motion<2>& motion, const std::string& where) {
  const double angle = motion[2] / part.radius;
  Vec2 pole = part.centre + Vec2(-motion[1], motion[0]) / angle;
  for (Eigen::Index k = 0; k < 2; ++k)
    if (std::abs(pole[k]) < 1e-9 * part.radius) pole[k] = 0.0;
  return fmt::format("nothing holds the rotation{} about {} m: expected another support, with a displacement "
                     "that is not along the line to that point",
                     where, place_text(pole, 4));
}

std::string describe_rotation(const Part<3>& part, const Motion<3>& motion, const std::string& where) {
  const Vec<3> turn = motion.tail<3>() / part.radius;
  Vec<3> axis = turn.normalized(),
         pole = part.centre + turn.cross(Vec<3>(motion.head<3>())) / turn.squaredNorm();
  pole -= axis * axis.dot(pole - part.centre);
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (std::abs(pole[k]) < 1e-9 * part.radius) pole[k] = 0.0;
    if (std::abs(axis[k]) < 1e-9) axis[k] = 0.0;
  }
  return fmt::format("nothing holds the rotation{} about the axis along {} through {} m: expected another "
                     "support, with a displacement that turns about it",
                     where, place_text(axis, 3), place_text(pole, 4));
}

/// The first motion that is free, in words; a translation if there is one. Empty: none.
template<int dim> std::string free_motion(const Part<dim>& part, bool several) {
  const std::string where =
      several ? fmt::format(" of the part around {} m", place_text(part.centre, 4)) : std::string();
  const Mat<dim> translations = part.held.template topLeftCorner<dim, dim>();
  const Eigen::SelfAdjointEigenSolver<Mat<dim>> along(translations);
  if (along.eigenvalues()[0] <= nothing) return describe_translation(along.eigenvectors().col(0), where);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, motions<dim>, motions<dim>>> modes(part.held);
  if (modes.eigenvalues()[0] <= nothing) return describe_rotation(part, modes.eigenvectors().col(0), where);
  return "";
}

} // namespace

template<int dim> std::vector<std::size_t> parts_of(const DiscreteOperators<dim>& op, std::size_t nodes) {
  DisjointSets together(nodes);
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    const auto first = index_of(op.row_begin[p]), last = index_of(op.row_begin[p + 1]);
    for (std::size_t e = first + 1; e < last; ++e) {
      const auto a = index_of(op.node[first]), b = index_of(op.node[e]);
      if (a >= nodes || b >= nodes) continue; // enrichment
      together.join(a, b);
    }
  }
  std::vector<std::size_t> part(nodes);
  for (std::size_t i = 0; i < nodes; ++i) part[i] = together.first(i);
  return part;
}

template<int dim>
std::string missing_support(const DiscreteOperators<dim>& operators, const std::vector<Vec<dim>>& position,
                            const Supports<dim>& supports) {
  const std::vector<std::size_t> part_of = parts_of(operators, position.size());
  std::map<std::size_t, Part<dim>> parts;
  for (std::size_t i = 0; i < position.size(); ++i) {
    Part<dim>& part = parts[part_of[i]];
    part.centre += position[i];
    part.nodes += 1.0;
  }
  for (auto& [first, part] : parts) part.centre /= part.nodes;
  for (std::size_t i = 0; i < position.size(); ++i) {
    Part<dim>& part = parts[part_of[i]];
    part.radius = std::max(part.radius, (position[i] - part.centre).norm());
  }
  for (const auto& p : supports.prescribed()) {
    Part<dim>& part = parts[part_of[index_of(p.node)]];
    const Motion<dim> felt = part.felt(position[index_of(p.node)], p.direction);
    part.held += felt * felt.transpose();
  }
  if constexpr (dim == 2)
    if (operators.of_revolution()) // only the axial translation is rigid
      for (auto& [first, part] : parts) part.held += Eigen::Vector3d(1.0, 0.0, 1.0).asDiagonal();
  for (const auto& [first, part] : parts)
    if (std::string motion = free_motion(part, parts.size() > 1); !motion.empty()) return motion;
  return "";
}

template std::vector<std::size_t> parts_of(const DiscreteOperators<2>&, std::size_t);
template std::vector<std::size_t> parts_of(const DiscreteOperators<3>&, std::size_t);
template std::string missing_support(const DiscreteOperators<2>&, const std::vector<Vec<2>>&,
                                     const Supports<2>&);
template std::string missing_support(const DiscreteOperators<3>&, const std::vector<Vec<3>>&,
                                     const Supports<3>&);

} // namespace cnem
