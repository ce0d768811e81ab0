// Cohesive faces alone, on nodes that match and that do not: patches, momentum, potential, frequencies,
// parting, new nodes.
#include "core/index.hpp"
#include "mechanics/boundary_parting.hpp"
#include "mechanics/cohesive_faces.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>

namespace cnem {
namespace {

constexpr double K = 2e13, h = 1e-5;

plasticity::CohesiveLaw law() {
  plasticity::CohesiveLaw law{.stiffness = K,
                              .strength = 20e6,
                              .shear_strength = 30e6,
                              .energy = 100.0,
                              .shear_energy = 250.0,
                              .eta = 1.5};
  law.complete();
  return law;
}

/// Two faces along y = 0 with nodes at these places, the upper first; each is a loop with a node of its own.
Cloud<2> two_faces(const std::vector<double>& upper, const std::vector<double>& lower) {
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

CohesiveFaces faces_of(const Cloud<2>& cloud, bool contact = false,
                       const std::vector<std::array<double, 2>>& open = {}) {
  return {{{"j", law(), {as<PieceIndex>(0), as<PieceIndex>(1)}, open}}, cloud, contact};
}

Fields<2> places(const Cloud<2>& cloud) {
  Fields<2> position;
  for (std::size_t k = 0; k < 2; ++k)
    for (const Vec2& x : cloud.position) position[k].push_back(x[static_cast<Eigen::Index>(k)]);
  return position;
}

const std::vector<double> matching{0, 1 * h, 2.5 * h, 3 * h, 4 * h};
const std::vector<double> other{0, 0.4 * h, 1.3 * h, 2.6 * h, 3.1 * h, 3.5 * h, 4 * h};

double random_number(unsigned& seed) {
  return static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) / (1u << 24) - 0.5;
}

TEST(CohesiveFaces, constant_traction_is_shared_out_as_on_a_loaded_edge) {
  for (const auto& lower : {matching, other}) {
    const Cloud<2> cloud = two_faces(matching, lower);
    CohesiveFaces faces = faces_of(cloud);
    Fields<2> x = places(cloud);
    const double opening = 4e-6;
    for (std::size_t i = 0; i < matching.size(); ++i) x[1][i] += opening;
    const CohesiveWork work = faces.evaluate(x);
    const double first = 20e6 / K, last = 2 * 100.0 / 20e6, t = 20e6 * (last - opening) / (last - first);
    EXPECT_NEAR(work.stored, 0.5 * t * opening * 4 * h, 1e-12 * work.stored);
    const auto expect = [&](const std::vector<double>& nodes, std::size_t begin, double sign) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double left = i > 0 ? nodes[i] - nodes[i - 1] : 0.0;
        const double right = i + 1 < nodes.size() ? nodes[i + 1] - nodes[i] : 0.0;
        EXPECT_NEAR(faces.force()[1][begin + i], sign * 0.5 * (left + right) * t, 1e-12 * h * t);
        EXPECT_NEAR(faces.force()[0][begin + i], 0.0, 1e-12 * h * t);
      }
    };
    expect(matching, 0, -1.0);
    expect(lower, matching.size(), 1.0);
  }
}

TEST(CohesiveFaces, forces_have_neither_sum_nor_moment) {
  const Cloud<2> cloud = two_faces(matching, other);
  CohesiveFaces faces = faces_of(cloud);
  unsigned seed = 3;
  for (int look = 0; look < 50; ++look) {
    Fields<2> x = places(cloud);
    const double angle = 2.0 * std::numbers::pi * random_number(seed), c = std::cos(angle),
                 s = std::sin(angle);
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      const Vec2 p(x[0][i] + 0.4 * h * random_number(seed), 0.6 * h * random_number(seed));
      x[0][i] = c * p.x() - s * p.y() + h;
      x[1][i] = s * p.x() + c * p.y() - h;
    }
    faces.evaluate(x);
    Vec2 sum = Vec2::Zero();
    double moment = 0.0, size = 0.0;
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      const Vec2 f = vector_at<2>(faces.force(), i), at = vector_at<2>(x, i);
      sum += f;
      moment += cross(at, f);
      size += f.norm();
    }
    EXPECT_GT(size, 0.0);
    EXPECT_LT(sum.norm(), 1e-13 * size);
    EXPECT_LT(std::abs(moment), 1e-13 * size * 4 * h);
  }
}

