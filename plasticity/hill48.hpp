#pragma once
// The yield function of rolled sheet: Hill, Proc. R. Soc. London A 193 (1948) 281, from r-values.
#include "core/parameter.hpp"
#include "plasticity/hill_form.hpp"

namespace cnem::plasticity {

enum class Axis { x, y, z };
inline constexpr const char* axis_names[] = {"x", "y", "z"};

/// Along rolling (1), transverse (2) and normal (3) direction of the sheet
///   σ̄² = F (σ22 − σ33)² + G (σ33 − σ11)² + H (σ11 − σ22)² + 2 L σ23² + 2 M σ31² + 2 N σ12²,
/// which is the flow stress in tension along the rolling direction: G + H = 1. r is the plastic strain of the
/// width over that of the thickness in tension at 0°, 45° and 90° to the rolling direction.
struct Hill48 {
  double r0 = 1.0, r45 = 1.0, r90 = 1.0, L = 1.5, M = 1.5;
  Axis rolling = Axis::x, normal = Axis::y; ///< in the model, at the start

  static constexpr const char* name = "hill48";
  static constexpr const char* formula =
      "the flow stress is σ̄, σ̄² = F (σ22 − σ33)² + G (σ33 − σ11)² + H (σ11 − σ22)² + 2 L σ23² + 2 M σ31² + 2 "
      "N σ12² with 1 the rolling, 2 the transverse and 3 the normal direction of the sheet, "
      "G = 1/(1 + r0), H = r0/(1 + r0), F = H/r90, N = (F + G) (r45 + ½) (Hill 1948)";
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

  struct Coefficients {
    double F, G, H, L, M, N;
  };
  Coefficients coefficients() const;
  /// In the axes of the model.
  HillForm form() const;
};

/// σ̄ in Pa of a stress along the axes of the sheet: xx, yy, zz, xy, yz, zx in the model at the start.
double hill_stress(const HillForm& form, const double (&stress)[6]);
/// The smallest −∂σ̄/∂ε̄p that a return may have, as a multiple of 2μ: the flow stress may fall by less.
double least_slope(const HillForm& form);

} // namespace cnem::plasticity
