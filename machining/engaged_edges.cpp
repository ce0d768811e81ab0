#include "machining/engaged_edges.hpp"

#include "core/index.hpp"
#include "machining/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace cnem::machining {

namespace {

constexpr double quarter_turn = 0.5 * std::numbers::pi;

/// Heights between which edges are taken for cones, from the tip upwards.
std::vector<double> ends_of_cones(const Cutter& cutter, double depth) {
  std::vector<double> ends{0.0};
  if (cutter.corner > 0.0) {
    constexpr int arcs = 24;
    for (int k = 1; k <= arcs; ++k) ends.push_back(cutter.corner * (1.0 - std::cos(quarter_turn * k / arcs)));
    while (ends.size() > 1 && ends.back() >= depth * (1.0 - 1e-9)) ends.pop_back(); // but for rounding
    ends.push_back(depth);
  } else if (cutter.edge) {
    const CuttingEdge& edge = *cutter.edge;
    const double top = std::min(depth, edge.top());
    ends[0] = std::min(std::max(0.0, edge.bottom()), top);
    constexpr double degree = std::numbers::pi / 180.0, bend = 4.0 * degree, cone = 0.02; // of the radius
    const auto apart = [&](double from, double to) {
      return std::max({std::abs(edge.lag(to) - edge.lag(from)) / degree,
                       std::abs(edge.lead(to, to) - edge.lead(from, from)) / bend,
                       std::abs(cutter.radius_at(to) - cutter.radius_at(from)) / (cone * cutter.radius())});
    };
    double corner = ends[0]; // of the polyline, the last one within reach of the slice
    for (const Vec3& point : edge.points()) {
      const double z = std::min(point.z(), top);
      if (z <= ends.back()) continue;
      // Short straight parts make one slice, long ones several.
      if (corner > ends.back() && apart(ends.back(), z) > 1.0) ends.push_back(corner);
      const double from = ends.back();
      const int pieces = static_cast<int>(std::ceil(apart(from, z) - 1e-9));
      for (int k = 1; k < pieces; ++k) ends.push_back(from + (z - from) * k / pieces);
      corner = z;
    }
    if (top > ends.back()) ends.push_back(top);
  } else
    ends.push_back(depth);
  return ends;
}

/// The same with slices along which the part of the turn that is in the cut changes by 0.1 rad at most, by
/// equal changes. Where the edge comes to the workpiece, or leaves its other side, it does so as the root of
/// the height: slices end there.
std::vector<double> ends_of_slices(const MillingCut& cut, double depth) {
  constexpr double most = 0.1, sliver = 1e-9; // rad; of a cone
  const std::vector<double> cones = ends_of_cones(cut.cutter, depth);
  const auto turn = [&](double z) {
    const double radius = cut.cutter.radius_at(z);
    return cut.engagement.exit(cut.cutter, radius) - cut.engagement.entry(cut.cutter, radius);
  };
  std::vector<double> ends{cones.front()};
  for (std::size_t k = 1; k < cones.size(); ++k) {
    const double low = cones[k - 1], high = cones[k], first = turn(low), change = turn(high) - first;
    const int pieces = static_cast<int>(std::ceil(std::abs(change) / most));
    // The first and the last end are where the turn begins to change and where it has done so.
    for (int i = 0; pieces > 1 && i <= pieces; ++i) {
      double from = low, to = high;
      for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (from + to), gone = (turn(middle) - first) / change;
        const bool past = i == 0 ? gone > 0.0 : gone >= static_cast<double>(i) / pieces;
        (past ? to : from) = middle;
      }
      const double end = i == 0 ? from : to, least = sliver * (high - low);
      if (end > ends.back() + least && end < high - least) ends.push_back(end);
    }
    ends.push_back(high);
  }
  return ends;
}

/// Adds the integral of f by `few` Gauss points where it is short over [from, to] in [0, 1], along which φ =
/// φ₀ + x Δφ, in pieces of at most half a radian that end where φ is at a kink.
template<class F>
void integrate(double from, double to, double phi, double change, std::span<const double> kinks, int few,
               DirectionalFactors& sum, const F& f) {
  if (!(to > from)) return;
  if (change == 0.0) {
    sum += (to - from) * f(phi);
    return;
  }
  for (const double kink : kinks)
    if (const double x = (kink - phi) / change; x > from && x < to) {
      integrate(from, x, phi, change, kinks, few, sum, f);
      integrate(x, to, phi, change, kinks, few, sum, f);
      return;
    }
  constexpr double piece = 0.5, short_one = 0.1; // rad
  const double turn = std::abs(change) * (to - from);
  const int pieces = std::max(1, static_cast<int>(std::ceil(turn / piece)));
  const GaussRule& rule = gauss_rule(turn > short_one ? 8 : few);
  const double width = (to - from) / pieces;
  for (int k = 0; k < pieces; ++k)
    for (std::size_t i = 0; i < rule.node.size(); ++i)
      sum += rule.weight[i] * width * f(phi + (from + (k + rule.node[i]) * width) * change);
}

} // namespace

