#pragma once
// Everything that evolves in a run: one line per field says its name, unit, how it goes over to a resampled
// cloud, whether checkpoints hold it, its value at rest and how users see it.
#include "core/fields/field_table.hpp"
#include "core/vec.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace cnem {

/// Components of a symmetric tensor: 2D keeps the out-of-plane one: xx, yy, zz, xy; 3D: xx, yy, zz, xy, yz,
/// zx.
template<int dim> inline constexpr int symmetric_size = dim == 2 ? 4 : 6;

/// Components of a general tensor: 2D keeps the out-of-plane one: xx, xy, yx, yy, zz; 3D row by row.
template<int dim> inline constexpr int tensor_size = dim == 2 ? 5 : 9;

/// Damage and failure index of a mode of plies.
constexpr FieldLine ply_damage(const char* name, const char* label, const char* meaning) {
  return {name,
          "1",
          Carry::mass_mean,
          Checkpoint::holds,
          rest_zero,
          Shown{label, meaning, "", 1.0, ColourMap::strain}};
}
constexpr FieldLine ply_index(const char* name, const char* label, const char* meaning) {
  return {name,           "1",
          Carry::renewed, Checkpoint::holds,
          rest_zero,      Shown{label, meaning, "", 1.0, ColourMap::heat}};
}

/// Fields at nodes. Index: [node], vectors [component][node]. Per metre of thickness in the plane, of the
/// whole body in 3D and of revolution.
template<int dim> struct NodeState {
  FieldTable table{"solver/node"};
  /// X, position in the reference configuration
  TensorField<dim> reference{table, {"reference", "m", Carry::renewed, Checkpoint::holds}};
  /// x, position at t_n
  TensorField<dim> position{table, {"position", "m", Carry::renewed, Checkpoint::holds}};
  /// v at t_{n−½}
  TensorField<dim> velocity{table, {"velocity", "m/s", Carry::inertia_mean, Checkpoint::holds}};
  /// internal and applied forces at t_n, contact and supports excluded
  TensorField<dim> force{table, {"force", "N/m", Carry::renewed, Checkpoint::holds}};
  /// carried with the node, never recomputed
  ScalarField mass{table, {"mass", "kg/m", Carry::sum, Checkpoint::holds}};
  ScalarField temperature{table,
                          {"temperature", "K", Carry::capacity_mean, Checkpoint::holds, rest_zero,
                           Shown{"temperature", "Temperature", "K", 1.0, ColourMap::heat}}};
  ScalarField heat_capacity{table, {"heat_capacity", "J/(K m)", Carry::sum, Checkpoint::holds}};
  TensorField<dim> initial_position{table, {"initial_position", "m", Carry::label, Checkpoint::holds}};
  ScalarField initial_temperature{table,
                                  {"initial_temperature", "K", Carry::capacity_mean, Checkpoint::holds}};
  LabelField material{table, "material"}; ///< index of the material
  /// factor on the flow stress at the start (InitialValues of mechanics/model.hpp)
  ScalarField strength{table, {"strength", "1", Carry::renewed, Checkpoint::omits, rest_one}};
  /// v_{n−½} while v_{n+½} is made
  TensorField<dim> velocity_before{table, {"velocity_before", "m/s"}};
  ScalarField heat_flow{table, {"heat_flow", "W/m"}};
  ScalarField contact_heat{table, {"contact_heat", "J/m"}}; ///< friction heat of the last step

  FieldTable scaling{"solver/node", false}; ///< on with mass scaling
  ScalarField mass_scale{scaling, {"mass_scale", "1", Carry::mass_mean, Checkpoint::holds}};
  ScalarField scaled_mass{scaling, {"scaled_mass", "kg/m"}};

  NodeState() = default;
  NodeState(const NodeState& other) : NodeState() { *this = other; }
  ~NodeState() = default;
  NodeState& operator=(const NodeState&) = default;

  std::size_t size() const { return mass.size(); }
  /// What resists acceleration: the mass, or more with mass scaling.
  const Field& inertia() const { return scaling.on() ? scaled_mass : mass; }
};

