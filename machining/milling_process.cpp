#include "machining/milling_process.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace cnem::machining {

MillingProcess::MillingProcess(MillingCut cut, std::vector<Mode> modes, const ProcessSettings& settings)
    : cut_(std::move(cut)), modes_(std::move(modes)), settings_(settings),
      dt_(full_turn / settings.spindle / settings.steps),
      feed_speed_(cut_.feed * static_cast<double>(cut_.cutter.teeth()) * settings.spindle / full_turn),
      edges_(cut_, settings.axial_depth, settings.layers, full_turn / settings.steps) {
  using enum ProcessSettings::Start;
  const Cutter& cutter = cut_.cutter;
  const double r = cutter.radius(), beyond = cutter.run_out + 0.25 * r;
  const double depth = cut_.engagement.radial_depth;
  const bool up = cut_.engagement.side == Engagement::Side::up, slot = depth >= cutter.diameter;
  start_ = settings.start == outside ? -r - beyond : 0.0;
  // Matter on the side where the teeth cut: its free surface is `depth` inside of where they reach.
  const Vec2 low(settings.start == outside ? 0.0
                 : settings.start == hole  ? -r - beyond
                                           : -0.25 * r,
                 slot || !up ? -r - beyond : r - depth);
  const Vec2 high(start_ + settings.length + r + beyond, slot || up ? r + beyond : depth - r);
  // Cells of about a degree of the cutter are the fastest, measured; what is taken does not depend on them.
  constexpr double degrees = 60.0;
  const DexelLayer whole(low, high, Vec2::Constant(std::max(settings.pitch, r / degrees)));
  block_ = whole.area() * settings.axial_depth;
  for (std::size_t k = 0; k < edges_.layers();
       ++k) { // what earlier turns have left: the disc, and its way there
    const double radius = edges_.radius(k);
    if (k > 0 && radius == edges_.radius(k - 1)) {
      layer_.push_back(layer_.back());
      continue;
    }
    layer_.push_back(whole);
    if (settings.start == hole) layer_[k].erase_disc(Vec2::Zero(), radius);
    if (settings.start != inside) continue;
    layer_[k].erase_disc(Vec2(-feed_of_turn(), 0.0), radius);
    layer_[k].erase_box(Vec2(low.x(), -radius), Vec2(-feed_of_turn(), radius));
  }
  for (const Mode& mode : modes_) {
    free_.emplace_back(mode, dt_);
    loss_.push_back(damping_loss(mode, dt_));
  }
  state_ = Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(modes_.size()));
  bite_.resize(edges_.layers() * edges_.teeth());
  way_.resize(bite_.size());
  shape_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(layer_.size()), state_.cols());
  shift_.assign(layer_.size(), Vec3::Zero());
  force_ = shift_;
}

double MillingProcess::axis_at(double turns) const {
  return start_ + std::min(feed_of_turn() * turns, settings_.length);
}

bool MillingProcess::at_end() const { return time() >= duration(); }

double MillingProcess::volume() const {
  double sum = 0.0;
  for (const DexelLayer& layer : layer_) sum += layer.area();
  return sum * edges_.thickness();
}

void MillingProcess::take_shapes() {
  const double x = axis_at((static_cast<double>(step_) + 0.5) / settings_.steps);
  for (std::size_t i = 0; i < modes_.size(); ++i)
    for (std::size_t k = 0; k < layer_.size(); ++k)
      shape_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = modes_[i].shape(x, height(k));
}

MillingProcess::PerLayer MillingProcess::shift_of(const Eigen::MatrixXd& state) const {
  PerLayer shift(layer_.size(), Vec3::Zero());
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Vec3 moved = state(0, column) * modes_[i].participation();
    for (std::size_t k = 0; k < layer_.size(); ++k)
      shift[k] += shape_(static_cast<Eigen::Index>(k), column) * moved;
  }
  return shift;
}

CutterPlace MillingProcess::place(std::int64_t step) const {
  const double turns = static_cast<double>(step) / settings_.steps;
  return {Vec3(axis_at(turns), 0.0, 0.0), full_turn * turns};
}

namespace {

double largest(const std::vector<Vec3>& shift) {
  double most = 0.0;
  for (const Vec3& s : shift) most = std::max(most, s.norm());
  return most;
}

} // namespace

double MillingProcess::reach(const PerLayer& shift) const {
  // Each tooth has been everywhere within a turn: what is left lies no deeper than the cutter has moved
  // since.
  constexpr double beyond = 1.25;
  return beyond * (feed_of_turn() + 2.0 * cut_.cutter.run_out + 2.0 * std::max(farthest_, largest(shift)));
}

template<class TakeBite>
EdgeLoad MillingProcess::bear(const PerLayer& shift, PerLayer& force, TakeBite&& bite) {
  const CutterPlace from = place(step_), to = place(step_ + 1);
  const auto shifted = [](CutterPlace place, const Vec3& by) {
    place.axis += by;
    return place;
  };
  const double deep = reach(shift);
  const double forward = 1.5 * feed_speed_ / settings_.spindle; // nearer to the axis rakes go backwards
#pragma omp parallel for schedule(static) if (bite_.size() >= 256)
  for (std::size_t k = 0; k < layer_.size(); ++k) {
    const double r = edges_.radius(k), depth = std::min(deep, std::max(r - forward, 0.5 * r));
    const CutterPlace first = shifted(from, shift_[k]), last = shifted(to, shift[k]);
    for (std::size_t j = 0; j < edges_.teeth(); ++j) {
      const Sweep sweep{edges_.rake(k, j, first, depth), edges_.rake(k, j, last, depth)};
      const Vec2 way = sweep.to.edge - sweep.from.edge;
      way_[k * edges_.teeth() + j] = {way.x(), way.y(), last.axis.z() - first.axis.z()};
      bite_[k * edges_.teeth() + j] = bite(k, sweep);
    }
  }
  EdgeLoad load;
  for (std::size_t k = 0, i = 0; k < layer_.size(); ++k) {
    const Vec3 below = load.force;
    for (std::size_t j = 0; j < edges_.teeth(); ++j, ++i)
      edges_.add(load, k, j, bite_[i], way_[i], dt_, from, to);
    force[k] = load.force - below;
  }
  return load;
}

