#pragma once
// What a response of a tool is asked about a node inside the tool, and what it answers.
#include "core/parameter.hpp"
#include "core/vec.hpp"

namespace cnem::contact {

/// A node that was inside a tool at the start of the step, before what the tool does to it in this step.
template<int dim> struct Intrusion {
  double depth = 0.0;                   ///< m, > 0, at t_n
  double dt = 0.0, dt_mean = 0.0;       ///< s, Δt₂ = t_{n+1} − t_n and Δt̄ = (Δt₁ + Δt₂)/2
  Vec<dim> normal = Vec<dim>::Zero();   ///< out of the tool
  Vec<dim> tool = Vec<dim>::Zero();     ///< m/s, velocity of the tool at t_{n+½}
  Vec<dim> approach = Vec<dim>::Zero(); ///< m/s, of the tool towards the node, at t_{n+½}
  Mat<dim> mobility = Mat<dim>::Zero(); ///< 1/kg, of the node against the tool
};

/// An impulse on the node, N s.
template<int dim> struct Push {
  Vec<dim> impulse = Vec<dim>::Zero();
  bool rubs = false; ///< friction, as `friction` has it, comes on top
};

} // namespace cnem::contact
