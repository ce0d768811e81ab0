#pragma once
// Domains that the tests of the cloud generator share.
#include "clouds/generate.hpp"
#include "tests/curves.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace cnem::clouds {

/// Polygon with pieces named NAME0, NAME1, …
inline Curve polygon(const std::vector<Vec2>& corners, const std::string& name = "side") {
  Curve curve = testing::polygon(corners);
  for (std::size_t k = 0; k < corners.size(); ++k) curve.pieces[k].name = name + std::to_string(k);
  return curve;
}

/// Pieces bottom, right, top, left.
inline Curve rectangle(double width, double height) {
  Curve curve = polygon({{0, 0}, {width, 0}, {width, height}, {0, height}});
  const char* names[] = {"bottom", "right", "top", "left"};
  for (std::size_t k = 0; k < 4; ++k) curve.pieces[k].name = names[k];
  return curve;
}

inline Curve circle(const Vec2& centre, double radius, const std::string& name) {
  CurvePiece piece;
  piece.from = piece.to = centre + Vec2(radius, 0);
  piece.centre = centre;
  piece.radius = radius;
  piece.name = name;
  return {{piece}};
}

inline DomainShape l_shape() { return {polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}), {}, {}}; }

inline DomainShape star() {
  std::vector<Vec2> corners;
  for (int k = 0; k < 10; ++k) {
    const double radius = k % 2 == 1 ? 0.45 : 1.0, angle = k * std::numbers::pi / 5;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return {polygon(corners), {}, {}};
}

inline DomainShape annulus() { return {circle({0, 0}, 1.0, "outside"), {circle({0, 0}, 0.4, "inside")}, {}}; }

inline DomainShape plate_with_hole() { return {rectangle(2, 1), {circle({1, 0.5}, 0.2, "hole")}, {}}; }

/// Unit square whose corner at (1, 1) is rounded with the radius.
inline DomainShape filleted_square(double radius) {
  Curve curve = polygon({{0, 0}, {1, 0}, {1, 1 - radius}, {1 - radius, 1}, {0, 1}});
  curve.pieces[2].centre = Vec2(1 - radius, 1 - radius);
  curve.pieces[2].radius = radius;
  curve.pieces[2].name = "fillet";
  return {curve, {}, {}};
}

inline Refinement near_points(std::vector<Vec2> points, double spacing, double growth = 0.3) {
  return {Refinement::Region::path, std::move(points), spacing, growth};
}

inline Refinement in_box(const Vec2& low, const Vec2& high, double spacing, double growth = 0.3) {
  return {Refinement::Region::box, {low, high}, spacing, growth};
}

/// Area enclosed by the facets, and area of all triangles.
inline double polygon_area(const Cloud<2>& cloud) {
  double area = 0.0;
  for (const Facet<2>& f : cloud.facets)
    area += 0.5 * cross(cloud.position[std::size_t(f.node[0])], cloud.position[std::size_t(f.node[1])]);
  return area;
}

inline double triangle_area(const Cloud<2>& cloud) {
  double area = 0.0;
  for (const auto& n : voronoi::triangulate(cloud).node) {
    const Vec2 &a = cloud.position[std::size_t(n[0])], &b = cloud.position[std::size_t(n[1])];
    area += 0.5 * cross(b - a, cloud.position[std::size_t(n[2])] - a);
  }
  return area;
}

inline double piece_length(const Cloud<2>& cloud, const std::string& name) {
  double length = 0.0;
  for (const Facet<2>& f : cloud.facets)
    if (cloud.piece_names[f.piece] == name)
      length += (cloud.position[std::size_t(f.node[1])] - cloud.position[std::size_t(f.node[0])]).norm();
  return length;
}

inline int nodes_at(const Cloud<2>& cloud, const Vec2& x) {
  return static_cast<int>(
      std::ranges::count_if(cloud.position, [&](const Vec2& y) { return (x - y).norm() < 1e-12; }));
}

/// The message of the error that a call throws, or "no error".
template<typename Call> std::string error_of(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) { return error.what(); }
  return "no error";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace cnem::clouds
