#include "cnem/smoothing.hpp"

#include "core/index.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

namespace cnem::scni {
namespace {

std::size_t index(std::int32_t i) { return index_of(i); }

/// Lists of items per cell from the cells of each item: a counting sort.
template<class CellsOf> CellFacets group_by_cell(int nodes, std::size_t items, CellsOf&& cells_of) {
  CellFacets around;
  around.begin.assign(index(nodes) + 1, 0);
  for (std::size_t f = 0; f < items; ++f)
    for (const std::int32_t i : cells_of(f)) ++around.begin[index(i) + 1];
  for (std::size_t i = 0; i < index(nodes); ++i) around.begin[i + 1] += around.begin[i];
  around.facet.resize(index(around.begin.back()));
  std::vector<std::int32_t> next(around.begin.begin(), around.begin.end() - 1);
  for (std::size_t f = 0; f < items; ++f)
    for (const std::int32_t i : cells_of(f))
      around.facet[index(next[index(i)]++)] = static_cast<std::int32_t>(f);
  return around;
}

/// One row while it is summed up: entries are found through a table over all nodes.
class RowAccumulator {
public:
  explicit RowAccumulator(int nodes) : slot_(index(nodes), -1) {}

  void add(std::int32_t node, const Vec2& b, double value = 0.0) {
    std::int32_t& slot = slot_[index(node)];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(entry_.size());
      entry_.push_back({node, b, value});
    } else {
      entry_[index(slot)].b += b;
      entry_[index(slot)].value += value;
    }
  }

  struct Entry {
    std::int32_t node;
    Vec2 b;
    double value; ///< at the centroid, of revolution
  };

  const std::vector<Entry>& sorted() {
    std::sort(entry_.begin(), entry_.end(), [](const Entry& x, const Entry& y) { return x.node < y.node; });
    return entry_;
  }

  void clear() {
    for (const Entry& e : entry_) slot_[index(e.node)] = -1;
    entry_.clear();
  }

private:
  std::vector<std::int32_t> slot_; ///< [node] index into entry_, −1: none
  std::vector<Entry> entry_;
};

/// Finished rows of consecutive cells.
struct RowBlock {
  std::vector<std::int32_t> node;
  std::array<std::vector<double>, 2> gradient;
  std::vector<double> hoop;
};

/// ∫ (1 − s, s) ds over a piece of a boundary facet; of revolution ∫ r (1 − s, s) ds.
std::array<double, 2> end_integrals(const voronoi::BoundaryPiece& piece, const Vec2& a, const Vec2& b,
                                    bool revolution) {
  const double middle = 0.5 * (piece.s0 + piece.s1), length = piece.s1 - piece.s0;
  if (!revolution) return {(1.0 - middle) * length, middle * length};
  const auto r = [&](double s) { return (1.0 - s) * a.x() + s * b.x(); };
  const double r0 = r(piece.s0) / 6.0, r1 = 4.0 * r(middle) / 6.0, r2 = r(piece.s1) / 6.0; // Simpson: exact
  const double second = piece.s0 * r0 + middle * r1 + piece.s1 * r2;
  return {length * (r0 + r1 + r2 - second), length * second};
}

} // namespace

CellFacets facets_of_cells(int nodes, const voronoi::Cells& cells) {
  return group_by_cell(
      nodes, cells.interior.size(), [&](std::size_t f) -> const auto& { return cells.interior[f].cell; });
}

