#include "clouds/space/repeat.hpp"

#include "core/error.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <vector>

namespace cnem::clouds {

namespace {

PieceIndex piece_named(const Cloud<3>& surface, const std::string& name) {
  const auto found = std::ranges::find(surface.piece_names, name);
  if (found == surface.piece_names.end())
    throw GeometryError(fmt::format("found no boundary piece '{}'", name));
  return as<PieceIndex>(found - surface.piece_names.begin());
}

/// A side of the body, and the edges where other pieces meet it.
struct Side {
  IndexedVector<NodeIndex, char> inside; ///< [node] of this piece alone
  std::vector<NodeIndex> border;
  double length = 0.0;    ///< m, of the border
  Vec3 centroid{0, 0, 0}; ///< m, of the border
};

Side side_of(const Cloud<3>& surface, const voronoi::SurfaceEdges& across, PieceIndex piece) {
  Side side{IndexedVector<NodeIndex, char>(surface.position.size(), 0), {}};
  for (const CloudFacetIndex f : surface.facets.indices()) {
    if (surface.facets[f].piece != piece) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex a = surface.facets[f].node[k], b = surface.facets[f].node[(k + 1) % 3];
      side.inside[a] = 1;
      if (surface.facets[voronoi::facet_of(across[f][k])].piece == piece) continue;
      const double length = (surface.position[b] - surface.position[a]).norm();
      side.border.push_back(a);
      side.centroid += 0.5 * length * (surface.position[a] + surface.position[b]);
      side.length += length;
    }
  }
  if (side.border.empty())
    throw GeometryError(fmt::format("found no edge round '{}'", surface.piece_names[piece]));
  std::sort(side.border.begin(), side.border.end());
  side.border.erase(std::unique(side.border.begin(), side.border.end()), side.border.end());
  for (const NodeIndex i : side.border) side.inside[i] = 0;
  side.centroid /= side.length;
  return side;
}

} // namespace

void repeat_piece(Cloud<3>& surface, const std::array<std::string, 2>& pieces, const SpaceSpacing& spacing) {
  const PieceIndex first = piece_named(surface, pieces[0]), second = piece_named(surface, pieces[1]);
  const voronoi::SurfaceEdges across = voronoi::surface_edges(surface);
  const Side from = side_of(surface, across, first), to = side_of(surface, across, second);
  const auto fail = [&](const std::string& what) {
    return RepeatError(
        fmt::format("{}, expected '{}' to be a shifted copy of '{}' with the same spacing along "
                    "its edges",
                    what, pieces[1], pieces[0]),
        pieces);
  };
  if (from.border.size() != to.border.size())
    throw fail(fmt::format("found {} nodes round '{}' and {} round '{}'", from.border.size(), pieces[0],
                           to.border.size(), pieces[1]));
  const Vec3 shift = to.centroid - from.centroid;
  IndexedVector<NodeIndex, NodeIndex> image(surface.position.size(), NodeIndex::none);
  constexpr double reach = 0.25; // h
  std::vector<NodeIndex> free = to.border;
  for (const NodeIndex i : from.border) {
    const Vec3 place = surface.position[i] + shift;
    const auto nearest = std::ranges::min_element(
        free, {}, [&](NodeIndex k) { return (surface.position[k] - place).squaredNorm(); });
    if (*nearest == i || (surface.position[*nearest] - place).norm() > reach * spacing.at(place))
      throw fail(fmt::format("found no partner of the node at {} m", place_text(surface.position[i])));
    image[i] = *nearest;
    surface.position[*nearest] = place;
    free.erase(nearest);
  }
  IndexedVector<CloudFacetIndex, Facet<3>> facets;
  for (const Facet<3>& facet : surface.facets)
    if (facet.piece != second) facets.push_back(facet);
  const std::size_t others = facets.size();
  for (std::size_t f = 0; f < others; ++f) {
    const Facet<3> facet = facets[as<CloudFacetIndex>(f)];
    if (facet.piece != first) continue;
    Facet<3> copy{{}, second};
    for (std::size_t k = 0; k < 3; ++k) {
      NodeIndex& there = image[facet.node[k]];
      if (!exists(there)) {
        there = surface.position.next();
        surface.position.push_back(Vec3(surface.position[facet.node[k]] + shift));
      }
      copy.node[2 - k] = there;
    }
    facets.push_back(copy);
  }
  // nodes that were inside of the second go
  IndexedVector<NodeIndex, NodeIndex> number(surface.position.size(), NodeIndex::none);
  IndexedVector<NodeIndex, Vec3> kept;
  for (const NodeIndex i : number.indices()) {
    if (index_of(i) < to.inside.size() && to.inside[i]) continue;
    number[i] = kept.next();
    kept.push_back(surface.position[i]);
  }
  for (Facet<3>& facet : facets)
    for (NodeIndex& i : facet.node) i = number[i];
  surface.position = std::move(kept);
  surface.facets = std::move(facets);
  voronoi::surface_edges(surface); // it is closed still
}

} // namespace cnem::clouds