/// Fields at stress points. Index: [point], tensors [component][point].
template<int dim> struct PointState {
  FieldTable table{"solver/point"};
  /// F, from the reference configuration
  TensorField<tensor_size<dim>> deformation{
      table, {"deformation", "1", Carry::renewed, Checkpoint::holds, rest_unit_general<dim>}};
  /// C_p⁻¹ = F⁻¹ b_e F⁻ᵀ: elastic left Cauchy-Green tensor, pulled back to the reference
  TensorField<symmetric_size<dim>> inverse_plastic_cauchy_green{
      table,
      {"inverse_plastic_cauchy_green", "1", Carry::logarithmic_mean, Checkpoint::holds, rest_unit_symmetric}};
  /// P, first Piola-Kirchhoff stress on the reference (P_iK)
  TensorField<tensor_size<dim>> piola{table, {"piola", "Pa", Carry::renewed, Checkpoint::holds}};
  ScalarField plastic_strain{
      table,
      {"plastic_strain", "1", Carry::mass_mean, Checkpoint::holds, rest_zero,
       Shown{"equivalent plastic strain", "Equivalent plastic strain", "", 1.0, ColourMap::strain}}};
  ScalarField plastic_rate{
      table,
      {"plastic_rate", "1/s", Carry::mass_mean, Checkpoint::holds, rest_zero,
       Shown{"equivalent plastic strain rate", "Rate of the equivalent plastic strain in the last step",
             "1/s", 1.0, ColourMap::heat}}};
  /// σ_eq in Kirchhoff measure: von Mises stress, Hill's of anisotropic materials
  ScalarField equivalent_stress{table, {"equivalent_stress", "Pa", Carry::renewed, Checkpoint::holds}};
  /// −tr τ/3, Kirchhoff pressure
  ScalarField pressure{table, {"pressure", "Pa", Carry::renewed, Checkpoint::holds}};
  /// ψ per unit stress-free volume
  ScalarField stored_energy{table, {"stored_energy", "J/m^3", Carry::renewed, Checkpoint::holds}};
  /// ∫ σ_eq dε̄p per unit stress-free volume, since the start
  ScalarField plastic_work{table, {"plastic_work", "J/m^3", Carry::mass_mean, Checkpoint::holds}};
  /// plastic work of the last step per unit stress-free volume; χ of it is heat
  ScalarField dissipation{table, {"dissipation", "J/m^3", Carry::mass_mean, Checkpoint::holds}};
  /// V_stress-free / V_reference = 1/√det C_p⁻¹, constant between re-references
  ScalarField stress_free{table, {"stress_free", "1", Carry::mass_mean, Checkpoint::holds, rest_one}};
  /// N·T, temperature the material sees
  ScalarField temperature{table, {"temperature", "K", Carry::renewed, Checkpoint::holds}};
  /// factor on the flow stress: 1, but for initial imperfections
  ScalarField strength{table, {"strength", "1", Carry::mass_mean, Checkpoint::holds, rest_one}};
  LabelField material{table, "material"}; ///< index of the material
  /// σ_y where and when the point last flowed
  ScalarField flow_stress{table,
                          {"flow_stress", "Pa", Carry::mass_mean, Checkpoint::holds,
                           Rest{std::numeric_limits<double>::infinity()}}};
  ScalarField shear_modulus{table, {"shear_modulus", "Pa", Carry::renewed, Checkpoint::holds}}; ///< μ
  /// λ + 2μ, less where broken (mechanics/terms/point_damage.hpp)
  ScalarField wave_modulus{table, {"wave_modulus", "Pa", Carry::renewed, Checkpoint::holds}};
  ScalarField density{table, {"density", "kg/m^3", Carry::renewed, Checkpoint::holds}}; ///< ρ at F = 1
  /// det F of the last step
  ScalarField jacobian{table, {"jacobian", "1", Carry::renewed, Checkpoint::holds, rest_one}};
  /// q of the bulk viscosity in the last step
  ScalarField viscous_pressure{table, {"viscous_pressure", "Pa", Carry::mass_mean, Checkpoint::holds}};

  FieldTable damaged{"solver/point", false}; ///< on where a material has a damage law
  ScalarField damage{damaged,
                     {"damage", "1", Carry::mass_mean, Checkpoint::holds, rest_zero,
                      Shown{"damage D", "Share of the fracture strain used up; at 1 softening begins", "",
                            1.0, ColourMap::strain}}};
  ScalarField softening{
      damaged,
      {"softening", "1", Carry::mass_mean, Checkpoint::holds, rest_zero,
       Shown{"softening", "Share of flow stress and tension lost; 1: broken", "", 1.0, ColourMap::strain}}};
  /// ε̄p at which softening began, 0 before; of mixed points the mean by mass, in which sound matter is 0
  ScalarField initiation_strain{
      damaged,
      {"initiation_strain", "1", Carry::mass_mean, Checkpoint::holds, rest_zero,
       Shown{"plastic strain at initiation", "Equivalent plastic strain at which softening began", "", 1.0,
             ColourMap::strain}}};
  /// the dilatation that the gaps of broken matter in a point take without tension; 0 but for points that
  /// resampling mixed of broken and sound ones
  ScalarField opening{damaged, {"opening", "1", Carry::mass_mean, Checkpoint::holds}};

  /// on the flow stress: strength and what softening leaves of it
  ScalarField flow_factor{damaged, {"flow_factor", "1"}};

  FieldTable traded{"solver/point", false}; ///< on where neighbours trade elastic volume
  /// ln of b_e's J over the geometric one, up to what new references add
  ScalarField volume_drift{traded, {"volume_drift", "1", Carry::mass_mean, Checkpoint::holds}};

  FieldTable oriented{"solver/point", false}; ///< on where a material is anisotropic
  /// F₀ of the reference configuration since the start: axes of the material turn with the whole F F₀
  TensorField<tensor_size<dim>> earlier_deformation{
      oriented, {"earlier_deformation", "1", Carry::mass_mean, Checkpoint::holds, rest_unit_general<dim>}};

  FieldTable thin{"solver/point",
                  false}; ///< on in plane stress, where what is per area is of the initial thickness
  ScalarField thickness{thin,
                        {"thickness", "1", Carry::mass_mean, Checkpoint::holds, rest_one,
                         Shown{"thickness", "Thickness of a point in plane stress over the initial one", "",
                               1.0, ColourMap::diverging}}};

  FieldTable fibrous{"solver/point", false}; ///< on where a material is a ply
  /// of the fibres from +x, counter-clockwise, at present
  ScalarField fibre_angle{fibrous,
                          {"fibre_angle", "rad", Carry::renewed, Checkpoint::holds, rest_zero,
                           Shown{"fibre angle", "Angle of the fibres of a ply from +x, counter-clockwise",
                                 "deg", 3.14159265358979324 / 180.0, ColourMap::diverging}}};

  FieldTable flowing{"solver/point", false}; ///< on where a ply flows
  /// E^p: ε11, ε22, γ12 in the axes of the ply
  TensorField<3> ply_flow{flowing, {"ply_flow", "1", Carry::mass_mean, Checkpoint::holds}};

  FieldTable failing{"solver/point", false}; ///< on where a ply fails; modes as in plasticity/ply_points.hpp
  ScalarField fibre_tension_damage{failing,
                                   ply_damage("fibre_tension_damage", "fibre damage, tension",
                                              "Damage of fibres that are pulled: share of stiffness lost")};
  ScalarField fibre_compression_damage{
      failing, ply_damage("fibre_compression_damage", "fibre damage, compression",
                          "Damage of fibres that are compressed: share of stiffness lost")};
  ScalarField matrix_tension_damage{
      failing, ply_damage("matrix_tension_damage", "matrix damage, tension",
                          "Damage of matrix that is pulled across the fibres: share of stiffness lost")};
  ScalarField matrix_compression_damage{
      failing, ply_damage("matrix_compression_damage", "matrix damage, compression",
                          "Damage of matrix that is compressed across the fibres: share of stiffness lost")};
  ScalarField shear_damage{
      failing, ply_damage("shear_damage", "shear damage", "Damage of a mode of shear alone (`max-stress`)")};
  ScalarField fibre_tension_index{failing, ply_index("fibre_tension_index", "fibre index, tension",
                                                     "Failure index of fibres that are pulled")};
  ScalarField fibre_compression_index{failing,
                                      ply_index("fibre_compression_index", "fibre index, compression",
                                                "Failure index of fibres that are compressed")};
  ScalarField matrix_tension_index{failing, ply_index("matrix_tension_index", "matrix index, tension",
                                                      "Failure index of matrix that is pulled")};
  ScalarField matrix_compression_index{failing,
                                       ply_index("matrix_compression_index", "matrix index, compression",
                                                 "Failure index of matrix that is compressed")};
  ScalarField shear_index{
      failing, ply_index("shear_index", "shear index", "Failure index of shear alone (`max-stress`)")};
  /// δ0 and σ0 where an index reached 1, and 1 from then on; means over what has begun where matter was mixed
  TensorField<5> onset_strain{failing, {"onset_strain", "m", Carry::mass_mean, Checkpoint::holds}};
  TensorField<5> onset_stress{failing, {"onset_stress", "Pa", Carry::mass_mean, Checkpoint::holds}};
  TensorField<5> begun{failing, {"begun", "1", Carry::mass_mean, Checkpoint::holds}};
  /// of the stiffness of each mode; the damages above end at 0.99, what is left bears on
  TensorField<5> ply_left{
      failing, {"ply_left", "1", Carry::mass_mean, Checkpoint::holds, Rest{1.0, 1.0, 1.0, 1.0, 1.0}}};
  /// ε11, ε22, γ12 in the axes of the ply at t_n
  TensorField<3> ply_strain{failing, {"ply_strain", "1", Carry::renewed, Checkpoint::holds}};
  /// ℓ over which the energy of a mode is spread
  ScalarField failure_length{failing, {"failure_length", "m", Carry::renewed, Checkpoint::holds}};
  /// let go by damage in the last step per unit stress-free volume
  ScalarField failure_release{failing, {"failure_release", "J/m^3"}};

  PointState() = default;
  PointState(const PointState& other) : PointState() { *this = other; }
  ~PointState() = default;
  PointState& operator=(const PointState&) = default;

  std::size_t size() const { return plastic_strain.size(); }
  /// All groups, as checkpoints and changes of the cloud go through them.
  std::vector<FieldTable*> tables() {
    return {&table, &damaged, &traded, &oriented, &thin, &fibrous, &flowing, &failing};
  }
};

