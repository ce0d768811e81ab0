#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/laws/johnson_cook.hpp"

namespace cnem::plasticity {

/// A measured flow curve, with the factors of rate and temperature of Johnson and Cook. Between the points
/// stands the piecewise cubic of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984): monotone where the
/// points are, so that it invents neither peaks nor softening, and with a continuous slope, of which the
/// return map's steps are made. Beyond the last point the stress stays what it is there.
struct Tabulated {
  NumberList strain, stress; ///< –, Pa
  double C = 0.0, rate0 = 1.0, m = 1.0, T0 = 293.15, Tmelt = infinite;

  static constexpr bool may_fall = true;
  static constexpr const char* name = "table";
  static constexpr const char* formula =
      "`stress` over `strain`, a smooth curve that is monotone between points and constant beyond the last, "
      "times (1 + C ln(ε̄̇p/rate0))(1 − T*ᵐ)";
  static constexpr const char* source = "Fritsch and Butland 1984";
  static constexpr ListParameter<Tabulated> lists[] = {
      {&Tabulated::strain,
       {.name = "strain",
        .range = not_negative,
        .required = true,
        .meaning = "Plastic strains of the points; they begin with 0 and increase.",
        .example = "[0, 0.02, 0.1, 0.5]"}},
      {&Tabulated::stress,
       {.name = "stress",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning =
            "Flow stresses at these strains, at `rate0` and `T0`. They may fall, but less steeply than "
            "three shear moduli per strain.",
        .example = "\"300 420 510 640 MPa\""}}};
  static constexpr Parameter<Tabulated> parameters[] = {{&Tabulated::C, JohnsonCook::parameters[3].info},
                                                        {&Tabulated::rate0, JohnsonCook::parameters[4].info},
                                                        {&Tabulated::m, JohnsonCook::parameters[5].info},
                                                        {&Tabulated::T0, JohnsonCook::parameters[6].info},
                                                        {&Tabulated::Tmelt, JohnsonCook::parameters[7].info}};
  static constexpr Order orders[] = {{"Tmelt", "T0"}};

  /// Makes the curve of the points. Throws InputError where they are none of a curve.
  void complete();

  /// Made by complete(): σ = Σ_k coefficient[k][i] (ε̄p − strain_i)^k from point i on.
  double coefficient[4][NumberList::capacity] = {};
};

namespace CNEM_ISA {

/// The cubic that each lane of `strain` is in.
template<class T> struct CurvePiece {
  T start, coefficient[4];

  CNEM_INLINE CurvePiece(const Tabulated& law, T strain) {
    constexpr int width = Number<T>::width;
    double at[width], gathered[5][width];
    store(at, strain);
    for (int k = 0; k < width; ++k) {
      int piece = 0;
      for (int beyond = law.strain.size; beyond - piece > 1;) {
        const int middle = (piece + beyond) / 2;
        (law.strain.value[middle] <= at[k] ? piece : beyond) = middle;
      }
      gathered[4][k] = law.strain.value[piece];
      for (int c = 0; c < 4; ++c) gathered[c][k] = law.coefficient[c][piece];
    }
    start = load<T>(gathered[4]);
    for (int c = 0; c < 4; ++c) coefficient[c] = load<T>(gathered[c]);
  }
};

template<class N, class T> CNEM_INLINE N flow_stress(const Tabulated& law, N strain, N rate, T temperature) {
  const CurvePiece<T> piece(law, value_of(strain));
  const T(&c)[4] = piece.coefficient;
  const N x = strain - piece.start;
  return at_rate_and_temperature(law, c[0] + x * (c[1] + x * (c[2] + x * c[3])), rate, temperature);
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
