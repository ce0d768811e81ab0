#pragma once
// Rigid tools: shape, motion or mass, friction and what they do to heat.
#include "contact/friction.hpp"
#include "contact/tool_shape.hpp"
#include "core/indexed.hpp"
#include "core/time_table.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>

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

/// A tool that moves as a rigid body, without rotation, under a force and the reaction of the workpiece.
template<int dim> struct ToolDrive {
  double mass = 0.0;                            ///< kg/m^(3−dim) (kg of revolution), > 0
  std::array<TimeTable, dim> force;             ///< N/m^(3−dim) (N of revolution); an empty table is zero
  Vec<dim> initial_velocity = Vec<dim>::Zero(); ///< m/s
  Mat<dim> free = Mat<dim>::Identity(); ///< projector on the directions it may move in; guides take the rest
};

/// Thermal side of a tool, which is held at one temperature.
struct ToolThermal {
  double effusivity = 0.0;  ///< W √s/(m² K), √(kρc): its share of the friction heat is e_t/(e_t + e_w)
  double conductance = 0.0; ///< W/(m² K), across the contact; 0 insulates
  double temperature = 293.15; ///< K
};

/// What a tool does to what touches it, whatever its shape and motion.
struct ToolSurface {
  std::string name;
  Friction friction;
  ToolThermal thermal;
};

template<int dim> struct Tool : ToolSurface {
  std::shared_ptr<const ToolShape<dim>> shape;
  ToolMotion<dim> motion; ///< prescribed, when there is no drive
  std::optional<ToolDrive<dim>> drive;
};

template<int dim> using Tools = IndexedVector<ToolIndex, Tool<dim>>;

} // namespace cnem::contact
