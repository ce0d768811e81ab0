#pragma once
// What is looked at before a run, a family of doubts in a file each; plausibility.cpp lists them.
#include "app/plausibility/plausibility.hpp"

namespace cnem::app {

using Doubts = std::vector<std::string>;

/// Constants of metals a power of ten off.
void doubt_materials(const input::Case& input, Doubts& doubts);
/// Temperatures near 0 K, and metals of tools that no tool is made of.
void doubt_heat(const input::Case& input, Doubts& doubts);
/// Signs of damage laws, and strains at which no metal breaks.
void doubt_damage(const input::Case& input, Doubts& doubts);
/// Coefficients of friction that no pair of metals has.
void doubt_friction(const input::Case& input, Doubts& doubts);
/// What [cutting] says that no lathe does.
void doubt_cutting(const input::Case& input, Doubts& doubts);
/// Output asked for when the run is over, or far too often.
void doubt_output(const input::Case& input, Doubts& doubts);
/// Tools that move away from the workpiece, meet it late or never, or go far beyond it.
template<int dim>
void doubt_motions(const input::Case& input, const ExplicitSolver<dim>& solver, Doubts& doubts);
/// Supports of which one alone holds what several name.
template<int dim>
void doubt_supports(const input::Case& input, const ExplicitSolver<dim>& solver, Doubts& doubts);
/// Tools with a mass that forces push away, hardly push by the end, or push with a force of nothing on earth.
void doubt_pushes(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts);
/// Clearances below zero, of nothing or wide open, strokes that cut nothing, sheets of a few cells, and arcs
/// of tools that no node feels.
void doubt_edges(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts);
/// Of the last in space: edges of tools along lines or round circles.
void doubt_edges(const input::Case& input, const ExplicitSolver<3>& solver, Doubts& doubts);
/// An arc of a tool, m, that nodes with this spacing, m, hardly feel; none where they do.
void doubt_arc(const input::Case& input, const std::string& tool, double radius, double spacing,
               Doubts& doubts);
/// The opening at which metal has broken and the length that damage is averaged over, beside the cells and
/// the workpiece.
void doubt_fracture(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts);
/// Cohesive interfaces whose zone of softening has too few cells.
void doubt_interfaces(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts);
/// Parts that pass through each other.
void doubt_parts(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts);

/// What adaptation refines to at the finest, m; infinite without it.
double adapted_spacing(const input::Case& input);

/// Materials that the workpiece has somewhere.
std::vector<const plasticity::Material*> materials_in_use(const input::Case& input);

/// Of a material that flows, Pa, at 1 /s and the temperature of the start.
double starting_flow_stress(const input::Case& input, const plasticity::Material& material, double strain);

/// The lesser side of the box round the workpiece, m. Of the plane.
double smaller_side(const input::Case& input);

/// Whether the workpiece stands until a tool comes: it neither flies nor is moved by its boundary.
template<int dim> bool waits_for_tools(const input::Case& input, const ExplicitSolver<dim>& solver);

/// "file:line:column: key 'a.b': text".
inline std::string doubt_about(const input::Case& input, const std::string& key, const std::string& text) {
  return input.error(key, text).what();
}

} // namespace cnem::app
