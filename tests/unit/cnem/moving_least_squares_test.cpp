// Moving least squares: functions against exact fractions (tests/data/moving_least_squares.py), what they
// keep in clouds, and which nodes see a point.
#include "cnem/moving_least_squares.hpp"
#include "core/error.hpp"
#include "tests/clouds.hpp"
#include "voronoi/plane/cells.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

namespace cnem::testing {
namespace {

using scni::MovingLeastSquares;
using scni::Supports;

/// Nodes that all see each other.
Supports open_supports(const Field& radius) {
  Supports all;
  const std::size_t n = radius.size();
  all.radius = radius;
  all.beside.assign(n, {NodeIndex::none, NodeIndex::none});
  all.around.begin = {0};
  all.walls.begin.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) all.around.item.push_back(as<NodeIndex>(j));
    all.around.begin.push_back(static_cast<std::int32_t>(all.around.item.size()));
  }
  return all;
}

struct Given {
  Vec2 x;
  Cloud<2> cloud;
  Field support, value;
  std::vector<Vec2> gradient;
};

std::map<std::string, Given> table() {
  std::map<std::string, Given> sets;
  std::ifstream in(CNEM_SOURCE_DIR "/tests/data/moving_least_squares.csv");
  std::string line;
  std::getline(in, line); // header
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string name, field;
    std::getline(fields, name, ',');
    std::vector<double> number;
    while (std::getline(fields, field, ',')) number.push_back(std::stod(field));
    Given& set = sets[name];
    set.x = {number[0], number[1]};
    set.cloud.position.push_back({number[2], number[3]});
    set.support.push_back(number[4]);
    set.value.push_back(number[5]);
    set.gradient.emplace_back(number[6], number[7]);
  }
  return sets;
}

NodeIndex nearest(const Cloud<2>& cloud, const Vec2& x) {
  NodeIndex best{0};
  for (const NodeIndex i : cloud.position.indices())
    if ((cloud.position[i] - x).norm() < (cloud.position[best] - x).norm()) best = i;
  return best;
}

/// A cloud, its triangles, and what its nodes reach as points of triangles see it.
struct Reached {
  explicit Reached(const Cloud<2>& given, double size = 2.5)
      : cloud(given), mesh(voronoi::triangulate(cloud)) {
    const auto cells = voronoi::constrained_cells(cloud, mesh, voronoi::circumcircles(cloud, mesh));
    edges = cells.neighbours;
    Field reach(edges.begin.size() - 1, 0.0);
    for (const NodeIndex i : cloud.position.indices())
      for (const NodeIndex j : edges.of(i))
        reach[index_of(i)] = std::max(reach[index_of(i)], (cloud.position[j] - cloud.position[i]).norm());
    supports = scni::supports(cloud, edges, reach, size);
  }

  /// body(x, corner) at a random point of each triangle.
  template<class Body> void at_points(Body&& body) const {
    Random random(3);
    for (const auto& corner : mesh.node) {
      const double a = random.uniform(0.05, 0.9), b = random.uniform(0.02, 0.95 - a);
      body(a * cloud.position[corner[0]] + b * cloud.position[corner[1]] +
               (1 - a - b) * cloud.position[corner[2]],
           corner[0]);
    }
  }

  Cloud<2> cloud;
  voronoi::Triangulation mesh;
  CellLists<NodeIndex> edges;
  Supports supports;
};

} // namespace

TEST(RegularisedWeight, is_that_of_the_paper) {
  const double support = 0.7;
  EXPECT_DOUBLE_EQ(scni::regularised_weight(0.0, support).value, 1.0);
  EXPECT_EQ(scni::regularised_weight(support * support, support).value, 0.0);
  EXPECT_EQ(scni::regularised_weight(support * support, support).slope, 0.0);
  for (const double share : {1e-3, 1e-2, 0.2, 0.7, 0.99}) {
    const double s = share * share, w = scni::regularised_weight(s * support * support, support).value;
    const double exact = (std::pow(s + 1e-5, -2) - std::pow(1 + 1e-5, -2)) / (1e10 - std::pow(1 + 1e-5, -2));
    EXPECT_NEAR(w, exact, 1e-12 * exact);
    const double step = 1e-4 * s * support * support, d2 = s * support * support;
    const double slope = (scni::regularised_weight(d2 + step, support).value -
                          scni::regularised_weight(d2 - step, support).value) /
                         (2 * step);
    EXPECT_NEAR(scni::regularised_weight(d2, support).slope, slope, 1e-6 * std::abs(slope));
  }
  EXPECT_LT(scni::regularised_weight(std::pow(0.18 * support, 2), support).value, 1e-7);
}

