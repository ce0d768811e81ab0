#pragma once
// Parts of polygons on one side of a line or a plane.
#include <cstddef>
#include <vector>

namespace cnem {

/// Leaves what of a polygon lies where `height`, linear over it, is not positive; convex or not (parts that
/// come apart stay joined along the line). New corners are between(a, b, share), share of the way from a to
/// b. scratch: any.
template<class Corner, class Height, class Between>
void clip_polygon(std::vector<Corner>& polygon, std::vector<Corner>& scratch, Height&& height,
                  Between&& between) {
  scratch.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &a = polygon[k], &b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double at_a = height(a), at_b = height(b);
    if (at_a <= 0.0) scratch.push_back(a);
    if ((at_a <= 0.0) != (at_b <= 0.0)) scratch.push_back(between(a, b, at_a / (at_a - at_b)));
  }
  polygon.swap(scratch);
}

/// The same of places.
template<class Place, class Height>
void clip_polygon(std::vector<Place>& polygon, std::vector<Place>& scratch, Height&& height) {
  clip_polygon(polygon, scratch, height,
               [](const Place& a, const Place& b, double share) { return Place(a + share * (b - a)); });
}

/// Divides a convex polygon by a line: `inside` gets what lies where `height` is not positive, `outside` the
/// rest; either may get nothing or less than three corners. Neither may be the polygon itself.
template<class Place, class Height>
void split_polygon(const std::vector<Place>& polygon, std::vector<Place>& inside, std::vector<Place>& outside,
                   Height&& height) {
  inside.clear();
  outside.clear();
  if (polygon.empty()) return;
  const Place* a = &polygon.back();
  double at_a = height(*a);
  for (const Place& b : polygon) {
    const double at_b = height(b);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) {
      const Place between = *a + at_a / (at_a - at_b) * (b - *a);
      inside.push_back(between);
      outside.push_back(between);
    }
    if (at_b <= 0.0) inside.push_back(b);
    if (at_b >= 0.0) outside.push_back(b);
    a = &b;
    at_a = at_b;
  }
}

} // namespace cnem
