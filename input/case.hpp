#pragma once
// A case as read: everything a user can write in case.toml, checked, with defaults filled in, in SI units.
// The structs of the libraries themselves, where they have one for it; input/case_reader.hpp fills them, app/
// makes solver objects of them. The meaning of each key is in docs/case_reference.md, which is generated from
// input/schema/schema.cpp.
#include "adapt/indicated_fields.hpp"
#include "adapt/plane/resample.hpp"
#include "clouds/generate.hpp"
#include "clouds/space/domain.hpp"
#include "contact/body_contact.hpp"
#include "core/error.hpp"
#include "core/geometry/curve.hpp"
#include "core/geometry/revolution.hpp"
#include "core/geometry/stl.hpp"
#include "core/time_table.hpp"
#include "core/vec.hpp"
#include "input/case_cutting.hpp"
#include "input/case_output.hpp"
#include "mechanics/local_steps.hpp"
#include "mechanics/mass_scaling.hpp"
#include "methods/registry.hpp"
#include "plasticity/cohesive.hpp"
#include "plasticity/material.hpp"
#include "thermal/boundaries.hpp"
#include "thermal/tool_section.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cnem::input {

struct MachiningCase;
struct StructureCase;

/// Prescribed histories of the components x, y and, in space, z; an absent component is not prescribed.
using VectorFunction = std::array<std::optional<TimeTable>, 3>;

/// Whether a component is anywhere other than zero.
bool moves(const VectorFunction& velocity);

struct Analysis {
  enum class Type { explicit_dynamics, statics, stability, milling, modes, removal };
  enum class Kinematics { plane_strain, plane_stress, axisymmetric, three_dimensional };
  Type type = Type::explicit_dynamics;
  Kinematics kinematics = Kinematics::plane_strain;
  /// Of milling, or of the structures that are milled: no body, no cloud.
  bool of_milling() const {
    return type == Type::stability || type == Type::milling || type == Type::modes || type == Type::removal;
  }
  int dimensions() const { return kinematics == Kinematics::three_dimensional ? 3 : 2; }
  Space space() const { return kinematics == Kinematics::axisymmetric ? Space::revolution : Space::plane; }
  bool mechanical = true; ///< false: nothing moves, heat alone
  bool thermal = false;   ///< solve for temperatures: plastic and friction heating, conduction
};

struct TimeControl {
  double end = 0.0;               ///< s; of statics the time at which loads are taken
  double safety = 0.9;            ///< – factor on the stable step
  std::optional<double> max_step; ///< s  upper bound of the step
  std::optional<double> fixed;    ///< s  step used as it is, without an estimate
  int check_every = 10;           ///< steps between estimates of the stable step
  std::optional<double>
      min_step; ///< s  a smaller stable step means divergence; absent: 1e-3 of the first one
  std::optional<std::int64_t> max_steps; ///< – the run ends after so many
  LocalStepControl local;                ///< steps differ from node to node
  std::optional<MassScaling> mass_scaling;
  bool quasi_static = false; ///< inertia is not meant to act
};

/// An embedded crack, or one open to the boundary where its first or last point lies on it. Its faces are
/// the boundary pieces NAME+ (material on the left of the path, seen along it) and NAME-.
struct Crack : clouds::Crack {
  std::array<std::string, 2> tips; ///< names of the first and the last end, for results
};

struct Hole {
  std::string name;
  Curve outline; ///< clockwise
};

/// A polyline from boundary to boundary that divides the workpiece. Its faces are bonded.
struct Interface : clouds::Crack {
  std::optional<double> conductance;               ///< W/(m² K); absent: both faces have one temperature
  std::optional<plasticity::CohesiveLaw> cohesive; ///< absent: faces move as one
  std::vector<Vec2> open; ///< m, empty or two points of a cohesive one: broken between them at the start
  std::string key;        ///< of the case, that asks for it: "domain.interfaces.joint"
};

/// The part of the workpiece, bounded by interfaces and cracks, that holds a point.
struct Region {
  std::string name;
  Vec2 at{0, 0}; ///< m
  std::string material;
  double temperature = 293.15; ///< K, at t = 0
  Vec2 velocity{0, 0};         ///< m/s, at t = 0
};

