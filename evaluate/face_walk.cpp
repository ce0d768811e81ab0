#include "evaluate/face_walk.hpp"

#include <utility>

namespace cnem::evaluate {

Vec2 turned_back(const Vec2& x, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * x.x() + s * x.y(), -s * x.x() + c * x.y()};
}

FaceWalk walk_of(const FaceOutline& outline, const FaceRules& rules, bool& parted) {
  std::vector<Vec2> point = outline.point;
  std::vector<FaceSurface> surface = outline.surface;
  if (std::abs(rules.turn) > steep)
    for (Vec2& x : point) x = turned_back(x, rules.turn);
  double twice = 0.0;
  Vec2 last = point.back();
  for (const Vec2& x : point) twice += cross(std::exchange(last, x), x);
  if (twice <= 0.0) {
    std::reverse(point.begin(), point.end());
    std::reverse(surface.begin(), surface.end());
    std::rotate(surface.begin(), surface.begin() + 1, surface.end());
  }
  const auto furthest = std::min_element(point.begin(), point.end(),
                                         [](const Vec2& a, const Vec2& b) {
                                           return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
                                         }) -
                        point.begin();
  std::rotate(point.begin(), point.begin() + furthest, point.end());
  std::rotate(surface.begin(), surface.begin() + furthest, surface.end());
  point.push_back(point.front());
  FaceWalk walk;
  const auto beyond =
      std::find_if(point.begin(), point.end(), [&](const Vec2& x) { return x.x() > rules.limit; });
  parted = beyond == point.end();
  walk.point.assign(point.begin(), parted ? beyond : beyond + 1);
  surface.resize(walk.point.size() - 1);
  walk.surface = std::move(surface);
  walk.measure();
  return walk;
}

} // namespace cnem::evaluate
