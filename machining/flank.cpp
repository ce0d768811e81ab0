#include "machining/flank.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::machining {

namespace {

/// ∫ max(0, e) over a length on which e goes linearly from a to b.
double positive_part(double a, double b, double length) {
  if (a >= 0.0 && b >= 0.0) return 0.5 * (a + b) * length;
  const double most = std::max(a, b);
  return most > 0.0 ? 0.5 * most * most / std::abs(a - b) * length : 0.0;
}

} // namespace

Flank Flank::about(double radius) const {
  Flank there = *this;
  there.land = std::min(land, widest_land * radius);
  return there;
}

double Flank::contact(double rise) const {
  const double leaves = std::tan(clearance) - rise;
  return recovery >= leaves * land ? land : recovery / leaves;
}

double Flank::pressed(double rise) const {
  const double wide = contact(rise);
  return wide * (recovery + 0.5 * wide * (rise - std::tan(clearance)));
}

double Flank::damping(double rise, double speed) const {
  const double wide = contact(rise);
  return 0.5 * specific_force * wide * wide / speed;
}

FlankTraces::FlankTraces(const Flank& flank, std::span<const double> radius, std::size_t teeth, double step)
    : flank_(flank), first_{0} {
  for (const double r : radius) {
    const auto steps = static_cast<std::size_t>(std::ceil(std::min(flank.land / r, widest_land) / step));
    for (std::size_t j = 0; j < teeth; ++j) first_.push_back(first_.back() + steps);
  }
  way_.resize(first_.back());
  before_.resize(edges());
}

double FlankTraces::pressed(std::size_t edge, const Vec2& arm, const Way& last) const {
  const auto cut = [](const Way& way) { return way.begin < way.end; };
  if (!cut(last) && std::none_of(&way_[first_[edge]], &way_[first_[edge + 1] - 1] + 1, cut)) return 0.0;
  const double radius = arm.norm(), end = std::min(flank_.land / radius, widest_land),
               slope = std::tan(flank_.clearance);
  Vec2 newer = arm;
  double angle = 0.0, depth = flank_.recovery, sum = 0.0;
  const auto add = [&](const Way& way) {
    const Vec2 older = newer - way.along;
    const double angle_older = std::atan2(cross(arm, older), arm.dot(older));
    const double depth_older = flank_.recovery + radius - older.norm() - slope * radius * angle_older;
    const double width = angle_older - angle;
    if (cut(way) && width > 0.0) {
      const double from = 1.0 - way.end, to = std::min(1.0 - way.begin, (end - angle) / width);
      const auto at = [&](double share) { return depth + share * (depth_older - depth); };
      if (to > from) sum += positive_part(at(from), at(to), radius * width * (to - from));
    }
    newer = older;
    angle = angle_older;
    depth = depth_older;
    return angle < end;
  };
  bool on = add(last);
  for (std::size_t k = first_[edge]; on && k < first_[edge + 1]; ++k) on = add(way_[k]);
  return sum;
}

void FlankTraces::note(std::size_t edge, const Way& last, double pressed) {
  const auto begin = way_.begin() + static_cast<std::ptrdiff_t>(first_[edge]),
             end = way_.begin() + static_cast<std::ptrdiff_t>(first_[edge + 1]);
  std::move_backward(begin, end - 1, end);
  *begin = last;
  before_[edge] = pressed;
}

void FlankTraces::archive(Archive& archive) {
  archive.list("milling/flank/pressed", "m^2", before_);
  std::vector<double> numbers; // shares as lengths of a way of 1 m
  for (const Way& way : way_)
    numbers.insert(numbers.end(), {way.along.x(), way.along.y(), way.begin, way.end});
  archive.list("milling/flank/ways", "m", numbers);
  if (numbers.size() != 4 * way_.size() || before_.size() != edges())
    throw IoError("milling/flank holds no ways of this case's edges");
  for (std::size_t k = 0; k < way_.size(); ++k)
    way_[k] = {Vec2(numbers[4 * k], numbers[4 * k + 1]), numbers[4 * k + 2], numbers[4 * k + 3]};
}

} // namespace cnem::machining