DirectionalFactors EdgeSlice::answer(double phi, const Vec3& force) const {
  const double s = std::sin(phi), c = std::cos(phi);
  const double radial = sine * force[1] + cosine * force[2], axial = sine * force[2] - cosine * force[1];
  const Vec3 on_tool(-force[0] * c - radial * s, force[0] * s - radial * c, -axial);
  return width * on_tool * Eigen::RowVector3d(sine * s, sine * c, -cosine);
}

std::vector<EdgeSlice> edge_slices(const MillingCut& cut, double depth) {
  const Cutter& cutter = cut.cutter;
  const std::vector<double> ends = ends_of_slices(cut, depth);
  std::vector<EdgeSlice> slices;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double low = ends[k], high = ends[k + 1];
    EdgeSlice& slice = slices.emplace_back();
    slice.radius = cutter.mean_radius(low, high);
    slice.width = cutter.profile(low, high);
    if (const double lead = cutter.lead(low, high); lead != quarter_turn) {
      slice.sine = std::sin(lead);
      slice.cosine = std::cos(lead);
    }
    slice.law = cut.law;
    if (cutter.edge) {
      const CuttingEdge::Angles angles = cutter.edge->angles(low, high);
      slice.law.incline(angles.inclination);
      slice.law.take_rake(angles.rake);
    }
    for (const auto& [end, z] : {std::pair{std::size_t{0}, low}, {std::size_t{1}, high}}) {
      const double radius = cutter.radius_at(z);
      slice.lag[end] = cutter.lag(z);
      slice.entry[end] = cut.engagement.entry(cutter, radius);
      slice.exit[end] = cut.engagement.exit(cutter, radius);
    }
  }
  return slices;
}

SteadyChips steady_chips(const MillingCut& cut, double depth) {
  const std::vector<double> ends = ends_of_slices(cut, depth);
  SteadyChips chips;
  const auto at = [&](double z) { // of edges at a height
    const double radius = cut.cutter.radius_at(z), lead = cut.cutter.lead(z, z),
                 entry = cut.engagement.entry(cut.cutter, radius),
                 exit = cut.engagement.exit(cut.cutter, radius);
    if (!(exit > entry)) return;
    const bool farthest = radius > chips.radius;
    if (farthest) {
      chips.radius = radius;
      chips.thinnest = infinite;
    }
    for (std::size_t j = 0; j < cut.cutter.teeth(); ++j) {
      chips.thickest =
          std::max(chips.thickest, std::sin(lead) * steady_thickness(cut, j, foremost_of(entry, exit)));
      // Within a hundredth of the engagement of where the thickness is nothing anyway it does not count.
      for (int k = 1; farthest && k < 100; ++k)
        chips.thinnest =
            std::min(chips.thinnest, steady_thickness(cut, j, entry + 0.01 * k * (exit - entry)));
    }
  };
  for (const double z : ends) at(z);
  return chips;
}

EngagedEdges::EngagedEdges(const MillingCut& cut, double depth, double spindle)
    : cut_(cut), spindle_(spindle), slices_(edge_slices(cut, depth)) {
  for (const EdgeSlice& slice : slices_)
    for (std::size_t j = 0; j < cut.cutter.teeth(); ++j)
      kinks_.push_back(changes_within(cut, j, slice.radius));
}

template<class PerSlice>
DirectionalFactors EngagedEdges::along_edge(std::size_t tooth, double tip, const PerSlice& per_slice) const {
  DirectionalFactors sum = DirectionalFactors::Zero();
  constexpr double straight = 1e-9;           // rad along a slice
  const int few = slices_.size() > 8 ? 2 : 8; // slopes of tables jump: many slices tell where
  for (std::size_t s = 0; s < slices_.size(); ++s) {
    const EdgeSlice& slice = slices_[s];
    // The tip is at such angles when the ends of the slice enter and leave.
    const double enters = slice.entry[0] + slice.lag[0], leaves = slice.exit[0] + slice.lag[0],
                 enters_later = slice.entry[1] + slice.lag[1] - enters,
                 leaves_later = slice.exit[1] + slice.lag[1] - leaves,
                 first = std::min(enters, enters + enters_later),
                 last = std::max(leaves, leaves + leaves_later), lags = slice.lag[1] - slice.lag[0];
    // A long edge is in the cut in several places.
    for (int k = static_cast<int>(std::floor((tip - last) / full_turn)); tip - k * full_turn >= first; ++k) {
      const double at = tip - k * full_turn;
      double from = 0.0, to = 1.0; // of the slice
      if (std::abs(enters_later) < straight) {
        if (at < enters) continue;
      } else
        (enters_later > 0.0 ? to : from) = std::clamp((at - enters) / enters_later, 0.0, 1.0);
      if (std::abs(leaves_later) < straight) {
        if (at > leaves) continue;
      } else {
        const double gone = std::clamp((at - leaves) / leaves_later, 0.0, 1.0);
        if (leaves_later > 0.0)
          from = std::max(from, gone);
        else
          to = std::min(to, gone);
      }
      integrate(from, to, at - slice.lag[0], std::abs(lags) < straight ? 0.0 : -lags,
                kinks_[s * cut_.cutter.teeth() + tooth], few, sum,
                [&](double phi) { return per_slice(slice, phi); });
    }
  }
  return sum;
}

