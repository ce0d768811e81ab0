#pragma once
// Energies of a milling cut in the time domain (paper 004, section 3.2: the work of the loads of Box 1).
#include "core/fields/archive.hpp"
#include "machining/mode.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cnem::machining {

/// What drives have put in since the begin of a run, where it went, and what modes, and a part that deforms,
/// hold now. All J.
struct MillingLedger {
  double spindle = 0.0;   ///< by the torque of the spindle
  double feed = 0.0;      ///< by the drive of the feed, against the forces on the cutter
  double cutting = 0.0;   ///< of edges along their own ways relative to the part: into chips and surface
  double ploughing = 0.0; ///< of flanks, along the same ways: into the surface
  double damping = 0.0;   ///< lost in modes and part
  double chips = 0.0;     ///< that matter had, kinetic and elastic, which has left the part
  double kinetic = 0.0, elastic = 0.0; ///< of modes and part, at present

  /// What goes in less what is found.
  double residual() const {
    return spindle + feed - cutting - ploughing - damping - chips - kinetic - elastic;
  }
  /// The same as a share of what has gone through. Elements of edges are rigid in a step: it is of the order
  /// of the square of the angle of one, and where K̂⁻¹ of a part is interpolated of the square of an interval.
  double share() const {
    const double through = std::max({std::abs(spindle), std::abs(cutting), kinetic + elastic});
    return through > 0.0 ? std::abs(residual()) / through : 0.0;
  }
  void archive(Archive& archive) {
    for (const auto& [name, value] : {std::tuple{"spindle", &spindle},
                                      {"feed", &feed},
                                      {"cutting", &cutting},
                                      {"ploughing", &ploughing},
                                      {"damping", &damping},
                                      {"chips", &chips},
                                      {"kinetic", &kinetic},
                                      {"elastic", &elastic}})
      archive.number(std::string("milling/ledger/") + name, "J", *value);
  }
};

/// zᵀ D z is what a free motion that begins with (q, v/ω) = z loses to damping in a time, s: the integral of
/// c q̇², by Gauss points along it. J/m²
Mat2 damping_loss(const Mode& mode, double time);

} // namespace cnem::machining