TEST(CohesiveFaces, forces_are_the_gradient_of_what_is_stored) {
  const Cloud<2> cloud = two_faces(matching, other);
  unsigned seed = 11;
  Fields<2> x = places(cloud);
  for (std::size_t i = 0; i < x[0].size(); ++i) { // below onset, but turned by all of 0.5
    const Vec2 p(x[0][i] + 3e-6 * random_number(seed), 0.5 * x[0][i] + 3e-6 * random_number(seed));
    x[0][i] = p.x();
    x[1][i] = p.y();
  }
  CohesiveFaces faces = faces_of(cloud);
  faces.evaluate(x); // has damage
  faces.evaluate(x);
  const Fields<2> force = faces.force();
  double size = 0.0;
  for (std::size_t i = 0; i < x[0].size(); ++i) size = std::max(size, vector_at<2>(force, i).norm());
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      const double step = 1e-12; // m, so small that growth of damage is no part of the work
      const auto stored = [&](double by) {
        Fields<2> moved = x;
        moved[k][i] += by;
        CohesiveFaces copy = faces;
        const CohesiveWork work = copy.evaluate(moved);
        return work.stored + work.dissipated;
      };
      EXPECT_NEAR(force[k][i], -(stored(step) - stored(-step)) / (2 * step), 1e-5 * size) << k << " " << i;
    }
}

TEST(CohesiveFaces, frequency_is_bounded) {
  const Cloud<2> cloud = two_faces(matching, other);
  CohesiveFaces faces = faces_of(cloud);
  const Fields<2> x = places(cloud);
  const std::size_t n = x[0].size();
  Field mass(n);
  for (std::size_t i = 0; i < n; ++i) mass[i] = 1e-6 * (1.0 + static_cast<double>(i % 3));
  Eigen::MatrixXd matrix(2 * n, 2 * n);
  const double step = 1e-10;
  for (std::size_t j = 0; j < 2 * n; ++j) {
    std::array<Fields<2>, 2> force;
    for (std::size_t side = 0; side < 2; ++side) {
      Fields<2> moved = x;
      moved[j / n][j % n] += side == 0 ? step : -step;
      faces.evaluate(moved);
      force[side] = faces.force();
    }
    for (std::size_t i = 0; i < 2 * n; ++i)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          -(force[0][i / n][i % n] - force[1][i / n][i % n]) / (2 * step) /
          std::sqrt(mass[i % n] * mass[j % n]);
  }
  const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (matrix + matrix.transpose()))
                             .eigenvalues()
                             .maxCoeff();
  EXPECT_GE(faces.frequency_bound(mass), largest);
  EXPECT_LE(faces.frequency_bound(mass), 2.0 * largest);
}

TEST(CohesiveFaces, parting_changes_no_traction) {
  const Cloud<2> cloud = two_faces(matching, matching);
  CohesiveFaces faces = faces_of(cloud);
  Fields<2> x = places(cloud);
  for (std::size_t i = 1; i < matching.size(); ++i) { // the first pair coincides
    x[1][i] -= 1e-9 * static_cast<double>(i);
    x[0][i] += 1e-6;
  }
  faces.evaluate(x);
  const Fields<2> before = faces.force();
  double size = 0.0;
  for (std::size_t i = 0; i < x[0].size(); ++i) size = std::max(size, vector_at<2>(before, i).norm());
  faces.part(x);
  EXPECT_EQ(x[1][0], 0.0);
  for (std::size_t i = 1; i < matching.size(); ++i) {
    EXPECT_GT(x[1][i], x[1][matching.size() + i]);
    EXPECT_LT(x[1][i] - x[1][matching.size() + i], 1e-3 * h);
  }
  const CohesiveWork work = faces.evaluate(x);
  EXPECT_EQ(work.dissipated, 0.0);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < x[0].size(); ++i) EXPECT_NEAR(faces.force()[k][i], before[k][i], 1e-3 * size);
  const Fields<2> parted = x;
  faces.part(x);
  EXPECT_EQ(x, parted);
}

