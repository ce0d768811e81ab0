#pragma once
// What is looked at before a run, a family of doubts in a file each; plausibility.cpp lists them.
#include "app/plausibility/plausibility.hpp"

namespace cnem::app {

using Doubts = std::vector<std::string>;

/// Constants of metals a power of ten off, and signs of damage laws.
void doubt_materials(const input::Case& input, Doubts& doubts);
/// Coefficients of friction that no pair of metals has.
void doubt_friction(const input::Case& input, Doubts& doubts);
/// What [cutting] says that no lathe does.
void doubt_cutting(const input::Case& input, Doubts& doubts);
/// Output asked for when the run is over.
void doubt_output(const input::Case& input, Doubts& doubts);
/// Tools that move away from the workpiece, meet it late or never, or go far beyond it.
template<int dim>
void doubt_motions(const input::Case& input, const ExplicitSolver<dim>& solver, Doubts& doubts);
/// Clearances below zero, of nothing or wide open, strokes that cut nothing, sheets of a few cells, and arcs
/// of tools that no node feels.
void doubt_edges(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts);
/// Cells wider than the opening at which metal has broken, and parts that pass through each other.
void doubt_bodies(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts);

/// What adaptation refines to at the finest, m; infinite without it.
double adapted_spacing(const input::Case& input);

/// Materials that the workpiece has somewhere.
std::vector<const plasticity::Material*> materials_in_use(const input::Case& input);

/// "file:line:column: key 'a.b': text".
inline std::string doubt_about(const input::Case& input, const std::string& key, const std::string& text) {
  return input.error(key, text).what();
}

} // namespace cnem::app
