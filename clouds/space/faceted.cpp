#include "clouds/space/faceted.hpp"

#include "clouds/space/facet_tree.hpp"
#include "core/geometry/box.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/place_text.hpp"
#include "core/geometry/triangle_surface.hpp"
#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/remesh.hpp"
#include "voronoi/space/surface.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>

namespace cnem::clouds {

namespace {

std::string facet_text(std::size_t number, const std::array<Vec3, 3>& x) {
  return fmt::format("facet {} at {}, {}, {} m", number + 1, place_text(x[0]), place_text(x[1]),
                     place_text(x[2]));
}

/// The facets as a closed surface, each solid a piece. Corners closer than a millionth of the size are one,
/// and facets that thereby lose their area go.
Cloud<3> merged(const FacetSoup& soup) {
  if (soup.triangles.empty()) throw GeometryError("the surface has no facets");
  for (std::size_t f = 0; f < soup.triangles.size(); ++f)
    for (const Vec3& x : soup.triangles[f].corner) {
      if (!x.allFinite()) throw GeometryError(fmt::format("facet {} has a corner that is not finite", f + 1));
    }
  const TriangleSurface corners = numbered_corners(soup);
  const Box<3> box = box_of<3>(corners.points);
  const double size = (box.high - box.low).norm();
  Cloud<3> surface;
  surface.position.assign(corners.points.begin(), corners.points.end());
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    const auto& triangle = soup.triangles[f];
    Facet<3> facet{{}, as<PieceIndex>(triangle.solid)};
    for (std::size_t k = 0; k < 3; ++k) facet.node[k] = as<NodeIndex>(corners.triangles[f][k]);
    if (facet.node[0] == facet.node[1] || facet.node[1] == facet.node[2] || facet.node[2] == facet.node[0])
      continue;
    if (!(area_normal<3>(triangle.corner).norm() > 1e-14 * size * size))
      throw GeometryError(facet_text(f, triangle.corner) +
                          " has no area; expected three corners off one line");
    surface.facets.push_back(facet);
  }
  return surface;
}

struct Parts {
  std::vector<int> of_facet;
  std::vector<double> area;
  std::vector<int> solid;
};

/// Facets that are joined by edges that are neither sharp nor between solids.
Parts parts_of(const Cloud<3>& surface, const voronoi::SurfaceEdges& across, double crease_angle) {
  Parts parts{std::vector<int>(surface.facets.size(), -1), {}, {}};
  const auto normal = [&](CloudFacetIndex f) {
    return Vec3(area_normal<3>(corners_of(surface.facets[f], surface.position)));
  };
  for (const CloudFacetIndex seed : surface.facets.indices()) {
    if (parts.of_facet[index_of(seed)] >= 0) continue;
    const int part = as<int>(parts.area.size());
    parts.area.push_back(0.0);
    parts.solid.push_back(as<int>(surface.facets[seed].piece));
    std::vector<CloudFacetIndex> stack{seed};
    parts.of_facet[index_of(seed)] = part;
    while (!stack.empty()) {
      const CloudFacetIndex f = stack.back();
      stack.pop_back();
      const Vec3 n = normal(f);
      parts.area.back() += n.norm();
      for (std::size_t k = 0; k < 3; ++k) {
        const CloudFacetIndex g = voronoi::facet_of(across[f][k]);
        if (parts.of_facet[index_of(g)] >= 0 || surface.facets[g].piece != surface.facets[f].piece) continue;
        const Vec3 m = normal(g);
        if (std::atan2(n.cross(m).norm(), n.dot(m)) > crease_angle) continue;
        parts.of_facet[index_of(g)] = part;
        stack.push_back(g);
      }
    }
  }
  return parts;
}

/// Names of parts: those given by points, else of the solid, numbered from the largest on.
std::vector<std::string> names_of(const Parts& parts, const Faceted& shape, const FacetTree& tree) {
  std::vector<std::string> name(parts.area.size());
  for (const Faceted::Name& given : shape.names) {
    const auto nearest = tree.nearest(given.at, std::numeric_limits<double>::max());
    name[index_of(parts.of_facet[index_of(nearest.facet)])] = given.name;
  }
  std::vector<std::size_t> order(name.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t p) { return parts.area[p]; });
  const auto solid_name = [&](std::size_t p) {
    const auto solid = index_of(parts.solid[p]);
    const bool named = solid < shape.soup.solids.size() && !shape.soup.solids[solid].empty();
    return named ? shape.soup.solids[solid] : std::string("surface");
  };
  std::map<std::string, int> count, number;
  for (std::size_t p = 0; p < name.size(); ++p) ++count[solid_name(p)];
  for (const std::size_t p : order) {
    const std::string solid = solid_name(p);
    const int k = ++number[solid];
    if (name[p].empty()) name[p] = count[solid] == 1 ? solid : fmt::format("{}-{}", solid, k);
  }
  return name;
}

} // namespace

Cloud<3> divided_surface(const Faceted& shape) {
  Cloud<3> surface = merged(shape.soup);
  const voronoi::SurfaceEdges across = voronoi::surface_edges(surface);
  if (!(enclosed_measure(surface) > 0.0))
    throw GeometryError("the surface is inside out: its facets run clockwise as seen from outside; expected "
                        "anticlockwise ones");
  if (const auto pair = voronoi::describe_crossing(surface))
    throw GeometryError(
        fmt::format("the surface crosses itself: {}; expected facets that meet at common edges only", *pair));
  const Parts parts = parts_of(surface, across, shape.crease_angle);
  const auto names = names_of(parts, shape, FacetTree(surface));
  surface.piece_names.assign(names.begin(), names.end());
  for (const CloudFacetIndex f : surface.facets.indices())
    surface.facets[f].piece = as<PieceIndex>(parts.of_facet[index_of(f)]);
  return surface;
}

Cloud<3> remeshed_surface(const Faceted& shape, const SpaceSpacing& spacing) {
  if (!spacing.uniform())
    throw SpacingError("a surface of facets takes one spacing everywhere; expected no refinements");
  Cloud<3> surface = voronoi::remesh(divided_surface(shape), spacing.spacing);
  IndexedVector<PieceIndex, PieceIndex> merged; // parts of one name are one piece
  IndexedVector<PieceIndex, std::string> names;
  for (const std::string& name : surface.piece_names) {
    const auto found = std::ranges::find(names, name);
    merged.push_back(as<PieceIndex>(found - names.begin()));
    if (found == names.end()) names.push_back(name);
  }
  surface.piece_names = std::move(names);
  for (Facet<3>& facet : surface.facets) facet.piece = merged[facet.piece];
  return surface;
}

} // namespace cnem::clouds
