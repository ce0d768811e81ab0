#pragma once
// What a run is made of: the model that stays as it is, the conditions that move and change with the cloud,
// and the values it starts from.
#include "contact/contact.hpp"
#include "core/operators/discretisation.hpp"
#include "mechanics/cohesive_faces.hpp"
#include "mechanics/local_steps.hpp"
#include "mechanics/mass_scaling.hpp"
#include "mechanics/supports.hpp"
#include "mechanics/terms/bulk_viscosity.hpp"
#include "mechanics/terms/loads.hpp"
#include "mechanics/ties.hpp"
#include "plasticity/material.hpp"
#include "thermal/boundaries.hpp"
#include "thermal/tool_section.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace cnem {

/// What does not change while a run goes on.
template<int dim> struct Model {
  std::unique_ptr<Discretisation<dim>> method;
  std::vector<plasticity::Material> materials;
  double stabilisation = 0.05;    ///< α of the edge defect
  double pressure_exchange = 0.0; ///< α of the exchange of volume between flowing neighbours
  double stress_annealing = 0.0;  ///< strength of the annealing of stresses where flow has ceased
  BulkViscosity viscosity;
  bool thermal = true;
  bool mechanical = true;    ///< false: nothing moves, heat alone
  bool plane_stress = false; ///< in the plane: no stress out of it; all is per initial thickness
  double safety = 0.9;       ///< factor on the stable step
  LocalStepControl local;    ///< local time steps
  MassScaling mass_scaling;
  bool open = false;                           ///< matter comes and goes: a window moves with a tool
  bool separating = false;                     ///< there are cohesive interfaces
  bool sprung_tools = false;                   ///< there are tools on springs or with dampers
  std::vector<ToolSection<dim>> tool_sections; ///< of tools that conduct
};

/// What acts on the body from outside or ties it, and the cloud it is known by: all of it follows the cloud
/// when that is resampled.
template<int dim> struct Conditions {
  Cloud<dim> cloud;       ///< boundary; its positions follow the reference
  Ties<dim> ties;         ///< nodes that move as one
  Ties<dim> heat_ties;    ///< nodes that have one temperature
  CohesiveFaces cohesive; ///< of the plane
  Supports<dim> supports;
  Loads<dim> loads;
  ThermalBoundaries<dim> heat_boundaries;
  contact::RigidContact<dim> contact{std::vector<contact::Tool<dim>>{}};
};

/// What the nodes are at t = 0 beside their positions.
template<int dim> struct InitialValues {
  std::vector<std::int32_t> node_material; ///< [node] index into materials; empty: the first everywhere
  Field strength;                          ///< [node] – factor on the flow stress; empty: 1 everywhere
};

/// All that a solver starts from.
template<int dim> struct Problem : Model<dim>, Conditions<dim>, InitialValues<dim> {};

} // namespace cnem
