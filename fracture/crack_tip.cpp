#include "fracture/crack_tip.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace cnem::fracture {

namespace {

double distance_to_segment(const Vec2& x, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double s = std::clamp((x - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (a + s * d - x).norm();
}

NodeIndex nearest_node(const Cloud<2>& cloud, const Vec2& x) {
  NodeIndex best{};
  for (const NodeIndex i : cloud.position.indices())
    if ((cloud.position[i] - x).squaredNorm() < (cloud.position[best] - x).squaredNorm()) best = i;
  return best;
}

bool is_face(const std::string& piece, const std::string& crack) {
  return piece == crack + "+" || piece == crack + "-";
}

} // namespace

double CrackTip::angle(const Vec2& x) const {
  const Vec2 l = local(x);
  return std::atan2(l.y(), l.x());
}

double CrackTip::angle_of_node(NodeIndex i, const Vec2& x) const {
  if (face[i] != 0) {
    // Beyond a kink the faces leave the line θ = ±π; the side still tells which way round to go.
    const double theta = angle(x);
    return std::abs(theta) > 0.5 * std::numbers::pi ? std::copysign(std::abs(theta), face[i]) : theta;
  }
  return angle(x);
}

std::array<FacetPoint, 4> facet_points(const CrackTip& tip, const FacetLoad& facet) {
  constexpr std::array<double, 4> x{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                    0.9305681557970263};
  constexpr std::array<double, 4> w{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                    0.1739274225687269};
  const Vec2 edge = facet.to - facet.from;
  const bool from_nearer = (facet.from - tip.position).norm() < (facet.to - tip.position).norm();
  std::array<FacetPoint, 4> points;
  for (std::size_t g = 0; g < 4; ++g) {
    FacetPoint& point = points[g];
    point.s = from_nearer ? x[g] * x[g] : 1.0 - x[g] * x[g];
    point.weight = 2.0 * x[g] * w[g] * edge.norm();
    point.position = facet.from + point.s * edge;
    point.r = (point.position - tip.position).norm();
    point.theta = tip.angle(point.position + 1e-9 * left_normal(edge));
  }
  return points;
}

std::vector<CrackTip> find_tips(const Cloud<2>& cloud, const std::vector<CrackPath>& cracks) {
  IndexedVector<NodeIndex, bool> twinned(index_of(cloud.nodes()), false);
  for (const auto& pair : cloud.twins)
    for (const NodeIndex i : pair) twinned[i] = true;
  std::vector<CrackTip> tips;
  for (const CrackPath& crack : cracks) {
    double length = 0.0;
    for (std::size_t k = 1; k < crack.points.size(); ++k)
      length += (crack.points[k] - crack.points[k - 1]).norm();
    std::vector<CrackTip> mine;
    for (const bool last : {false, true}) {
      const Vec2 end = last ? crack.points.back() : crack.points.front();
      const Vec2 before = last ? crack.points[crack.points.size() - 2] : crack.points[1];
      CrackTip tip;
      tip.name = crack.tip_names[last ? 1 : 0];
      tip.crack = crack.name;
      tip.node = nearest_node(cloud, end);
      tip.position = cloud.position[tip.node];
      if ((tip.position - end).norm() > 1e-6 * length)
        throw GeometryError(fmt::format("the crack '{}' ends at ({:g}, {:g}) m, where there is no node",
                                        crack.name, end.x(), end.y()));
      if (twinned[tip.node]) continue; // a mouth
      tip.direction = (end - before).normalized();
      tip.straight = (end - before).norm();
      tip.face.assign(index_of(cloud.nodes()), 0);
      tip.clearance = std::numeric_limits<double>::infinity();
      double edges = 0.0;
      for (const Facet<2>& facet : cloud.facets) {
        const std::string& piece = cloud.piece_names[facet.piece];
        const Vec2 &a = cloud.position[facet.node[0]], &b = cloud.position[facet.node[1]];
        if (!is_face(piece, crack.name)) {
          tip.clearance = std::min(tip.clearance, distance_to_segment(tip.position, a, b));
          continue;
        }
        for (const NodeIndex i : facet.node) {
          if (i == tip.node) {
            edges += 0.5;
            tip.spacing += 0.5 * (b - a).norm();
          } else {
            tip.face[i] = static_cast<std::int8_t>((piece.back() == '+') == last ? 1 : -1);
          }
        }
      }
      if (edges == 0.0) continue; // on the boundary without faces: not an end of the slit
      tip.spacing /= edges;
      mine.push_back(std::move(tip));
    }
    for (CrackTip& tip : mine) {
      tip.half_length = length / static_cast<double>(mine.size());
      tips.push_back(std::move(tip));
    }
  }
  return tips;
}

std::array<std::string, 2> tip_names(const Vec2& first, const Vec2& last) {
  const Vec2 d = last - first;
  if (std::abs(d.x()) > 1e-9 * d.norm())
    return d.x() > 0.0 ? std::array<std::string, 2>{"left", "right"}
                       : std::array<std::string, 2>{"right", "left"};
  return d.y() > 0.0 ? std::array<std::string, 2>{"bottom", "top"}
                     : std::array<std::string, 2>{"top", "bottom"};
}

} // namespace cnem::fracture
