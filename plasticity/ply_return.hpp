#pragma once
// The return of a ply's stress to Hill's yield surface, in the axes of the ply.
#include "plasticity/hill48.hpp"
#include "plasticity/orthotropic.hpp"

#include <Eigen/Core>

namespace cnem::plasticity {

/// Flow stress as a function of the plastic strain that a step adds.
class StepFlow {
public:
  virtual double stress(double increment) const = 0; ///< Pa
  virtual double slope(double increment) const = 0;  ///< Pa, its derivative
protected:
  ~StepFlow() = default;
};

/// Elasticity and yield function of a ply. Strains ε11, ε22, γ12 and stresses σ11, σ22, σ12 in its axes, σ33
/// and ε33 beside them where nothing strains out of the plane.
class PlyReturn {
public:
  /// stress_free: no stress out of the plane, else no strain there.
  PlyReturn(const Orthotropic& elastic, const HillCoefficients& yield, bool stress_free);

  /// What a step comes to.
  struct Result {
    double stress[3] = {};  ///< Pa
    double out = 0.0;       ///< Pa, σ33
    double energy = 0.0;    ///< J/m³, elastic
    double yield = 0.0;     ///< Pa, σ̄
    double increment = 0.0; ///< –, Δγ
    double flow[3] = {};    ///< –, ΔE^p = Δγ ∂σ̄/∂T
    bool found = true;      ///< false: no Δγ was
  };

  /// T = (S + Δγ A/σ_y)⁻¹ (E − E^p), S = Q⁻¹, paper 001 (1) as σ̄² = TᵀAT, with Δγ such that σ̄ is the flow
  /// stress; with flow = null, or where σ̄ is below the flow stress, Q (E − E^p). ΔE^p keeps volume, so that
  /// without strain out of the plane E^p33 = −E^p11 − E^p22.
  /// softening: ω of broken matter, without stress out of the plane alone. Of σ̄² the part m² 1ᵀA1 of the
  /// mean m = 1ᵀAT/1ᵀA1, by which the ply flows out of the plane, counts by (1 − ω)² where m is a pressure: a
  /// broken ply does not give way to it (docs/theory.md).
  Result operator()(const double (&strain)[3], const double (&plastic)[3], const StepFlow* flow,
                    double softening = 0.0) const;

  /// σ̄ of a stress σ11, σ22, σ12, σ33, Pa.
  double yield_stress(const double (&stress)[3], double out = 0.0) const;
  /// The smallest −dσ̄/dΔγ of a return, Pa: the flow stress may fall by less.
  double least_slope() const;

private:
  using Normals = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>; ///< 11, 22 and perhaps 33
  /// Stresses v_k with v_kᵀ S v_l = δ_kl and v_kᵀ A v_l = a_k δ_kl: T = Σ_k (v_kᵀ E) v_k/(1 + λ a_k) on the
  /// way back, λ = Δγ/σ̄. Components 11, 22, 33, 12.
  struct Modes {
    int count = 0;
    double value[4] = {};
    double vector[4][4] = {};
    double strain[4][4] = {}; ///< S v_k
  };
  Modes modes(const Normals& normal) const;
  template<int n> Modes modes_of(const Normals& normal) const;
  static Result solve(const Modes& modes, const double (&trial)[4], const StepFlow* flow);

  bool stress_free_;
  Normals compliance_, normal_;  ///< S and A of normal stresses, 1/Pa and –
  double shear_modulus_, shear_; ///< Pa, –: G12 and 2 N
  Modes all_;
};

/// σ̄ of a stress in the axes of the model, Pa: xx, yy, zz, xy, with yz and zx left aside.
double ply_yield_stress(const Orthotropic& elastic, const HillCoefficients& yield, const double (&stress)[6]);
/// The least slope of a ply's return, without stress or without strain out of the plane: the smaller.
double least_ply_slope(const Orthotropic& elastic, const HillCoefficients& yield);

} // namespace cnem::plasticity
