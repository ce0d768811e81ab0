// Cohesive faces alone, on nodes that match and that do not: patches, momentum, potential, frequencies, new
// nodes.
#include "tests/unit/mechanics/bonded_faces.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cnem {
namespace {

using namespace bonded_faces;

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

/// The largest square of a frequency of two faces alone at places, by differences of their forces, 1/s².
double largest_frequency(CohesiveFaces faces, const Fields<2>& x, const Field& mass) {
  const std::size_t n = x[0].size();
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
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (matrix + matrix.transpose()))
      .eigenvalues()
      .maxCoeff();
}

TEST(CohesiveFaces, frequency_is_bounded) {
  const Cloud<2> cloud = two_faces(matching, other);
  const CohesiveFaces faces = faces_of(cloud);
  const Fields<2> x = places(cloud);
  Field mass(x[0].size());
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = 1e-6 * (1.0 + static_cast<double>(i % 3));
  const double largest = largest_frequency(faces, x, mass);
  EXPECT_GE(faces.frequency_bound(x, mass), largest);
  EXPECT_LE(faces.frequency_bound(x, mass), 2.0 * largest);
}

/// Pressed together after they have slid by some facets, still bonded: the couple has lever arms of as many.
TEST(CohesiveFaces, frequency_is_bounded_where_faces_have_slid) {
  const Cloud<2> cloud = two_faces(matching, {0, 0.99 * h, 1.01 * h, 2.5 * h, 3 * h, 4 * h});
  const double slid = 1.2 * h;
  CohesiveFaces faces = faces_of(cloud, true);
  Fields<2> x = places(cloud);
  const Field mass(x[0].size(), 1e-6);
  const double at_rest = largest_frequency(faces, x, mass);
  for (std::size_t i = 0; i < matching.size(); ++i) x[0][i] += slid, x[1][i] -= 1e-6;
  faces.evaluate(x);
  const double largest = largest_frequency(faces, x, mass);
  EXPECT_GT(largest, 3.0 * at_rest);
  EXPECT_GE(faces.frequency_bound(x, mass), largest);
  EXPECT_LE(faces.frequency_bound(x, mass), 4.0 * largest);
}

TEST(CohesiveFaces, that_have_turned_across_each_other_are_broken) {
  for (const bool contact : {false, true})
    for (const double turn : {0.45, 0.55}) { // of π
      const Cloud<2> cloud = two_faces(matching, matching);
      CohesiveFaces faces = faces_of(cloud, contact);
      Fields<2> x = places(cloud);
      const auto turned = [&](double by) { // the upper face comes into the lower one
        Fields<2> to = x;
        for (std::size_t i = 0; i < matching.size(); ++i) {
          to[1][i] = -x[0][i] * std::sin(by * std::numbers::pi);
          to[0][i] = x[0][i] * std::cos(by * std::numbers::pi);
        }
        return to;
      };
      const double stored = faces.evaluate(turned(0.45)).stored;
      const CohesiveWork work = faces.evaluate(turned(turn));
      const bool across = turn > 0.5;
      EXPECT_EQ(CohesiveFaces::broken_length(faces.interfaces()[0]) > 3.9 * h, across);
      EXPECT_EQ(work.stored, across ? 0.0 : stored);
      EXPECT_EQ(work.dissipated > 0.9 * stored, across) << "what was stored is booked";
      double size = 0.0;
      for (std::size_t i = 0; i < x[0].size(); ++i) size += vector_at<2>(faces.force(), i).norm();
      EXPECT_EQ(size == 0.0, across);
      EXPECT_EQ(faces.evaluate(turned(turn)).dissipated, 0.0) << "once";
    }
}

