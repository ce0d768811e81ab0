#pragma once
// What contact solves for: contacts with their impulses, and what nodes and tools answer to them.
#include "core/indexed.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>

namespace cnem::contact {

/// What a node or a tool answers to an impulse: Δv = inverse J with inverse = P/m; 0 for prescribed motion.
template<int dim> struct Reaction {
  Mat<dim> inverse = Mat<dim>::Zero();  ///< 1/kg (times m^(3−dim))
  Vec<dim> position = Vec<dim>::Zero(); ///< m, x* of the prediction
  Vec<dim> velocity = Vec<dim>::Zero(); ///< m/s, v* of the prediction
  Vec<dim> change = Vec<dim>::Zero();   ///< m/s, correction found so far
  /// Of a tied node the one whose `change` is that of all that are tied to it, and its `inverse` theirs.
  BoundaryNodeIndex moves_with = BoundaryNodeIndex::none;
};

template<int dim> using ReactionsOfNodes = IndexedVector<BoundaryNodeIndex, Reaction<dim>>;
/// The node whose change a node has: its own where nothing is tied to it.
template<int dim> BoundaryNodeIndex mover(const ReactionsOfNodes<dim>& nodes, BoundaryNodeIndex node) {
  return exists(nodes[node].moves_with) ? nodes[node].moves_with : node;
}
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
  Vec<dim> shift = Vec<dim>::Zero();   ///< m, of what has weights < 0: that image of it is touched
  double level = 0.0;                  ///< m, where the tool is predicted
  Vec<dim> surface = Vec<dim>::Zero(); ///< m/s, predicted velocity of the tool at t_{n+½}
  double coulomb = 0.0;                ///< –
  double limit = 0.0;                  ///< N s, largest tangential impulse (Tresca)
  bool smooth = false;                 ///< Coulomb's law passes smoothly into that limit

  double pressing = 0.0;               ///< N s, normal impulse ≥ 0
  Vec<dim> sliding = Vec<dim>::Zero(); ///< N s, tangential impulse
  bool swept = false;                  ///< in a group that is left to sweeps
  Vec<dim> impulse() const { return pressing * normal + sliding; }

  /// N s, what friction bears at most at a normal impulse (N s): at the present one, or at another.
  double strength() const { return strength(pressing); }
  double strength(double at) const;
};

extern template struct Contact<2>;
extern template struct Contact<3>;

} // namespace cnem::contact