/// m, how far a point lies above a face whose nodes are these, in the order of x; nothing beside it.
std::optional<double> height_above(const Fields<2>& x, std::size_t first, std::size_t count, const Vec2& of) {
  for (std::size_t i = first; i + 1 < first + count; ++i) {
    const double place = (of.x() - x[0][i]) / (x[0][i + 1] - x[0][i]);
    if (place >= 0.0 && place <= 1.0) return of.y() - std::lerp(x[1][i], x[1][i + 1], place);
  }
  return std::nullopt;
}

/// Faces that slide over waves overlap elsewhere than where they were bonded.
TEST(CohesiveFaces, parting_sets_apart_what_has_slid_over_waves) {
  std::vector<double> grid;
  for (int i = 0; i <= 40; ++i) grid.push_back(i * h);
  const Cloud<2> cloud = two_faces(grid, grid);
  for (const double slip : {0.3 * h, 0.8 * h, 2.0 * h}) {
    CohesiveFaces faces = faces_of(cloud);
    Fields<2> x = places(cloud);
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      x[1][i] = 0.5 * h * std::sin(0.9 * x[0][i] / h);
      if (i < grid.size()) x[0][i] += slip, x[1][i] += 0.3 * slip;
    }
    const auto deepest = [&] {
      double deep = 0.0;
      for (std::size_t i = 0; i < x[0].size(); ++i) {
        const bool above = i < grid.size();
        const auto height = height_above(x, above ? grid.size() : 0, grid.size(), vector_at<2>(x, i));
        if (height) deep = std::max(deep, above ? -*height : *height);
      }
      return deep;
    };
    EXPECT_GT(deepest(), 0.01 * h) << slip / h;
    faces.part(x);
    EXPECT_LE(deepest(), 0.0) << slip / h;
  }
}

/// What is broken and has gone is no business of the pairs that it once made.
TEST(CohesiveFaces, parting_leaves_alone_what_has_slid_away) {
  const Cloud<2> cloud = two_faces(matching, matching);
  CohesiveFaces faces = faces_of(cloud, true, {{0.0, 4 * h}});
  Fields<2> x = places(cloud);
  for (std::size_t i = 0; i < matching.size(); ++i) { // turned by a right angle, beside the lower face
    x[0][i] = -2 * h;
    x[1][i] = -matching[i] - h;
  }
  const Fields<2> before = x;
  faces.part(x);
  EXPECT_EQ(x, before);
}

// Where a body has been cut through, a face ends in a corner that can lie in the other one.
TEST(CohesiveFaces, parting_asks_the_last_node_of_a_face_too) {
  const Cloud<2> cloud = two_faces(matching, other);
  CohesiveFaces faces = faces_of(cloud, true, {{0.0, 4 * h}});
  Fields<2> x = places(cloud);
  const std::size_t last = matching.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) x[0][i] -= 0.7 * h, x[1][i] = i < last ? 0.1 * h : -0.02 * h;
  EXPECT_EQ(faces.part(x), nullptr);
  const std::size_t a = matching.size() + 4, b = a + 1; // the segment below it
  ASSERT_LT(x[0][a], x[0][last]);
  ASSERT_GT(x[0][b], x[0][last]);
  const double at = (x[0][last] - x[0][a]) / (x[0][b] - x[0][a]);
  EXPECT_GT(x[1][last] - (1.0 - at) * x[1][a] - at * x[1][b], 0.0);
}

