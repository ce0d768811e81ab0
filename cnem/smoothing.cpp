#include "cnem/smoothing.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/operator_checks.hpp"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <optional>
#include <utility>

namespace cnem::scni {
namespace {

/// One row while it is summed up: entries are found through a table over all nodes.
template<int dim> class RowAccumulator {
public:
  explicit RowAccumulator(int nodes) : slot_(index_of(nodes), -1) {}

  void add(NodeIndex node, const Vec<dim>& b, double value = 0.0) {
    std::int32_t& slot = slot_[node];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(entry_.size());
      entry_.push_back({node, b, value});
    } else {
      entry_[index_of(slot)].b += b;
      entry_[index_of(slot)].value += value;
    }
  }

  struct Entry {
    NodeIndex node;
    Vec<dim> b;
    double value; ///< at the centroid, of revolution
  };

  const std::vector<Entry>& sorted() {
    std::sort(entry_.begin(), entry_.end(), [](const Entry& x, const Entry& y) { return x.node < y.node; });
    return entry_;
  }

  void clear() {
    for (const Entry& e : entry_) slot_[e.node] = -1;
    entry_.clear();
  }

private:
  IndexedVector<NodeIndex, std::int32_t> slot_; ///< index into entry_, −1: none
  std::vector<Entry> entry_;
};

/// Finished rows of consecutive cells.
template<int dim> struct RowBlock {
  std::vector<NodeIndex> node;
  std::array<std::vector<double>, dim> gradient;
  std::vector<double> hoop;
};

/// Of revolution ∫ r φ_a dΓ/|Γ| for the ends of a boundary facet over a part of it, m.
std::array<double, 2> revolved_shares(const BoundaryPart<2>& part, const std::array<Vec2, 2>& end) {
  const double s0 = part.place[0][0], s1 = part.place[1][0], middle = 0.5 * (s0 + s1), length = s1 - s0;
  const auto r = [&](double s) { return (1.0 - s) * end[0].x() + s * end[1].x(); };
  const double r0 = r(s0) / 6.0, r1 = 4.0 * r(middle) / 6.0, r2 = r(s1) / 6.0; // Simpson: exact
  const double second = s0 * r0 + middle * r1 + s1 * r2;
  return {length * (r0 + r1 + r2 - second), length * second};
}

} // namespace