/// A workpiece in space of a usual shape.
struct Block {
  enum class Shape { box, cylinder, sphere };
  enum class Part { whole, half, quarter, eighth, sector };
  Shape shape = Shape::box;
  Vec3 from{0, 0, 0}, to{0, 0, 0}; ///< m, corners of the box
  Vec3 centre{0, 0, 0};            ///< m; of the bottom of the cylinder, whose axis is along z
  double radius = 0.0;             ///< m
  double inner_radius = 0.0;       ///< m, of a tube or a shell; 0: there is none
  double length = 0.0;             ///< m
  Part part = Part::whole; ///< all, y > 0, x > 0 and y > 0, x, y and z > 0 from the centre, 0 < θ < angle
  double angle = 0.0;      ///< rad, of a sector
  bool grid = true;        ///< boxes of six tetrahedra; else a surface and nodes inside

  /// Names of the faces x-, x+, y-, y+, z-, z+ of the grid.
  std::array<std::string, 6> faces() const;
  /// Corners of the box around it, the lower one first, m.
  std::array<Vec3, 2> bounds() const;
};

/// What makes a body in space of outline and holes: z is drawn out, or y becomes z and they are turned.
struct Sweep {
  bool turned = false;
  double from = 0.0, to = 0.0;       ///< m along z, where it is drawn
  double angle = 0.0;                ///< rad, where it is turned
  Vec3 origin{0, 0, 0};              ///< m, where (0, 0) of an outline that is turned comes to lie
  std::array<std::string, 2> ends{}; ///< names of the ends
};

struct Domain {
  std::string material;                      ///< where no region says otherwise
  std::optional<Block> block;                ///< in space
  std::optional<Sweep> sweep;                ///< in space, of `outer` and `holes`
  std::optional<clouds::Faceted> faceted;    ///< in space, from a file
  std::vector<std::string> faceted_pieces{}; ///< of it, the plane ones first
  std::size_t plane_pieces = 0;              ///< number of these
  Curve outer;                               ///< counter-clockwise
  std::vector<Hole> holes;
  std::vector<Crack> cracks;
  std::vector<Interface> interfaces;
  std::vector<Region> regions;

  bool in_space() const { return block || sweep || faceted; }

  /// Names of the boundary pieces of outline, holes and cracks, each once, in order of appearance.
  std::vector<std::string> piece_names() const;
};

/// The nodes: the spacing that is wanted, and how they are laid out.
struct CloudSpec : clouds::SpacingField, clouds::CloudOptions {
  std::vector<clouds::SpaceRefinement> space_refinements{}; ///< in space, in place of `refinements`
};

/// Conditions on boundary pieces; what is absent is free (mechanics) or insulated (heat). The reader has
/// checked that pieces exist, that symmetry pieces are straight and that no two conditions fight over one
/// piece.
struct BoundaryCondition {
  std::string name;
  std::vector<std::string> pieces;      ///< names; "all" is spelt out
  std::vector<Vec3> points;             ///< m; the nodes nearest to them are held too
  bool symmetry = false;                ///< zero normal velocity, free tangentially
  VectorFunction velocity;              ///< m/s
  VectorFunction displacement;          ///< m, from the initial position
  VectorFunction traction;              ///< Pa, force on the initial area
  std::optional<TimeTable> pressure;    ///< Pa, pushes against the body, on the present area and normal
  std::optional<TimeTable> temperature; ///< K
  std::optional<TimeTable> heat_flux;   ///< W/m², into the body
  std::optional<ConvectionLaw> convection;
};

/// A coolant; its box as in a window.
struct Coolant : ConvectionLaw {
  std::optional<std::array<Vec2, 2>> box; ///< m
  std::optional<std::size_t> follow;      ///< index of the tool that the box moves with
};

struct Spin {
  double rate = 0.0; ///< rad/s, counter-clockwise
  Vec2 centre{0, 0}; ///< m
};

struct VelocityGradient {
  Mat2 rate = Mat2::Zero(); ///< 1/s, ∂v_i/∂X_j
  Vec2 centre{0, 0};        ///< m
};

