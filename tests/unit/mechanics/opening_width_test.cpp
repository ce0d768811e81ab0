// Widths over which methods spread openings between nodes, in units of the spacing.
#include "mechanics/opening_width.hpp"

#include "core/index.hpp"
#include "methods/registry.hpp"
#include "tests/clouds.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

constexpr double width_spacing = 0.1;

/// The unit square with its operators.
struct SquareOperators {
  Cloud<2> cloud;
  DiscreteOperators<2> operators;
  Field place;

  explicit SquareOperators(const char* method, const Mat2& stretch = Mat2::Identity(),
                           const methods::Options& options = {}, Lattice lattice = Lattice::square) {
    add_loop(cloud, rectangle(1, 1), width_spacing);
    fill(cloud, lattice, width_spacing, 0.0, 0.5 * width_spacing, 1);
    for (Vec2& x : cloud.position) x = stretch * x;
    operators = methods::make<2>(method, options)->rebuild(cloud).mechanics;
    for (const Vec2& x : cloud.position) place.insert(place.end(), {x.x(), x.y()});
  }
  double width(std::size_t p, const Vec2& n) const {
    return opening_width(operators, place, p, n, n) / width_spacing;
  }
  std::size_t node_at(const Vec2& x) const {
    for (std::size_t i = 0; i < index_of(cloud.nodes()); ++i)
      if ((cloud.position[i] - x).norm() < 1e-9) return i;
    return index_of(cloud.nodes());
  }
  std::size_t nearest(const Vec2& x) const {
    std::size_t best = 0;
    for (std::size_t i = 0; i < index_of(cloud.nodes()); ++i)
      if ((cloud.position[i] - x).norm() < (cloud.position[best] - x).norm()) best = i;
    return best;
  }
  /// Mean over openings everywhere and volume: what those points that see an opening come to, over its area.
  double counted(const Vec2& n) const {
    double sum = 0.0, area = 0.0;
    for (std::size_t p = 0; p < index_of(operators.points); ++p) {
      sum += operators.volume[p] * seen(p, n) / (width_spacing * width(p, n));
      area += operators.volume[p];
    }
    return sum / area;
  }

private:
  /// m: openings at so many places along n does the point see.
  double seen(std::size_t p, const Vec2& n) const {
    double low = INFINITY, high = -INFINITY;
    for (auto e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e) {
      const double share = std::abs(n.x() * operators.gradient[0][e] + n.y() * operators.gradient[1][e]),
                   at = n.dot(cloud.position[index_of(operators.node[e])]);
      if (share < 1e-6 / width_spacing) continue;
      low = std::min(low, at), high = std::max(high, at);
    }
    return high - low;
  }
};

const Vec2 across_columns(1, 0), across_rows(0, 1);

} // namespace

TEST(OpeningWidth, cells_of_a_square_lattice_share_an_opening_with_one_neighbour) {
  const SquareOperators square("cnem");
  const std::size_t inside = square.node_at({0.5, 0.5}), bottom = square.node_at({0.5, 0.0});
  EXPECT_NEAR(square.width(inside, across_columns), 2.0, 1e-9);
  EXPECT_NEAR(square.width(inside, across_rows), 2.0, 1e-9);
  EXPECT_NEAR(square.width(bottom, across_columns), 2.0, 1e-9) << "half as high and as wide";
  EXPECT_NEAR(square.width(bottom, across_rows), 1.0, 1e-9) << "as wide as to its neighbour";
}

TEST(OpeningWidth, cells_of_a_hexagonal_lattice_see_openings_across_two_spacings_or_two_rows) {
  const SquareOperators hexagonal("cnem", Mat2::Identity(), {}, Lattice::hexagonal);
  const std::size_t inside = hexagonal.nearest({0.5, 0.5});
  EXPECT_NEAR(hexagonal.width(inside, across_columns), 2.0, 1e-9) << "not 1.8, the mean of what they see";
  EXPECT_NEAR(hexagonal.width(inside, across_rows), std::sqrt(3.0), 1e-9);
}

TEST(OpeningWidth, triangles_take_an_opening_alone) {
  const SquareOperators square("fe-triangles");
  for (const std::size_t p : {0U, 40U, 100U})
    for (const Vec2& n : {across_columns, across_rows}) EXPECT_NEAR(square.width(p, n), 1.0, 1e-9) << p;
}

TEST(OpeningWidth, openings_that_a_cell_hardly_sees_are_none_of_its_own) {
  const SquareOperators square("cnem", Mat2::Identity(), {.least_squares = true});
  const std::size_t inside = square.node_at({0.5, 0.5});
  double beyond = 0.0; // of a unit opening between the next column and the one after it, spacings
  for (auto e = index_of(square.operators.row_begin[inside]);
       e < index_of(square.operators.row_begin[inside + 1]); ++e)
    if (square.cloud.position[index_of(square.operators.node[e])].x() > 0.65)
      beyond += width_spacing * square.operators.gradient[0][e];
  EXPECT_NEAR(beyond, 0.0171, 0.0005) << "cells of least squares reach as far";
  EXPECT_NEAR(square.width(inside, across_columns), 2.0, 1e-9);
}

TEST(OpeningWidth, points_of_an_opening_count_its_area_once) {
  for (const Vec2& n : {across_columns, across_rows}) {
    EXPECT_NEAR(SquareOperators("cnem").counted(n), 1.0, 1e-9);
    EXPECT_NEAR(SquareOperators("fe-triangles").counted(n), 1.0, 1e-9);
  }
}

TEST(OpeningWidth, is_measured_in_the_other_configuration) {
  const Mat2 F = (Mat2() << 1.3, 0.4, -0.2, 0.8).finished();
  const SquareOperators rest("fe-triangles"), stretched("fe-triangles", F);
  ASSERT_EQ(rest.operators.points, stretched.operators.points);
  for (std::size_t p = 0; p < index_of(rest.operators.points); ++p)
    EXPECT_NEAR(opening_width(stretched.operators, stretched.place, p, F * across_columns,
                              F.inverse().transpose() * across_columns),
                opening_width(rest.operators, rest.place, p, across_columns, across_columns), 1e-9);
}

} // namespace cnem::testing
