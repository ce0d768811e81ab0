// The promises of the geometry on adversarial clouds; 70 seeds of every family, more than 1,000 clouds in
// all.
#include "core/index.hpp"
#include "tests/degenerate/random_clouds.hpp"
#include "voronoi/plane/cells.hpp"
#include "voronoi/plane/natural_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace cnem::voronoi::test {
namespace {

constexpr std::uint32_t seeds = 70;

class RandomClouds : public testing::TestWithParam<int> {
protected:
  /// Calls check(cloud) for all clouds of the family; stops at the first that fails.
  template<class Check> void for_each_cloud(Check check) {
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      const auto random = random_cloud(GetParam(), seed);
      SCOPED_TRACE(random.name);
      const auto mesh = triangulate(random.cloud);
      const auto circles = circumcircles(random.cloud, mesh);
      check(random, mesh, circles);
      if (HasFailure()) return;
    }
  }
};

/// The centroid and two points close to the edges and corners of some triangles.
std::vector<std::pair<SimplexIndex, Vec2>> sample_points(const Cloud<2>& cloud, const Triangulation& mesh) {
  std::vector<std::pair<SimplexIndex, Vec2>> points;
  const std::int32_t stride = std::max(1, mesh.triangles() / 60);
  for (std::int32_t t = 0; t < mesh.triangles(); t += stride) {
    const SimplexIndex in{t};
    const auto& [i, j, k] = mesh.node[in];
    const Vec2 &a = cloud.position[i], &b = cloud.position[j], &c = cloud.position[k];
    points.emplace_back(in, (a + b + c) / 3.0);
    points.emplace_back(in, 0.3 * a + 0.699 * b + 0.001 * c);
    points.emplace_back(in, 0.9999 * a + 0.00006 * b + 0.00004 * c);
    points.emplace_back(in, 0.4 * a + 0.6 * b);
  }
  return points;
}

TEST_P(RandomClouds, CellsFillTheDomainAndAreClosed) {
  for_each_cloud([](const RandomCloud& random, const Triangulation& mesh, const Circumcircles& circles) {
    const Cloud<2>& cloud = random.cloud;
    const Cells cells = constrained_cells(cloud, mesh, circles);
    const CellGeometry<2> polygons = cell_geometry(cloud, mesh, circles, cells);
    double volume = 0.0;
    for (const double v : cells.volume) volume += v;
    // The second term is the rounding of the area itself, of a domain that is hardly wider than a line.
    EXPECT_NEAR(volume, random.area, 1e-12 * random.area + 1e-16 * random.size * random.size);

    std::vector<Vec2> normals(index_of(cloud.nodes()), Vec2::Zero());
    for (const auto& f : cells.interior) {
      normals[index_of(f.cell[0])] += f.normal();
      normals[index_of(f.cell[1])] -= f.normal();
    }
    IndexedVector<CloudFacetIndex, double> covered(cloud.facets.size(), 0.0);
    for (const auto& piece : cells.boundary) {
      const auto& [a, b] = cloud.facets[piece.facet].node;
      EXPECT_EQ(piece.place[0][0], covered[piece.facet]);
      EXPECT_LE(piece.place[0][0], piece.place[1][0]);
      covered[piece.facet] = piece.place[1][0];
      normals[index_of(piece.cell)] +=
          right_normal(cloud.position[b] - cloud.position[a]) * (piece.place[1][0] - piece.place[0][0]);
    }
    for (const double s : covered) EXPECT_EQ(s, 1.0);

    for (const NodeIndex i : cloud.position.indices()) {
      EXPECT_GT(cells.volume[index_of(i)], 0.0) << "node " << index_of(i);
      EXPECT_LT(normals[index_of(i)].norm(), 1e-13) << "node " << index_of(i);
      double area = 0.0;
      const std::int32_t begin = polygons.begin[index_of(i)], end = polygons.begin[index_of(i) + 1];
      ASSERT_GE(end - begin, 3);
      for (std::int32_t k = begin; k < end; ++k) {
        const std::int32_t l = k + 1 == end ? begin : k + 1;
        area += 0.5 * cross(polygons.vertex[index_of(polygons.index[index_of(k)])] - cloud.position[i],
                            polygons.vertex[index_of(polygons.index[index_of(l)])] - cloud.position[i]);
      }
      EXPECT_NEAR(area, cells.volume[index_of(i)], 1e-13 * random.area) << "node " << index_of(i);
    }
    for (std::size_t v = 0; v < polygons.vertex.size(); ++v) {
      Vec2 x = Vec2::Zero();
      double sum = 0.0;
      for (std::int32_t e = polygons.vertex_begin[v]; e < polygons.vertex_begin[v + 1]; ++e) {
        x +=
            polygons.vertex_weight[index_of(e)] * cloud.position[index_of(polygons.vertex_node[index_of(e)])];
        sum += polygons.vertex_weight[index_of(e)];
        EXPECT_GE(polygons.vertex_weight[index_of(e)], -1e-9);
      }
      EXPECT_NEAR(sum, 1.0, 1e-13);
      EXPECT_LT((x - polygons.vertex[v]).norm(), 1e-13);
    }
  });
}

