#include "results/polyhedra.hpp"

#include "core/fields/vector_at.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/median_cells.hpp"
#include "voronoi/space/voronoi_cells.hpp"

#include <algorithm>
#include <map>

namespace cnem::results {
namespace {

using Corner = std::array<NodeIndex, 4>;

/// Polyhedra on the way.
class Maker {
public:
  Maker(const Cloud<3>& cloud, const Fields<3>& position) : cloud_(cloud), position_(position) {
    made_.cell.resize(cloud.position.size());
    made_.face_begin.push_back(0);
  }

  Vec3 at(NodeIndex i) const { return vector_at<3>(position_, index_of(i)); }

  std::int32_t add_point(const Vec3& x) {
    made_.point.push_back(x);
    return as<std::int32_t>(made_.point.size() - 1);
  }
  /// The mean of some nodes, one point for each set of them.
  template<std::size_t n> std::int32_t mean_of(std::array<NodeIndex, n> nodes) {
    std::sort(nodes.begin(), nodes.end());
    std::array<NodeIndex, 3> key;
    key.fill(NodeIndex::none);
    std::copy(nodes.begin(), nodes.end(), key.begin());
    const auto [known, fresh] = means_.try_emplace(key, 0);
    if (!fresh) return known->second;
    Vec3 sum = Vec3::Zero();
    for (const NodeIndex i : nodes) sum += at(i);
    return known->second = add_point(sum / static_cast<double>(n));
  }

