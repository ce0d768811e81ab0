#pragma once
// Rigid tools: shape, motion or mass, friction and what they do to heat.
#include "contact/friction.hpp"
#include "contact/response.hpp"
#include "contact/springs/list.hpp"
#include "contact/tool_shape.hpp"
#include "core/heat_curves.hpp"
#include "core/indexed.hpp"
#include "core/parameter.hpp"
#include "core/time_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cnem::contact {

/// Translation with prescribed velocity components, m/s over s.
template<int dim> struct ToolMotion {
  std::array<TimeTable, dim> velocity; ///< an empty table is zero

  Vec<dim> velocity_at(double t) const {
    Vec<dim> v;
    for (int k = 0; k < dim; ++k) v[k] = velocity[index_of(k)](t);
    return v;
  }
  /// Displacement since t = 0, m.
  Vec<dim> displacement(double t) const {
    Vec<dim> u;
    for (int k = 0; k < dim; ++k) u[k] = velocity[index_of(k)].integral(t);
    return u;
  }
};

/// A spring between a tool and its mount: what holds a blank holder down, or the frame of a press above a
/// punch. The mount moves as the motion of the tool says.
template<int dim> struct ToolSpring {
  Spring spring;
  Vec<dim> along = Vec<dim>::Zero(); ///< unit vector: it pushes the tool that way, away from the mount
};

/// A tool that moves as a rigid body, without rotation, under a force, a spring, a damper and the reaction of
/// the workpiece.
template<int dim> struct ToolDrive {
  double mass = 0.0;                            ///< kg/m^(3−dim) (kg of revolution), > 0
  std::array<TimeTable, dim> force;             ///< N/m^(3−dim) (N of revolution); an empty table is zero
  Vec<dim> initial_velocity = Vec<dim>::Zero(); ///< m/s
  Mat<dim> free = Mat<dim>::Identity(); ///< projector on the directions it may move in; guides take the rest
  std::optional<ToolSpring<dim>> spring = {};
  double damping = 0.0; ///< N s/m^(4−dim) (N s/m of revolution), against motion relative to the mount
};

/// Thermal side of a tool, which is held at one temperature unless it has a section
/// (thermal/tool_section.hpp).
struct ToolThermal {
  double conductance = 0.0;
  double temperature = 293.15;
  double effusivity = 0.0;          ///< its share of the friction heat is e_t/(e_t + e_w) …
  double friction_share = infinite; ///< … or this, where finite

  /// Of the friction heat, where the effusivity of the workpiece is e_w (W √s/(m² K)).
  double share_of_workpiece(double e_w) const {
    if (friction_share < infinite) return 1.0 - friction_share;
    return effusivity == 0.0 ? 1.0 : e_w / (e_w + effusivity);
  }

  static constexpr Parameter<ToolThermal> parameters[] = {
      {&ToolThermal::conductance,
       {.name = "conductance",
        .unit = "W/(m2 K)",
        .range = not_negative,
        .meaning = "Of the closed contact; 0 insulates."}},
      {&ToolThermal::temperature,
       {.name = "temperature",
        .unit = "K",
        .range = temperature_range,
        .meaning = "Of the tool.",
        .example = "296 K",
        .computed = "`initial.temperature`"}},
      {&ToolThermal::effusivity,
       {.name = "effusivity",
        .unit = "W s^0.5/(m2 K)",
        .range = not_negative,
        .meaning = "√(kρc), which decides the tool's share of the friction heat; or give the next three.",
        .source = "Carslaw and Jaeger 1959",
        .computed = "0: all of it goes to the workpiece"}},
      {&ToolThermal::friction_share,
       {.name = "friction_share",
        .range = fraction,
        .meaning = "Share of the friction heat that the tool takes.",
        .example = "0.5",
        .computed = "by the effusivities"}}};
};

/// What the effusivity of a tool can be made of.
struct ToolMetal {
  double conductivity = infinite, density = infinite, specific_heat = infinite;
  HeatCurves heat_curves;

  static constexpr Parameter<ToolMetal> parameters[] = {
      {&ToolMetal::conductivity,
       {.name = "conductivity", .unit = "W/(m K)", .range = not_negative, .meaning = "Of the tool."}},
      {&ToolMetal::density,
       {.name = "density", .unit = "kg/m3", .range = positive, .meaning = "Of the tool."}},
      {&ToolMetal::specific_heat,
       {.name = "specific_heat", .unit = "J/(kg K)", .range = positive, .meaning = "Of the tool."}}};

  double effusivity() const { return std::sqrt(conductivity * density * specific_heat); } ///< W √s/(m² K)
};

/// What a tool does to what touches it, whatever its shape and motion.
struct ToolSurface {
  std::string name;
  Friction friction;
  std::vector<Friction>
      friction_by_material; ///< [material of the node] in place of it; empty: the same for all
  Response response;
  ToolThermal thermal;
  bool equal_areas = false; ///< as contact/arc_offset.hpp and contact/covered_edges.hpp say

  /// Whether any of its friction is what `property` says.
  bool any_friction(bool (Friction::*property)() const) const {
    return (friction.*property)() || std::any_of(friction_by_material.begin(), friction_by_material.end(),
                                                 [&](const Friction& one) { return (one.*property)(); });
  }
};

template<int dim> struct Tool : ToolSurface {
  std::shared_ptr<const ToolShape<dim>> shape;
  ToolMotion<dim> motion; ///< prescribed; with a drive that of its mount
  std::optional<ToolDrive<dim>> drive;

  /// Where it would be at t (m) if it met nothing and its spring were stiff, and how fast (m/s): for what is
  /// said before a run.
  Vec<dim> led_displacement(double t) const {
    if (!drive) return motion.displacement(t);
    return drive->free * Vec<dim>(motion.displacement(t) + t * drive->initial_velocity);
  }
  Vec<dim> led_velocity(double t) const {
    if (!drive) return motion.velocity_at(t);
    return drive->free * Vec<dim>(motion.velocity_at(t) + drive->initial_velocity);
  }
};

template<int dim> using Tools = IndexedVector<ToolIndex, Tool<dim>>;

} // namespace cnem::contact
