#include "voronoi/exact.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>
#include <array>
#include <utility>

namespace cnem::voronoi {

namespace {

using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;

Exact::Point_2 point(const Vec2& x) { return {x.x(), x.y()}; }

} // namespace

int orientation_in_doubt(const Vec2& a, const Vec2& b, const Vec2& c) {
  return static_cast<int>(Exact().orientation_2_object()(point(a), point(b), point(c)));
}

bool in_circle_in_doubt(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = Exact().side_of_oriented_circle_2_object()(point(a), point(b), point(c), point(d));
  if (side != CGAL::ON_ORIENTED_BOUNDARY) return side == CGAL::ON_POSITIVE_SIDE;
  // each point is lifted by an infinitely small amount, the more the later it is from left to right
  std::array<const Vec2*, 4> order{&a, &b, &c, &d};
  std::sort(order.begin(), order.end(), [](const Vec2* p, const Vec2* q) {
    return std::pair(p->x(), p->y()) < std::pair(q->x(), q->y());
  });
  for (std::size_t k = 3; k > 0; --k) {
    const Vec2* const last = order[k];
    if (last == &d) return false;
    const int turn = last == &c   ? orientation(a, b, d)
                     : last == &b ? orientation(a, d, c)
                                  : orientation(d, b, c);
    if (turn != 0) return turn > 0;
  }
  return false;
}

} // namespace cnem::voronoi
