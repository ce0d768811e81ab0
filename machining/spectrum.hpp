#pragma once
// Spectra of signals at equal times, and what of them is no harmonic.
#include <optional>
#include <span>
#include <vector>

namespace cnem::machining {

struct Spectrum {
  double step = 0.0;             ///< Hz from one amplitude to the next, the first at 0
  std::vector<double> amplitude; ///< of a sine there, in the unit of the signal; up to half the sampling rate

  double frequency(std::size_t k) const { return step * static_cast<double>(k); }
};

/// Under Hann's window, without the mean. dt: s between samples, of which there are at least four.
Spectrum spectrum_of(std::span<const double> signal, double dt);

struct SpectralPeak {
  double frequency = 0.0; ///< Hz
  double amplitude = 0.0; ///< in the unit of the signal
};

/// The largest amplitude farther than two steps of the spectrum, which a sine reaches under Hann's window,
/// from all multiples of `base`, Hz, and from 0; none where nothing lies between multiples. Frequency and
/// amplitude are those of a sine between the steps (Grandke 1983).
std::optional<SpectralPeak> strongest_beside(const Spectrum& spectrum, double base);

} // namespace cnem::machining
