// What a cutter finds at first, and what it leaves.
#include "core/error.hpp"
#include "machining/layer_grading.hpp"
#include "machining/milling_process.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace cnem::machining {

namespace {

/// How far beyond the cutter matter is looked at, m.
double beyond(const Cutter& cutter) { return cutter.run_out + 0.25 * cutter.radius(); }

/// m, x of the axis at first, of a cut without passes.
double start_of(const Cutter& cutter, ProcessSettings::Start start) {
  return start == ProcessSettings::Start::outside ? -cutter.radius() - beyond(cutter) : 0.0;
}

} // namespace

Workpiece workpiece_of(const MillingCut& cut, const ProcessSettings& settings) {
  using enum ProcessSettings::Start;
  if (settings.blank)
    return {{settings.blank->low.x(), settings.blank->low.y(), 0.0},
            {settings.blank->high.x(), settings.blank->high.y(), settings.blank->height}};
  const Cutter& cutter = cut.cutter;
  const double r = cutter.radius(), beside = beyond(cutter), depth = cut.engagement.radial_depth;
  const bool up = cut.engagement.side == Engagement::Side::up, slot = depth >= cutter.diameter;
  // Matter on the side where the teeth cut: its free surface is `depth` inside of where they reach.
  return {{settings.start == outside ? 0.0
           : settings.start == hole  ? -r - beside
                                     : -0.25 * r,
           slot || !up ? -r - beside : r - depth, 0.0},
          {start_of(cutter, settings.start) + settings.length + r + beside,
           slot || up ? r + beside : depth - r, settings.axial_depth}};
}

std::vector<Slice> slices_of(const MillingCut& cut, const ProcessSettings& settings) {
  assert(!settings.blank || settings.blank->height > 0.0);
  const double height = settings.blank ? settings.blank->height : settings.axial_depth;
  std::vector<double> between;
  for (const ToolPath& pass : settings.passes) between.push_back(pass.tip());
  if (between.empty()) between.push_back(0.0);
  double most = settings.axial_depth / settings.layers;
  if (cut.cutter.rounded()) {
    const LayerGrading grading(cut, settings.axial_depth, settings.steps);
    const std::vector<double> ends = grading.ends(settings.layers);
    most = grading.thickest(settings.layers);
    // Where passes overlap an end of one stands for that of another.
    constexpr double near = 1.0 / 3.0; // of a layer
    std::set<double> taken(between.begin(), between.end());
    const std::vector<double> tips(taken.begin(), taken.end());
    for (std::size_t k = 1; k < ends.size(); ++k) {
      const double thickness = ends[k] - ends[k - 1];
      for (const double tip : tips) {
        const double z = tip + ends[k];
        const auto above = taken.lower_bound(z - near * thickness);
        if (z < height && (above == taken.end() || *above > z + near * thickness)) taken.insert(z);
      }
    }
    between.assign(taken.begin(), taken.end());
  }
  if (settings.blank && settings.blank->left) return divided(settings.blank->left->slices, most, between);
  return slices(height, most, between);
}

ToolMotion motion_of(const MillingCut& cut, const ProcessSettings& settings) {
  const double feed_speed = cut.feed * static_cast<double>(cut.cutter.teeth()) * settings.spindle / full_turn;
  if (!settings.passes.empty())
    return {settings.spindle, feed_speed,     settings.steps,    settings.passes,
            settings.dwell,   settings.drive, cut.cutter.teeth()};
  const double start = start_of(cut.cutter, settings.start);
  if (settings.drive)
    return {settings.spindle, feed_speed,     settings.steps,  start,
            settings.length,  settings.dwell, *settings.drive, cut.cutter.teeth()};
  return {settings.spindle, feed_speed, settings.steps, start, settings.length, settings.dwell};
}

Vec2 MillingProcess::cells() const {
  // Cells of about a degree of the cutter are the fastest, measured; what is taken does not depend on them.
  constexpr double degrees = 60.0;
  return Vec2::Constant(std::max(settings_.pitch, cut_.cutter.radius() / degrees));
}

DexelLayer MillingProcess::stock(std::size_t layer) const {
  assert(settings_.blank);
  const Blank& blank = *settings_.blank;
  if (blank.left) {
    DexelLayer none(blank.low, blank.high, cells());
    none.erase_box(blank.low, blank.high);
    return none;
  }
  if (blank.surface.triangles.empty()) return {blank.low, blank.high, cells()};
  return {blank.low, blank.high, cells(), section_pieces(blank.surface, height(layer))};
}