/// The yield stress is lower by `reduction` exp(−(d/width)²) of itself, d the distance to the polyline.
struct Imperfection {
  std::string name;
  std::vector<Vec2> points; ///< m; one: a point
  double width = 0.0;       ///< m
  double reduction = 0.0;   ///< –
};

struct InitialState {
  double temperature = 293.15;              ///< K
  Vec3 velocity{0, 0, 0};                   ///< m/s
  std::optional<Spin> spin;                 ///< adds rate × (X − centre) to the velocity
  std::optional<VelocityGradient> gradient; ///< adds rate (X − centre)
  std::vector<Imperfection> imperfections;
};

/// Two boundary pieces, one a shifted copy of the other, whose nodes move alike and have the same
/// temperature.
struct Periodicity {
  std::string name;
  std::array<std::string, 2> pieces;
};

struct Loads {
  VectorFunction body_force; ///< m/s², force per unit mass; absent: zero
};

/// Bounds a tool, at t = 0.
struct Plane {
  Vec3 at{0, 0, 0};     ///< m
  Vec3 normal{0, 0, 0}; ///< out of the tool, of any length but zero
};

/// The solid of a tool in space, in axes of its own.
struct ToolSolid {
  enum class Shape { half_space, box, extruded, revolved, swept, stl };
  Shape shape = Shape::half_space;
  Plane plane;                                           ///< of a half-space
  std::array<Vec3, 2> box{Vec3(0, 0, 0), Vec3(0, 0, 0)}; ///< m, low and high corner
  Curve outline, profile;                                ///< m
  std::optional<double> low, high;                       ///< m, ends of what is extruded; none: without end
  double radius_low = 0.0, radius_high = 0.0;            ///< m, of the edges there
  FacetSoup soup;                                        ///< of a file of triangles
  std::string file;                                      ///< its name, for messages
  Vec3 at{0, 0, 0}, axis{0, 0, 1};                       ///< m; –, of any length: of its axes
  double turn = 0.0;                                     ///< rad, about its z axis
};

/// The nodes that a tool conducts with.
struct ToolNodes {
  clouds::SpacingField spacing;
  std::vector<std::string> held;     ///< pieces of the outline that keep the temperature of the start
  double heat_capacity_factor = 1.0; ///< – of tool and coating
  std::optional<ToolCoating> coating;
};

/// A rigid tool. Its shape is made of that by app/problem/registry.
struct Tool : contact::ToolSurface {
  std::map<std::string, contact::Friction> friction_on; ///< by material, where it is another one
  Curve outline;                                        ///< in the plane: counter-clockwise, at t = 0, m
  std::optional<ToolSolid> solid;                       ///< in space
  VectorFunction velocity;                              ///< m/s, without a drive; absent components are zero
  std::optional<contact::ToolDrive<3>> drive;           ///< in the plane without z
  std::optional<contact::ToolMetal> metal; ///< what its effusivity is made of, where it was not given
  std::optional<ToolNodes> section;        ///< of that metal; none: at one temperature
};

struct Method {
  enum class Lagrangian { total, periodic, updated };
  std::string name = "cnem"; ///< as in the registry of methods
  methods::Options options;
  double stabilisation = 0.05;    ///< – α of the edge defect; 0: off
  double stress_annealing = 0.0;  ///< – strength of the annealing of stresses where flow has ceased; 0: off
  double pressure_exchange = 0.0; ///< – α of the exchange of volume between flowing nodes; 0: off
  Lagrangian lagrangian = Lagrangian::periodic;
  int rereference_every = 0;        ///< steps (periodic); 0: never by count
  double rereference_strain = 0.25; ///< – max‖f − 1‖ since the last reference (periodic); 0: never by strain
  double viscosity_linear = 0.06;   ///< – c₂ of the bulk viscosity
  double viscosity_quadratic = 1.2; ///< – c₁ of the bulk viscosity
  double energy_tolerance = 0.05; ///< – |residual|/(work + initial energy) beyond which a run has diverged
};

/// A part of a longer workpiece that goes with a tool: matter is fed in ahead and taken off behind, in
/// strips.
struct MovingWindow {
  std::size_t tool = 0;       ///< index of the tool
  double ahead = 0.0;         ///< m of workpiece from the tip of the tool on, at least
  double behind = 0.0;        ///< m behind the tip that are kept
  std::optional<double> chip; ///< m of its rake side that are kept; absent: all
  double strip = 0.0;         ///< m, by which it moves
};

