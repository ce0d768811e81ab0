#pragma once
// Shanks, holders and spindles as Timoshenko beams that turn: M q̈ + (C + Ω G) q̇ + K q = 0.
#include "core/vec.hpp"
#include "machining/structure/cells.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace cnem::machining {

/// A piece of a shaft along z: a tube.
struct ShaftSection {
  double from = 0.0, to = 0.0;       ///< m
  double diameter = 0.0, bore = 0.0; ///< m
  ElasticSolid solid;
  std::optional<double> shear_correction; ///< – Cowper's for a circle or a tube without it
};

/// Springs and dampers between the shaft and the machine, the same in all directions across the axis.
struct Bearing {
  double at = 0.0;                                 ///< m
  double stiffness = 0.0, damping = 0.0;           ///< N/m, N s/m; an infinite stiffness holds the place
  double tilt_stiffness = 0.0, tilt_damping = 0.0; ///< N m, N m s; infinite: holds the slope
};

/// Unknowns of each node: x, y, slopes x', y' of its cross-section (dx/dz without shear).
class Shaft {
public:
  /// Elements at most `length` m long end where sections and bearings do. Throws
  /// InputError where sections overlap or leave a gap, or a bearing is beside the shaft.
  Shaft(std::vector<ShaftSection> sections, std::vector<Bearing> bearings, double length);

  Eigen::Index unknowns() const { return mass_.rows(); }
  double begin() const { return node_.front(); }             ///< m
  double end() const { return node_.back(); }                ///< m
  const std::vector<double>& nodes() const { return node_; } ///< m

  /// [unknowns × unknowns]; gyroscopic: G, times the speed in rad/s it is skew-symmetric.
  const Eigen::MatrixXd& mass() const { return mass_; }           ///< kg, kg m, kg m²
  const Eigen::MatrixXd& stiffness() const { return stiffness_; } ///< N/m, N, N m
  const Eigen::MatrixXd& damping() const { return damping_; }     ///< of bearings, N s/m, N s, N m s
  const Eigen::MatrixXd& gyroscopic() const { return gyroscopic_; }

  /// x and y of the axis at a place, of the unknowns: [2 × unknowns]. Throws InputError beside the shaft.
  Eigen::MatrixXd displacement_at(double z) const;

private:
  void add_element(std::size_t element, const ShaftSection& section);
  Eigen::Index unknown(std::size_t node, Eigen::Index freedom) const {
    return held_[node][freedom] ? -1 : first_[node][freedom];
  }
  std::vector<double> node_;                   ///< m
  std::vector<double> flexibility_;            ///< Φ of each element, of shear to bending
  std::vector<Eigen::Array<bool, 4, 1>> held_; ///< [node]
  std::vector<Eigen::Array<Eigen::Index, 4, 1>> first_;
  Eigen::MatrixXd mass_, stiffness_, damping_, gyroscopic_;
};

/// A whirl, or a vibration of a shaft at rest.
struct Whirl {
  double omega = 0.0;     ///< rad/s, undamped: |λ|
  double damping = 0.0;   ///< – −Re λ/|λ|
  double direction = 0.0; ///< 1: forward, round with the shaft, seen from +z against the clock where the
                          ///< speed is positive; −1: backward; between: on ellipses; 0: at rest
  Eigen::VectorXcd shape; ///< [unknowns], of length 1
};

/// The lowest `count` at a speed, rad/s, ascending in ω: eigenvalues of the whole first-order system.
std::vector<Whirl> whirls(const Shaft& shaft, double speed, std::size_t count);

/// Cowper (1966) of a circular cross-section, m = bore/diameter.
double circular_shear_correction(double poisson, double hollow);

} // namespace cnem::machining
