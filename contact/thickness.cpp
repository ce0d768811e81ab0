#include "contact/thickness.hpp"

#include <algorithm>
#include <limits>

namespace cnem::contact {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int chords_of_arc = 16;

bool look_away(const Vec2& entered, const Vec2& left) { return entered.dot(left) < -0.4; }

} // namespace

Thickness::Thickness(const Curve& outline) : least_(infinite) {
  for (const CurvePiece& piece : outline.pieces) {
    const int parts = piece.is_arc() ? chords_of_arc : 1;
    for (int k = 0; k < parts; ++k) {
      const Vec2 from = piece.point(static_cast<double>(k) / parts),
                 to = piece.point(static_cast<double>(k + 1) / parts);
      const double length = (to - from).norm();
      const Vec2 along = (to - from) / length;
      chords_.push_back({from, to, along, right_normal(along), length});
      size_ += length;
    }
  }
  for (const Chord& chord : chords_)
    for (std::size_t k = 0; k < chords_.size(); ++k) {
      const Chord& next = chords_[(k + 1) % chords_.size()];
      if (&chord != &chords_[k] && &chord != &next) least_ = std::min(least_, distance(chord, next.from));
    }
}

double Thickness::distance(const Chord& chord, const Vec2& x) const {
  const double s = std::clamp(chord.along.dot(x - chord.from), 0.0, chord.length);
  return (x - chord.from - s * chord.along).norm();
}

const Thickness::Chord& Thickness::nearest(const Vec2& x) const {
  return *std::min_element(chords_.begin(), chords_.end(),
                           [&](const Chord& a, const Chord& b) { return distance(a, x) < distance(b, x); });
}

std::vector<Thickness::Crossing> Thickness::crossings(const Vec2& from, const Vec2& to) const {
  std::vector<Crossing> found;
  for (const Chord& chord : chords_) {
    const double start = chord.normal.dot(from - chord.from), stop = chord.normal.dot(to - chord.from);
    if ((start > 0.0) == (stop > 0.0)) continue;
    const double at = start / (start - stop);
    const double along = chord.along.dot(from + at * (to - from) - chord.from);
    if (along >= 0.0 && along < chord.length) found.push_back({at, chord.normal, stop > 0.0});
  }
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
  return found;
}

double Thickness::passed(const Vec2& from, const Vec2& to) const {
  const std::vector<Crossing> list = crossings(from, to);
  double entered = 0.0, most = 0.0;
  Vec2 normal(0, 0);
  if (!list.empty() && list.front().leaving) normal = nearest(from).normal;
  for (const Crossing& crossing : list)
    if (!crossing.leaving)
      entered = crossing.at, normal = crossing.normal;
    else if (look_away(normal, crossing.normal))
      most = std::max(most, crossing.at - entered);
  return most * (to - from).norm();
}

double Thickness::along(const Vec2& direction) const {
  double least = infinite;
  for (const Chord& chord : chords_) {
    const double facing = chord.normal.dot(direction);
    if (facing == 0.0) continue;
    const Vec2 inwards = facing < 0.0 ? direction : Vec2(-direction);
    const Vec2 middle = 0.5 * (chord.from + chord.to), before = middle - 1e-9 * size_ * inwards;
    const double path = 2.0 * size_;
    for (const Crossing& crossing : crossings(before, before + path * inwards))
      if (crossing.leaving) {
        if (look_away(chord.normal, crossing.normal))
          least = std::min(least, crossing.at * path - 1e-9 * size_);
        break;
      }
  }
  return least;
}

} // namespace cnem::contact
