#pragma once
// The yield function of rolled sheet and of plies: Hill, Proc. R. Soc. London A 193 (1948) 281, from r-values
// or from ratios of yield stresses.
#include "core/law_variant.hpp"
#include "core/parameter.hpp"
#include "plasticity/hill_form.hpp"

namespace cnem::plasticity {

enum class Axis { x, y, z };
inline constexpr const char* axis_names[] = {"x", "y", "z"};

/// Along rolling (1), transverse (2) and normal (3) direction of the sheet
///   σ̄² = F (σ22 − σ33)² + G (σ33 − σ11)² + H (σ11 − σ22)² + 2 L σ23² + 2 M σ31² + 2 N σ12².
struct HillCoefficients {
  double F, G, H, L, M, N;

  /// Whether all stresses but a mean one have σ̄² > 0: with ratios, each 1/R11, 1/R22, 1/R33 is less than the
  /// sum of the other two.
  bool convex() const;
};

/// In the axes of the model. The sheet has two of its directions along them.
HillForm hill_form(const HillCoefficients& coefficients, Axis rolling, Axis normal);

/// σ̄ is the flow stress in tension along the rolling direction: G + H = 1. r is the plastic strain of the
/// width over that of the thickness in tension at 0°, 45° and 90° to the rolling direction.
struct Hill48 {
  double r0 = 1.0, r45 = 1.0, r90 = 1.0, L = 1.5, M = 1.5;
  Axis rolling = Axis::x, normal = Axis::y; ///< in the model, at the start

  static constexpr const char* name = "hill48";
  static constexpr const char* formula =
      "the flow stress is σ̄, σ̄² = F (σ22 − σ33)² + G (σ33 − σ11)² + H (σ11 − σ22)² + 2 L σ23² + 2 M σ31² + 2 "
      "N σ12² with 1 the rolling, 2 the transverse and 3 the normal direction of the sheet, "
      "G = 1/(1 + r0), H = r0/(1 + r0), F = H/r90, N = (F + G) (r45 + ½)";
  static constexpr const char* source = "Hill 1948";
  static constexpr Parameter<Hill48> parameters[] = {
      {&Hill48::r0,
       {.name = "r0",
        .range = positive,
        .required = true,
        .meaning = "Plastic strain of the width over that of the thickness in tension along the rolling "
                   "direction.",
        .example = "1.8"}},
      {&Hill48::r45,
       {.name = "r45",
        .range = positive,
        .meaning = "The same at 45° to it.",
        .example = "1.4",
        .computed = "`r0`"}},
      {&Hill48::r90,
       {.name = "r90",
        .range = positive,
        .meaning = "The same across it.",
        .example = "2.1",
        .computed = "`r0`"}},
      {&Hill48::L,
       {.name = "L",
        .range = positive,
        .meaning = "Of shear across the thickness and the transverse direction, which r-values say nothing "
                   "of: the flow stress in it is σ̄/√(2 L). 1.5 is that of an isotropic metal."}},
      {&Hill48::M,
       {.name = "M",
        .range = positive,
        .meaning = "The same of shear across the thickness and the rolling direction: what a cut across the "
                   "rolling direction shears."}}};

  HillCoefficients coefficients() const;
  HillForm form() const { return hill_form(coefficients(), rolling, normal); }
};

/// The same function, each R a yield stress over the one that the hardening law gives, R12, R13 and R23 over
/// that by √3: paper 001 (2)–(13), with the sign of 1/R11² in (2) put right.
struct HillRatios {
  double R11 = 1.0, R22 = 1.0, R33 = 1.0, R12 = 1.0, R13 = 1.0, R23 = 1.0;
  Axis rolling = Axis::x, normal = Axis::y; ///< in the model, at the start

  static constexpr const char* name = "hill48-ratios";
  static constexpr const char* formula =
      "the same σ̄, of a ply with 1 along the fibres, 2 across them in the plane and 3 out of it, "
      "F = ½ (1/R22² + 1/R33² − 1/R11²), G = ½ (1/R33² + 1/R11² − 1/R22²), H = ½ (1/R11² + 1/R22² − 1/R33²), "
      "L = 3/(2 R23²), M = 3/(2 R13²), N = 3/(2 R12²)";
  static constexpr const char* source = "paper 001 (1)–(13)";
  static constexpr Parameter<HillRatios> parameters[] = {
      {&HillRatios::R11,
       {.name = "R11",
        .range = positive,
        .meaning = "Yield stress in tension along 1 over the flow stress."}},
      {&HillRatios::R22,
       {.name = "R22", .range = positive, .meaning = "The same in tension along 2.", .example = "0.2"}},
      {&HillRatios::R33,
       {.name = "R33",
        .range = positive,
        .meaning = "The same in tension along 3.",
        .example = "0.2",
        .computed = "`R22`"}},
      {&HillRatios::R12,
       {.name = "R12",
        .range = positive,
        .meaning = "Yield stress in shear of 1 and 2 over the flow stress by √3.",
        .example = "0.046188"}},
      {&HillRatios::R13,
       {.name = "R13",
        .range = positive,
        .meaning = "The same in shear of 1 and 3.",
        .example = "0.046188",
        .computed = "`R12`"}},
      {&HillRatios::R23,
       {.name = "R23",
        .range = positive,
        .meaning = "The same in shear of 2 and 3.",
        .example = "0.046188"}}};

  HillCoefficients coefficients() const;
};

using AnisotropyLaws = Laws<Hill48, HillRatios>;

/// The yield function of a material, by any of its laws.
struct Anisotropy : VariantOf<AnisotropyLaws> {
  using VariantOf<AnisotropyLaws>::variant;

  HillCoefficients coefficients() const;
  HillForm form() const; ///< in the axes of the model
  Axis normal() const;   ///< of the sheet
};

/// σ̄ in Pa of a stress along the axes of the sheet: xx, yy, zz, xy, yz, zx in the model at the start.
double hill_stress(const HillForm& form, const double (&stress)[6]);
/// The smallest −∂σ̄/∂ε̄p that a return may have, as a multiple of 2μ: the flow stress may fall by less.
double least_slope(const HillForm& form);

} // namespace cnem::plasticity