template<int dim>
DiscreteOperators<dim> smoothed_gradients(const Cloud<dim>& cloud, const CellComplex<dim>& cells,
                                          const CellLists<FaceIndex>& faces, const FaceMeans& means,
                                          const CentroidValues* revolution) {
  const auto nodes = index_of(cloud.nodes());
  assert(cells.cells() == nodes && faces.begin.size() == nodes + 1);
  const CellLists<PartIndex> boundary = parts_of_cells(cells);

  DiscreteOperators<dim> op;
  op.points = op.nodes = cloud.nodes();
  op.nodal = true;
  op.volume = cells.volume;
  if (revolution) {
    assert(dim == 2 && revolution->radius.size() == nodes);
    op.radius = revolution->radius;
    for (std::size_t i = 0; i < nodes; ++i) op.volume[i] *= 2.0 * std::numbers::pi * op.radius[i];
  }
  op.row_begin.assign(nodes + 1, 0);

  const auto shares_of = [&](const BoundaryPart<dim>& part, const std::array<Vec<dim>, dim>& corner) {
    if constexpr (dim == 2)
      if (revolution) return revolved_shares(part, corner);
    return part.shares();
  };
  std::vector<RowBlock<dim>> blocks((nodes + block_size - 1) / block_size);
  const auto sum_rows = [&](std::size_t k, RowAccumulator<dim>& row) {
    RowBlock<dim>& block = blocks[k];
    const std::size_t first = k * block_size, last = std::min(first + block_size, nodes);
    block.node.reserve(11 * (last - first));
    for (auto& g : block.gradient) g.reserve(11 * (last - first));
    for (std::size_t i = first; i < last; ++i) {
      for (const FaceIndex f : faces.of(i)) {
        const InnerFace<dim>& face = cells.interior[f];
        const double sign = index_of(face.cell[0]) == i ? 1.0 : -1.0;
        const Vec<dim> normal = sign * face.normal();
        const auto node = means.nodes(f);
        const auto value = means.values(f);
        for (std::size_t e = 0; e < node.size(); ++e) row.add(node[e], value[e] * normal);
      }
      for (const PartIndex p : boundary.of(i)) {
        const BoundaryPart<dim>& part = cells.boundary[p];
        const Facet<dim>& facet = cloud.facets[part.facet];
        const auto corner = corners_of<dim>(facet, cloud.position);
        const Vec<dim> normal = area_normal<dim>(corner);
        const auto share = shares_of(part, corner);
        for (std::size_t a = 0; a < dim; ++a) row.add(facet.node[a], share[a] * normal);
      }
      double measure = cells.volume[i];
      if (revolution) {
        for (auto e = index_of(revolution->begin[i]); e < index_of(revolution->begin[i + 1]); ++e) {
          Vec<dim> radial = Vec<dim>::Zero();
          radial[0] = -cells.volume[i] * revolution->value[e];
          row.add(revolution->node[e], radial, revolution->value[e]);
        }
        measure *= op.radius[i];
      }
      for (const auto& entry : row.sorted()) {
        block.node.push_back(entry.node);
        for (std::size_t d = 0; d < dim; ++d)
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
    std::optional<RowAccumulator<dim>> row;
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
  op.node.resize(index_of(offset.back()));
  for (Field& g : op.gradient) g.resize(index_of(offset.back()));
  if (revolution) op.hoop.resize(index_of(offset.back()));
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const std::size_t first = k * block_size, last = std::min(first + block_size, nodes);
    for (std::size_t i = first; i < last; ++i) op.row_begin[i + 1] += offset[k];
    std::copy(blocks[k].node.begin(), blocks[k].node.end(), op.node.begin() + offset[k]);
    for (std::size_t d = 0; d < dim; ++d)
      std::copy(blocks[k].gradient[d].begin(), blocks[k].gradient[d].end(),
                op.gradient[d].begin() + offset[k]);
    std::copy(blocks[k].hoop.begin(), blocks[k].hoop.end(), op.hoop.begin() + (revolution ? offset[k] : 0));
  }
  op.build_transpose();
  assert(rows_are_complete(op) && reproduces_linear_fields(op, cloud.position));
  return op;
}

template<int dim>
StabilisationLinks<dim> stabilisation_links(const Cloud<dim>& cloud, const CellComplex<dim>& cells,
                                            const CellLists<FaceIndex>& faces) {
  constexpr double least = dim == 2 ? 0.1 : 0.05, most = 2.0;
  StabilisationLinks<dim> links;
  links.begin = cells.neighbours.begin;
  links.neighbour = cells.neighbours.item;
  links.weight.assign(links.neighbour.size(), 0.0);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < cells.cells(); ++i) {
    const auto linked = cells.neighbours.of(i);
    double* const weight = links.weight.data() + links.begin[i];
    for (const FaceIndex f : faces.of(i)) {
      const InnerFace<dim>& face = cells.interior[f];
      const NodeIndex other = face.cell[index_of(face.cell[0]) == i ? 1 : 0];
      const auto link = std::find(linked.begin(), linked.end(), other);
      assert(link != linked.end());
      weight[link - linked.begin()] += face.normal().norm();
    }
    for (std::size_t k = 0; k < linked.size(); ++k) {
      const double distance = (cloud.position[linked[k]] - cloud.position[i]).norm();
      if constexpr (dim == 2)
        weight[k] = std::clamp(weight[k] / distance, least, most);
      else
        weight[k] = std::clamp(weight[k] / (distance * distance), least, most) * distance;
    }
  }
  return links;
}

template DiscreteOperators<2> smoothed_gradients(const Cloud<2>&, const CellComplex<2>&,
                                                 const CellLists<FaceIndex>&, const FaceMeans&,
                                                 const CentroidValues*);
template DiscreteOperators<3> smoothed_gradients(const Cloud<3>&, const CellComplex<3>&,
                                                 const CellLists<FaceIndex>&, const FaceMeans&,
                                                 const CentroidValues*);
template StabilisationLinks<2> stabilisation_links(const Cloud<2>&, const CellComplex<2>&,
                                                   const CellLists<FaceIndex>&);
template StabilisationLinks<3> stabilisation_links(const Cloud<3>&, const CellComplex<3>&,
                                                   const CellLists<FaceIndex>&);

} // namespace cnem::scni
