#pragma once
// Elasticity of a unidirectional ply: four constants in the plane of fibres and their direction.
#include "core/parameter.hpp"

namespace cnem::plasticity {

/// The strain that stress is linear in, along the axes of the stress-free state.
enum class StrainMeasure {
  logarithmic, ///< ½ ln C
  green, ///< ½ (C − 1), paper 000 (51)–(53): softens in compression, at rest below a stretch of 0.58
};
inline constexpr const char* strain_measure_names[] = {"log", "green"};

/// 1 lies along the fibres, in the plane of the model, 2 across them in that plane, 3 out of it.
struct Orthotropic {
  double E1 = 0.0, E2 = 0.0, nu12 = 0.0, G12 = 0.0, angle = 0.0, E3 = infinite, nu13 = infinite, nu23 = 0.4;
  StrainMeasure measure = StrainMeasure::logarithmic;

  static constexpr const char* name = "orthotropic";
  static constexpr const char* formula =
      "of fibres in the plane of the model, ε1 = σ1/E1 − nu12 σ2/E1, ε2 = σ2/E2 − nu12 σ1/E1, γ12 = σ12/G12 "
      "without stress out of the plane; without strain there the compliance of three axes is condensed";
  static constexpr const char* source = "paper 000, 2.4";
  static constexpr Parameter<Orthotropic> parameters[] = {
      {&Orthotropic::E1,
       {.name = "E1",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Young's modulus along the fibres.",
        .example = "34.28 GPa"}},
      {&Orthotropic::E2,
       {.name = "E2",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Young's modulus across them, in the plane.",
        .example = "11.57 GPa"}},
      {&Orthotropic::nu12,
       {.name = "nu12",
        .required = true,
        .meaning = "Contraction across the fibres over the strain along them in tension along them; nu21 is "
                   "nu12 E2/E1.",
        .example = "0.24244"}},
      {&Orthotropic::G12,
       {.name = "G12",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Shear modulus in the plane.",
        .example = "2.05 GPa"}},
      {&Orthotropic::angle,
       {.name = "angle",
        .unit = "rad",
        .meaning = "Of the fibres from +x at the start, counter-clockwise: a tool that cuts towards +x, the "
                   "free surface above it, meets fibres of 0 to 90° that rise ahead of it.",
        .example = "45 deg"}},
      {&Orthotropic::E3,
       {.name = "E3",
        .unit = "Pa",
        .range = positive,
        .meaning = "Young's modulus out of the plane (plane strain).",
        .example = "11.57 GPa",
        .computed = "`E2`"}},
      {&Orthotropic::nu13,
       {.name = "nu13",
        .meaning = "Contraction out of the plane over the strain along the fibres in tension along them "
                   "(plane strain).",
        .example = "0.24244",
        .computed = "`nu12`"}},
      {&Orthotropic::nu23,
       {.name = "nu23",
        .meaning = "Contraction out of the plane over the strain across the fibres in tension across them "
                   "(plane strain)."}}};

  /// Whether the compliance of the plane, and that of all three axes, is positive definite.
  bool sound_in_plane() const;
  bool sound_in_space() const;
};

/// What is left of the stiffness along a fibre, across it and in shear, 1 to 0.
struct PlyShares {
  double fibre = 1.0, matrix = 1.0, shear = 1.0;
};

/// Q of a ply in its axes: σ = Q ε, Pa.
struct PlyStiffness {
  double Q11, Q22, Q12, Q66;

  /// σ11, σ22, σ12 of ε11, ε22, γ12.
  void stress(const double (&strain)[3], double (&stress)[3]) const;
  double largest_eigenvalue() const; ///< in Mandel's notation, with 2 Q66
};

/// The constants that act in the plane, without stress or without strain out of it.
struct PlyConstants {
  double E1, E2, nu12, G12;
  double out_of_plane[2]; ///< σ33 = out_of_plane · (σ11, σ22): 0 without stress there

  double nu21() const { return nu12 * E2 / E1; }
  /// Of damaged matter: Δ = 1 − fibre·matrix·ν12 ν21, Q11 = fibre·E1/Δ, Q22 = matrix·E2/Δ,
  /// Q12 = fibre·matrix·ν12 E2/Δ, Q66 = shear·G12 (Matzenmiller, Lubliner and Taylor 1995).
  PlyStiffness stiffness(const PlyShares& left = {}) const;
};

/// Without stress out of the plane the constants themselves; without strain E1' = 1/S'11, E2' = 1/S'22,
/// ν12' = −S'12/S'11 of the condensed compliance S'_ij = S_ij − S_i3 S_j3/S_33.
PlyConstants ply_constants(const Orthotropic& elastic, bool stress_free);

/// E' of a crack at `angle` from the fibres that is torn open, Pa: K²/E' is what it lets go per area (Sih,
/// Paris and Irwin 1965, with the roots μ of S11 μ⁴ + (2 S12 + S66) μ² + S22 turned into the axes of the
/// crack).
double crack_modulus(const PlyConstants& ply, double angle);

/// Stiffness of σxx, σyy, σxy over εxx, εyy, γxy in the axes of the model, Pa, of fibres at `elastic.angle`.
struct PlaneStiffness {
  double D[3][3];
  double zz[3];        ///< σzz over these strains, Pa
  double thickness[3]; ///< εzz over these strains where there is no σzz; else 0
  double shear;        ///< G12, Pa
};
PlaneStiffness plane_stiffness(const Orthotropic& elastic, bool stress_free);

} // namespace cnem::plasticity
