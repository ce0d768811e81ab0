#include "machining/cutting_edge.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "machining/gauss.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace cnem::machining {

namespace {

double from_axis(const Vec3& x) { return x.head<2>().norm(); }

/// rad, clockwise seen from +z, round the axis from one place to another.
double turn_between(const Vec3& a, const Vec3& b) {
  return std::atan2(b.x() * a.y() - b.y() * a.x(), a.x() * b.x() + a.y() * b.y());
}

std::string in_mm(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) mm", 1e3 * x.x(), 1e3 * x.y(), 1e3 * x.z());
}

/// The boundary of a surface, round it: points and the triangles on the way to the next one.
struct Rim {
  std::vector<std::int32_t> point;
  std::vector<std::size_t> triangle;
};

Rim rim_of(const TriangleSurface& rake) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides; // without sense
  for (const auto& t : rake.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
  std::map<std::int32_t, std::pair<std::int32_t, std::size_t>> next; // along the boundary
  for (std::size_t n = 0; n < rake.triangles.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& t = rake.triangles[n];
      const std::int32_t a = t[k], b = t[(k + 1) % 3];
      const int shared = sides.at(std::minmax(a, b));
      if (shared > 2 || (shared == 1 && !next.try_emplace(a, b, n).second))
        throw GeometryError(fmt::format("triangles meet at {} in more than one way, expected a single face",
                                        in_mm(rake.points[index_of(a)])));
    }
  if (next.empty()) throw GeometryError("found a closed surface, expected a rake face, which has an edge");
  Rim rim;
  const std::int32_t first = next.begin()->first;
  std::int32_t at = first;
  do {
    const auto found = next.find(at);
    if (found == next.end())
      throw GeometryError(fmt::format("triangles at {} are turned over, expected all of one side in sight",
                                      in_mm(rake.points[index_of(at)])));
    rim.point.push_back(at);
    rim.triangle.push_back(found->second.second);
    at = found->second.first;
  } while (at != first && rim.point.size() <= next.size());
  if (at != first || rim.point.size() != next.size())
    throw GeometryError("found a face with holes or of several pieces, expected a single one");
  return rim;
}

} // namespace

CuttingEdge::CuttingEdge(const TriangleSurface& rake) {
  const Rim rim = rim_of(rake);
  const std::size_t count = rim.point.size();
  const auto point = [&](std::size_t k) -> const Vec3& {
    return rake.points[index_of(rim.point[k % count])];
  };
  double size = 0.0;
  for (std::size_t k = 0; k < count; ++k) size = std::max(size, point(k).norm());
  const double level = 1e-6 * size; // files have single precision
  // Of the lowest and of the highest points those that are the farthest from the axis.
  std::size_t tip = 0, top = 0;
  for (std::size_t k = 1; k < count; ++k) {
    const Vec3 &x = point(k), &low = point(tip), &high = point(top);
    if (x.z() < low.z() - level || (x.z() < low.z() + level && from_axis(x) > from_axis(low))) tip = k;
    if (x.z() > high.z() + level || (x.z() > high.z() - level && from_axis(x) > from_axis(high))) top = k;
  }
  struct Chain {
    std::vector<Vec3> points;
    std::vector<std::size_t> triangles;
    double section = 0.0; ///< m², between it and the axis
  };
  std::array<Chain, 2> chains; // with the rim and against it
  for (const bool against : {false, true}) {
    Chain& chain = chains[against];
    chain.points.push_back(point(tip));
    for (std::size_t k = tip; k % count != top;) {
      const std::size_t to = against ? k + count - 1 : k + 1;
      chain.triangles.push_back(rim.triangle[(against ? to : k) % count]);
      chain.section += 0.5 * (from_axis(point(k)) + from_axis(point(to))) * (point(to).z() - point(k).z());
      chain.points.push_back(point(to));
      k = to % count;
    }
  }
  Chain& edge = chains[chains[1].section > chains[0].section];
  if (edge.points.size() < 2) throw GeometryError("found a face without height, expected one along the axis");
  points_ = std::move(edge.points);
  for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
    if (!(points_[k + 1].z() > points_[k].z()))
      throw GeometryError(
          fmt::format("the edge does not rise from {} to {}, expected one that does all along "
                      "from the tip",
                      in_mm(points_[k]), in_mm(points_[k + 1])));
    const auto [a, b, c] = rake.corners(edge.triangles[k]);
    normals_.push_back((b - a).cross(c - a).normalized());
    const Vec3 middle = 0.5 * (points_[k] + points_[k + 1]);
    if (normals_.back().dot(Vec3(middle.y(), -middle.x(), 0.0)) < 0.0) normals_.back() *= -1.0;
  }
  // Behind +y, without jumps of a turn; on the axis as beside it.
  lag_.assign(points_.size(), 0.0);
  const std::size_t beside = from_axis(points_.front()) > level ? 0 : 1;
  lag_[beside] = -std::atan2(points_[beside].x(), points_[beside].y());
  lag_[0] = lag_[beside];
  for (std::size_t k = beside + 1; k < points_.size(); ++k)
    lag_[k] = lag_[k - 1] - turn_between(points_[k - 1], points_[k]);
  constexpr double beyond = 1e-3; // of the radius: between corners of the edge the face may stand out
  for (const Vec3& x : rake.points)
    if (from_axis(x) > from_axis(at(x.z())) + beyond * radius())
      throw GeometryError(fmt::format("the face reaches {:.6g} mm from the axis at {}, beyond its edge, "
                                      "expected the edge on its outer side",
                                      1e3 * from_axis(x), in_mm(x)));
}

