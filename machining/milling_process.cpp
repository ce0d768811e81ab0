#include "machining/milling_process.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::machining {

namespace {

/// What the cutter's axis keeps from the ends of the block, m.
double margin(const Cutter& cutter) { return 0.25 * cutter.radius(); }

} // namespace

MillingProcess::MillingProcess(MillingCut cut, std::vector<Mode> modes, const ProcessSettings& settings)
    : cut_(std::move(cut)), modes_(std::move(modes)), settings_(settings),
      dt_(full_turn / settings.spindle / settings.steps),
      feed_speed_(cut_.feed * static_cast<double>(cut_.cutter.teeth()) * settings.spindle / full_turn) {
  const double r = cut_.cutter.radius(), edge = margin(cut_.cutter), depth = cut_.engagement.radial_depth;
  const double r_cut = r + cut_.cutter.run_out;
  const bool up = cut_.engagement.side == Engagement::Side::up;
  // Matter on the side where the teeth cut: its free surface is `depth` inside of where they reach. Both fall
  // between lines along x, which else would see another depth; beyond them there are whole lines.
  const double lines = std::ceil(depth / settings.pitch - 1e-9), across = depth / lines;
  const double beyond = across * std::ceil((cut_.cutter.run_out + edge) / across);
  Vec2 low, high;
  start_ = settings.from_outside ? -r_cut - edge : 0.0;
  low.x() = settings.from_outside ? 0.0 : -edge;
  high.x() = start_ + settings.length + r_cut + edge;
  const bool slot = depth >= cut_.cutter.diameter;
  low.y() = slot || !up ? -r - beyond : r - depth;
  high.y() = slot || up ? r + beyond : depth - r;
  layer_.assign(index_of(settings.layers), DexelLayer(low, high, Vec2(settings.pitch, across)));
  state_ = Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(modes_.size()));
  chips_.assign(layer_.size() * cut_.cutter.teeth(), 0.0);
  strip_ = r;
  if (!settings.from_outside) { // what earlier turns have left: the disc, and its way there
    for (DexelLayer& layer : layer_) {
      layer.erase_disc(Vec2(-feed_of_turn(), 0.0), r);
      layer.erase_box(Vec2(low.x(), -r), Vec2(-feed_of_turn(), r));
    }
  }
}

bool MillingProcess::at_end() const { return axis() - start_ >= settings_.length; }

double MillingProcess::height(std::size_t layer) const {
  return (static_cast<double>(layer) + 0.5) * settings_.axial_depth / settings_.layers;
}

double MillingProcess::volume() const {
  double sum = 0.0;
  for (const DexelLayer& layer : layer_) sum += layer.area(1); // lines along y see the depth as it is
  return sum * settings_.axial_depth / settings_.layers;
}

Vec2 MillingProcess::shift_of(const Eigen::MatrixXd& state) const {
  Vec2 shift = Vec2::Zero();
  for (std::size_t i = 0; i < modes_.size(); ++i)
    shift += state(0, static_cast<Eigen::Index>(i)) * modes_[i].participation().head<2>();
  return shift;
}

DexelLayer::Sweep MillingProcess::sweep(std::size_t tooth, std::size_t layer, const Vec2& shift) const {
  const Cutter& cutter = cut_.cutter;
  const double r = cutter.radius_of(tooth), lag = cutter.behind(tooth) + cutter.lag(height(layer));
  const auto edge = [&](double when, const Vec2& moved) {
    const Vec2 centre = Vec2(start_ + feed_speed_ * when, 0.0) + moved;
    return Vec2(centre + r * outward(settings_.spindle * when - lag).head<2>());
  };
  const Vec2 normal = outward(settings_.spindle * (time() + 0.5 * dt_) - lag).head<2>();
  // A line goes through the cutter to the other side of it, half of which belongs to the edge over there.
  const Vec2 reach = (r * normal.cwiseAbs()).cwiseMin(strip_);
  return {edge(time(), shift_), edge(time() + dt_, shift), normal, reach, r};
}