void expect_consistent(const Cloud<2>& cloud, const NaturalNeighbours& at, const Vec2& x) {
  double sum = 0.0;
  Vec2 mean = Vec2::Zero();
  for (std::size_t k = 0; k < at.nodes().size(); ++k) {
    EXPECT_GE(at.values()[k], 0.0);
    sum += at.values()[k];
    mean += at.values()[k] * (cloud.position[index_of(at.nodes()[k])] - x);
  }
  EXPECT_NEAR(sum, 1.0, 1e-14);
  EXPECT_LT(mean.norm(), 1e-12) << "at " << x.transpose();
}

TEST_P(RandomClouds, FunctionsArePositiveAndLinearlyConsistent) {
  for_each_cloud([](const RandomCloud& random, const Triangulation& mesh, const Circumcircles& circles) {
    const Cloud<2>& cloud = random.cloud;
    const Cells cells = constrained_cells(cloud, mesh, circles);
    NaturalNeighbours at(cloud, mesh, circles);
    for (const auto functions : {Functions::sibson, Functions::laplace}) {
      for (const auto& [t, x] : sample_points(cloud, mesh)) {
        at.evaluate(functions, x, t);
        expect_consistent(cloud, at, x);
      }
      for (const auto& f : cells.interior)
        for (const double s : {0.0, 0.211, 0.5, 1.0}) {
          const Vec2 x = (1.0 - s) * f.corner[0] + s * f.corner[1];
          at.evaluate_on_facet(functions, x, f.simplex);
          expect_consistent(cloud, at, x);
        }
    }
  });
}

TEST_P(RandomClouds, FunctionsInterpolateTheNodes) {
  for_each_cloud([](const RandomCloud& random, const Triangulation& mesh, const Circumcircles& circles) {
    const Cloud<2>& cloud = random.cloud;
    NaturalNeighbours at(cloud, mesh, circles);
    for (const auto functions : {Functions::sibson, Functions::laplace})
      for (const NodeIndex i : cloud.position.indices()) {
        at.evaluate(functions, cloud.position[i], mesh.triangle_of_node[i]);
        ASSERT_EQ(at.nodes().size(), 1u);
        EXPECT_EQ(at.nodes()[0], i);
        EXPECT_EQ(at.values()[0], 1.0);
      }
  });
}

TEST_P(RandomClouds, GradientsAreThoseOfTheValues) {
  for_each_cloud([](const RandomCloud& random, const Triangulation& mesh, const Circumcircles& circles) {
    const Cloud<2>& cloud = random.cloud;
    NaturalNeighbours at(cloud, mesh, circles);
    const std::int32_t stride = std::max(1, mesh.triangles() / 20);
    for (const auto functions : {Functions::sibson, Functions::laplace})
      for (std::int32_t t = 0; t < mesh.triangles(); t += stride) {
        const SimplexIndex in{t};
        const auto& [i, j, k] = mesh.node[in];
        const Vec2 &a = cloud.position[i], &b = cloud.position[j], &c = cloud.position[k];
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        const double step = 1e-5 * cross(b - a, c - a) / longest;
        if (step < 1e-9) continue; // differences drown in rounding
        const Vec2 x = 0.37 * a + 0.34 * b + 0.29 * c;
        std::map<NodeIndex, Vec2> error;
        at.evaluate_with_gradients(functions, x, in);
        Vec2 sum = Vec2::Zero();
        Mat2 moment = Mat2::Zero();
        for (std::size_t n = 0; n < at.nodes().size(); ++n) {
          error[at.nodes()[n]] = at.gradients()[n];
          sum += at.gradients()[n];
          moment += (cloud.position[index_of(at.nodes()[n])] - x) * at.gradients()[n].transpose();
        }
        EXPECT_LT(sum.norm() * step, 1e-17) << "triangle " << t;
        EXPECT_LT((moment - Mat2::Identity()).norm(), 1e-9) << "triangle " << t;
        const std::size_t stencil = error.size();
        bool same_stencil = true;
        for (const Vec2& d : {Vec2(step, 0), Vec2(0, step)})
          for (const double sign : {1.0, -1.0}) {
            at.evaluate(functions, x + sign * d, in);
            same_stencil &= at.nodes().size() == stencil;
            for (std::size_t n = 0; n < at.nodes().size(); ++n)
              error[at.nodes()[n]] -= sign * at.values()[n] * d / (2.0 * step * step);
          }
        if (functions == Functions::laplace && !same_stencil) continue; // they have kinks on the circles
        for (const auto& [node, e] : error)
          EXPECT_LT(e.norm() * step, 1e-9) << "triangle " << t << ", node " << index_of(node);
      }
  });
}

