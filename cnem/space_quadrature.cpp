#include "cnem/space_quadrature.hpp"

#include "core/machine/parallel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace cnem::scni {
namespace {

using voronoi::VoronoiCells;

/// Share of the squared distance of two nodes that makes a facet.
constexpr double least_area = 1e-14;

/// How a facet is integrated.
enum class Kind : std::uint8_t { none, at_once, by_triangles };

/// A facet as a polygon.
class Polygon {
public:
  void set(const Cloud<3>& cloud, const VoronoiCells& cells, EdgeIndex edge) {
    voronoi::facet_polygon(cloud, cells, edge, corner_);
    const auto& end = cells.rings.end[edge];
    across_ = cloud.position[end[1]] - cloud.position[end[0]];
    middle_ = 0.5 * (cloud.position[end[0]] + cloud.position[end[1]]);
  }

  /// Plane to rounding.
  bool is_plane() const {
    constexpr double epsilon = std::numeric_limits<double>::epsilon(), relative = 1e-13;
    const double bound = relative * across_.squaredNorm() + 8.0 * epsilon * middle_.norm() * across_.norm();
    return std::all_of(corner_.begin(), corner_.end(),
                       [&](const Vec<3>& x) { return std::abs((x - middle_).dot(across_)) <= bound; });
  }

  /// Of a plane one, to be integrated as that says. by_triangles: it crosses itself so that hardly any area
  /// is left, and the centroid is far from it.
  Kind find_centroid() {
    const Vec<3>& origin = corner_[0];
    Vec<3> moment = Vec<3>::Zero();
    double sum = 0.0, size = 0.0;
    for (std::size_t k = 1; k + 1 < corner_.size(); ++k) {
      const Vec<3> a = corner_[k] - origin, b = corner_[k + 1] - origin;
      const double twice = a.cross(b).dot(across_);
      sum += twice;
      size += std::abs(twice);
      moment += twice * (a + b);
    }
    const double squared = across_.squaredNorm();
    if (!(size > 2.0 * least_area * squared * std::sqrt(squared))) return Kind::none;
    if (!(std::abs(sum) > 0.9 * size)) return Kind::by_triangles;
    centroid_ = origin + moment / (3.0 * sum);
    return Kind::at_once;
  }
  const Vec<3>& centroid() const { return centroid_; }

  /// Calls body(point, share) for the triangles round the centroid.
  template<class Body> void for_each_part(Body&& body) const {
    double sum = 0.0;
    const auto area = [&](std::size_t k) {
      const Vec<3>&a = corner_[k], &b = corner_[(k + 1) % corner_.size()];
      return (a - centroid_).cross(b - centroid_).dot(across_);
    };
    for (std::size_t k = 0; k < corner_.size(); ++k) sum += area(k);
    for (std::size_t k = 0; k < corner_.size(); ++k)
      body((centroid_ + corner_[k] + corner_[(k + 1) % corner_.size()]) / 3.0, area(k) / sum);
  }

private:
  std::vector<Vec<3>> corner_;
  Vec<3> across_, middle_, centroid_; ///< from node to node
};

/// What is integrated at once: a facet, or a triangle of its fan.
struct Item {
  EdgeIndex edge;
  std::int32_t triangle; ///< −1: the facet
};

struct FunctionsAt {
  voronoi::NaturalNeighbours3 neighbours;
  Polygon polygon;
  std::vector<SimplexIndex> around;
  FaceMeans::Block block; ///< while it grows: it is kept without room to spare
};

/// A triangle of the fan of a facet, from the middle between its nodes.
struct FanTriangle {
  Vec<3> middle, from, to;

  FanTriangle(const Cloud<3>& cloud, const VoronoiCells& cells, const Item& item) {
    const auto ring = cells.rings.of(item.edge);
    const auto& [i, j] = cells.rings.end[item.edge];
    middle = 0.5 * (cloud.position[i] + cloud.position[j]);
    from = cells.points.place[ring[index_of(item.triangle)]];
    to = cells.points.place[ring[index_of(item.triangle + 1) % ring.size()]];
  }
  Vec<3> area() const { return 0.5 * (from - middle).cross(to - middle); }
  Vec<3> centroid() const { return (middle + from + to) / 3.0; }
};

} // namespace

