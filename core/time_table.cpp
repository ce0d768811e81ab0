#include "core/time_table.hpp"
#include "core/index.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem {

TimeTable::TimeTable(std::vector<double> time, std::vector<double> value)
    : time_(std::move(time)), value_(std::move(value)) {
  if (time_.empty() || time_.size() != value_.size())
    throw InputError(fmt::format("a time table needs as many times as values and at least one, found {} "
                                 "times and {} values, expected as many",
                                 time_.size(), value_.size()));
  for (std::size_t i = 1; i < time_.size(); ++i)
    if (time_[i] <= time_[i - 1])
      throw InputError(
          fmt::format("the times of a table must increase, found {} s after {} s, expected a later time",
                      time_[i], time_[i - 1]));
}

double TimeTable::operator()(double t) const {
  if (time_.empty()) return 0.0;
  const auto next = std::upper_bound(time_.begin(), time_.end(), t);
  if (next == time_.begin()) return value_.front();
  if (next == time_.end()) return value_.back();
  const auto i = index_of(next - time_.begin());
  const double s = (t - time_[i - 1]) / (time_[i] - time_[i - 1]);
  return (1.0 - s) * value_[i - 1] + s * value_[i];
}

/// Primitive that vanishes at the first time of the table.
double TimeTable::primitive(double t) const {
  if (t <= time_.front()) return value_.front() * (t - time_.front());
  double sum = 0.0;
  for (std::size_t i = 1; i < time_.size(); ++i) {
    const double end = std::min(t, time_[i]);
    sum += 0.5 * (value_[i - 1] + (*this)(end)) * (end - time_[i - 1]);
    if (t <= time_[i]) return sum;
  }
  return sum + value_.back() * (t - time_.back());
}

double TimeTable::integral(double t) const { return time_.empty() ? 0.0 : primitive(t) - primitive(0.0); }

} // namespace cnem
