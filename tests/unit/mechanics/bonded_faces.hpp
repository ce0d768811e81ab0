#pragma once
// Two bonded faces without anything behind them.
#include "core/index.hpp"
#include "mechanics/cohesive_faces.hpp"

#include <array>
#include <vector>

namespace cnem::bonded_faces {

inline constexpr double K = 2e13, h = 1e-5;

inline plasticity::CohesiveLaw law() {
  plasticity::CohesiveLaw law{.stiffness = K,
                              .strength = 20e6,
                              .shear_strength = 30e6,
                              .energy = 100.0,
                              .shear_energy = 250.0,
                              .eta = 1.5};
  law.complete();
  return law;
}

/// Two faces along y = 0 with nodes at these places, the upper first.
inline Cloud<2> two_faces(const std::vector<double>& upper, const std::vector<double>& lower) {
  Cloud<2> cloud;
  cloud.piece_names = {"j+", "j-", "rest"};
  for (const double x : upper) cloud.position.push_back({x, 0.0});
  for (const double x : lower) cloud.position.push_back({x, 0.0});
  const auto node = [](std::size_t i) { return as<NodeIndex>(i); };
  for (std::size_t i = 0; i + 1 < upper.size(); ++i)
    cloud.facets.push_back({{node(i), node(i + 1)}, as<PieceIndex>(0)});
  for (std::size_t i = lower.size() - 1; i > 0; --i)
    cloud.facets.push_back({{node(upper.size() + i), node(upper.size() + i - 1)}, as<PieceIndex>(1)});
  return cloud;
}

/// With matter of this thickness (m) behind each of two_faces: their nodes come first, two of a back follow
/// for the upper and two for the lower.
inline Cloud<2> two_bodies(const std::vector<double>& upper, const std::vector<double>& lower,
                           double thickness) {
  Cloud<2> cloud = two_faces(upper, lower);
  const auto node = [](std::size_t i) { return as<NodeIndex>(i); };
  const auto close = [&](std::size_t end, std::size_t start, double y) {
    const std::size_t back = cloud.position.size();
    for (const std::size_t i : {end, start}) cloud.position.push_back({cloud.position[node(i)].x(), y});
    for (const auto& [a, b] :
         {std::array{end, back}, std::array{back, back + 1}, std::array{back + 1, start}})
      cloud.facets.push_back({{node(a), node(b)}, as<PieceIndex>(2)});
  };
  close(upper.size() - 1, 0, thickness);
  close(upper.size(), upper.size() + lower.size() - 1, -thickness);
  return cloud;
}

inline CohesiveFaces faces_of(const Cloud<2>& cloud, bool contact = false,
                              const std::vector<std::array<double, 2>>& open = {}) {
  return {{{"j", law(), {as<PieceIndex>(0), as<PieceIndex>(1)}, open}}, cloud, contact};
}

inline Fields<2> places(const Cloud<2>& cloud) {
  Fields<2> position;
  for (std::size_t k = 0; k < 2; ++k)
    for (const Vec2& x : cloud.position) position[k].push_back(x[static_cast<Eigen::Index>(k)]);
  return position;
}

inline const std::vector<double> matching{0, 1 * h, 2.5 * h, 3 * h, 4 * h};
inline const std::vector<double> other{0, 0.4 * h, 1.3 * h, 2.6 * h, 3.1 * h, 3.5 * h, 4 * h};

} // namespace cnem::bonded_faces
