#pragma once
// A material at one point, pulled, pressed or sheared at a constant rate: what tests of materials measure.
#include "plasticity/material.hpp"

#include <vector>

namespace cnem::evaluate {

/// A test of a material. Rates and strains are true ones and count positive.
struct PointTest {
  enum class Kind { tension, compression, shear };
  Kind kind = Kind::tension;
  double rate = 1.0;           ///< 1/s, of the total axial strain, or of the shear strain
  double temperature = 293.15; ///< K, at the start
  bool adiabatic = false;      ///< plastic work heats the point
  double strain = 0.0;         ///< total strain at which it ends
  bool plastic = false;        ///< curves are over the plastic strain, else over the total one
};

/// What a test would record.
struct PointCurve {
  std::vector<double> strain;            ///< –, axial or shear, total or plastic; grows
  std::vector<double> stress;            ///< Pa, true axial or shear stress, > 0
  std::vector<double> equivalent_strain; ///< – ε̄p
  std::vector<double> temperature;       ///< K
};

/// The curve of a test by the return map of the program, `steps` steps long. The path is that of isochoric
/// flow: the volume strain of an axial stress is added after it, exactly so where elasticity is isotropic and
/// flow von Mises'. Damage plays no part. Throws InputError for anisotropic materials, and where the return
/// map finds no stress.
PointCurve point_curve(const plasticity::Material& material, const PointTest& test, int steps = 400);

/// Flow stress of a material at a strain, its rate (1/s) and temperature (K), Pa; 0 of an elastic one.
double flow_stress_of(const plasticity::Material& material, double strain, double rate, double temperature);

} // namespace cnem::evaluate