/// The segment from a to b cuts through the inside of a facet.
bool crosses_wall(const Cloud<2>& cloud, const Vec2& a, const Vec2& b) {
  const double small = 1e-12 * (b - a).norm();
  for (const auto& facet : cloud.facets) {
    const Vec2 &p = cloud.position[facet.node[0]], &q = cloud.position[facet.node[1]];
    const double scale = small * (q - p).norm();
    const double side_p = cross(b - a, p - a), side_q = cross(b - a, q - a);
    const double side_a = cross(q - p, a - p), side_b = cross(q - p, b - p);
    if (std::min(side_p, side_q) < -scale && std::max(side_p, side_q) > scale &&
        std::min(side_a, side_b) < -scale && std::max(side_a, side_b) > scale)
      return true;
  }
  return false;
}

/// The facets that leave and arrive; none inside.
IndexedVector<NodeIndex, std::array<CloudFacetIndex, 2>> facets_of_nodes(const Cloud<2>& cloud) {
  constexpr CloudFacetIndex none = CloudFacetIndex::none;
  IndexedVector<NodeIndex, std::array<CloudFacetIndex, 2>> facets(index_of(cloud.nodes()), {none, none});
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    facets[cloud.facets[f].node[0]][0] = f;
    facets[cloud.facets[f].node[1]][1] = f;
  }
  return facets;
}

/// x lies in the material angle of the boundary node: counter-clockwise from the facet that leaves it to the
/// one that arrives. Tells the two faces of a crack apart.
bool in_sector(const Cloud<2>& cloud, NodeIndex node, const std::array<CloudFacetIndex, 2>& facets,
               const Vec2& x) {
  if (!exists(facets[0])) return true;
  const Vec2& origin = cloud.position[node];
  const Vec2 out = cloud.position[cloud.facets[facets[0]].node[1]] - origin;
  const Vec2 in = cloud.position[cloud.facets[facets[1]].node[0]] - origin;
  const auto angle = [&](const Vec2& d) {
    const double phi = std::atan2(cross(out, d), out.dot(d));
    return phi < -1e-9 ? phi + 2.0 * std::numbers::pi : phi;
  };
  const bool tip =
      cloud.position[cloud.facets[facets[0]].node[1]] == cloud.position[cloud.facets[facets[1]].node[0]];
  return tip || angle(x - origin) <= angle(in) + 1e-9;
}

TEST_P(RandomClouds, WallsStopAllInfluence) {
  for_each_cloud([](const RandomCloud& random, const Triangulation& mesh, const Circumcircles& circles) {
    const Cloud<2>& cloud = random.cloud;
    const auto facets = facets_of_nodes(cloud);
    const Cells cells = constrained_cells(cloud, mesh, circles);
    NaturalNeighbours at(cloud, mesh, circles);
    const auto expect_visible = [&](const Vec2& x) {
      for (const NodeIndex i : at.nodes()) {
        EXPECT_FALSE(crosses_wall(cloud, x, cloud.position[i]))
            << "node " << index_of(i) << " from " << x.transpose();
        EXPECT_TRUE(in_sector(cloud, i, facets[i], x)) << "node " << index_of(i) << " from " << x.transpose();
      }
    };
    for (const SimplexIndex t : mesh.node.indices()) {
      const auto& [i, j, k] = mesh.node[t];
      const Vec2 x = 0.4 * cloud.position[i] + 0.35 * cloud.position[j] + 0.25 * cloud.position[k];
      at.evaluate(Functions::sibson, x, t);
      expect_visible(x);
    }
    for (const auto& f : cells.interior) {
      const Vec2 x = 0.5 * (f.corner[0] + f.corner[1]);
      at.evaluate_on_facet(Functions::sibson, x, f.simplex);
      expect_visible(x);
    }
  });
}

TEST_P(RandomClouds, CellsBelongToTheNearestVisibleNode) {
  for_each_cloud([](const RandomCloud& random, const Triangulation& mesh, const Circumcircles& circles) {
    const Cloud<2>& cloud = random.cloud;
    const Cells cells = constrained_cells(cloud, mesh, circles);
    const auto expect_nearest = [&](const Vec2& x, NodeIndex owner) {
      const double distance = (cloud.position[owner] - x).norm();
      for (const NodeIndex i : cloud.position.indices())
        if ((cloud.position[i] - x).norm() < distance - 1e-9) {
          EXPECT_TRUE(crosses_wall(cloud, x, cloud.position[i]))
              << "node " << index_of(i) << " is nearer to " << x.transpose() << " than node "
              << index_of(owner);
        }
    };
    for (const auto& f : cells.interior) {
      const Vec2 x = 0.5 * (f.corner[0] + f.corner[1]);
      EXPECT_NEAR((cloud.position[f.cell[0]] - x).norm(), (cloud.position[f.cell[1]] - x).norm(), 1e-9);
      expect_nearest(x, f.cell[0]);
    }
    for (const auto& piece : cells.boundary) {
      const auto& [a, b] = cloud.facets[piece.facet].node;
      const Vec2 edge = cloud.position[b] - cloud.position[a];
      const Vec2 x = cloud.position[a] + 0.5 * (piece.place[0][0] + piece.place[1][0]) * edge;
      expect_nearest(x + 1e-10 * left_normal(edge), piece.cell);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, RandomClouds, testing::Range(0, families()));

} // namespace
} // namespace cnem::voronoi::test
