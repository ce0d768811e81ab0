#pragma once
// Piecewise-linear functions of time: ramps and histories of prescribed velocities, loads and temperatures.
#include <vector>

namespace cnem {

/// Linear between (time, value) points, constant before the first and after the last. Times in s, increasing;
/// values in the unit of what is prescribed. A single point is a constant.
class TimeTable {
public:
  TimeTable() = default;
  explicit TimeTable(double constant) : time_{0.0}, value_{constant} {}
  /// Throws InputError when the lists differ in length, are empty or the times do not increase.
  TimeTable(std::vector<double> time, std::vector<double> value);

  /// Value at t; 0 for an empty table.
  double operator()(double t) const;
  /// ∫ value dt from 0 to t.
  double integral(double t) const;
  bool empty() const { return time_.empty(); }
  const std::vector<double>& times() const { return time_; }
  const std::vector<double>& values() const { return value_; }

private:
  double primitive(double t) const;
  std::vector<double> time_, value_;
};

} // namespace cnem