/// What adaptation says of the nodes; each list is [node].
struct AdaptationFields {
  FieldTable table{"adaptation"};
  ScalarField level{table,
                    {"level", "1", Carry::renewed, Checkpoint::omits, rest_zero,
                     Shown{"level of refinement",
                           "Level of refinement: log2 of `cloud.spacing` over the wanted spacing (pictures, "
                           "with `adapt.resample`)",
                           "", 1.0, ColourMap::strain}}};
  ScalarField indicator{
      table,
      {"indicator", "1", Carry::renewed, Checkpoint::omits, rest_zero,
       Shown{"error indicator",
             "Error indicator of the cell at the last new reference (pictures, with `adapt.resample`)", "",
             1.0, ColourMap::heat}}};
  ScalarField age{
      table,
      {"age", "s", Carry::renewed, Checkpoint::omits, rest_zero,
       Shown{"age of the node", "Time since the node was inserted (pictures, with `adapt.resample`)", "µs",
             1e-6, ColourMap::heat}}};

  AdaptationFields() = default;
  AdaptationFields(const AdaptationFields& other) : AdaptationFields() { *this = other; }
  ~AdaptationFields() = default;
  AdaptationFields& operator=(const AdaptationFields&) = default;
};

/// What a moving window has taken off of the body, less what it has fed in; per metre of thickness.
template<int dim> struct Departed {
  double mass = 0.0, volume = 0.0;      ///< kg/m^(3−dim), m^dim
  Vec<dim> momentum = Vec<dim>::Zero(); ///< of v_{n−½}, N s/m^(3−dim)
  double enthalpy = 0.0;                ///< Σ C h(T), J/m^(3−dim)
};

template<int dim> struct State {
  NodeState<dim> node;
  PointState<dim> point;
  Departed<dim> departed;
  std::vector<Field> tool_temperature; ///< K, [section][node of it] of tools that conduct
  double time = 0.0;                   ///< s     t_n
  double step_before = 0.0;            ///< s     Δt that led to t_n (0 before the first step)
  std::int64_t step = 0;               ///< –     n
};

} // namespace cnem
