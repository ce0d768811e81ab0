#pragma once
// A mode of vibration as a tap test gives it.
#include "core/piecewise_linear.hpp"
#include "core/vec.hpp"

#include <cmath>
#include <numbers>

namespace cnem::machining {

struct Mode {
  enum class Of { tool, part };
  Of of = Of::tool;
  double frequency = 0.0;         ///< Hz, undamped
  double damping = 0.0;           ///< – ζ, in [0, 1)
  double stiffness = 0.0;         ///< N/m, where the cutter cuts, along the direction
  Vec3 direction = Vec3::UnitX(); ///< unit vector along which it moves there

  /// How it changes along the path and over the height where the cutter cuts, as shares of the displacement
  /// that the stiffness is of; linear between, 1 without points. m, –
  NumberList along{}, shape_along{}, height{}, shape_over_height{};
  /// At the places along the path, as shares of `frequency`, where the modal mass stays: a wall that gets
  /// thinner. Lobes take it; in the time domain there is none.
  NumberList frequency_along{};

  double shape(double x, double z) const {
    return piecewise_linear(along, shape_along, x) * piecewise_linear(height, shape_over_height, z);
  }
  bool moves_at(double x) const { return piecewise_linear(along, shape_along, x) != 0.0; }
  /// The mode as a cutter meets it at a place along the path, m: the same along all of it. It has to move
  /// there.
  Mode at(double x) const {
    const double share = piecewise_linear(along, shape_along, x);
    const double faster = frequency_along.size > 0 ? piecewise_linear(along, frequency_along, x) : 1.0;
    Mode mode = *this;
    mode.along = mode.shape_along = mode.frequency_along = {};
    mode.frequency *= faster;
    mode.stiffness *= faster * faster / (share * share);
    return mode;
  }
  double omega() const { return 2.0 * std::numbers::pi * frequency; } ///< rad/s
  double mass() const { return stiffness / (omega() * omega()); }     ///< kg
  /// Displacement of the tool relative to the part by one unit of the mode; the force on the tool works on it
  /// through the same vector, because the part bears the opposite one.
  Vec3 participation() const { return of == Of::tool ? direction : Vec3(-direction); }
};

/// Response of a mode over a time: of its state (q, v/ω), and of an impulse.
class FreeMotion {
public:
  FreeMotion(const Mode& mode, double time) {
    const double zeta = mode.damping, omega = mode.omega(), s = std::sqrt(1.0 - zeta * zeta);
    const double decay = std::exp(-zeta * omega * time);
    const double c = decay * std::cos(s * omega * time), n = decay * std::sin(s * omega * time) / s;
    of_state << c + zeta * n, n, -n, c - zeta * n;
    of_impulse = omega / mode.stiffness * of_state.col(1);
  }
  Mat2 of_state;   ///< (q, v/ω) from (q, v/ω)
  Vec2 of_impulse; ///< (q, v/ω) per N s
};

} // namespace cnem::machining
