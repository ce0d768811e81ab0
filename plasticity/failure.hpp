#pragma once
// How plies fail: indices of modes from the effective stress, and what follows when one reaches 1.
#include "core/parameter.hpp"
#include "plasticity/orthotropic.hpp"
#include "plasticity/ply_points.hpp"

#include <array>

namespace cnem::plasticity {

enum class FailureCriterion { max_stress, hashin, larc02 };
inline constexpr const char* failure_criterion_names[] = {"max-stress", "hashin", "larc02"};

/// What follows when an index has reached 1.
enum class Degradation {
  energy, ///< the energy of the mode is spent per area, whatever the cells
  sudden, ///< damage grows at the rate (1 − d) c/ℓ: what is spent falls with the cells (paper 000)
};
inline constexpr const char* degradation_names[] = {"energy", "sudden"};

/// Paper 000, appendix A.
struct Failure {
  FailureCriterion criterion = FailureCriterion::hashin;
  Degradation degradation = Degradation::energy;
  double Xt = infinite, Xc = 0.0, Yt = 0.0, Yc = 0.0, S = 0.0;
  double eps1t = infinite, alpha0 = 0.92502450355699462; // 53°
  double Gft = infinite, Gfc = infinite, Gmt = infinite, Gmc = infinite, Gs = infinite;
  double band = 2.0;

  static constexpr double broken = 0.99; ///< largest d that is told of

  static constexpr Parameter<Failure> parameters[] = {
      {&Failure::Xt,
       {.name = "Xt",
        .unit = "Pa",
        .range = positive,
        .meaning = "Strength along the fibres in tension (`max-stress`, `hashin`).",
        .example = "697.8 MPa"}},
      {&Failure::Xc,
       {.name = "Xc",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Strength along the fibres in compression.",
        .example = "443.76 MPa"}},
      {&Failure::Yt,
       {.name = "Yt",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Strength across the fibres in tension.",
        .example = "89.7216 MPa"}},
      {&Failure::Yc,
       {.name = "Yc",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Strength across the fibres in compression.",
        .example = "148.33 MPa"}},
      {&Failure::S,
       {.name = "S",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Strength in shear along the fibres.",
        .example = "33.1 MPa"}},
      {&Failure::eps1t,
       {.name = "eps1t",
        .range = positive,
        .meaning = "Strain along the fibres at which they break in tension (`larc02`).",
        .example = "0.023"}},
      {&Failure::alpha0,
       {.name = "alpha0",
        .unit = "rad",
        .range =
            {.low = 0.78539816339744831, .high = 1.5707963267948966, .low_open = true, .high_open = true},
        .meaning = "Angle of the plane of fracture in compression across the fibres (`larc02`, and the shear "
                   "strength across the fibres of `hashin`).",
        .source = "Davila and Camanho 2003"}},
      {&Failure::Gft,
       {.name = "Gft",
        .unit = "J/m2",
        .range = positive,
        .meaning = "Energy per area that breaking fibres take in tension (`energy`).",
        .example = "12.5 kJ/m2"}},
      {&Failure::Gfc,
       {.name = "Gfc",
        .unit = "J/m2",
        .range = positive,
        .meaning = "The same in compression.",
        .example = "12.5 kJ/m2"}},
      {&Failure::Gmt,
       {.name = "Gmt",
        .unit = "J/m2",
        .range = positive,
        .meaning = "Energy per area that breaking matrix takes in tension across the fibres (`energy`).",
        .example = "1 kJ/m2"}},
      {&Failure::Gmc,
       {.name = "Gmc",
        .unit = "J/m2",
        .range = positive,
        .meaning = "The same in compression.",
        .example = "1 kJ/m2"}},
      {&Failure::Gs,
       {.name = "Gs",
        .unit = "J/m2",
        .range = positive,
        .meaning = "The same in shear (`max-stress`).",
        .example = "1 kJ/m2",
        .computed = "`Gmt`"}},
      {&Failure::band,
       {.name = "band",
        .range = positive,
        .meaning = "Thickness of the band in which cells break, in cell sizes (half the width over which the "
                   "gradients of a cell spread an opening): with it the energy of a mode is spread over the "
                   "cells. 2 is that width itself (docs/theory.md)."}}};

  double energy(int mode) const { return std::array{Gft, Gfc, Gmt, Gmc, Gs}[static_cast<std::size_t>(mode)]; }
  /// Length ℓ from which on a mode snaps back, m: 2 G E/X² with its modulus and strength; infinite: the
  /// criterion does not have it, or damage grows at once.
  double longest_length(const PlyConstants& elastic, int mode) const;
};

/// The criterion of a material with what follows from its constants.
class FailureForm {
public:
  FailureForm(const Failure& law, const PlyConstants& elastic);

  /// Indices of all modes from ε11, ε22, γ12 and the effective stress Q ε (Pa), all in the axes of the ply.
  /// A mode that the signs of the stresses rule out has 0.
  void indices(const double (&strain)[3], const double (&stress)[3], double (&index)[ply_modes]) const;

  /// The norm of the signed strains whose stresses stand in the index of a mode, and the stress (Pa) that is
  /// conjugate to it in work.
  struct Opening {
    double strain, stress;
  };
  Opening opening(int mode, const double (&strain)[3], const double (&stress)[3]) const;

  const Failure& law() const { return law_; }

private:
  double matrix_crushing(double s2, double shear) const;
  void larc(const double (&strain)[3], double s1, double s2, double shear, double (&index)[ply_modes]) const;

  Failure law_;
  double shear_modulus_;
  double transverse_shear_, eta_along_, kink_; ///< S_T (Pa), η_L, ψc (rad)

  static constexpr std::size_t planes = 91; ///< of fracture, a degree apart
  /// On a plane the index is ⟨−σ2 across⟩² + ⟨|τ| along + σ2 held⟩².
  struct Plane {
    double across, along, held; ///< 1/Pa
  };
  Plane plane(double angle) const;
  std::array<double, planes> across_, along_, held_; ///< 1/Pa, of `larc02`
};

} // namespace cnem::plasticity
