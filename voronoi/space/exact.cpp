#include "voronoi/space/exact.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>
#include <array>

namespace cnem::voronoi {

namespace {

using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;

Exact::Point_3 point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

} // namespace

int orientation_in_doubt(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return static_cast<int>(Exact().orientation_3_object()(point(a), point(b), point(c), point(d)));
}

bool in_coplanar_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Exact::Point_3 pa = point(a), pb = point(b), pc = point(c), pd = point(d);
  const auto turn = Exact().coplanar_orientation_3_object();
  const auto side = Exact().coplanar_side_of_bounded_circle_3_object()(pa, pb, pc, pd);
  if (side != CGAL::ON_BOUNDARY) return side == CGAL::ON_BOUNDED_SIDE;
  // each point is lifted by an infinitely small amount, the more the later it is from left to right
  std::array<const Exact::Point_3*, 4> order{&pa, &pb, &pc, &pd};
  std::sort(order.begin(), order.end(), [](const auto* p, const auto* q) { return *p < *q; });
  const auto sense = turn(pa, pb, pc);
  for (std::size_t k = 3; k > 0; --k) {
    const Exact::Point_3* const last = order[k];
    if (last == &pd) return false;
    const auto of_last = last == &pc ? turn(pa, pb, pd) : last == &pb ? turn(pa, pd, pc) : turn(pd, pb, pc);
    if (of_last != CGAL::COLLINEAR) return of_last == sense;
  }
  return false;
}

} // namespace cnem::voronoi
