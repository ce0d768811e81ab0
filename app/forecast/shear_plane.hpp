#pragma once
// How a chip is to be expected, from metal, rake and friction.

namespace cnem::app {

/// Ratio of chip thickness to feed, cos(φ − α)/sin φ, at the angle φ of the shear plane in Oxley's theory of
/// machining (The Mechanics of Machining, 1989, (7.4)): tan(φ + β − α) = 1 + 2 (π/4 − φ) − 5.9 n with
/// β = atan µ. rake α: rad; friction µ: –; hardening n: –, the slope of log flow stress over log strain at
/// strain 1. Within 1 and 4, and n no more than a quarter: hotter metal hardens less.
double foretold_chip_ratio(double rake, double friction, double hardening);

} // namespace cnem::app