double MillingProcess::rest_of(std::size_t mode, const PerLayer& force) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < layer_.size(); ++k)
    sum += shape_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(mode)) * force[k];
  return modes_[mode].participation().dot(sum) / modes_[mode].stiffness;
}

Eigen::MatrixXd MillingProcess::moved(const PerLayer& force) const {
  Eigen::MatrixXd state = state_;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Vec2 rest(rest_of(i, force), 0.0);
    state.col(column) = rest + free_[i].of_state * (state_.col(column) - rest);
  }
  return state;
}

void MillingProcess::book(const EdgeLoad& load, const Eigen::MatrixXd& state, const PerLayer& shift) {
  const CutterPlace from = place(step_), to = place(step_ + 1);
  double of_shift = 0.0, of_modes = 0.0; // J, of the forces
  for (std::size_t k = 0; k < layer_.size(); ++k) of_shift += force_[k].dot(shift[k] - shift_[k]);
  ledger_.kinetic = ledger_.elastic = 0.0;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double stiffness = modes_[i].stiffness;
    const double rest = rest_of(i, force_);
    const Vec2 begin = state_.col(column) - Vec2(rest, 0.0);
    of_modes += stiffness * rest * (state(0, column) - state_(0, column));
    ledger_.damping += begin.dot(loss_[i] * begin);
    ledger_.elastic += 0.5 * stiffness * state(0, column) * state(0, column);
    ledger_.kinetic += 0.5 * stiffness * state(1, column) * state(1, column);
  }
  ledger_.cutting += load.work;
  ledger_.spindle += load.torque * (to.angle - from.angle);
  // A cutter that is fed along a mode whose shape changes there goes with that shape: the feed does that.
  ledger_.feed -= load.force.dot(to.axis - from.axis) + of_shift - of_modes;
}

ProcessStep MillingProcess::advance() {
  take_shapes();
  PerLayer shift = shift_of(moved(force_));
  // Where an edge only just touches its force comes and goes from one question to the next: what that moves
  // is told from a failure by its size.
  constexpr int enough = 5, most = 30;
  constexpr double close = 1e-12; // m
  const double touch = 1e-6 * cut_.feed;
  for (int iteration = 0; !modes_.empty(); ++iteration) {
    bear(shift, force_, [&](std::size_t k, const Sweep& sweep) { return layer_[k].ask(sweep); });
    PerLayer next = shift_of(moved(force_));
    double change = 0.0;
    for (std::size_t k = 0; k < layer_.size(); ++k) change = std::max(change, (next[k] - shift[k]).norm());
    shift = std::move(next);
    if (change < close || (iteration >= enough && change < touch)) break;
    if (iteration >= most)
      throw DivergenceError(
          fmt::format(
              "at {:.6g} s forces and vibration of a step do not agree: the shift of the cutter still "
              "changes by {:.3g} m, expected smaller steps (dexels.steps)",
              time(), change),
          -1, "displacement");
  }
  ProcessStep step;
  static_cast<EdgeLoad&>(step) =
      bear(shift, force_, [&](std::size_t k, const Sweep& sweep) { return layer_[k].erase(sweep); });
  step.time = time() + 0.5 * dt_;
  step.angle = settings_.spindle * step.time;
  Eigen::MatrixXd state = moved(force_);
  book(step, state, shift);
  state_ = std::move(state);
  farthest_ = std::max(farthest_, largest(shift));
  for (const Vec3& s : shift)
    if (s.squaredNorm() > step.displacement.squaredNorm()) step.displacement = s;
  shift_ = std::move(shift);
  ++step_;
  return step;
}

void MillingProcess::archive(Archive& archive) {
  archive.integer("milling/step", step_);
  std::vector<double> modes(state_.data(), state_.data() + state_.size());
  archive.list("milling/modes", "m", modes);
  if (modes.size() != static_cast<std::size_t>(state_.size()))
    throw IoError("milling/modes holds no modes of this case");
  std::copy(modes.begin(), modes.end(), state_.data());
  for (const auto& [name, unit, list] :
       {std::tuple{"milling/shift", "m", &shift_}, {"milling/force", "N", &force_}}) {
    std::vector<double> numbers(list->front().data(), list->front().data() + 3 * list->size());
    archive.list(name, unit, numbers);
    if (numbers.size() != 3 * list->size())
      throw IoError(fmt::format("{} is not of this case's layers", name));
    std::copy(numbers.begin(), numbers.end(), list->front().data());
  }
  archive.number("milling/farthest", "m", farthest_);
  ledger_.archive(archive);
  for (std::size_t k = 0; k < layer_.size(); ++k)
    layer_[k].archive(archive, fmt::format("milling/layer/{}/", k));
}

std::optional<double> MillingProcess::left_at(std::size_t layer, double x) const {
  const std::vector<Interval> matter = layer_[layer].matter(1, x);
  if (matter.empty()) return std::nullopt;
  const bool up = cut_.engagement.side == Engagement::Side::up;
  return up ? edges_.radius(layer) - matter.back().low : matter.front().high + edges_.radius(layer);
}

} // namespace cnem::machining
