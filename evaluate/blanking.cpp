#include "evaluate/blanking.hpp"
#include "core/index.hpp"

#include "evaluate/blanking_parts.hpp"
#include "evaluate/force_stroke.hpp"
#include "mechanics/statics/rigid_motion.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

namespace cnem::evaluate {

namespace {

/// How much of the line at t lies inside a polygon, m.
double thickness_at(const CutTools& tools, const std::vector<Vec2>& polygon, double t) {
  std::vector<double> crossing;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double ta = tools.across(a) - t, tb = tools.across(b) - t;
    if ((ta < 0.0) == (tb < 0.0)) continue;
    const double share = ta / (ta - tb);
    crossing.push_back((1.0 - share) * tools.along(a) + share * tools.along(b));
  }
  if (crossing.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(crossing.begin(), crossing.end());
  return *high - *low;
}

/// The part with the most volume where t is in a band; −1 when there is none.
std::int32_t part_in(const CutTools& tools, const CutSheet& sheet, double from, double to) {
  std::map<std::int32_t, double> volume;
  for (std::size_t i = 0; i < sheet.position.size(); ++i)
    if (const double t = tools.across(sheet.position[i]); t >= from && t <= to)
      volume[sheet.part[i]] += sheet.volume[i];
  std::int32_t most = -1;
  for (const auto& [part, v] : volume)
    if (most < 0 || v > volume[most]) most = part;
  return most;
}

/// A body's shape by least squares of s over t: slope of a line, or height of an arc.
struct Shape {
  double angle = std::numeric_limits<double>::quiet_NaN();
  double dishing = std::numeric_limits<double>::quiet_NaN();
};
struct Sample {
  double t = 0.0, s = 0.0, weight = 0.0;
};
/// plane: t of a plane of symmetry, about which the arc is even.
Shape shape_of(const std::vector<Sample>& samples, bool arc, std::optional<double> plane) {
  double mean = 0.0, weight = 0.0, low = INFINITY, high = -INFINITY;
  for (const Sample& x : samples) {
    mean += x.weight * x.t;
    weight += x.weight;
    low = std::min(low, x.t);
    high = std::max(high, x.t);
  }
  Shape shape;
  if (samples.size() < 3 || !(high > low)) return shape;
  mean = plane.value_or(mean / weight);
  const double half = plane ? std::max(high - mean, mean - low) : 0.5 * (high - low);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Sample& x : samples) {
    const double t = (x.t - mean) / half;
    const Eigen::Vector3d row(1.0, plane ? 0.0 : t, arc ? t * t : 0.0);
    normal += x.weight * row * row.transpose();
    right += x.weight * x.s * row;
  }
  for (Eigen::Index k = 0; k < 3; ++k)
    if (normal(k, k) == 0.0) normal(k, k) = weight; // what is not asked for stays zero
  const Eigen::Vector3d fit = normal.ldlt().solve(right);
  if (!plane) shape.angle = std::atan(fit[1] / half);
  if (arc) shape.dishing = -fit[2];
  return shape;
}

std::vector<Vec2> positions(const Fields<2>& field) {
  std::vector<Vec2> list(field[0].size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = {field[0][i], field[1][i]};
  return list;
}

std::vector<char> nodes_on_planes(const Supports<2>& supports, const Vec2& direction, std::size_t nodes) {
  std::vector<char> on(nodes, 0);
  for (const Support<2>& support : supports.list())
    if (support.kind == Support<2>::Kind::symmetry && std::abs(support.direction.dot(direction)) < 1e-6)
      for (const NodeIndex i : support.nodes) on[index_of(i)] = 1;
  return on;
}

/// Pieces of the boundary that neither the outline of the sheet nor fracture made: holes and cracks.
std::vector<PieceIndex> other_pieces(const input::Domain& domain,
                                     const IndexedVector<PieceIndex, std::string>& names) {
  std::vector<PieceIndex> others;
  for (const PieceIndex piece : names.indices()) {
    const auto is_this = [&](const CurvePiece& part) { return part.name == names[piece]; };
    if (names[piece] != input::Adaptation::fracture_piece &&
        std::none_of(domain.outer.pieces.begin(), domain.outer.pieces.end(), is_this))
      others.push_back(piece);
  }
  return others;
}

double largest_of(const Fields<2>& displacement, const std::vector<std::int32_t>& part, std::int32_t wanted) {
  double most = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i)
    if (part[i] == wanted) most = std::max(most, std::hypot(displacement[0][i], displacement[1][i]));
  return most;
}

} // namespace

std::vector<Vec2> points_of(const Curve& curve, const Vec2& shift) {
  constexpr int divisions = 32;
  std::vector<Vec2> points;
  for (const CurvePiece& piece : curve.pieces)
    for (int k = 0; k < (piece.is_arc() ? divisions : 1); ++k)
      points.push_back(piece.point(k / double(divisions)) + shift);
  return points;
}

