#pragma once
// What forces and vibrations of a cut at a steady speed say: spectra, and whether disturbances grow from one
// period of the teeth to the next.
#include "core/fields/archive.hpp"
#include "machining/cutter.hpp"
#include "machining/spectrum.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace cnem::machining {

/// Samples at equal angles of the cutter: force on the tool, N, and its displacement relative to the part, m.
class CutVibration {
public:
  enum Signal { Fx, Fy, Fz, x, y, z };
  static constexpr std::size_t signals = 6;

  /// steps: samples in a turn.
  CutVibration(const Cutter& cutter, int steps);

  void add(const Vec3& force, const Vec3& displacement);
  void archive(Archive& archive);
  std::size_t samples() const { return sample_.front().size(); }

  /// After how many samples a cut without chatter comes back: teeth that are alike pass, or a turn.
  int period() const { return period_; }
  /// That of the harmonics of such a cut, Hz. spindle: rad/s.
  double base(double spindle) const { return spindle / full_turn * steps_ / period_; }

  /// Of the last whole turns. Throws nothing; none for less than two turns.
  std::optional<Spectrum> spectrum(Signal signal, double spindle) const;

  struct Growth {
    double factor = 0.0; ///< of disturbances in a period
    /// The same of the last third of the periods, five at least, less two standard errors.
    double late = 0.0;
    double size = 0.0; ///< m, by how much a sample differs from the one a period before, root of the mean
                       ///< square at the end
    double vibration = 0.0; ///< m, of samples about their mean, root of the mean square
  };
  /// From differences to samples a period before, in which nothing is left of the forced vibration: a line
  /// through logarithms of their mean squares in each period. None for less than six periods, or nothing that
  /// differs.
  std::optional<Growth> growth() const;
  /// The vibration that is no harmonic, of x or y, the larger one. none without any.
  std::optional<SpectralPeak> chatter(double spindle) const;

private:
  int steps_, period_;
  std::array<std::vector<double>, signals> sample_;
};

} // namespace cnem::machining
