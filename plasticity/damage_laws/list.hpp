#pragma once
// The laws of damage: a file each beside this one. A law is a struct of constants (core/parameter.hpp) with
//   breaks(law, flowing)            where damage grows at all; of laws of the largest stress: flowing.hpp
//   fracture_strain(law, flowing)   ε_f: there it grows by dε̄p/ε_f; none at or below 0 means at once
//   of_largest_stress               optional, true: it asks for flowing.largest
// the first two in namespace CNEM_ISA, on numbers T of core/machine/simd.hpp.
#include "plasticity/damage_laws/cockcroft_latham.hpp"
#include "plasticity/damage_laws/cockcroft_latham_normalised.hpp"
#include "plasticity/damage_laws/johnson_cook.hpp"

namespace cnem::plasticity {

using DamageLaws = Laws<JohnsonCookDamage, CockcroftLatham, NormalisedCockcroftLatham>;

} // namespace cnem::plasticity