template<class PerSlice> DirectionalFactors EngagedEdges::mean_of_turn(const PerSlice& per_slice) const {
  DirectionalFactors sum = DirectionalFactors::Zero();
  for (std::size_t s = 0; s < slices_.size(); ++s) {
    const EdgeSlice& slice = slices_[s];
    const bool cone = slice.entry[0] != slice.entry[1] || slice.exit[0] != slice.exit[1];
    const GaussRule& rule = gauss_rule(cone ? 3 : 1);
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double x = rule.node[i], entry = (1.0 - x) * slice.entry[0] + x * slice.entry[1],
                   turn = (1.0 - x) * slice.exit[0] + x * slice.exit[1] - entry;
      for (std::size_t j = 0; j < cut_.cutter.teeth(); ++j) {
        DirectionalFactors part = DirectionalFactors::Zero();
        integrate(0.0, 1.0, entry, turn, kinks_[s * cut_.cutter.teeth() + j], 8, part,
                  [&](double phi) { return per_slice(slice, j, phi); });
        sum += rule.weight[i] * turn * part;
      }
    }
  }
  return sum / full_turn;
}

DirectionalFactors EngagedEdges::factors_at(const EdgeSlice& slice, std::size_t tooth, double phi) const {
  const double h = slice.sine * steady_thickness(cut_, tooth, phi), onset = slice.sine * cut_.onset;
  if (!(h > 0.0) && !cut_.linear()) return DirectionalFactors::Zero();
  if (onset > 0.0 && h < onset)
    return slice.answer(phi,
                        slice.law.at({.thickness = onset, .speed = spindle_ * slice.radius}).force / onset);
  const LawPoint point = slice.law.at({.thickness = h, .speed = spindle_ * slice.radius});
  return slice.answer(phi, point.slope);
}

DirectionalFactors EngagedEdges::damping_at(const EdgeSlice& slice, std::size_t tooth, double phi) const {
  if (!(steady_thickness(cut_, tooth, phi) > 0.0)) return DirectionalFactors::Zero();
  const double damping = cut_.flank.about(slice.radius)
                             .damping(flank_rise(cut_, tooth, phi, slice.radius), spindle_ * slice.radius);
  DirectionalFactors answer = slice.answer(phi, damping * Vec3(cut_.flank.friction, 1.0, 0.0));
  answer.col(2).setZero(); // lands are pressed in across the axis, as FlankTraces has it
  return answer;
}

DirectionalFactors EngagedEdges::factors(std::size_t tooth, double tip) const {
  return along_edge(tooth, tip,
                    [&](const EdgeSlice& slice, double phi) { return factors_at(slice, tooth, phi); });
}

DirectionalFactors EngagedEdges::damping(std::size_t tooth, double tip) const {
  if (!cut_.flank.presses()) return DirectionalFactors::Zero();
  return along_edge(tooth, tip,
                    [&](const EdgeSlice& slice, double phi) { return damping_at(slice, tooth, phi); });
}

bool EngagedEdges::engages(std::size_t tooth, double tip) const {
  return !along_edge(tooth, tip, [](const EdgeSlice&, double) -> DirectionalFactors {
            return DirectionalFactors::Ones();
          }).isZero(0.0);
}

DirectionalFactors EngagedEdges::mean_factors() const {
  return mean_of_turn(
      [&](const EdgeSlice& slice, std::size_t j, double phi) { return factors_at(slice, j, phi); });
}

DirectionalFactors EngagedEdges::mean_damping() const {
  if (!cut_.flank.presses()) return DirectionalFactors::Zero();
  return mean_of_turn(
      [&](const EdgeSlice& slice, std::size_t j, double phi) { return damping_at(slice, j, phi); });
}

double EngagedEdges::rounding() const {
  return cut_.cutter.rounded() ? 1e-5 : 1e-10; // of files in single precision
}

std::vector<double> EngagedEdges::changes(std::size_t tooth) const {
  std::vector<double> list;
  // Of a course over the height: its ends, and where it turns back.
  const auto add = [&](const auto& at) {
    double before = at(slices_.front(), 0), way = 0.0;
    list.push_back(before);
    for (const EdgeSlice& slice : slices_) {
      const double next = at(slice, 1), on = next - before;
      if (std::abs(on) <= rounding()) continue;
      if (on * way < 0.0) list.push_back(before);
      way = on;
      before = next;
    }
    list.push_back(at(slices_.back(), 1));
  };
  if (slices_.empty()) return list;
  add([](const EdgeSlice& slice, std::size_t end) { return slice.entry[end] + slice.lag[end]; });
  add([](const EdgeSlice& slice, std::size_t end) { return slice.exit[end] + slice.lag[end]; });
  for (std::size_t s = 0; s < slices_.size(); s += std::max<std::size_t>(1, slices_.size() - 1))
    for (const double phi : kinks_[s * cut_.cutter.teeth() + tooth])
      for (const double lag : slices_[s].lag) list.push_back(phi + lag);
  return list;
}

} // namespace cnem::machining
