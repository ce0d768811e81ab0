// Faces that lie in each other are set apart, bonded ones without a change of their traction.
#include "mechanics/boundary_parting.hpp"
#include "tests/unit/mechanics/bonded_faces.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

namespace cnem {
namespace {

using namespace bonded_faces;

TEST(CohesiveParting, changes_no_traction) {
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
  faces.part(cloud, x);
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
  faces.part(cloud, x);
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
TEST(CohesiveParting, sets_apart_what_has_slid_over_waves) {
  std::vector<double> grid;
  for (int i = 0; i <= 40; ++i) grid.push_back(i * h);
  const Cloud<2> cloud = two_bodies(grid, grid, 10 * h);
  for (const double slip : {0.3 * h, 0.8 * h, 2.0 * h}) {
    CohesiveFaces faces = faces_of(cloud);
    Fields<2> x = places(cloud);
    for (std::size_t i = 0; i < 2 * grid.size(); ++i) {
      x[1][i] = 0.5 * h * std::sin(0.9 * x[0][i] / h);
      if (i < grid.size()) x[0][i] += slip, x[1][i] += 0.3 * slip;
    }
    const auto deepest = [&] {
      double deep = 0.0;
      for (std::size_t i = 0; i < 2 * grid.size(); ++i) {
        const bool above = i < grid.size();
        const auto height = height_above(x, above ? grid.size() : 0, grid.size(), vector_at<2>(x, i));
        if (height) deep = std::max(deep, above ? -*height : *height);
      }
      return deep;
    };
    EXPECT_GT(deepest(), 0.01 * h) << slip / h;
    faces.part(cloud, x);
    EXPECT_LE(deepest(), 0.0) << slip / h;
  }
}

/// What is broken and has gone is no business of the pairs that it once made.
TEST(CohesiveParting, leaves_alone_what_has_slid_away) {
  const Cloud<2> cloud = two_faces(matching, matching);
  CohesiveFaces faces = faces_of(cloud, true, {{0.0, 4 * h}});
  Fields<2> x = places(cloud);
  for (std::size_t i = 0; i < matching.size(); ++i) { // turned by a right angle, beside the lower face
    x[0][i] = -2 * h;
    x[1][i] = -matching[i] - h;
  }
  const Fields<2> before = x;
  faces.part(cloud, x);
  EXPECT_EQ(x, before);
}

/// A sliver of the upper body has come to lie under the lower one, which is a film: it is nearer to the
/// film's upper side than faces lie in each other, and yet in no matter.
TEST(CohesiveParting, leaves_alone_what_stands_beyond_a_film) {
  const Cloud<2> cloud = two_bodies(matching, matching, 0.2 * h);
  CohesiveFaces faces = faces_of(cloud, true, {{0.0, 4 * h}});
  const auto under_the_film = [&](double y) { // its lower face there, its upper one higher by 0.15 h
    Fields<2> x = places(cloud);
    for (std::size_t i = 0; i < matching.size(); ++i) x[1][i] = y;
    for (const std::size_t back : {0U, 1U}) x[1][2 * matching.size() + back] = y + 0.15 * h;
    return x;
  };
  const Fields<2> beyond = under_the_film(-0.4 * h);
  Fields<2> x = beyond;
  EXPECT_EQ(faces.part(cloud, x), nullptr);
  EXPECT_EQ(x, beyond);
  Fields<2> within = under_the_film(-0.1 * h);
  EXPECT_EQ(faces.part(cloud, within), nullptr);
  EXPECT_NE(within, under_the_film(-0.1 * h));
}

// Where a body has been cut through, a face ends in a corner that can lie in the other one.
TEST(CohesiveParting, asks_the_last_node_of_a_face_too) {
  const Cloud<2> cloud = two_bodies(matching, other, h);
  CohesiveFaces faces = faces_of(cloud, true, {{0.0, 4 * h}});
  Fields<2> x = places(cloud);
  const std::size_t last = matching.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) x[0][i] -= 0.7 * h, x[1][i] = i < last ? 0.1 * h : -0.02 * h;
  EXPECT_EQ(faces.part(cloud, x), nullptr);
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

TEST(CohesiveParting, contact_is_told_what_pressed_a_bond_that_broke_until_its_faces_are_parted) {
  const Cloud<2> cloud = two_bodies(matching, matching, h);
  CohesiveFaces faces = faces_of(cloud, true);
  Fields<2> x = places(cloud);
  for (std::size_t i = 0; i < matching.size(); ++i) x[0][i] += 2 * h, x[1][i] = -1e-8;
  faces.evaluate(x);
  ASSERT_NEAR(CohesiveFaces::broken_length(faces.interfaces()[0]), 4 * h, 1e-18);
  const auto pressed = [&](std::size_t i) { return faces.bonds(cloud).pressed[as<NodeIndex>(i)]; };
  const std::size_t of_faces = 2 * matching.size();
  for (std::size_t i = 0; i < of_faces; ++i) EXPECT_NEAR(pressed(i), 1e-8, 1e-16) << i;
  EXPECT_EQ(faces.part(cloud, x), nullptr);
  for (std::size_t i = 0; i < of_faces; ++i) EXPECT_EQ(pressed(i), 0.0) << i;
}

} // namespace
} // namespace cnem
