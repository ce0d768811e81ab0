#include "cnem/smoothing.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/operator_checks.hpp"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <utility>

namespace cnem::scni {
namespace {

/// Of revolution ∫ r φ_a dΓ/|Γ| for the ends of a boundary facet over a part of it, m.
std::array<double, 2> revolved_shares(const BoundaryPart<2>& part, const std::array<Vec2, 2>& end) {
  const double s0 = part.place[0][0], s1 = part.place[1][0], middle = 0.5 * (s0 + s1), length = s1 - s0;
  const auto r = [&](double s) { return (1.0 - s) * end[0].x() + s * end[1].x(); };
  const double r0 = r(s0) / 6.0, r1 = 4.0 * r(middle) / 6.0, r2 = r(s1) / 6.0; // Simpson: exact
  const double second = s0 * r0 + middle * r1 + s1 * r2;
  return {length * (r0 + r1 + r2 - second), length * second};
}

} // namespace

template<int dim, class Face>
UnjoinedRows<dim> smoothed_rows(const Cloud<dim>& cloud, const FacesOfCells<dim, Face>& cells,
                                FaceMeans means, const CentroidValues* revolution) {
  const auto nodes = index_of(cloud.nodes());
  assert(cells.volume.size() == nodes && cells.of_cell.begin.size() == nodes + 1);
  const auto boundary = group_by_cell<PartIndex>(
      nodes, cells.boundary.size(), [&](std::size_t p) { return std::array{cells.boundary[p].cell}; });

  DiscreteOperators<dim> op;
  op.points = op.nodes = cloud.nodes();
  op.nodal = true;
  op.volume = cells.volume;
  if (revolution) {
    assert(dim == 2 && revolution->radius.size() == nodes);
    op.radius = revolution->radius;
    for (std::size_t i = 0; i < nodes; ++i) op.volume[i] *= 2.0 * std::numbers::pi * op.radius[i];
  }

  const auto shares_of = [&](const BoundaryPart<dim>& part, const std::array<Vec<dim>, dim>& corner) {
    if constexpr (dim == 2)
      if (revolution) return revolved_shares(part, corner);
    return part.shares();
  };
  auto rows = sum_rows(op, [&](std::size_t i, RowAccumulator<dim>& row) {
    for (const FaceIndex f : cells.of_cell.of(i)) {
      const Face& face = cells.inner[index_of(f)];
      const double sign = index_of(face.cell[0]) == i ? 1.0 : -1.0;
      const Vec<dim> normal = sign * face.normal();
      const auto node = means.nodes(f);
      const auto value = means.values(f);
      for (std::size_t e = 0; e < node.size(); ++e) row.add(node[e], value[e] * normal);
    }
    means.release(cells.of_cell.of(i)); // rows take their place
    for (const PartIndex p : boundary.of(i)) {
      const BoundaryPart<dim>& part = cells.boundary[p];
      const Facet<dim>& facet = cloud.facets[part.facet];
      const auto corner = corners_of<dim>(facet, cloud.position);
      const Vec<dim> normal = area_normal<dim>(corner);
      const auto share = shares_of(part, corner);
      for (std::size_t a = 0; a < dim; ++a) row.add(facet.node[a], share[a] * normal);
    }
    if (!revolution) return cells.volume[i];
    for (auto e = index_of(revolution->begin[i]); e < index_of(revolution->begin[i + 1]); ++e) {
      Vec<dim> radial = Vec<dim>::Zero();
      radial[0] = -cells.volume[i] * revolution->value[e];
      row.add(revolution->node[e], radial, revolution->value[e]);
    }
    return cells.volume[i] * op.radius[i];
  });
  return {std::move(op), std::move(rows)};
}

template<int dim, class Face>
DiscreteOperators<dim> smoothed_gradients(const Cloud<dim>& cloud, const FacesOfCells<dim, Face>& cells,
                                          FaceMeans means, const CentroidValues* revolution) {
  DiscreteOperators<dim> op = joined(smoothed_rows(cloud, cells, std::move(means), revolution));
  op.build_transpose();
  assert(rows_are_complete(op) && reproduces_linear_fields(op, cloud.position));
  return op;
}

template<int dim, class Face>
StabilisationLinks<dim> stabilisation_links(const Cloud<dim>& cloud, const FacesOfCells<dim, Face>& cells) {
  StabilisationLinks<dim> links;
  links.begin = cells.neighbours.begin;
  links.neighbour = cells.neighbours.item;
  links.weight.assign(links.neighbour.size(), 0.0);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < cells.volume.size(); ++i) {
    const auto linked = cells.neighbours.of(i);
    double* const weight = links.weight.data() + links.begin[i];
    for (const FaceIndex f : cells.of_cell.of(i)) {
      const Face& face = cells.inner[index_of(f)];
      const NodeIndex other = face.cell[index_of(face.cell[0]) == i ? 1 : 0];
      const auto link = std::find(linked.begin(), linked.end(), other);
      assert(link != linked.end());
      weight[link - linked.begin()] += face.normal().norm();
    }
    for (std::size_t k = 0; k < linked.size(); ++k)
      weight[k] = link_weight<dim>(weight[k], (cloud.position[linked[k]] - cloud.position[i]).norm());
  }
  return links;
}

template DiscreteOperators<2> smoothed_gradients(const Cloud<2>&, const FacesOfCells<2, InnerFace<2>>&,
                                                 FaceMeans, const CentroidValues*);
template DiscreteOperators<3> smoothed_gradients(const Cloud<3>&, const FacesOfCells<3, InnerFace<3>>&,
                                                 FaceMeans, const CentroidValues*);
template DiscreteOperators<3> smoothed_gradients(const Cloud<3>&, const FacesOfCells<3, Interface<3>>&,
                                                 FaceMeans, const CentroidValues*);
template UnjoinedRows<3> smoothed_rows(const Cloud<3>&, const FacesOfCells<3, Interface<3>>&, FaceMeans,
                                       const CentroidValues*);
template StabilisationLinks<2> stabilisation_links(const Cloud<2>&, const FacesOfCells<2, InnerFace<2>>&);
template StabilisationLinks<3> stabilisation_links(const Cloud<3>&, const FacesOfCells<3, InnerFace<3>>&);
template StabilisationLinks<3> stabilisation_links(const Cloud<3>&, const FacesOfCells<3, Interface<3>>&);

} // namespace cnem::scni