TEST(MovingLeastSquares, values_and_gradients_are_those_of_exact_fractions) {
  const auto sets = table();
  ASSERT_EQ(sets.size(), 8U);
  for (const auto& [name, given] : sets) {
    SCOPED_TRACE(name);
    const Supports all = open_supports(given.support);
    MovingLeastSquares phi(given.cloud, all);
    phi.evaluate_with_gradients(given.x, nearest(given.cloud, given.x));
    Field value(given.value.size(), 0.0);
    std::vector<Vec2> gradient(value.size(), Vec2::Zero());
    for (std::size_t k = 0; k < phi.nodes().size(); ++k) {
      value[index_of(phi.nodes()[k])] = phi.values()[k];
      gradient[index_of(phi.nodes()[k])] = phi.gradients()[k];
    }
    for (std::size_t j = 0; j < value.size(); ++j) {
      EXPECT_NEAR(value[j], given.value[j], 1e-9);
      EXPECT_LT((gradient[j] - given.gradient[j]).norm(), 1e-9) << value[j];
    }
  }
}

TEST(MovingLeastSquares, reproduce_linear_fields_to_rounding) {
  for (const NamedCloud& domain : domains()) {
    SCOPED_TRACE(domain.name);
    const Reached reached(domain.cloud);
    MovingLeastSquares phi(reached.cloud, reached.supports);
    reached.at_points([&](const Vec2& x, NodeIndex near) {
      phi.evaluate_with_gradients(x, near);
      double sum = 0.0;
      Vec2 place = Vec2::Zero(), slope = Vec2::Zero();
      Mat2 identity = Mat2::Zero();
      for (std::size_t k = 0; k < phi.nodes().size(); ++k) {
        const Vec2 node = reached.cloud.position[phi.nodes()[k]] - x;
        sum += phi.values()[k];
        place += phi.values()[k] * node;
        slope += phi.gradients()[k];
        identity += node * phi.gradients()[k].transpose();
      }
      EXPECT_NEAR(sum, 1.0, 1e-14);
      EXPECT_LT(place.norm(), 1e-14 * domain.spacing);
      EXPECT_LT(slope.norm() * domain.spacing, 1e-12);
      EXPECT_LT((identity - Mat2::Identity()).norm(), 1e-12);
    });
  }
}

/// To 1e-7 where no node is nearer than a fifth of a support, else to what the weights of the others are
/// there. But for nodes of one place on two faces, which no point tells apart.
TEST(MovingLeastSquares, all_but_interpolate_at_nodes) {
  int close = 0, apart = 0;
  for (const NamedCloud& domain : domains()) {
    if (!domain.cloud.twins.empty()) continue;
    SCOPED_TRACE(domain.name);
    const Reached reached(domain.cloud);
    MovingLeastSquares phi(reached.cloud, reached.supports);
    for (const NodeIndex i : reached.cloud.position.indices()) {
      phi.evaluate(reached.cloud.position[i], i);
      double others = 0.0, nearest = 1.0;
      for (const NodeIndex j : phi.nodes()) {
        const double radius = reached.supports.radius[index_of(j)];
        const double d2 = (reached.cloud.position[j] - reached.cloud.position[i]).squaredNorm();
        if (j == i) continue;
        others += scni::regularised_weight(d2, radius).value;
        nearest = std::min(nearest, std::sqrt(d2) / radius);
      }
      ++(nearest < 0.2 ? close : apart);
      for (std::size_t k = 0; k < phi.nodes().size(); ++k)
        EXPECT_NEAR(phi.values()[k], phi.nodes()[k] == i ? 1.0 : 0.0, nearest < 0.2 ? 2.0 * others : 1e-7);
    }
  }
  EXPECT_GT(apart, 20 * close);
}