/// A square of side 1 with a node in the middle of its upper side, and a triangle that stands on it.
Cloud<2> standing_on_a_square(double deep) {
  Cloud<2> cloud;
  const auto loop = [&](const std::vector<Vec2>& points) {
    const std::size_t first = cloud.position.size();
    for (std::size_t k = 0; k < points.size(); ++k) {
      cloud.position.push_back(points[k]);
      const std::size_t next = first + (k + 1) % points.size();
      cloud.facets.push_back({{as<NodeIndex>(first + k), as<NodeIndex>(next)}, as<PieceIndex>(0)});
    }
  };
  loop({{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0, 1}});
  loop({{0.3, 1 - deep}, {0.6, 1.5}, {0, 1.5}});
  return cloud;
}

TEST(PartBoundary, sets_apart_what_contact_has_left) {
  for (const double deep : {1e-8, 4e-4}) {
    const Cloud<2> cloud = standing_on_a_square(deep);
    Fields<2> x = places(cloud);
    part_boundary(cloud, x);
    const double at = 2.0 * x[0][5]; // between nodes 4 and 3
    EXPECT_GT(x[1][5], (1.0 - at) * x[1][4] + at * x[1][3]);
    for (std::size_t i = 0; i < x[0].size(); ++i)
      EXPECT_LT((vector_at<2>(x, i) - cloud.position[as<NodeIndex>(i)]).norm(), deep + 1e-6)
          << i; // and what is kept
  }
}

TEST(PartBoundary, leaves_what_is_apart_or_deep_and_turns_no_film_inside_out) {
  Cloud<2> film;
  for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 4e-4), Vec2(0.5, 4e-4), Vec2(0, 4e-4)})
    film.position.push_back(at);
  for (std::size_t k = 0; k < 5; ++k)
    film.facets.push_back({{as<NodeIndex>(k), as<NodeIndex>((k + 1) % 5)}, as<PieceIndex>(0)});
  for (const Cloud<2>& cloud : {standing_on_a_square(-1e-6), standing_on_a_square(0.1), film}) {
    Fields<2> x = places(cloud);
    part_boundary(cloud, x);
    EXPECT_EQ(x, places(cloud));
  }
}

TEST(CohesiveFaces, contact_is_told_what_pressed_a_bond_that_broke_until_its_faces_are_parted) {
  const Cloud<2> cloud = two_faces(matching, matching);
  CohesiveFaces faces = faces_of(cloud, true);
  Fields<2> x = places(cloud);
  for (std::size_t i = 0; i < matching.size(); ++i) x[0][i] += 2 * h, x[1][i] = -1e-8;
  faces.evaluate(x);
  ASSERT_NEAR(CohesiveFaces::broken_length(faces.interfaces()[0]), 4 * h, 1e-18);
  const auto pressed = [&](std::size_t i) { return faces.bonds(cloud).pressed[as<NodeIndex>(i)]; };
  for (std::size_t i = 0; i < x[0].size(); ++i) EXPECT_NEAR(pressed(i), 1e-8, 1e-16) << i;
  EXPECT_EQ(faces.part(x), nullptr);
  for (std::size_t i = 0; i < x[0].size(); ++i) EXPECT_EQ(pressed(i), 0.0) << i;
}

TEST(CohesiveFaces, open_parts_bear_nothing_and_are_left_to_contact) {
  const Cloud<2> cloud = two_faces(matching, matching);
  CohesiveFaces faces = faces_of(cloud, true, {{0.0, 2.5 * h}});
  EXPECT_NEAR(CohesiveFaces::broken_length(faces.interfaces()[0]), 2.5 * h, 1e-18);
  Fields<2> x = places(cloud);
  for (std::size_t i = 0; i < matching.size(); ++i) x[1][i] -= 1e-8;
  faces.evaluate(x);
  EXPECT_EQ(faces.force()[1][1], 0.0);
  EXPECT_NEAR(faces.force()[1][3], K * 1e-8 * 0.75 * h, 1e-10 * K * 1e-8 * h);
  const contact::Bonds bonds = faces.bonds(cloud);
  EXPECT_EQ(bonds.bonded[as<NodeIndex>(1)], -1);
  EXPECT_EQ(bonds.bonded[as<NodeIndex>(3)], 0);
  EXPECT_EQ(bonds.bonded[as<NodeIndex>(matching.size() + 3)], 1);
  const auto joins = [&](std::size_t node, std::size_t facet) {
    return bonds.joins(as<NodeIndex>(node), as<CloudFacetIndex>(facet));
  };
  EXPECT_TRUE(joins(3, 4) && joins(4, 4)) << "the last two nodes, and the facet across from them";
  EXPECT_FALSE(joins(1, 4)) << "is broken";
  EXPECT_FALSE(joins(4, 7)) << "is elsewhere";
}

