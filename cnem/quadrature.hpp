#pragma once
// Natural-neighbour functions integrated along the Voronoi facets, each facet once for its two cells.
#include "core/revolution.hpp"
#include "voronoi/cells.hpp"
#include "voronoi/natural_neighbours.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cnem::scni {

/// Means φ̄_J = (1/L) ∫ φ_J ds of the functions along each interior facet, as sparse rows.
class FacetMeans {
public:
  /// Stencil of an interior facet; empty for facets without length.
  std::span<const std::int32_t> nodes(std::size_t facet) const;
  /// φ̄ on that stencil; sums to 1. Of revolution the mean of r φ (m), which sums to the mean radius.
  std::span<const double> values(std::size_t facet) const;

private:
  friend FacetMeans facet_means(const Cloud<2>&, const voronoi::Triangulation&, const voronoi::Circumcircles&,
                                const voronoi::Cells&, voronoi::Functions, int, Space);
  static constexpr std::size_t block_size = 512;
  struct Block {
    std::vector<std::int32_t> begin; ///< [facet of the block + 1]
    std::vector<std::int32_t> node;
    std::vector<double> value;
  };
  std::vector<Block> blocks_;
};

/// Integrates with 1, 2 or 3 Gauss points per facet. Facets shorter than 1e-14 of the distance between their
/// nodes (cocircular nodes) are skipped: they carry rounding only. Of revolution at least 2 points, without
/// which r φ of linear fields would not be exact. Throws GeometryError where the domain is so thin that
/// rounding puts a point of a facet outside of it.
FacetMeans facet_means(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                       const voronoi::Circumcircles& circles, const voronoi::Cells& cells,
                       voronoi::Functions functions, int gauss_points, Space space = Space::plane);

} // namespace cnem::scni
