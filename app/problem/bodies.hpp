#pragma once
// What a case says about parts of the workpiece: materials and initial states of regions, bonded interfaces,
// periodic pieces, imperfections.
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cnem::app {

/// Facets of the named pieces; both faces NAME+ and NAME- of a crack or an interface answer to NAME.
template<int dim>
std::vector<Facet<dim>> facets_of(const Cloud<dim>& cloud, const std::vector<std::string>& pieces);

/// The nodes of facets, each once, in increasing order.
template<int dim> std::vector<NodeIndex> nodes_of(const std::vector<Facet<dim>>& facets);

/// For each node the region of the case it belongs to, −1 where none was given; empty without regions.
/// Throws InputError when two regions lie in one part of the domain.
IndexedVector<NodeIndex, std::int32_t> region_of_nodes(const input::Case& input, const Cloud<2>& cloud);

/// Pairs of nodes that move as one, and those of them that have one temperature; the pieces they are on.
struct Pairs {
  std::vector<std::array<NodeIndex, 2>> motion, heat;
  std::vector<PieceIndex> motion_pieces, heat_pieces;
};

/// The pieces of the two sides of a period.
template<int dim> std::array<PieceIndex, 2> sides_of(const input::Periodicity& spec, const Cloud<dim>& cloud);

/// Faces of interfaces and periodic pieces; of a period the pieces of its two sides stand one after the
/// other. Throws InputError when the nodes of two periodic pieces do not match.
template<int dim> Pairs tied_pairs(const input::Case& input, const Cloud<dim>& cloud);
/// What contact of a body with itself knows of periods, of which those that follow from others are dropped.
/// Throws as tied_pairs does, and where a period lies among others but is no sum of multiples of them.
contact::Repetition<3> repetition(const input::Case& input, const Cloud<3>& cloud);
/// Makes mates of their facets and of those of cracks. Throws as tied_pairs does.
void pair_facets(const input::Case& input, Cloud<2>& cloud);

/// Interfaces whose faces separate. Throws InputError where one is open nowhere between its points.
std::vector<CohesiveSpec> cohesive_specs(const input::Case& input, const Cloud<2>& cloud);

/// Interfaces that heat crosses through a conductance.
std::vector<ContactConductance<2>> conductances(const input::Case& input, const Cloud<2>& cloud);

/// Factor on the flow stress of each node; empty without imperfections.
Field strength(const input::Case& input, const Cloud<2>& cloud);

/// Velocity [component][node], m/s, and temperature [node], K, at time 0. region: as region_of_nodes gives
/// it.
template<int dim>
void set_initial_state(const input::Case& input, const Cloud<dim>& cloud,
                       const IndexedVector<NodeIndex, std::int32_t>& region, Fields<dim>& velocity,
                       Field& temperature);

} // namespace cnem::app