TEST(CohesiveFaces, that_are_open_without_contact_do_not_bound_the_step_by_how_far) {
  const Cloud<2> cloud = two_faces(matching, matching);
  CohesiveFaces faces = faces_of(cloud);
  Fields<2> x = places(cloud);
  const Field mass(x[0].size(), 1e-6);
  const double closed = faces.frequency_bound(x, mass);
  for (std::size_t i = 0; i < matching.size(); ++i) x[1][i] += 100 * h;
  faces.evaluate(x);
  EXPECT_NEAR(faces.frequency_bound(x, mass), closed, 1e-12 * closed);
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
  change.old_position = cloud.position;
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
  change.parcels = change.labels;
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

/// The middle node of the upper face stands out by `height` and goes.
Resampling<2> without_middle_node(const Cloud<2>& cloud, double height) {
  Resampling<2> change;
  change.cloud = cloud;
  change.old_position = cloud.position;
  change.old_position[as<NodeIndex>(2)].y() += height;
  change.cloud.position.erase(change.cloud.position.begin() + 2);
  change.cloud.facets.clear();
  const auto renumbered = [](NodeIndex i) { return as<NodeIndex>(index_of(i) - (index_of(i) > 2 ? 1 : 0)); };
  for (const Facet<2>& facet : cloud.facets) {
    const auto [a, b] = facet.node;
    if (a == as<NodeIndex>(2)) continue;
    change.cloud.facets.push_back(
        {{renumbered(a), renumbered(b == as<NodeIndex>(2) ? as<NodeIndex>(3) : b)}, facet.piece});
  }
  change.labels.begin.assign(1, 0);
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    change.new_of.push_back(i == 2 ? NodeIndex::none : renumbered(as<NodeIndex>(i)));
    if (i == 2) continue;
    change.old_of.push_back(as<NodeIndex>(i));
    change.labels.from.push_back(as<NodeIndex>(i));
    change.labels.weight.push_back(1.0);
    change.labels.begin.push_back(static_cast<std::int32_t>(change.labels.from.size()));
  }
  change.parcels = change.labels;
  return change;
}

TEST(CohesiveFaces, break_where_the_face_is_laid_elsewhere) {
  for (const auto& [height, broken] : {std::pair{0.9 * h, 0.0}, {1.1 * h, 1.0}}) {
    const Cloud<2> cloud = two_faces(matching, matching);
    CohesiveFaces faces = faces_of(cloud, true);
    faces.resample(without_middle_node(cloud, height)); // of a facet of 2 h
    const CohesiveInterface& after = faces.interfaces()[0];
    ASSERT_EQ(after.element.size(), 4u);
    EXPECT_EQ(after.state[1][0].damage, 0.0);
    EXPECT_EQ(after.state[1][1].damage, broken);
    EXPECT_EQ(after.state[2][0].damage, broken);
    EXPECT_EQ(after.state[2][1].damage, 0.0);
  }
}

TEST(CohesiveFaces, end_at_the_node_that_their_last_one_went_into) {
  Cloud<2> cloud = two_faces(matching, matching);
  const NodeIndex last = as<NodeIndex>(matching.size() - 1), corner = as<NodeIndex>(cloud.position.size());
  cloud.position.push_back({4.01 * h, 0.0});
  cloud.facets.push_back({{last, corner}, as<PieceIndex>(2)});
  for (const bool carried : {false, true}) {
    CohesiveFaces faces = faces_of(cloud, true);
    Resampling<2> change;
    change.cloud = cloud;
    change.old_position = cloud.position;
    change.cloud.facets.pop_back();
    change.cloud.facets[as<CloudFacetIndex>(matching.size() - 2)].node[1] = corner;
    change.parcels.begin.assign(1, 0);
    for (std::size_t i = 0; i < cloud.position.size(); ++i) { // the last stays where it is, on no facet
      const auto node = as<NodeIndex>(i);
      change.new_of.push_back(node == last ? NodeIndex::none : node);
      change.old_of.push_back(node == last ? NodeIndex::none : node);
      change.parcels.from.push_back(node);
      change.parcels.weight.push_back(1.0);
      if (carried && node == corner) {
        change.parcels.from.push_back(last);
        change.parcels.weight.push_back(1.0);
      }
      change.parcels.begin.push_back(static_cast<std::int32_t>(change.parcels.from.size()));
    }
    change.labels = change.parcels;
    faces.resample(change);
    const CohesiveInterface& after = faces.interfaces()[0];
    EXPECT_EQ(after.element.size(), carried ? 4u : 3u);
    EXPECT_EQ(after.face[0].back().node[1] == corner, carried);
    EXPECT_NEAR(after.face[0].back().arc[1], carried ? 4 * h : 3 * h, 1e-12 * h);
  }
}

} // namespace
} // namespace cnem
