#include "mechanics/statics/rigid_motion.hpp"

#include "core/index.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>

namespace cnem {

namespace {

struct Part {
  Vec2 centre{0, 0};
  double nodes = 0.0, radius = 0.0;
  Eigen::Matrix3d held = Eigen::Matrix3d::Zero(); ///< Σ r rᵀ, r what a direction feels of x, y, rotation
};

std::string describe(const Part& part, const Eigen::Vector3d& motion, bool several) {
  std::string where =
      several ? fmt::format(" of the part around ({:.4g}, {:.4g}) m", part.centre.x(), part.centre.y()) : "";
  if (std::abs(motion[2]) < 1e-6) {
    const bool x = std::abs(motion[0]) > std::abs(motion[1]);
    return fmt::format("nothing holds the translation{} along ({:.3g}, {:.3g}): expected a support with a "
                       "displacement in {} somewhere",
                       where, motion[0] + 0.0, motion[1] + 0.0, x ? "x" : "y");
  }
  const double angle = motion[2] / part.radius;
  Vec2 pole = part.centre + Vec2(-motion[1], motion[0]) / angle;
  for (Eigen::Index k = 0; k < 2; ++k)
    if (std::abs(pole[k]) < 1e-9 * part.radius) pole[k] = 0.0;
  return fmt::format(
      "nothing holds the rotation{} about ({:.4g}, {:.4g}) m: expected another support, with a "
      "displacement that is not along the line to that point",
      where, pole.x(), pole.y());
}

} // namespace

std::vector<std::size_t> parts_of(const DiscreteOperators<2>& op, std::size_t nodes) {
  std::vector<std::size_t> parent(nodes);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    const auto first = index_of(op.row_begin[p]), last = index_of(op.row_begin[p + 1]);
    for (std::size_t e = first + 1; e < last; ++e) {
      const auto a = index_of(op.node[first]), b = index_of(op.node[e]);
      if (a >= nodes || b >= nodes) continue; // enrichment
      const std::size_t ra = root(a), rb = root(b);
      parent[std::max(ra, rb)] = std::min(ra, rb);
    }
  }
  for (std::size_t i = 0; i < nodes; ++i) parent[i] = root(i);
  return parent;
}

std::string missing_support(const DiscreteOperators<2>& operators, const std::vector<Vec2>& position,
                            const Supports<2>& supports) {
  const std::vector<std::size_t> part_of = parts_of(operators, position.size());
  std::map<std::size_t, Part> parts;
  for (std::size_t i = 0; i < position.size(); ++i) {
    Part& part = parts[part_of[i]];
    part.centre += position[i];
    part.nodes += 1.0;
  }
  for (auto& [first, part] : parts) part.centre /= part.nodes;
  for (std::size_t i = 0; i < position.size(); ++i) {
    Part& part = parts[part_of[i]];
    part.radius = std::max(part.radius, (position[i] - part.centre).norm());
  }
  for (const auto& p : supports.prescribed()) {
    const auto i = index_of(p.node);
    Part& part = parts[part_of[i]];
    const Eigen::Vector3d felt(p.direction.x(), p.direction.y(),
                               p.direction.dot(left_normal(position[i] - part.centre)) / part.radius);
    part.held += felt * felt.transpose();
  }
  if (operators.of_revolution()) // only the axial translation is rigid
    for (auto& [first, part] : parts) part.held += Eigen::Vector3d(1.0, 0.0, 1.0).asDiagonal();
  for (const auto& [first, part] : parts) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(part.held);
    if (modes.eigenvalues()[0] <= 1e-9) return describe(part, modes.eigenvectors().col(0), parts.size() > 1);
  }
  return "";
}

} // namespace cnem
