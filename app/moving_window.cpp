#include "app/moving_window.hpp"

#include "core/fields/vector_at.hpp"
#include "core/index.hpp"
#include "evaluate/chip.hpp"
#include "evaluate/cut_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem::app {

namespace {

/// How far the workpiece reaches below the tip, along and against the way of the tool, m from the tip.
struct Reach {
  double ahead = -std::numeric_limits<double>::infinity(), behind = -ahead;
};
Reach reach_of(const Cloud<2>& cloud, const std::vector<Vec2>& place) {
  Reach reach;
  for (const Facet<2>& facet : cloud.facets)
    if (const Vec2& x = place[index_of(facet.node[0])]; x.y() < 0.0)
      reach = {std::max(reach.ahead, x.x()), std::min(reach.behind, x.x())};
  return reach;
}

/// Heights at which the boundary crosses a line square to the way of the tool, from below, m.
std::vector<double> crossings(const Cloud<2>& cloud, const std::vector<Vec2>& place, double x) {
  std::vector<double> heights;
  for (const Facet<2>& facet : cloud.facets) {
    const Vec2 &a = place[index_of(facet.node[0])], &b = place[index_of(facet.node[1])];
    if ((a.x() < x) != (b.x() < x))
      heights.push_back(a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

} // namespace

MovingWindow::MovingWindow(const input::Case& input)
    : rules_(&*input.adapt.window), feed_(input.report.cutting ? input.report.cutting->feed : 0.0),
      tool_(input::cutting_tool(input, rules_->tool)) {}

MovingWindow::Cut MovingWindow::oriented(const Vec2& from, const Vec2& to) const {
  return cross(tool_.along, tool_.away) > 0.0 ? Cut{from, to} : Cut{to, from};
}

/// Through the machined part of the workpiece, from its surface down.
std::optional<MovingWindow::Cut> MovingWindow::behind(const Cloud<2>& cloud,
                                                      const std::vector<Vec2>& place) const {
  if (-reach_of(cloud, place).behind < rules_->behind + rules_->strip) return std::nullopt;
  const std::vector<double> height = crossings(cloud, place, -rules_->behind);
  if (height.size() < 2) return std::nullopt;
  return oriented({-rules_->behind, height[1]}, {-rules_->behind, height[0]});
}

/// Across the chip, from its free side to that on the rake face.
std::optional<MovingWindow::Cut> MovingWindow::across_chip(const Cloud<2>& cloud,
                                                           const std::vector<Vec2>& place) const {
  constexpr double widest = 2.0; // of the mean thickness
  const evaluate::Chip chip =
      evaluate::measure_chip(evaluate::cut_outline(cloud.facets, place), feed_, tool_.rake);
  if (!chip.note.empty() || chip.length < *rules_->chip + rules_->strip) return std::nullopt;
  const evaluate::Section section = evaluate::section_across(chip, *rules_->chip);
  if (section.length() > widest * chip.thickness) return std::nullopt;
  return oriented(section.free, section.rake);
}

std::optional<Resampling<2>> MovingWindow::next(End end, const ExplicitSolver<2>& solver,
                                                const Cloud<2>& cloud, const adapt::NodeProperties& node) {
  const Vec2 moved = solver.conditions().contact.displacement(rules_->tool, solver.state().time);
  const std::vector<Vec2> place = evaluate::places(tool_, moved, solver.state().node.position);
  std::optional<Cut> cut;
  if (end == End::behind) cut = behind(cloud, place);
  if (end == End::chip && rules_->chip) cut = across_chip(cloud, place);
  if (end == End::ahead ? reach_of(cloud, place).ahead >= rules_->ahead : !cut) return std::nullopt;
  const auto in_space = [&](const Vec2& x) -> Vec2 {
    return tool_.tip + moved + x.x() * tool_.along + x.y() * tool_.away;
  };
  IndexedVector<NodeIndex, Vec2> undeformed;
  for (std::size_t i = 0; i < place.size(); ++i)
    undeformed.push_back(vector_at<2>(solver.state().node.initial_position, i));
  std::optional<Resampling<2>> change;
  if (const auto structure = adapt::structure_if_valid(cloud, solver.approximation().mechanics.space()))
    change = cut ? adapt::take_off(cloud, *structure, node, in_space(cut->from), in_space(cut->to))
                 : adapt::feed(cloud, *structure, node, undeformed, tool_.along, rules_->strip);
  if (!change) {
    ++refused_;
    return std::nullopt;
  }
  fed_ += std::ssize(change->virgin);
  taken_off_ +=
      std::ssize(change->old_position) + std::ssize(change->virgin) - std::ssize(change->cloud.position);
  return change;
}

std::vector<std::pair<std::string, double>> MovingWindow::metrics() const {
  return {{"window.fed", static_cast<double>(fed_)},
          {"window.taken_off", static_cast<double>(taken_off_)},
          {"window.refused", static_cast<double>(refused_)}};
}

void MovingWindow::archive(Archive& archive) {
  archive.integer("run/window/fed", fed_);
  archive.integer("run/window/taken_off", taken_off_);
  archive.integer("run/window/refused", refused_);
}

} // namespace cnem::app
