#include "cnem/quadrature.hpp"

#include "core/index.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace cnem::scni {
namespace {

struct GaussPoint {
  double at; ///< fraction of the facet
  double weight;
};

std::span<const GaussPoint> gauss_rule(int points) {
  static constexpr GaussPoint one[]{{0.5, 1.0}};
  static constexpr GaussPoint two[]{{0.21132486540518712, 0.5}, {0.78867513459481288, 0.5}};
  static constexpr GaussPoint three[]{
      {0.11270166537925831, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.88729833462074169, 5.0 / 18.0}};
  if (points == 1) return one;
  if (points == 2) return two;
  return three;
}

} // namespace

std::span<const std::int32_t> FacetMeans::nodes(std::size_t facet) const {
  const Block& block = blocks_[facet / block_size];
  const auto* begin = &block.begin[facet % block_size];
  return {block.node.data() + begin[0], block.node.data() + begin[1]};
}

std::span<const double> FacetMeans::values(std::size_t facet) const {
  const Block& block = blocks_[facet / block_size];
  const auto* begin = &block.begin[facet % block_size];
  return {block.value.data() + begin[0], block.value.data() + begin[1]};
}

FacetMeans facet_means(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                       const voronoi::Circumcircles& circles, const voronoi::Cells& cells,
                       voronoi::Functions functions, int gauss_points, Space space) {
  constexpr double shortest = 1e-14;
  const auto rule = gauss_rule(space == Space::revolution ? std::max(gauss_points, 2) : gauss_points);
  const std::size_t facets = cells.interior.size();
  FacetMeans means;
  means.blocks_.resize((facets + FacetMeans::block_size - 1) / FacetMeans::block_size);

  const auto integrate = [&](std::size_t b, voronoi::NaturalNeighbours& neighbours) {
    FacetMeans::Block& block = means.blocks_[b];
    const std::size_t first = b * FacetMeans::block_size;
    const std::size_t last = std::min(first + FacetMeans::block_size, facets);
    block.begin.reserve(last - first + 1);
    block.node.reserve(10 * (last - first));
    block.value.reserve(10 * (last - first));
    block.begin.push_back(0);
    for (std::size_t f = first; f < last; ++f) {
      const voronoi::InteriorFacet& facet = cells.interior[f];
      const Vec2 along = facet.end - facet.start;
      const Vec2 between = cloud.position[index_of(facet.cell[1])] - cloud.position[index_of(facet.cell[0])];
      if (along.squaredNorm() > shortest * shortest * between.squaredNorm()) {
        const std::size_t start = block.node.size();
        for (const GaussPoint& point : rule) {
          const Vec2 at = facet.start + point.at * along;
          const double weight = space == Space::revolution ? point.weight * at.x() : point.weight;
          neighbours.evaluate_on_facet(functions, at, facet.triangle);
          const auto node = neighbours.nodes();
          const auto value = neighbours.values();
          const std::size_t known = block.node.size();
          for (std::size_t k = 0; k < node.size(); ++k) {
            std::size_t e = start;
            while (e < known && block.node[e] != node[k]) ++e;
            if (e < known) {
              block.value[e] += weight * value[k];
            } else {
              block.node.push_back(node[k]);
              block.value.push_back(weight * value[k]);
            }
          }
        }
      }
      block.begin.push_back(static_cast<std::int32_t>(block.node.size()));
    }
  };

  ParallelFailure failure;
#pragma omp parallel
  {
    std::optional<voronoi::NaturalNeighbours> neighbours;
#pragma omp for schedule(dynamic)
    for (std::size_t b = 0; b < means.blocks_.size(); ++b)
      failure.guard(static_cast<std::ptrdiff_t>(b), [&] {
        if (!neighbours) neighbours.emplace(cloud, triangulation, circles);
        integrate(b, *neighbours);
      });
  }
  failure.rethrow();
  return means;
}

} // namespace cnem::scni