FacetMeans facet_means(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh, voronoi::Circumspheres spheres,
                       const VoronoiCells& cells, voronoi::Functions functions, FacetRule rule) {
  const std::size_t edges = cells.rings.end.size(), tetrahedra = mesh.node.size();
  const auto triangles = [&](EdgeIndex e) {
    const auto ring = cells.rings.of(e);
    return ring.size() - (index_of(ring.front()) >= tetrahedra ? 1 : 0);
  };
  std::vector<Kind> kind(edges);
  for_each_block(edges, [&](std::size_t begin, std::size_t end) {
    Polygon polygon;
    for (std::size_t k = begin; k < end; ++k) {
      const auto e = as<EdgeIndex>(k);
      polygon.set(cloud, cells, e);
      kind[k] = polygon.is_plane() ? polygon.find_centroid() : Kind::by_triangles;
    }
  });
  std::vector<Item> items;
  items.reserve(edges + edges / 4);
  for (const EdgeIndex e : cells.rings.end.indices()) {
    if (kind[index_of(e)] == Kind::at_once) items.push_back({e, -1});
    if (kind[index_of(e)] == Kind::by_triangles)
      for (std::size_t k = 0; k < triangles(e); ++k) items.push_back({e, as<std::int32_t>(k)});
  }

  std::optional<voronoi::FunctionMesh> function_mesh(std::in_place, cloud, mesh, spheres, functions);
  spheres = {};
  constexpr std::size_t size = FaceMeans::block_size;
  std::vector<FaceMeans::Block> list((items.size() + size - 1) / size);
  const auto integrate = [&](std::size_t b, FunctionsAt& at) {
    FaceMeans::Block& block = at.block;
    const std::size_t first = b * size, last = std::min(first + size, items.size());
    block.node.clear();
    block.value.clear();
    block.begin.assign(1, 0);
    for (std::size_t k = first; k < last; ++k) {
      const auto& [edge, triangle] = items[k];
      const auto ring = cells.rings.of(edge);
      const std::size_t start = block.node.size();
      at.around.clear();
      for (const DualPointIndex p : ring)
        if (index_of(p) < tetrahedra) at.around.push_back(as<SimplexIndex>(index_of(p)));
      if (triangle < 0) {
        at.polygon.set(cloud, cells, edge);
        at.polygon.find_centroid();
        const auto add = [&](const Vec<3>& x, double weight) {
          at.neighbours.evaluate(functions, x, at.around);
          add_point(block, start, at.neighbours, weight);
        };
        if (rule == FacetRule::one_point)
          add(at.polygon.centroid(), 1.0);
        else
          at.polygon.for_each_part(add);
      } else {
        const FanTriangle part(cloud, cells, items[k]);
        const auto& [i, j] = cells.rings.end[edge];
        if (part.area().norm() > least_area * (cloud.position[j] - cloud.position[i]).squaredNorm()) {
          at.neighbours.evaluate(functions, part.centroid(), at.around);
          add_point(block, start, at.neighbours, 1.0);
        }
      }
      block.begin.push_back(static_cast<std::int32_t>(block.node.size()));
    }
    list[b] = block;
  };
  voronoi::Fallbacks fallbacks;
  ParallelFailure failure;
#pragma omp parallel
  {
    std::optional<FunctionsAt> functions_here;
#pragma omp for schedule(dynamic)
    for (std::size_t b = 0; b < list.size(); ++b)
      failure.guard(static_cast<std::ptrdiff_t>(b), [&] {
        if (!functions_here)
          functions_here.emplace(
              FunctionsAt{voronoi::NaturalNeighbours3(cloud, mesh, *function_mesh), Polygon(), {}, {}});
        integrate(b, *functions_here);
      });
#pragma omp critical
    if (functions_here) {
      fallbacks.to_laplace += functions_here->neighbours.fallbacks().to_laplace;
      fallbacks.to_linear += functions_here->neighbours.fallbacks().to_linear;
    }
  }
  failure.rethrow();
  function_mesh.reset(); // before what comes of it
  std::vector<Interface<3>> facet(items.size());
  for_each_block(items.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Item& item = items[k];
      facet[k] = {cells.rings.end[item.edge], item.triangle < 0
                                                  ? voronoi::facet_normal(cloud, cells, item.edge)
                                                  : FanTriangle(cloud, cells, item).area()};
    }
  });
  return {std::move(facet), FaceMeans(std::move(list)), fallbacks};
}

} // namespace cnem::scni
