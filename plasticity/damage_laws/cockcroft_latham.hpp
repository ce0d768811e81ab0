#pragma once
#include "core/parameter.hpp"
#include "plasticity/damage_laws/flowing.hpp"

namespace cnem::plasticity {

/// Work of the largest tension (Cockcroft and Latham, J. Inst. Metals 96, 1968): one constant, measured in a
/// tensile test up to fracture.
struct CockcroftLatham {
  double critical_work = 0.0;

  static constexpr const char* name = "cockcroft-latham";
  static constexpr const char* formula =
      "damage grows by max(σ1, 0) dε̄p/critical_work, σ1 the largest principal stress";
  static constexpr const char* source = "Cockcroft and Latham 1968";
  static constexpr bool of_largest_stress = true;
  static constexpr Parameter<CockcroftLatham> parameters[] = {{&CockcroftLatham::critical_work,
                                                               {.name = "critical_work",
                                                                .unit = "Pa",
                                                                .range = positive,
                                                                .required = true,
                                                                .meaning = "∫ max(σ1, 0) dε̄p at fracture.",
                                                                .example = "300 MPa"}}};
};

namespace CNEM_ISA {

template<class T> CNEM_INLINE T fracture_strain(const CockcroftLatham& law, const Flowing<T>& at) {
  return T(law.critical_work) / max(at.largest, T(1e-100));
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
