#include "core/geometry/triangle_foot.hpp"

namespace cnem {

TriangleFoot foot_on_triangle(const std::array<Vec3, 3>& corner, const Vec3& x) {
  const auto& [a, b, c] = corner;
  const auto on_edge = [](const Vec3& p, const Vec3& q, double s, std::size_t i, std::size_t j) {
    TriangleFoot foot{p + s * (q - p), {}};
    foot.weight[i] = 1.0 - s;
    foot.weight[j] = s;
    return foot;
  };
  const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, {1, 0, 0}};
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0.0 && d4 <= d3) return {b, {0, 1, 0}};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return on_edge(a, b, d1 / (d1 - d3), 0, 1);
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0.0 && d5 <= d6) return {c, {0, 0, 1}};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return on_edge(a, c, d2 / (d2 - d6), 0, 2);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return on_edge(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)), 1, 2);
  const double sum = va + vb + vc, v = vb / sum, w = vc / sum;
  return {a + v * ab + w * ac, {1.0 - v - w, v, w}};
}

} // namespace cnem