void MillingProcess::take_blank() {
  using enum ProcessSettings::Start;
  if (settings_.blank) {
    if (const auto& left = settings_.blank->left) {
      first_ = left->turned * settings_.steps / left->steps_of_turn;
      std::size_t of = 0;
      for (const Slice& slice : slice_) {
        while (of + 1 < left->slices.size() && left->slices[of + 1].low < slice.middle()) ++of;
        layer_.push_back(left->layers[of]);
      }
    } else {
      for (std::size_t k = 0; k < slice_.size(); ++k) layer_.push_back(stock(k));
    }
    block_ = volume();
    return;
  }
  const Workpiece block = workpiece();
  const Vec2 low = block.low.head<2>(), high = block.high.head<2>();
  const DexelLayer whole(low, high, cells());
  block_ = whole.area() * settings_.axial_depth;
  for (std::size_t k = 0; k < slice_.size();
       ++k) { // what earlier turns have left: the disc, and its way there
    const double radius = edges().radius(k);
    if (k > 0 && radius == edges().radius(k - 1)) {
      layer_.push_back(layer_.back());
      continue;
    }
    layer_.push_back(whole);
    if (settings_.start == hole) layer_[k].erase_disc(Vec2::Zero(), radius);
    if (settings_.start != inside) continue;
    layer_[k].erase_disc(Vec2(-feed_of_turn(), 0.0), radius);
    layer_[k].erase_box(Vec2(low.x(), -radius), Vec2(-feed_of_turn(), radius));
  }
}

void MillingProcess::begin_pass(std::size_t pass) {
  const EdgeElements& edges = edges_[pass];
  const Vec2 at = way_at(static_cast<double>(step_)).at;
  for (std::size_t k = 0; k < layer_.size(); ++k) {
    if (!edges.reaches(k)) continue;
    const double radius = edges.radius(k);
    if (settings_.start == ProcessSettings::Start::hole) {
      layer_[k].erase_disc(at, radius);
      continue;
    }
    DexelLayer without = layer_[k];
    const double there = without.erase_disc(at, radius);
    constexpr double touches = 1e-6; // of the area of the cutter
    if (there > touches * radius * radius)
      throw DivergenceError(
          fmt::format("pass {} begins in matter: {:.4g} mm² of it lie within the cutter at ({:.6g}, {:.6g}) "
                      "mm, {:.4g} "
                      "mm over its tip, expected a start beside the workpiece, or milling.start = \"hole\"",
                      pass + 1, 1e6 * there, 1e3 * at.x(), 1e3 * at.y(), 1e3 * edges.over_tip(k)),
          -1, "displacement");
  }
  ++passes_begun_;
  // On its way there, in the air, what vibrates comes to rest.
  ledger_.damping += ledger_.kinetic + ledger_.elastic;
  ledger_.kinetic = ledger_.elastic = 0.0;
  state_.setZero();
  shift_.assign(layer_.size(), Vec3::Zero());
  force_ = shift_;
  farthest_ = 0.0; // of this pass: what those before have left is met feed by feed
  take_flanks();
  if (part_) part_->rest();
}

LeftWorkpiece MillingProcess::left() const {
  return {slice_, layer_, first_ + static_cast<double>(step_), settings_.steps};
}

double MillingProcess::volume() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < layer_.size(); ++k) sum += layer_[k].area() * slice_[k].thickness;
  return sum;
}

std::optional<double> MillingProcess::left_at(std::size_t layer, double x) const {
  const std::vector<Interval> matter = layer_[layer].matter(1, x);
  if (matter.empty()) return std::nullopt;
  const bool up = cut_.engagement.side == Engagement::Side::up;
  return up ? edges().radius(layer) - matter.back().low : matter.front().high + edges().radius(layer);
}

std::optional<double> MillingProcess::left_beside(std::size_t layer, double way,
                                                  const DexelLayer& stock) const {
  assert(motion_.last_path());
  const auto place = motion_.last_path()->at(way);
  const double r = edges().radius(layer);
  const auto beside = [&](const DexelLayer& of) {
    return of.matter(place.at, machined_side(place.along), cut_.cutter.radius() + beyond(cut_.cutter));
  };
  const std::vector<Interval> matter = beside(layer_[layer]);
  const auto side = std::min_element(matter.begin(), matter.end(), [r](const Interval& a, const Interval& b) {
    return std::abs(a.low - r) < std::abs(b.low - r);
  });
  if (side == matter.end()) return std::nullopt;
  constexpr double taken = 1e-9;               // m
  for (const Interval& before : beside(stock)) // it may be a thin wall: others lie behind
    if (std::abs(before.low - side->low) <= taken) return std::nullopt;
  return r - side->low;
}

} // namespace cnem::machining
