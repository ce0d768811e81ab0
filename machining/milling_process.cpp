#include "machining/milling_process.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace cnem::machining {

namespace {

/// How far beyond the cutter matter is looked at, m.
double beyond(const Cutter& cutter) { return cutter.run_out + 0.25 * cutter.radius(); }

ToolMotion motion_of(const MillingCut& cut, const ProcessSettings& settings) {
  const double feed_speed = cut.feed * static_cast<double>(cut.cutter.teeth()) * settings.spindle / full_turn;
  if (!settings.passes.empty())
    return {settings.spindle, feed_speed,     settings.steps,    settings.passes,
            settings.dwell,   settings.drive, cut.cutter.teeth()};
  const double start =
      settings.start == ProcessSettings::Start::outside ? -cut.cutter.radius() - beyond(cut.cutter) : 0.0;
  if (settings.drive)
    return {settings.spindle, feed_speed,     settings.steps,  start,
            settings.length,  settings.dwell, *settings.drive, cut.cutter.teeth()};
  return {settings.spindle, feed_speed, settings.steps, start, settings.length, settings.dwell};
}

} // namespace

MillingProcess::MillingProcess(MillingCut cut, std::vector<Mode> modes, const ProcessSettings& settings)
    : cut_(std::move(cut)), modes_(std::move(modes)), settings_(settings), motion_(motion_of(cut_, settings)),
      dt_(motion_.dt(0)),
      feed_speed_(cut_.feed * static_cast<double>(cut_.cutter.teeth()) * settings.spindle / full_turn),
      edges_(cut_, settings.axial_depth, settings.layers, full_turn / settings.steps) {
  assert(settings.passes.empty() == !settings.blank);
  take_blank();
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

void MillingProcess::take_blank() {
  using enum ProcessSettings::Start;
  const Cutter& cutter = cut_.cutter;
  const double r = cutter.radius(), beside = beyond(cutter);
  const double depth = cut_.engagement.radial_depth;
  // Cells of about a degree of the cutter are the fastest, measured; what is taken does not depend on them.
  constexpr double degrees = 60.0;
  const Vec2 pitch = Vec2::Constant(std::max(settings_.pitch, r / degrees));
  if (settings_.blank) {
    const Blank& blank = *settings_.blank;
    for (std::size_t k = 0; k < edges_.layers(); ++k) {
      if (blank.surface.triangles.empty())
        layer_.push_back(k > 0 ? layer_.back() : DexelLayer(blank.low, blank.high, pitch));
      else
        layer_.emplace_back(blank.low, blank.high, pitch, section_pieces(blank.surface, height(k)));
    }
    block_ = volume();
    return;
  }
  const bool up = cut_.engagement.side == Engagement::Side::up, slot = depth >= cutter.diameter;
  // Matter on the side where the teeth cut: its free surface is `depth` inside of where they reach.
  const Vec2 low(settings_.start == outside ? 0.0
                 : settings_.start == hole  ? -r - beside
                                            : -0.25 * r,
                 slot || !up ? -r - beside : r - depth);
  const Vec2 high(motion_.start() + settings_.length + r + beside, slot || up ? r + beside : depth - r);
  const DexelLayer whole(low, high, pitch);
  block_ = whole.area() * settings_.axial_depth;
  for (std::size_t k = 0; k < edges_.layers();
       ++k) { // what earlier turns have left: the disc, and its way there
    const double radius = edges_.radius(k);
    if (k > 0 && radius == edges_.radius(k - 1)) {
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

Vec2 MillingProcess::axis_at(double at) const { return motion_.axis(motion_.pass_of(step_), at); }

bool MillingProcess::at_end() const { return motion_.at_end(step_); }

void MillingProcess::begin_step() {
  if (const double dt = motion_.dt(step_); dt != dt_) {
    dt_ = dt;
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      free_[i] = FreeMotion(modes_[i], dt_);
      loss_[i] = damping_loss(modes_[i], dt_);
    }
  }
  if (settings_.passes.empty()) return;
  const std::size_t pass = motion_.pass_of(step_);
  if (motion_.passes()[pass].begin == step_) begin_pass(pass);
}

void MillingProcess::begin_pass(std::size_t pass) {
  // On its way there, in the air, what vibrates comes to rest.
  ledger_.damping += ledger_.kinetic + ledger_.elastic;
  state_.setZero();
  shift_.assign(layer_.size(), Vec3::Zero());
  force_ = shift_;
  const Vec2 at = axis_at(static_cast<double>(step_));
  for (std::size_t k = 0; k < layer_.size(); ++k) {
    const double radius = edges_.radius(k);
    DexelLayer without = layer_[k];
    const double there = without.erase_disc(at, radius);
    constexpr double touches = 1e-6; // of the area of the cutter
    if (settings_.start == ProcessSettings::Start::hole)
      layer_[k] = std::move(without);
    else if (there > touches * radius * radius)
      throw DivergenceError(
          fmt::format("pass {} begins in matter: {:.4g} mm² of it lie within the cutter at ({:.6g}, {:.6g}) "
                      "mm, {:.4g} "
                      "mm over the tip, expected a start beside the workpiece, or milling.start = \"hole\"",
                      pass + 1, 1e6 * there, 1e3 * at.x(), 1e3 * at.y(), 1e3 * height(k)),
          -1, "displacement");
  }
}

double MillingProcess::volume() const {
  double sum = 0.0;
  for (const DexelLayer& layer : layer_) sum += layer.area();
  return sum * edges_.thickness();
}

void MillingProcess::take_shapes() {
  const double x = axis_at(static_cast<double>(step_) + 0.5).x();
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
  const double at = static_cast<double>(step);
  const Vec2 axis = axis_at(at);
  return {Vec3(axis.x(), axis.y(), 0.0), full_turn * (at / settings_.steps)};
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
  begin_step();
  take_shapes();
  PerLayer shift = shift_of(moved(force_));
  // Where an edge only just touches its force comes and goes from one question to the next: what that moves
  // is told from a failure by its size.
  constexpr int enough = 5, most = 30;
  constexpr double close = 1e-12;                                 // m
  const double touch = 1e-6 * cut_.feed, rubs = 1e-4 * cut_.feed; // spring passes do little else
  for (int iteration = 0; !modes_.empty(); ++iteration) {
    bear(shift, force_, [&](std::size_t k, const Sweep& sweep) { return layer_[k].ask(sweep); });
    PerLayer next = shift_of(moved(force_));
    double change = 0.0;
    for (std::size_t k = 0; k < layer_.size(); ++k) change = std::max(change, (next[k] - shift[k]).norm());
    shift = std::move(next);
    if (change < close || (iteration >= enough && change < touch)) break;
    if (iteration >= most && change < rubs) break;
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
  step.angle = motion_.steady() ? settings_.spindle * step.time
                                : place(step_).angle + 0.5 * full_turn / settings_.steps;
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

std::optional<double> MillingProcess::left_beside(std::size_t layer, double way) const {
  assert(motion_.last_path());
  const auto [at, along] = motion_.last_path()->at(way);
  const bool up = cut_.engagement.side == Engagement::Side::up;
  const double r = edges_.radius(layer);
  const std::vector<Interval> matter = layer_[layer].matter(at, up ? left_normal(along) : right_normal(along),
                                                            cut_.cutter.radius() + beyond(cut_.cutter));
  if (matter.empty()) return std::nullopt;
  return r - matter.back().low;
}

} // namespace cnem::machining