  /// A face that is seen counter-clockwise from the second cell; none: from outside the body.
  void add_face(std::span<const std::int32_t> points, NodeIndex first, NodeIndex second = NodeIndex::none) {
    const auto face = as<std::int32_t>(made_.faces());
    made_.face_point.insert(made_.face_point.end(), points.begin(), points.end());
    made_.face_begin.push_back(as<std::int32_t>(made_.face_point.size()));
    made_.cell[index_of(first)].push_back(face);
    if (exists(second)) made_.cell[index_of(second)].push_back(-1 - face);
  }
  /// What of the facets belongs to each node. inner: [facet] the point in it.
  void add_boundary(const std::vector<std::int32_t>& inner) {
    for (const CloudFacetIndex f : cloud_.facets.indices()) {
      const auto& node = cloud_.facets[f].node;
      for (std::size_t a = 0; a < 3; ++a) {
        const NodeIndex i = node[a];
        add_face(std::array{mean_of(std::array{i}), mean_of(std::array{i, node[(a + 1) % 3]}),
                            inner[index_of(f)], mean_of(std::array{i, node[(a + 2) % 3]})},
                 i);
      }
    }
  }
  Polyhedra take() { return std::move(made_); }

private:
  const Cloud<3>& cloud_;
  const Fields<3>& position_;
  std::map<std::array<NodeIndex, 3>, std::int32_t> means_;
  Polyhedra made_;
};

Polyhedra of_median(const Cloud<3>& cloud, std::span<const Corner> tetrahedra, const Fields<3>& position) {
  Maker maker(cloud, position);
  for (const Corner& node : tetrahedra) {
    const std::int32_t centre = maker.add_point(
        (maker.at(node[0]) + maker.at(node[1]) + maker.at(node[2]) + maker.at(node[3])) / 4.0);
    for (const auto& [a, b, c, d] : voronoi::edges_of_tetrahedron)
      maker.add_face(std::array{maker.mean_of(std::array{node[a], node[b]}),
                                maker.mean_of(std::array{node[a], node[b], node[c]}), centre,
                                maker.mean_of(std::array{node[a], node[b], node[d]})},
                     node[a], node[b]);
  }
  std::vector<std::int32_t> inner;
  for (const Facet<3>& facet : cloud.facets) inner.push_back(maker.mean_of(facet.node));
  maker.add_boundary(inner);
  return maker.take();
}

/// Where a place of the reference has gone with a tetrahedron.
Vec3 moved(const Cloud<3>& cloud, const Maker& maker, const Corner& node, const Vec3& x) {
  Mat<3> before, after;
  for (int k = 0; k < 3; ++k) {
    const NodeIndex i = node[index_of(k + 1)];
    before.col(k) = cloud.position[i] - cloud.position[node[0]];
    after.col(k) = maker.at(i) - maker.at(node[0]);
  }
  return maker.at(node[0]) + after * before.fullPivLu().solve(x - cloud.position[node[0]]);
}

/// Whether a facet inside the body lies in one plane through the middle of its edge, in the reference.
bool is_plane(const Cloud<3>& cloud, const voronoi::VoronoiCells& cells, EdgeIndex e) {
  const auto& [i, j] = cells.rings.end[e];
  const Vec3 middle = 0.5 * (cloud.position[i] + cloud.position[j]),
             normal = facet_normal(cloud, cells, e).normalized();
  const double size = (cloud.position[j] - cloud.position[i]).norm();
  return std::ranges::all_of(cells.rings.of(e), [&](DualPointIndex p) {
    return std::abs(normal.dot(cells.points.place[p] - middle)) < 1e-9 * size;
  });
}

Polyhedra of_voronoi(const Cloud<3>& cloud, std::span<const Corner> tetrahedra, const Fields<3>& position) {
  const voronoi::Tetrahedra mesh = voronoi::connected(cloud, tetrahedra);
  const voronoi::VoronoiCells cells =
      voronoi::voronoi_cells(cloud, mesh, voronoi::circumspheres(cloud, mesh));
  Maker maker(cloud, position);
  std::vector<std::int32_t> point; // [dual point]
  for (const SimplexIndex t : mesh.node.indices()) {
    const SimplexIndex holder = cells.points.holder[t];
    point.push_back(maker.add_point(moved(cloud, maker, mesh.node[exists(holder) ? holder : t],
                                          cells.points.place[voronoi::dual_point_of(t)])));
  }
  for (const CloudFacetIndex f : cloud.facets.indices())
    point.push_back(
        maker.add_point(point_on<3>(corners_of<3>(cloud.facets[f], position), voronoi::facet_centroid)));
  std::vector<std::int32_t> polygon;
  for (const EdgeIndex e : cells.rings.end.indices()) {
    const auto ring = cells.rings.of(e);
    const auto& end = cells.rings.end[e];
    const bool open = index_of(ring.front()) >= mesh.node.size(); // at the boundary
    polygon.clear();
    if (open) polygon.push_back(maker.mean_of(end));
    for (const DualPointIndex p : ring) polygon.push_back(point[index_of(p)]);
    if (open || is_plane(cloud, cells, e)) {
      maker.add_face(polygon, end[0], end[1]);
      continue;
    }
    const std::int32_t middle = maker.mean_of(end); // whose fan the cells have
    for (std::size_t k = 0; k < polygon.size(); ++k)
      maker.add_face(std::array{middle, polygon[k], polygon[(k + 1) % polygon.size()]}, end[0], end[1]);
  }
  maker.add_boundary({point.begin() + static_cast<std::ptrdiff_t>(mesh.node.size()), point.end()});
  return maker.take();
}

} // namespace

std::vector<Corner> tetrahedra_of(const CellGeometry<3>& cells) {
  std::vector<Corner> list;
  for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c) {
    Corner corner;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto vertex = index_of(cells.index[index_of(cells.begin[c]) + k]);
      corner[k] = cells.vertex_node[index_of(cells.vertex_begin[vertex])];
    }
    list.push_back(corner);
  }
  return list;
}

double Polyhedra::volume(std::size_t c) const {
  double sum = 0.0;
  for (const std::int32_t signed_face : cell[c]) {
    const auto corner = face(index_of(signed_face < 0 ? -1 - signed_face : signed_face));
    const Vec3& first = point[index_of(corner[0])];
    double part = 0.0;
    for (std::size_t k = 2; k < corner.size(); ++k)
      part += first.dot(point[index_of(corner[k - 1])].cross(point[index_of(corner[k])])) / 6.0;
    sum += signed_face < 0 ? -part : part;
  }
  return sum;
}

Polyhedra polyhedra(PolyhedraOf cells, const Cloud<3>& reference, std::span<const Corner> tetrahedra,
                    const Fields<3>& position) {
  return cells == PolyhedraOf::voronoi_cells ? of_voronoi(reference, tetrahedra, position)
                                             : of_median(reference, tetrahedra, position);
}

} // namespace cnem::results