/// Splits the upper face's second segment in the middle.
Resampling<2> one_more_node(const Cloud<2>& cloud) {
  Resampling<2> change;
  change.cloud = cloud;
  const std::size_t n = cloud.position.size();
  const NodeIndex a = as<NodeIndex>(1), b = as<NodeIndex>(2), made = as<NodeIndex>(n);
  change.cloud.position.push_back(0.5 * (cloud.position[a] + cloud.position[b]));
  change.cloud.facets[as<CloudFacetIndex>(1)].node = {a, made};
  change.cloud.facets.push_back({{made, b}, as<PieceIndex>(0)});
  change.labels.begin.assign(1, 0);
  for (std::size_t i = 0; i <= n; ++i) {
    const NodeIndex old = i < n ? as<NodeIndex>(i) : NodeIndex::none;
    change.old_of.push_back(old);
    if (i < n) change.new_of.push_back(old);
    for (const NodeIndex from : i < n ? std::vector{old} : std::vector{a, b}) {
      change.labels.from.push_back(from);
      change.labels.weight.push_back(i < n ? 1.0 : 0.5);
    }
    change.labels.begin.push_back(static_cast<std::int32_t>(change.labels.from.size()));
  }
  return change;
}

TEST(CohesiveFaces, new_nodes_interpolate_arc_length_and_damage) {
  const Cloud<2> cloud = two_faces(matching, matching);
  CohesiveFaces faces = faces_of(cloud);
  Fields<2> x = places(cloud);
  x[1][2] += 5e-6; // tears there and beside
  faces.evaluate(x);
  const CohesiveInterface before = faces.interfaces()[0];
  const Resampling<2> change = one_more_node(cloud);
  faces.resample(change);
  const CohesiveInterface& after = faces.interfaces()[0];
  ASSERT_EQ(after.element.size(), before.element.size() + 1);
  EXPECT_EQ(after.face[0][1].arc[1], 1.75 * h);
  EXPECT_EQ(after.face[0][2].node[0], as<NodeIndex>(10));
  EXPECT_EQ(after.state[1][0].damage, before.state[1][0].damage);
  EXPECT_EQ(after.state[2][1].damage, before.state[1][1].damage);
  EXPECT_NEAR(after.state[1][1].damage, 0.5 * (before.state[1][0].damage + before.state[1][1].damage), 1e-15);
  EXPECT_GT(before.state[1][1].damage, 0.5);
  EXPECT_EQ(after.state[3][0].damage, before.state[2][0].damage);
  for (std::size_t k = 0; k < 2; ++k) x[k].push_back(0.5 * (x[k][1] + x[k][2]));
  const CohesiveWork work = faces.evaluate(x);
  EXPECT_GT(work.stored, 0.0);
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < x[0].size(); ++i) sum += vector_at<2>(faces.force(), i);
  EXPECT_LT(sum.norm(), 1e-12 * std::abs(faces.force()[1][2]));
}

TEST(CohesiveFaces, nothing_heals_where_nodes_come) {
  const Cloud<2> cloud = two_faces(matching, matching);
  CohesiveFaces faces = faces_of(cloud);
  Fields<2> x = places(cloud);
  x[1][2] += 25e-6; // breaks there alone
  faces.evaluate(x);
  const double broken = CohesiveFaces::broken_length(faces.interfaces()[0]);
  EXPECT_NEAR(broken, 1.0 * h, 1e-18);
  faces.resample(one_more_node(cloud));
  EXPECT_NEAR(CohesiveFaces::broken_length(faces.interfaces()[0]), broken, 1e-18);
}

} // namespace
} // namespace cnem