double CuttingEdge::radius() const {
  double most = 0.0;
  for (const Vec3& x : points_) most = std::max(most, from_axis(x));
  return most;
}

std::size_t CuttingEdge::segment(double z) const {
  const auto after = std::upper_bound(points_.begin() + 1, points_.end() - 1, z,
                                      [](double height, const Vec3& x) { return height < x.z(); });
  return index_of(after - points_.begin() - 1);
}

Vec3 CuttingEdge::at(double z) const {
  const std::size_t k = segment(z);
  const Vec3 &a = points_[k], &b = points_[k + 1];
  return a + std::clamp((z - a.z()) / (b.z() - a.z()), 0.0, 1.0) * (b - a);
}

template<class Visit> void CuttingEdge::over(double from, double to, Visit&& visit) const {
  const double low = std::clamp(from, bottom(), top()), high = std::clamp(to, bottom(), top());
  for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
    const double below = std::max(low, points_[k].z()), above = std::min(high, points_[k + 1].z());
    if (below < above) visit(at(below), at(above), k);
  }
}

namespace {

/// Mean of a function over the heights of straight parts.
template<class Value> double mean_along(const Vec3& a, const Vec3& b, const Value& value) {
  constexpr int points = 8;
  const GaussRule& rule = gauss_rule(points);
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.node.size(); ++k)
    sum += rule.weight[k] * value(Vec3(a + rule.node[k] * (b - a)));
  return sum;
}

} // namespace

double CuttingEdge::mean_radius(double from, double to) const {
  double sum = 0.0, height = 0.0;
  over(from, to, [&](const Vec3& a, const Vec3& b, std::size_t) {
    sum += (b.z() - a.z()) * mean_along(a, b, from_axis);
    height += b.z() - a.z();
  });
  return height > 0.0 ? sum / height : from_axis(at(from));
}

double CuttingEdge::length(double from, double to) const {
  double sum = 0.0;
  over(from, to, [&](const Vec3& a, const Vec3& b, std::size_t) {
    sum += std::hypot(from_axis(b) - from_axis(a), b.z() - a.z());
  });
  return sum;
}

double CuttingEdge::lead(double from, double to) const {
  Vec3 low = at(from), high = at(to);
  if (!(low.z() < high.z())) { // the straight part there; at a corner the one that ends in it
    const std::size_t above = segment(from),
                      k = above > 0 && !(points_[above].z() < from) ? above - 1 : above;
    low = points_[k];
    high = points_[k + 1];
  }
  return std::atan2(high.z() - low.z(), from_axis(high) - from_axis(low));
}

double CuttingEdge::lag(double z) const {
  const std::size_t k = segment(z);
  const Vec3 x = at(z);
  return from_axis(x) > 0.0 ? lag_[k + 1] - turn_between(points_[k + 1], x) : lag_[k];
}

double CuttingEdge::lag(double from, double to) const {
  double sum = 0.0, height = 0.0;
  over(from, to, [&](const Vec3& a, const Vec3& b, std::size_t k) {
    sum += (b.z() - a.z()) *
           mean_along(a, b, [&](const Vec3& x) { return lag_[k + 1] - turn_between(points_[k + 1], x); });
    height += b.z() - a.z();
  });
  return height > 0.0 ? sum / height : lag(from);
}

CuttingEdge::Angles CuttingEdge::angles(double from, double to) const {
  Angles sum;
  double length = 0.0;
  over(from, to, [&](const Vec3& a, const Vec3& b, std::size_t k) {
    const Vec3 way = b - a, tangent = way.normalized(), middle = 0.5 * (a + b);
    const Vec3 motion = Vec3(middle.y(), -middle.x(), 0.0).normalized();
    const Vec3 across = (motion - motion.dot(tangent) * tangent).normalized();
    Vec3 outwards = tangent.cross(across); // across the edge and the motion, away from the tool
    const Vec3 from_the_axis(middle.x(), middle.y(), 0.0);
    if (const Vec3 profile =
            way.z() * from_the_axis.normalized() - (from_axis(b) - from_axis(a)) * Vec3::UnitZ();
        outwards.dot(profile) < 0.0)
      outwards *= -1.0;
    sum.inclination += way.norm() * std::asin(std::clamp(-tangent.dot(motion), -1.0, 1.0));
    sum.rake += way.norm() * std::atan2(-normals_[k].dot(outwards), normals_[k].dot(across));
    length += way.norm();
  });
  return length > 0.0 ? Angles{sum.inclination / length, sum.rake / length} : sum;
}

} // namespace cnem::machining