DiscreteOperators<2> smoothed_gradients(const Cloud<2>& cloud, const voronoi::Cells& cells,
                                        const CellFacets& around, const FacetMeans& means,
                                        const CentroidValues* revolution) {
  const auto nodes = index(cloud.nodes());
  const CellFacets boundary = group_by_cell(cloud.nodes(), cells.boundary.size(), [&](std::size_t f) {
    return std::array<std::int32_t, 1>{cells.boundary[f].cell};
  });

  DiscreteOperators<2> op;
  op.points = op.nodes = cloud.nodes();
  op.nodal = true;
  op.volume = cells.volume;
  if (revolution) {
    op.radius = revolution->radius;
    for (std::size_t i = 0; i < nodes; ++i) op.volume[i] *= 2.0 * std::numbers::pi * op.radius[i];
  }
  op.row_begin.assign(nodes + 1, 0);

  std::vector<RowBlock> blocks((nodes + block_size - 1) / block_size);
  const auto sum_rows = [&](std::size_t k, RowAccumulator& row) {
    RowBlock& block = blocks[k];
    const std::size_t first = k * block_size, last = std::min(first + block_size, nodes);
    block.node.reserve(11 * (last - first));
    for (auto& g : block.gradient) g.reserve(11 * (last - first));
    for (std::size_t i = first; i < last; ++i) {
      for (auto a = index(around.begin[i]); a < index(around.begin[i + 1]); ++a) {
        const auto f = index(around.facet[a]);
        const voronoi::InteriorFacet& facet = cells.interior[f];
        const double sign = index(facet.cell[0]) == i ? 1.0 : -1.0;
        const Vec2 normal = sign * right_normal(facet.end - facet.start);
        const auto node = means.nodes(f);
        const auto value = means.values(f);
        for (std::size_t e = 0; e < node.size(); ++e) row.add(node[e], value[e] * normal);
      }
      for (auto a = index(boundary.begin[i]); a < index(boundary.begin[i + 1]); ++a) {
        const voronoi::BoundaryPiece& piece = cells.boundary[index(boundary.facet[a])];
        const auto& ends = cloud.facets[index(piece.facet)].node;
        const Vec2 &a0 = cloud.position[index(ends[0])], &a1 = cloud.position[index(ends[1])];
        const Vec2 normal = right_normal(a1 - a0);
        const auto share = end_integrals(piece, a0, a1, revolution != nullptr);
        row.add(ends[0], share[0] * normal);
        row.add(ends[1], share[1] * normal);
      }
      double measure = cells.volume[i];
      if (revolution) {
        for (auto e = index(revolution->begin[i]); e < index(revolution->begin[i + 1]); ++e)
          row.add(revolution->node[e], Vec2(-cells.volume[i] * revolution->value[e], 0.0),
                  revolution->value[e]);
        measure *= op.radius[i];
      }
      for (const auto& entry : row.sorted()) {
        block.node.push_back(entry.node);
        for (std::size_t d = 0; d < 2; ++d)
          block.gradient[d].push_back(entry.b[static_cast<Eigen::Index>(d)] / measure);
        if (revolution) block.hoop.push_back(entry.value / op.radius[i]);
      }
      row.clear();
      op.row_begin[i + 1] = static_cast<std::int32_t>(block.node.size()); // of the block, so far
    }
  };
  ParallelFailure failure;
#pragma omp parallel
  {
    std::optional<RowAccumulator> row;
#pragma omp for schedule(dynamic)
    for (std::size_t k = 0; k < blocks.size(); ++k)
      failure.guard(static_cast<std::ptrdiff_t>(k), [&] {
        if (!row) row.emplace(cloud.nodes());
        sum_rows(k, *row);
      });
  }
  failure.rethrow();

  std::vector<std::int32_t> offset(blocks.size() + 1, 0);
  for (std::size_t k = 0; k < blocks.size(); ++k)
    offset[k + 1] = offset[k] + static_cast<std::int32_t>(blocks[k].node.size());
  op.node.resize(index(offset.back()));
  for (Field& g : op.gradient) g.resize(index(offset.back()));
  if (revolution) op.hoop.resize(index(offset.back()));
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const std::size_t first = k * block_size, last = std::min(first + block_size, nodes);
    for (std::size_t i = first; i < last; ++i) op.row_begin[i + 1] += offset[k];
    std::copy(blocks[k].node.begin(), blocks[k].node.end(), op.node.begin() + offset[k]);
    for (std::size_t d = 0; d < 2; ++d)
      std::copy(blocks[k].gradient[d].begin(), blocks[k].gradient[d].end(),
                op.gradient[d].begin() + offset[k]);
    std::copy(blocks[k].hoop.begin(), blocks[k].hoop.end(), op.hoop.begin() + (revolution ? offset[k] : 0));
  }
  op.build_transpose();
  return op;
}

StabilisationLinks<2> delaunay_links(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                                     const voronoi::Cells& cells, const CellFacets& around) {
  constexpr double least = 0.1, most = 2.0;
  std::vector<std::array<std::int32_t, 2>> edges;
  edges.reserve(3 * index(cloud.nodes()));
  for (std::size_t t = 0; t < triangulation.node.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (triangulation.neighbour[t][k] < static_cast<std::int32_t>(t))
        edges.push_back({triangulation.node[t][(k + 1) % 3], triangulation.node[t][(k + 2) % 3]});
  CellFacets ends = group_by_cell(
      cloud.nodes(), edges.size(), [&](std::size_t e) -> const auto& { return edges[e]; });

  StabilisationLinks<2> links;
  links.begin = std::move(ends.begin);
  links.neighbour = std::move(ends.facet);
  links.weight.assign(links.neighbour.size(), least);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < index(cloud.nodes()); ++i) {
    const auto other = [i](const std::array<std::int32_t, 2>& pair) {
      return pair[index(pair[0]) == i ? 1 : 0];
    };
    const auto first = links.neighbour.begin() + links.begin[i];
    const auto last = links.neighbour.begin() + links.begin[i + 1];
    for (auto link = first; link < last; ++link) *link = other(edges[index(*link)]);
    std::sort(first, last);
    for (auto a = index(around.begin[i]); a < index(around.begin[i + 1]); ++a) {
      const voronoi::InteriorFacet& facet = cells.interior[index(around.facet[a])];
      const Vec2 between = cloud.position[index(facet.cell[1])] - cloud.position[index(facet.cell[0])];
      const auto link = std::find(first, last, other(facet.cell)) - links.neighbour.begin();
      links.weight[index_of(link)] =
          std::clamp((facet.end - facet.start).norm() / between.norm(), least, most);
    }
  }
  return links;
}

} // namespace cnem::scni
