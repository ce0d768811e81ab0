#include "adapt/split.hpp"

#include "adapt/resample.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace cnem::adapt {

namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

/// An edge to open: from a boundary node to an inner one, or to another boundary node.
struct Opening {
  std::int32_t from, to;
  double weakness; ///< sum of both ends' measure of damage
};

class Splitter {
public:
  Splitter(const WorkingCloud& work, const Structure& structure, const Field& broken, const SplitRules& rules)
      : work_(work), structure_(structure), broken_(broken), rules_(rules) {}

  /// The best edge there is.
  std::optional<Opening> next() const {
    std::optional<Opening> best;
    for (std::int32_t b = 0; b < static_cast<std::int32_t>(work_.size()); ++b) {
      if (!work_.on_boundary(b) || !(broken_[u(b)] >= 1.0)) continue;
      const bool tip = is_tip(b);
      if (!tip && near_face(b)) continue;
      for (const std::int32_t i : structure_.neighbours(b)) {
        if (!(broken_[u(i)] >= 1.0) || work_.next(b) == i || work_.previous(b) == i) continue;
        if (tip ? turns_too_much(b, i) : near_face(i)) continue;
        if (work_.on_boundary(i) && work_.next(work_.next(i)) == b) continue; // would cut off one triangle
        if (work_.on_boundary(i) && work_.next(work_.next(b)) == i) continue;
        const double weakness =
            broken_[u(b)] + broken_[u(i)] + (tip ? 1e3 : 0.0); // cracks grow before new start
        if (!best || weakness > best->weakness) best = {b, i, weakness};
      }
    }
    return best;
  }

private:
  const Vec2& at(std::int32_t i) const { return work_.cloud().position[u(i)]; }
  bool on_face(std::int32_t i) const {
    return work_.on_boundary(i) &&
           (work_.piece(i) == rules_.piece || work_.piece(work_.previous(i)) == rules_.piece);
  }
  /// Both facets are new faces and the boundary turns back there.
  bool is_tip(std::int32_t b) const {
    if (work_.piece(b) != rules_.piece || work_.piece(work_.previous(b)) != rules_.piece) return false;
    const Vec2 back = at(work_.previous(b)) - at(b), ahead = at(work_.next(b)) - at(b);
    return back.dot(ahead) > 0.0 && cross(ahead, back) <= 0.0;
  }
  bool turns_too_much(std::int32_t tip, std::int32_t to) const {
    const Vec2 came = at(tip) - 0.5 * (at(work_.previous(tip)) + at(work_.next(tip))),
               goes = at(to) - at(tip);
    return came.dot(goes) < std::cos(rules_.turn * std::numbers::pi / 180.0) * came.norm() * goes.norm();
  }
  /// A node of a new face is near.
  bool near_face(std::int32_t i) const {
    const double limit = rules_.clear * work_.node().size[u(i)];
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(work_.size()); ++f)
      if (on_face(f) && (at(f) - at(i)).norm() < limit) return true;
    return false;
  }

  const WorkingCloud& work_;
  const Structure& structure_;
  const Field& broken_;
  const SplitRules& rules_;
};

} // namespace

Resampling<2> split(const Cloud<2>& cloud, NodeProperties properties, const Field& broken,
                    const SplitRules& rules, SplitReport& report) {
  WorkingCloud work(cloud, std::move(properties));
  Structure structure = build_structure(work.cloud());
  Field measure = broken;
  for (int opened = 0; opened < rules.most; ++opened) {
    const std::optional<Opening> edge = Splitter(work, structure, measure, rules).next();
    if (!edge) break;
    WorkingCloud open = work;
    const bool through = open.on_boundary(edge->to);
    const double gap = rules.gap * work.size_between(edge->from, edge->to);
    const std::vector<std::array<std::int32_t, 2>> doubled =
        open.open_edge(edge->from, edge->to, rules.piece, gap);
    open.refresh_facets();
    Structure after;
    try {
      after = build_structure(open.cloud());
    } catch (const GeometryError&) { break; }
    for (const auto& [old, made] : doubled) {
      const double mine = after.cells.volume[u(old)], other = after.cells.volume[u(made)];
      open.move_now(old, made, other / (mine + other));
      measure.push_back(measure[u(old)]);
    }
    report.area_change += area_of(open.cloud()) - area_of(work.cloud());
    work = std::move(open);
    structure = std::move(after);
    ++report.opened;
    report.separated += through;
  }
  Resampling<2> change = work.finish();
  change.old_position = cloud.position;
  return change;
}

} // namespace cnem::adapt
