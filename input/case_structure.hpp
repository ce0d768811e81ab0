#pragma once
// Parts and shafts as read.
#include "machining/structure/eigenmodes.hpp"
#include "machining/structure/part.hpp"
#include "machining/structure/removal.hpp"
#include "machining/structure/shaft.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cnem::input {

/// A place of a part that is looked at: a point of the material, or the mean of a face.
struct PartPlace {
  std::string name;
  std::optional<Vec3> at;    ///< m
  int axis = 0;              ///< of the face
  bool far = false;          ///< which end of it
  Vec3 force = Vec3::Zero(); ///< N
};

struct PartCase {
  machining::PartShape shape;
  machining::PartElement element = machining::PartElement::hexahedron_27;
  std::vector<machining::PartSupport> supports;
  int count = 6;                                           ///< modes
  std::optional<double> damping;                           ///< – ζ of each
  std::optional<machining::Rayleigh> rayleigh;             ///< in its place
  std::optional<Vec3> cutter;                              ///< m, where it cuts
  Eigen::Matrix3d to_cutter = Eigen::Matrix3d::Identity(); ///< from axes of the part to those of the cut
  bool mapped = false; ///< in the time domain: hexahedra follow it where it is cut
  std::optional<std::array<int, 3>> hexahedra;
  bool newmark = false; ///< all unknowns in place of modes
  struct Taking {
    std::int64_t interval = 1; ///< steps
    double most = 0.0;         ///< – D of what is gone
  };
  std::optional<Taking> taking; ///< of it, while it is milled
  std::vector<PartPlace> places;

  /// ζ of a mode, omega: rad/s; 0 where nothing is said of it.
  double damping_of(double omega) const {
    return rayleigh ? rayleigh->of_mode(omega) : damping.value_or(0.0);
  }
};

struct ShaftPlace {
  std::string name;
  double at = 0.0;    ///< m
  double force = 0.0; ///< N along x
};

struct ShaftCase {
  std::vector<machining::ShaftSection> sections;
  std::vector<machining::Bearing> bearings;
  double element = 0.0; ///< m
  double speed = 0.0;   ///< rad/s
  int count = 8;        ///< modes
  std::vector<ShaftPlace> places;
};

/// A tool that goes along a box of a part and takes it.
struct RemovalCase {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero(); ///< m
  int axis = 0;
  bool backward = false;
  double speed = 0.0, duration = 0.0; ///< m/s, s
  double most = 0.0;                  ///< – D of what is gone
  machining::RemovalSettings settings;
  bool reference = false;
  struct Force {
    Vec3 at = Vec3::Zero(), amplitude = Vec3::Zero(); ///< m, N
    double frequency = 0.0;                           ///< Hz
    bool follows = true;
  };
  std::optional<Force> force;

  /// m that the tool has gone by a time, s, and the same as a vector.
  double way(double time) const { return std::min(speed * time, high[axis] - low[axis]); }
  Vec3 shift(double time) const { return (backward ? -way(time) : way(time)) * Vec3::Unit(axis); }
  /// Corners of what it has taken by then, m.
  Vec3 taken_low(double time) const { return backward ? Vec3(low + taken_side(time)) : low; }
  Vec3 taken_high(double time) const { return backward ? high : Vec3(high - taken_side(time)); }

private:
  Vec3 taken_side(double time) const { return (high[axis] - low[axis] - way(time)) * Vec3::Unit(axis); }
};

struct StructureCase {
  std::optional<PartCase> part;
  std::optional<ShaftCase> shaft;
  std::optional<RemovalCase> removal;
};

} // namespace cnem::input
