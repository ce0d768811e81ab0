#pragma once
// Cutting laws from orthogonal cuts: linear and Kienzle's by weighted least squares, the shear plane from the
// linear one and the chips.
#include "machining/line_fit.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cnem::machining {

/// The mean of the steady part of one cut.
struct OrthogonalCut {
  std::string name;
  double thickness = 0.0, speed = 0.0, rake = 0.0; ///< m, of the uncut chip; m/s; rad
  Estimate tangential{}, radial{};                 ///< N/m of edge: along the cut, away from the workpiece
  double chip_thickness = std::numeric_limits<double>::quiet_NaN(); ///< m; not-a-number: not known
};

/// Kc h + Ke.
struct LinearFit {
  LineFit tangential, radial; ///< intercepts are edge forces, N/m; slopes pressures, Pa
  bool no_edge_force = false; ///< the tangential one came out below 0 and is taken as 0
};
/// Needs two thicknesses.
LinearFit fit_linear(const std::vector<OrthogonalCut>& cuts);

/// K1 h1 (h/h1)^(1 − m), h1 = 1 mm, by logarithms.
struct PowerFit {
  Estimate pressure, exponent;  ///< Pa, of a chip of 1 mm; – m, from 0 to below 1
  double r_squared = 1.0;       ///< of the forces
  std::vector<double> residual; ///< N/m of each cut
};
struct KienzleFit {
  PowerFit tangential;
  std::optional<PowerFit> radial; ///< none where forces change their sign or hardly depend on h
};
/// Needs two thicknesses; none where tangential forces do not grow with h, or not all are positive.
std::optional<KienzleFit> fit_kienzle(const std::vector<OrthogonalCut>& cuts);

/// What the linear law means in a shear plane (Merchant; Altintas 2012, 2.2): r = h/h_chip,
/// tan φ = r cos α/(1 − r sin α), β = α + atan(Krc/Ktc), τ = (Ktc cos φ − Krc sin φ) sin φ. An oblique law of
/// these gives Ktc and Krc back on an edge that is not inclined.
struct ShearPlaneFit {
  Estimate shear_stress, friction_angle, shear_angle, chip_ratio; ///< Pa, rad, rad, –
};
/// Of cuts with one rake; none where no chip thickness is known or it says no angle.
std::optional<ShearPlaneFit> fit_shear_plane(const std::vector<OrthogonalCut>& cuts, const LinearFit& linear);

/// Cuts of one rake and one speed.
struct CutGroup {
  double rake = 0.0, speed = 0.0; ///< rad, m/s: of the first
  std::vector<OrthogonalCut> cuts;

  /// Of the uncut chips, increasing, those within a hundredth taken as one.
  std::vector<double> thicknesses() const;
};
/// By rake, then by speed, increasing; those that differ by less than a tenth of a degree and a hundredth are
/// the same. Within a group by thickness.
std::vector<CutGroup> groups_of(std::vector<OrthogonalCut> cuts);

/// Forces over thickness, speed and rake, means where there are several cuts.
struct CutTable {
  std::vector<double> thickness, speed, rake;
  std::vector<double> tangential, radial; ///< N/m, thickness varies fastest and rake slowest
};
/// None unless there is a cut at each thickness with each speed and rake.
std::optional<CutTable> table_of(const std::vector<CutGroup>& groups);

} // namespace cnem::machining
