#pragma once
// Forces of a tool over the length of its cut, and the part of it that is steady.
#include <cmath>
#include <string>
#include <vector>

namespace cnem::evaluate {

/// What a tool has given the workpiece up to some lengths of cut, which increase.
struct CutImpulse {
  std::vector<double> cut;    ///< m
  std::vector<double> time;   ///< s
  std::vector<double> Fc, Ft; ///< N s/m, sums since the start of what acts along the cut and against it

  std::size_t rows() const { return cut.size(); }
};

/// Mean forces per width, N/m: Fc along the way of the tool, Ft on the workpiece, > 0 into it.
struct CutForce {
  double Fc = 0.0, Ft = 0.0;
};

/// Between two lengths of cut within the table: what was given there over the time it took.
CutForce mean_force(const CutImpulse& impulse, double from, double to);

/// At each row the mean over `window` of cut (m) centred there, over half of it at the ends.
std::vector<CutForce> filtered_forces(const CutImpulse& impulse, double window);

struct SteadyRule {
  double feed = 0.0;  ///< m
  double feeds = 3.0; ///< it is at least so many of them long
  double tolerance = 0.05;
  double window = 0.0;   ///< m of cut that filtered forces are the mean over
  double tooth = 0.0;    ///< m of cut in which a tooth is made; 0: no teeth
  double end = INFINITY; ///< m of cut at which the workpiece ends
};

/// Where forces are taken from.
struct SteadyPart {
  bool steady = false;
  std::string note;            ///< why it is not; empty where it is
  double from = 0.0, to = 0.0; ///< m of cut
  CutForce mean, spread;       ///< N/m; spread: standard deviation of the filtered forces
};

/// The longest part of the cut beyond its first feed over which forces are steady (docs/cutting.md); where
/// there is none, the last part as long as a steady one would have to be, or the last half of a shorter cut,
/// and why. The last two and a half feeds before the end of a workpiece, which breaks out, and what comes
/// after are no part of it.
SteadyPart steady_part(const CutImpulse& impulse, const SteadyRule& rule);

} // namespace cnem::evaluate