TEST(Supports, are_so_many_mean_distances_to_neighbours) {
  for (const double size : {1.5, 2.5, 4.0}) {
    const Reached reached(jittered_square(0.1, 0.2, 4), size);
    for (const NodeIndex j : reached.cloud.position.indices()) {
      double sum = 0.0, longest = 0.0;
      for (const NodeIndex i : reached.edges.of(j)) {
        const double length = (reached.cloud.position[i] - reached.cloud.position[j]).norm();
        sum += length;
        longest = std::max(longest, length);
      }
      const double mean = sum / static_cast<double>(reached.edges.of(j).size());
      if (size == 2.5) {
        EXPECT_GT(size * mean, 1.1 * longest) << "an ordinary cloud needs no least support";
      }
      EXPECT_DOUBLE_EQ(reached.supports.radius[index_of(j)], std::max(size * mean, 1.1 * longest));
    }
  }
  EXPECT_THROW(scni::check_support(1.4), InputError);
  EXPECT_THROW(scni::check_support(5.1), InputError);
  EXPECT_THROW(scni::check_support(std::nan("")), InputError);
}

/// All nodes are looked at, and the way to each in two hundred places: outlines without cracks.
TEST(Supports, hold_the_nodes_that_see_a_point_and_no_others) {
  for (const NamedCloud& domain : domains()) {
    if (!domain.cloud.twins.empty()) continue;
    SCOPED_TRACE(domain.name);
    const Reached reached(domain.cloud);
    MovingLeastSquares phi(reached.cloud, reached.supports);
    int unseen = 0, point = 0;
    reached.at_points([&](const Vec2& x, NodeIndex near) {
      if (point++ % 16 != 0) return;
      phi.evaluate(x, near);
      for (const NodeIndex j : reached.cloud.position.indices()) {
        const Vec2 way = reached.cloud.position[j] - x;
        if (way.norm() >= reached.supports.radius[index_of(j)]) continue;
        bool sees = true;
        for (int n = 1; n < 200 && sees; ++n) sees = inside(reached.cloud, x + n / 200.0 * way, 0.0);
        const bool counts = std::binary_search(phi.nodes().begin(), phi.nodes().end(), j);
        unseen += !sees;
        EXPECT_EQ(counts, sees) << x.transpose() << " " << reached.cloud.position[j].transpose();
      }
    });
    const bool convex = domain.name.starts_with("square");
    EXPECT_EQ(unseen == 0, convex);
  }
}

TEST(Supports, do_not_reach_across_a_slit_and_hold_the_nodes_of_their_own_face) {
  const auto all = domains();
  const auto found =
      std::find_if(all.begin(), all.end(), [](const auto& d) { return d.name == "slit_open"; });
  ASSERT_NE(found, all.end());
  const Reached reached(found->cloud);
  MovingLeastSquares phi(reached.cloud, reached.supports);
  const double slit = 0.5, tip = 0.5;
  int beyond = 0, on_slit = 0;
  reached.at_points([&](const Vec2& x, NodeIndex near) {
    phi.evaluate(x, near);
    for (const NodeIndex j : reached.cloud.position.indices()) {
      const Vec2& node = reached.cloud.position[j];
      if ((node - x).norm() >= reached.supports.radius[index_of(j)]) continue;
      const bool counts = std::binary_search(phi.nodes().begin(), phi.nodes().end(), j);
      if (node.x() == slit &&
          node.y() < tip) { // of the two in its place the one whose neighbours are at the left
        double mean = 0.0;
        for (const NodeIndex i : reached.edges.of(j)) mean += reached.cloud.position[i].x() - slit;
        const double at =
            x.y() + (node - x).y(); // in sight along the way to the slit from either side of the tip
        if (at < tip) { EXPECT_EQ(counts, mean * (x.x() - slit) > 0.0) << x.transpose(); }
        on_slit += counts;
      } else if ((node.x() - slit) * (x.x() - slit) < 0.0) {
        const double share = (slit - x.x()) / (node.x() - x.x());
        EXPECT_EQ(counts, x.y() + share * (node.y() - x.y()) > tip);
        beyond += !counts;
      } else {
        EXPECT_TRUE(counts);
      }
    }
  });
  EXPECT_GT(beyond, 100);
  EXPECT_GT(on_slit, 100);
}

TEST(MovingLeastSquares, say_where_nodes_lie_in_one_line) {
  Cloud<2> cloud;
  for (int i = 0; i < 4; ++i) cloud.position.push_back({0.1 * i, 0.2 * i});
  const Supports all = open_supports(Field(4, 1.0));
  MovingLeastSquares phi(cloud, all);
  try {
    phi.evaluate({0.16, 0.3}, NodeIndex{1});
    FAIL();
  } catch (const GeometryError& e) {
    EXPECT_NE(std::string(e.what()).find("(0.16, 0.3) m lie in one line"), std::string::npos) << e.what();
  }
}

} // namespace cnem::testing
