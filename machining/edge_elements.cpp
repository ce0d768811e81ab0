#include "machining/edge_elements.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cnem::machining {

EdgeElements::EdgeElements(const MillingCut& cut, std::span<const Slice> slices, double tip, double step)
    : cut_(cut), chord_(std::sqrt(step / std::sin(step))) {
  assert(!slices.empty() && step > 0.0 && step < 1.0);
  constexpr double rounding = 1e-6; // of the thickness
  for (const Slice& slice : slices) {
    double low = slice.low - tip;
    if (std::abs(low) < rounding * slice.thickness) low = 0.0;
    const double high = low + slice.thickness;
    const double begin = cut.cutter.edge ? std::max(0.0, cut.cutter.edge->bottom()) : 0.0;
    if (slice.middle() < tip + begin) {
      ++lowest_;
      ++end_;
      layer_.emplace_back();
      continue;
    }
    assert(low >= 0.0);
    if (slice.middle() - tip > cut.cutter.top()) {
      layer_.emplace_back();
      continue;
    }
    ++end_;
    layer_.push_back({.low = low,
                      .thickness = slice.thickness,
                      .radius = cut.cutter.mean_radius(low, high),
                      .lag = cut.cutter.mean_lag(low, high),
                      .width = cut.cutter.profile(low, high),
                      .lead = cut.cutter.lead(low, high)});
  }
  if (const CuttingEdge* edge = cut.cutter.edge.get())
    for (const Layer& layer : layer_) {
      const CuttingEdge::Angles angles = edge->angles(layer.low, layer.low + layer.thickness);
      law_.push_back(cut.law);
      law_.back().incline(angles.inclination);
      law_.back().take_rake(angles.rake);
    }
  for (std::size_t j = 0; j < cut.cutter.teeth(); ++j) teeth_.push_back(cut.cutter.behind(j));
}

Vec2 EdgeElements::arm(std::size_t layer, std::size_t tooth, const CutterPlace& place) const {
  const Cutter& cutter = cut_.cutter;
  const Layer& at = layer_[layer];
  const double low = at.low - place.axis.z();
  const double radius = chord_ * (cutter.rounded() ? cutter.mean_radius(low, low + at.thickness) : at.radius);
  return radius * outward(phi(layer, tooth, place.angle)).head<2>();
}

Rake EdgeElements::rake(std::size_t layer, std::size_t tooth, const CutterPlace& place, double reach) const {
  const Cutter& cutter = cut_.cutter;
  Vec2 axis = place.axis.head<2>();
  if (cutter.run_out > 0.0) axis += cutter.run_out * outward(place.angle + cutter.run_out_angle).head<2>();
  const Vec2 edge = arm(layer, tooth, place);
  return {axis + edge, axis + std::max(0.0, 1.0 - reach / edge.norm()) * edge};
}

Vec3 EdgeElements::bear(EdgeLoad& load, std::size_t layer, std::size_t tooth, double turned,
                        const Vec3& local) const {
  const Vec3 force = on_tool(phi(layer, tooth, turned), layer_[layer].lead, local);
  load.force += force;
  load.torque += local[0] * layer_[layer].radius;
  if (const Cutter& cutter = cut_.cutter; cutter.run_out > 0.0) { // round the axis of the spindle
    const double out = turned + cutter.run_out_angle;
    load.torque -= cutter.run_out * (force.x() * std::cos(out) - force.y() * std::sin(out));
  }
  return force;
}

double EdgeElements::bears(double thickness, double speed) const {
  double sum = 0.0;
  for (std::size_t k = lowest_; k < end_; ++k)
    sum += layer_[k].width *
           (law_.empty() ? cut_.law : law_[k]).at({.thickness = thickness, .speed = speed}).force.norm();
  return sum;
}

void EdgeElements::add(EdgeLoad& load, std::size_t layer, std::size_t tooth, const Bite& bite,
                       const Vec3& way, double duration, const CutterPlace& from,
                       const CutterPlace& to) const {
  const double share = bite.share();
  if (!(bite.area > 0.0) || !(share > 0.0)) return;
  const double path = way.head<2>().norm();
  const Layer& at = layer_[layer];
  // Over the part of its way on which the edge cuts. The chip is as thick, from the edge inwards, as makes
  // the area: its middle goes a shorter way round the axis than its edge, h (1 − h/2r) = a.
  const double a = bite.area / (path * share);
  const double of_edge =
      0.5 * (1.0 + std::sqrt(std::max(0.0, 1.0 - 2.0 * a / at.radius))); // a/h, way of the middle
  const double inward = a / of_edge;
  const double chip = inward * at.thickness / at.width;
  const double middle = 0.5 * (bite.begin + bite.end);
  const double turned = from.angle + middle * (to.angle - from.angle);
  const CuttingLaw& law = law_.empty() ? cut_.law : law_[layer];
  const Vec3 local = at.width * share * law.at({.thickness = chip, .speed = path / duration}).force;
  load.work -= bear(load, layer, tooth, turned, local).dot(way);
  load.power += local[0] * path * of_edge / duration;
  load.removed += bite.area * at.thickness;
  load.thickest = std::max(load.thickest, chip);
}

void EdgeElements::plough(EdgeLoad& load, std::size_t layer, std::size_t tooth, double pressed,
                          const Vec3& way, double duration, const CutterPlace& from,
                          const CutterPlace& to) const {
  if (!(pressed > 0.0)) return;
  // Across the profile the land is pressed in by less and is as much longer: the volume is that of the layer.
  const double normal = cut_.flank.specific_force * pressed * layer_[layer].thickness,
               rub = cut_.flank.friction * normal;
  load.ploughed -= bear(load, layer, tooth, 0.5 * (from.angle + to.angle), Vec3(rub, normal, 0.0)).dot(way);
  load.power += rub * way.head<2>().norm() / duration;
}

} // namespace cnem::machining