ProcessStep MillingProcess::ask(const Vec2& shift, std::vector<double>& chips) const {
  ProcessStep step;
  step.time = time() + 0.5 * dt_;
  step.angle = settings_.spindle * step.time;
  const Cutter& cutter = cut_.cutter;
  const double thickness = settings_.axial_depth / settings_.layers;
  for (std::size_t k = 0; k < layer_.size(); ++k)
    for (std::size_t j = 0; j < cutter.teeth(); ++j) {
      const DexelLayer::Sweep edge = sweep(j, k, shift);
      const double phi = step.angle - cutter.behind(j) - cutter.lag(height(k)),
                   path = (edge.b - edge.a).norm();
      // A step that is shorter than the distance of lines goes on with the chip of the last one.
      double& chip = chips[k * cutter.teeth() + j];
      chip = layer_[k].chip(edge).value_or(chip);
      if (!(chip > 0.0)) continue;
      const Vec3 local = thickness * cut_.law.at({.thickness = chip, .speed = path / dt_}).force;
      step.force += on_tool(phi, local);
      step.torque += local[0] * cutter.radius_of(j);
      step.power += local[0] * path / dt_;
      step.removed += chip * path * thickness;
      step.thickest = std::max(step.thickest, chip);
    }
  return step;
}

void MillingProcess::erase(const Vec2& shift) {
  for (std::size_t k = 0; k < layer_.size(); ++k)
    for (std::size_t j = 0; j < cut_.cutter.teeth(); ++j) layer_[k].erase(sweep(j, k, shift));
}

ProcessStep MillingProcess::advance() {
  // Modes are integrated exactly under the mean force of the step.
  const auto moved = [&](const Vec3& force) {
    Eigen::MatrixXd state = state_;
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const FreeMotion free(modes_[i], dt_);
      const Vec2 rest(modes_[i].participation().dot(force) / modes_[i].stiffness, 0.0);
      state.col(column) = rest + free.of_state * (state_.col(column) - rest);
    }
    return state;
  };
  Eigen::MatrixXd state = moved(force_);
  Vec2 shift = shift_of(state);
  std::vector<double> chips = chips_;
  ProcessStep step = ask(shift, chips);
  constexpr int most = 20;
  constexpr double close = 1e-12; // m
  for (int iteration = 0; iteration < most && !modes_.empty(); ++iteration) {
    const Vec2 next = shift_of(moved(step.force));
    const double change = (next - shift).norm();
    shift = next;
    chips = chips_;
    step = ask(shift, chips);
    if (change < close) break;
  }
  erase(shift);
  chips_ = std::move(chips);
  force_ = step.force;
  state_ = moved(step.force);
  shift_ = shift;
  for (std::size_t i = 0; i < modes_.size(); ++i)
    step.displacement += state_(0, static_cast<Eigen::Index>(i)) * modes_[i].participation();
  ++step_;
  // Once the cutter has turned round in its place, matter comes from ahead of the last cut alone.
  constexpr double turns = 4.0;
  if (step_ == settings_.steps)
    strip_ = std::min(strip_, turns * feed_of_turn() + 4.0 * settings_.pitch + cut_.cutter.run_out);
  return step;
}

double MillingProcess::left_at(std::size_t layer, double x) const {
  const DexelLayer& matter = layer_[layer];
  const double first = matter.place(1, 0), pitch = matter.place(1, 1) - first;
  const auto line = static_cast<std::size_t>(
      std::clamp(std::round((x - first) / pitch), 0.0, static_cast<double>(matter.lines(1)) - 1.0));
  const auto pieces = matter.matter(1, line);
  const bool up = cut_.engagement.side == Engagement::Side::up;
  return up ? cut_.cutter.radius() - pieces.back().low : pieces.front().high + cut_.cutter.radius();
}

} // namespace cnem::machining
