#pragma once
// A disturbance of a milling cut, marched in small steps by another way than the library's: edges are cut
// into slices, delays are rounded to steps, modes step by central differences of their own.
#include "machining/milling_cut.hpp"
#include "machining/mode.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace cnem::machining {

/// By what the disturbance grows in a turn, after many of them: a mean over the last turns.
inline double marched_growth(const MillingCut& cut, const std::vector<Mode>& modes, double spindle,
                             double depth) {
  constexpr int steps = 16000, settle = 30, turns = 60;
  const double two_pi = 2.0 * std::numbers::pi, dt = two_pi / spindle / steps;
  const Cutter& cutter = cut.cutter;
  // Of a ball slices are as wide on its arc, which depths end within.
  const bool ball = cutter.corner > 0.0;
  const int slices = ball ? 200 : 30;
  // Directional factors of each step and tooth: the same every turn.
  std::vector<std::vector<DirectionalFactors>> factors(steps);
  std::vector<int> delay;
  for (std::size_t j = 0; j < cutter.teeth(); ++j)
    delay.push_back(static_cast<int>(std::lround(cutter.pitch_before(j) / two_pi * steps)));
  for (int n = 0; n < steps; ++n)
    for (std::size_t j = 0; j < cutter.teeth(); ++j) {
      DirectionalFactors sum = DirectionalFactors::Zero();
      for (int s = 0; s < slices; ++s) {
        const double R = cutter.radius(), c = cutter.corner, share = (s + 0.5) / slices;
        const double arc = ball ? share * std::acos(1.0 - depth / c) : 0.5 * std::numbers::pi;
        const double z = ball ? c * (1.0 - std::cos(arc)) : share * depth;
        const double width = (ball ? c * std::acos(1.0 - depth / c) : depth) / slices;
        double phi = (n + 0.5) * two_pi / steps - cutter.behind(j) - z * std::tan(cutter.helix) / R;
        phi -= two_pi * std::floor(phi / two_pi);
        // The normal of the profile leans by its arc from the axis.
        const double sine_k = std::sin(arc), cosine_k = ball ? std::cos(arc) : 0.0,
                     r = ball ? R - c + c * sine_k : R;
        const double sine = std::sin(phi), cosine = std::cos(phi);
        // The workpiece begins (up) or ends (down) at the side of the radial depth.
        const bool up = cut.engagement.side == Engagement::Side::up;
        const double across = up ? r * cosine : -r * cosine;
        if (sine < 0.0 || across < R - cut.engagement.radial_depth) continue;
        const Vec3 K = cut.law.at({.thickness = 1e-4, .speed = 1.0}).slope;
        const double radial = sine_k * K[1] + cosine_k * K[2], axial = sine_k * K[2] - cosine_k * K[1];
        const Vec3 force(-K[0] * cosine - radial * sine, K[0] * sine - radial * cosine, -axial);
        sum += width * force * Eigen::RowVector3d(sine_k * sine, sine_k * cosine, -cosine_k);
      }
      factors[static_cast<std::size_t>(n)].push_back(sum);
    }
  const std::size_t m = modes.size();
  std::vector<double> q(m), before(m);
  for (std::size_t i = 0; i < m; ++i) q[i] = before[i] = 1.0 + 0.3 * static_cast<double>(i);
  std::vector<Vec3> past(steps, Vec3::Zero());
  double scale = 0.0, first = 0.0, last = 0.0;
  for (int turn = 0; turn < settle + turns; ++turn) {
    double size = 0.0;
    for (int n = 0; n < steps; ++n) {
      Vec3 u = Vec3::Zero();
      for (std::size_t i = 0; i < m; ++i) u += q[i] * modes[i].participation();
      Vec3 force = Vec3::Zero();
      for (std::size_t j = 0; j < cutter.teeth(); ++j) {
        const DirectionalFactors& w = factors[static_cast<std::size_t>(n)][j];
        if (!w.isZero(0.0)) force += w * (u - past[static_cast<std::size_t>((n - delay[j] + steps) % steps)]);
      }
      past[static_cast<std::size_t>(n)] = u;
      for (std::size_t i = 0; i < m; ++i) {
        const double omega = modes[i].omega(), damp = modes[i].damping * omega * dt;
        const double drive = modes[i].participation().dot(force) / modes[i].mass();
        const double next =
            (2.0 * q[i] - (1.0 - damp) * before[i] + dt * dt * (drive - omega * omega * q[i])) / (1.0 + damp);
        before[i] = q[i];
        q[i] = next;
      }
      for (std::size_t i = 0; i < m; ++i) size = std::max(size, std::abs(q[i]));
    }
    // Of a pair of multipliers the size swings from turn to turn: a mean of its logarithm over many turns.
    if (turn >= settle && turn < settle + 20) first += (std::log(size) + scale) / 20.0;
    if (turn >= settle + turns - 20) last += (std::log(size) + scale) / 20.0;
    scale += std::log(size);
    for (std::size_t i = 0; i < m; ++i) {
      q[i] /= size;
      before[i] /= size;
    }
    for (Vec3& x : past) x /= size;
  }
  return std::exp((last - first) / (turns - 20));
}

} // namespace cnem::machining