std::vector<Clearance> find_clearances(const CutTools& tools, const std::vector<Vec2>& outline) {
  std::vector<Clearance> list;
  double low = INFINITY, high = -INFINITY; // of the punch
  for (const Vec2& x : tools.punch) {
    low = std::min(low, tools.across(x));
    high = std::max(high, tools.across(x));
  }
  double top = INFINITY, bottom = -INFINITY; // of the sheet; what lies a sheet further down is no edge
  for (const Vec2& x : outline) {
    top = std::min(top, tools.along(x));
    bottom = std::max(bottom, tools.along(x));
  }
  const double deepest = 2.0 * bottom - top;
  for (const double side : {-1.0, 1.0}) {
    const double reach = side > 0.0 ? high : -low, middle = side * 0.5 * (low + high);
    double edge = INFINITY;
    for (const Vec2& x : tools.die)
      if (const double t = side * tools.across(x); t > middle && tools.along(x) < deepest)
        edge = std::min(edge, t);
    if (!std::isfinite(edge)) continue; // no die on this side
    const double gap = side * 0.5 * (reach + edge), thickness = thickness_at(tools, outline, gap);
    if (thickness > 0.0)
      list.push_back({side < 0.0 ? "left" : "right", edge - reach, thickness,
                      tools.place(gap, 0.5 * (top + bottom)), tools.place(side, 0.0)});
  }
  if (list.size() == 1) list.front().name.clear();
  return list;
}

std::vector<Cut> find_cuts(const CutTools& tools, const CutSheet& sheet) {
  std::vector<Cut> cuts;
  for (const double side : {-1.0, 1.0}) {
    Cut cut;
    cut.side = side;
    double reach = -INFINITY, edge = INFINITY;
    for (const Vec2& x : tools.punch) reach = std::max(reach, side * tools.across(x));
    for (const Vec2& x : tools.die)
      if (const double t = side * tools.across(x); t >= reach - 1e-9 * std::abs(reach))
        edge = std::min(edge, t);
    if (!std::isfinite(edge)) continue; // no die on this side
    cut.punch = side * reach;
    cut.die = side * edge;
    cut.thickness = thickness_at(tools, sheet.initial_outline, 0.5 * (cut.punch + cut.die));
    if (!(cut.thickness > 0.0)) continue;
    const double inner = cut.punch - side * cut.thickness, outer = cut.die + side * cut.thickness;
    cut.slug = part_in(tools, sheet, std::min(inner, cut.punch), std::max(inner, cut.punch));
    cut.skeleton = part_in(tools, sheet, std::min(outer, cut.die), std::max(outer, cut.die));
    cuts.push_back(cut);
  }
  if (cuts.size() == 2) {
    cuts[0].name = "left";
    cuts[1].name = "right";
  }
  return cuts;
}

std::vector<BodySpringback> springback_of_bodies(std::span<const Cut> cuts, const CutTools& tools,
                                                 const CutSheet& sheet, const Fields<2>& displacement,
                                                 const Field& mass) {
  std::vector<BodySpringback> bodies;
  const auto add = [&](const std::string& name, std::int32_t part, bool arc, auto&& inside) {
    BodySpringback body;
    body.body = name;
    std::vector<Sample> before, after;
    std::optional<double> plane;
    for (std::size_t i = 0; i < sheet.position.size(); ++i) {
      const double t = tools.across(sheet.position[i]);
      if (sheet.part[i] != part || !inside(t)) continue;
      if (sheet.on_plane[i]) plane = t;
      const Vec2 move(displacement[0][i], displacement[1][i]);
      body.largest = std::max(body.largest, move.norm());
      before.push_back({t, tools.along(sheet.position[i]), mass[i]});
      after.push_back(
          {tools.across(sheet.position[i] + move), tools.along(sheet.position[i] + move), mass[i]});
    }
    if (before.empty()) return;
    const Shape a = shape_of(before, arc, plane), b = shape_of(after, arc, plane);
    body.angle_before = a.angle;
    body.angle_change = b.angle - a.angle;
    body.dishing_before = a.dishing;
    body.dishing_change = b.dishing - a.dishing;
    bodies.push_back(std::move(body));
  };
  if (cuts.empty()) return bodies;
  add("slug", cuts.front().slug, true, [&](double t) {
    return std::all_of(cuts.begin(), cuts.end(),
                       [&](const Cut& cut) { return cut.side * (t - cut.die) <= 0.0; });
  });
  for (const Cut& cut : cuts)
    add(cut.name.empty() ? "skeleton" : fmt::format("skeleton_{}", cut.name), cut.skeleton, false,
        [&](double t) { return cut.side * (t - cut.punch) >= 0.0; });
  return bodies;
}