/// How the cloud follows the deformation.
struct Adaptation {
  /// The boundary piece that separation makes.
  static constexpr const char* fracture_piece = "fracture";
  bool resample = false;
  bool separate = false;      ///< broken matter is opened along edges between nodes
  bool cracks = false;        ///< also from the boundary to a tip inside
  double thinnest_film = 0.0; ///< m, thinner ones are cut though they are whole
  adapt::Placement placement = adapt::Placement::between_nodes;
  int quiet_every = 0; ///< steps between passes at most, where they change hardly anything; 0: as ever
  double growth = 0.3; ///< – of the wanted spacing per distance
  std::optional<double> tool_spacing;    ///< m, at corners and arcs of tools
  std::optional<double> surface_spacing; ///< m, of free surfaces that flow
  double rest_factor = 0.0; ///< – of the first spacing, for what has flowed and rests; 0: it keeps its own
  const adapt::IndicatedField* indicator = nullptr; ///< null: the spacing stays
  double tolerance = 0.1;          ///< – of the norm of the field, shared out among the cells
  double coarsen = 0.05;           ///< – of the limit; 0: never
  double h_min = 0.0, h_max = 0.0; ///< m
  std::int64_t max_nodes = 100000;
  std::optional<MovingWindow> window;
};

/// Evaluation of crack tips.
struct Fracture {
  bool enrichment = true;                  ///< branch functions near tips (statics, cnem)
  std::optional<double> enrichment_radius; ///< m
  std::optional<double> integral_inner;    ///< m, the weight of the domain integral is 1 within
  std::optional<double> integral_outer;    ///< m, and 0 beyond
};

/// Names of the fields of the catalogue (mechanics/field_catalogue.hpp): all of them, or those that probes
/// and lines know.
std::vector<std::string> field_names(int dimensions, bool adaptive = true);

/// A variable of [let].
struct Variable {
  std::string name;
  double value = 0.0;     ///< SI
  std::string unit;       ///< SI; "": a number
  std::string expression; ///< as it was written; "" for a bare number
};

struct Case {
  std::string path;  ///< file it was read from
  std::string name;  ///< folder of a case.toml, else the file name without extension
  std::string title; ///< free text
  Analysis analysis;
  TimeControl time;
  Domain domain;
  CloudSpec cloud;
  std::vector<plasticity::Material> materials;
  std::vector<BoundaryCondition> boundary;
  std::vector<Coolant> coolants;
  std::vector<Periodicity> periodic;
  InitialState initial;
  Loads loads;
  std::vector<Tool> tools;
  contact::BodyContactLaw contact; ///< of the workpiece with itself
  Method method;
  Adaptation adapt;
  Fracture fracture;
  std::optional<CuttingSetup> cutting; ///< what the case was made of, where it says [cutting]
  /// Of milling analyses, which have nothing of the above but titles (input/case_machining.hpp); else null.
  std::shared_ptr<const MachiningCase> machining;
  /// What vibrates in it, and in analyses of modes (input/case_structure.hpp); else null.
  std::shared_ptr<const StructureCase> structure;
  Output output;
  Report report;

  Vec3 origin{0, 0, 0}; ///< m, from which all places above are counted (input/local_origin.hpp)

  std::vector<Variable> variables;             ///< in the order they were written
  std::string resolved;                        ///< the whole case in SI, defaults included, as TOML
  std::map<std::string, std::string> location; ///< key → "file:line:column", or the --set that gave it
  std::vector<std::string> warnings;           ///< what is allowed and hardly meant, one sentence each

  /// The material of that name; the reader has checked that domain.material exists.
  const plasticity::Material& material(const std::string& name) const;

  /// An error about a key found later than reading, e.g. when geometry is built:
  /// "file:line:column: key 'a.b': message". Falls back to the nearest enclosing table that was written.
  /// Places in the message are counted from `origin`, and it says so.
  InputError error(const std::string& key, const std::string& message) const;

  /// A message that may name places, with the point they are counted from when that is not (0, 0).
  std::string placed(const std::string& message) const;
};

} // namespace cnem::input
