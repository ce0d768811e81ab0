#pragma once
// Unilateral contacts with friction between weighted nodes and planes of rigid tools or facets of other
// nodes, solved for impulses by projected Gauss-Seidel.
#include "core/indexed.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem::contact {

/// What a node or a tool answers to an impulse: Δv = inverse J with inverse = P/m; 0 for prescribed motion.
template<int dim> struct Reaction {
  Mat<dim> inverse = Mat<dim>::Zero();  ///< 1/kg (times m^(3−dim))
  Vec<dim> position = Vec<dim>::Zero(); ///< m, x* of the prediction
  Vec<dim> velocity = Vec<dim>::Zero(); ///< m/s, v* of the prediction
  Vec<dim> change = Vec<dim>::Zero();   ///< m/s, correction found so far
};

template<int dim> using ReactionsOfNodes = IndexedVector<BoundaryNodeIndex, Reaction<dim>>;
template<int dim> using ReactionsOfTools = IndexedVector<ToolIndex, Reaction<dim>>;

/// n·(Σ w_a x_a − Δt Δv_tool) ≥ level at the end of the step, with friction against a plane that moves at
/// `surface` + Δv_tool. Against a tool w are the values N_a of shape functions; a node against a facet of the
/// workpiece has w = 1 and the facet's nodes −N_a, so that the impulses on both sides are equal and opposite;
/// then there is no tool, and Δv_tool and `surface` are zero.
template<int dim> struct Contact {
  static constexpr std::size_t slots = dim + 1;

  ToolIndex tool = ToolIndex::none;    ///< none: the workpiece itself
  std::int32_t feature = 0;            ///< piece of the tool's surface, or ridge
  FacetIndex facet = FacetIndex::none; ///< under a ridge or a node; none for a node on a tool's face
  std::array<BoundaryNodeIndex, slots> node{};
  std::array<double, slots> weight{};  ///< w_a; 0 for unused nodes
  Vec<dim> normal = Vec<dim>::Zero();  ///< out of the tool
  double level = 0.0;                  ///< m, where the tool is predicted
  Vec<dim> surface = Vec<dim>::Zero(); ///< m/s, predicted velocity of the tool at t_{n+½}
  double coulomb = 0.0;                ///< –
  double limit = 0.0;                  ///< N s, largest tangential impulse (Tresca)
  bool smooth = false;                 ///< Coulomb's law passes smoothly into that limit

  double pressing = 0.0;               ///< N s, normal impulse ≥ 0
  Vec<dim> sliding = Vec<dim>::Zero(); ///< N s, tangential impulse
  Vec<dim> impulse() const { return pressing * normal + sliding; }

  /// N s, what friction bears at most at the present normal impulse.
  double strength() const;
};

/// Solves in place: contacts get their impulses, nodes and tools their change of velocity. Sweeps in the
/// order given until nothing moves by more than `tolerance` (m), at most `sweeps` times. Where many nodes
/// press on one free tool, each sweep also moves the tool together with all of them, as Gauss-Seidel alone
/// would need as many sweeps as the contacting nodes are heavier than the tool.
template<int dim>
void solve_impulses(std::vector<Contact<dim>>& contacts, ReactionsOfNodes<dim>& nodes,
                    ReactionsOfTools<dim>& tools, double dt, double tolerance, int sweeps);

extern template void solve_impulses<2>(std::vector<Contact<2>>&, ReactionsOfNodes<2>&, ReactionsOfTools<2>&,
                                       double, double, int);

} // namespace cnem::contact