std::vector<MeasuredHeights> measured_beside(const std::vector<ShearedFace>& faces,
                                             const std::vector<input::MeasuredFace>& measured) {
  std::vector<MeasuredHeights> list;
  for (const ShearedFace& face : faces)
    for (const input::MeasuredFace& one : measured) {
      const auto same = [&](const MeasuredHeights& known) { // of a section at another angle
        return known.cut == face.cut && known.body == face.body;
      };
      if (one.body != face.body || std::any_of(list.begin(), list.end(), same)) continue;
      MeasuredHeights& heights = list.emplace_back(MeasuredHeights{face.cut, face.body});
      const auto set = [&](double& height, const std::optional<input::MeasuredHeight>& given) {
        if (given) height = given->share ? given->value * face.thickness : given->value;
      };
      set(heights.rollover, one.rollover);
      set(heights.burnish, one.burnish);
      set(heights.fracture, one.fracture);
      set(heights.burr, one.burr);
      if (one.fracture_angle) heights.fracture_angle = *one.fracture_angle;
    }
  return list;
}

BlankingResult evaluate_blanking(const input::Case& input, const results::Snapshot<2>& shot,
                                 const Supports<2>& supports, const Springback* springback,
                                 const results::HistoryTable& history) {
  BlankingResult result;
  result.time = shot.state.time;
  if (input.analysis.kinematics == input::Analysis::Kinematics::axisymmetric) {
    result.force_unit = "N";
    result.work_unit = "J";
  }
  const auto each_part = [&] {
    for (std::int32_t part = 0; springback && part < springback->bodies; ++part) {
      result.springback.emplace_back().body = fmt::format("body_{}", part + 1);
      result.springback.back().largest = largest_of(springback->displacement, springback->body, part);
    }
  };
  if (!input.report.blanking) {
    each_part();
    return result;
  }
  const input::BlankingReport& asked = *input.report.blanking;
  result.punch = input.tools[asked.punch].name;
  result.parallel = asked.parallel;
  const double now = shot.state.time;
  CutTools tools;
  Vec2 stroke = shot.contact.displacement(asked.punch, now);
  tools.punch = points_of(input.tools[asked.punch].outline, stroke);
  for (const std::size_t die : asked.dies) {
    result.dies.push_back(input.tools[die].name);
    const Vec2 moved = shot.contact.displacement(die, now);
    const std::vector<Vec2> points = points_of(input.tools[die].outline, moved);
    tools.die.insert(tools.die.end(), points.begin(), points.end());
    stroke -= moved / static_cast<double>(asked.dies.size());
  }
  result.stroke = stroke.norm();
  if (!(result.stroke > 0.0)) {
    result.note = fmt::format("{} has not moved", result.punch);
    each_part();
    return result;
  }
  tools.direction = stroke.normalized();
  result.direction_x = tools.direction.x();
  result.direction_y = tools.direction.y();
  if (history.rows() > 0)
    for (const input::Tool& tool : input.tools)
      result.forces.push_back(largest_force(force_curve(history, tool.name, result.punch, result.dies,
                                                        Vec3(tools.direction.x(), tools.direction.y(), 0.0)),
                                            tool.name));

  const auto& pieces = shot.cloud.piece_names;
  const auto piece = std::find(pieces.begin(), pieces.end(), input::Adaptation::fracture_piece);
  CutSheet sheet{positions(shot.state.node.position),
                 shot.cloud.facets,
                 piece == pieces.end() ? PieceIndex::none : as<PieceIndex>(piece - pieces.begin()),
                 {},
                 shot.approximation.node_volume,
                 nodes_on_planes(supports, tools.direction, shot.state.node.size()),
                 points_of(input.domain.outer, Vec2::Zero()),
                 other_pieces(input.domain, pieces),
                 positions(shot.state.node.initial_position),
                 broken_nodes(shot)};
  for (const std::size_t root : parts_of(shot.approximation.mechanics, sheet.position.size()))
    sheet.part.push_back(static_cast<std::int32_t>(root));
  const std::vector<Cut> cuts = find_cuts(tools, sheet);
  if (cuts.empty()) {
    result.note = fmt::format("no side of {} passes an edge of {} where there was sheet", result.punch,
                              fmt::join(result.dies, ", "));
    each_part();
    return result;
  }
  for (const Cut& cut : cuts)
    result.cut_length += result.force_unit == "N" ? 2.0 * std::numbers::pi * std::abs(cut.punch) : 1.0;
  result.smoothing = asked.smoothing.value_or(cuts.front().thickness / 50.0);
  for (const Cut& cut : cuts)
    for (ShearedFace& face : measure_cut(cut, tools, sheet, asked.parallel, result.smoothing))
      result.faces.push_back(std::move(face));
  result.measured = measured_beside(result.faces, asked.measured);
  if (springback)
    result.springback =
        springback_of_bodies(cuts, tools, sheet, springback->displacement, shot.state.node.mass);
  return result;
}

} // namespace cnem::evaluate
