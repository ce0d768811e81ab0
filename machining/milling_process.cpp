#include "machining/milling_process.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace cnem::machining {

MillingProcess::MillingProcess(MillingCut cut, std::vector<Mode> modes, const ProcessSettings& settings,
                               std::unique_ptr<FlexiblePart> part)
    : cut_(std::move(cut)), modes_(std::move(modes)), settings_(settings), motion_(motion_of(cut_, settings)),
      dt_(motion_.dt(0)),
      feed_speed_(cut_.feed * static_cast<double>(cut_.cutter.teeth()) * settings.spindle / full_turn),
      slice_(slices_of(cut_, settings_)), part_(std::move(part)) {
  assert(settings.passes.empty() == !settings.blank);
  for (std::size_t pass = 0; pass < motion_.passes().size(); ++pass)
    edges_.emplace_back(cut_, slice_, motion_.tip(pass), full_turn / settings.steps);
  take_blank();
  for (const Mode& mode : modes_) {
    free_.emplace_back(mode, dt_);
    loss_.push_back(damping_loss(mode, dt_));
  }
  state_ = Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(modes_.size()));
  bite_.resize(edges().layers() * edges().teeth());
  way_.resize(bite_.size());
  sweep_.resize(bite_.size());
  if (part_) edge_.assign(bite_.size(), Vec3::Zero());
  take_flanks();
  shape_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(layer_.size()), state_.cols());
  shift_.assign(layer_.size(), Vec3::Zero());
  force_ = shift_;
}

ToolPath::Place MillingProcess::way_at(double at) const { return motion_.place(motion_.pass_of(step_), at); }

MillingProcess MillingProcess::rigid() const {
  MillingProcess still(cut_, {}, settings_);
  still.layer_ = layer_;
  still.step_ = step_;
  still.passes_begun_ = passes_begun_;
  still.farthest_ = farthest_; // matter lies as deep
  still.take_flanks();
  return still;
}

void MillingProcess::take_flanks() {
  if (!cut_.flank.presses()) return;
  std::vector<double> radius; // without edges none is pressed in: any will do
  for (std::size_t k = 0; k < layer_.size(); ++k)
    radius.push_back(edges().reaches(k) ? edges().radius(k) : cut_.cutter.radius());
  flanks_.emplace(cut_.flank, radius, edges().teeth(), full_turn / settings_.steps);
  pressed_.assign(bite_.size(), 0.0);
}

bool MillingProcess::at_end() const { return motion_.at_end(step_); }

void MillingProcess::begin_step() {
  if (const double dt = motion_.dt(step_); dt != dt_) {
    dt_ = dt;
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      free_[i] = FreeMotion(modes_[i], dt_);
      loss_[i] = damping_loss(modes_[i], dt_);
    }
  }
  if (!settings_.passes.empty())
    if (const std::size_t pass = motion_.pass_of(step_); index_of(passes_begun_) == pass) begin_pass(pass);
  if (part_) part_->begin_step(dt_);
}

void MillingProcess::take_shapes() {
  const double x = way_at(static_cast<double>(step_) + 0.5).at.x();
  for (std::size_t i = 0; i < modes_.size(); ++i)
    for (std::size_t k = 0; k < layer_.size(); ++k) { // heights of a tool are those over its tip
      const double z = modes_[i].of == Mode::Of::tool ? edges().over_tip(k) : height(k);
      shape_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
          edges().reaches(k) ? modes_[i].shape(x, z) : 0.0;
    }
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
  const Vec2 axis = way_at(at).at;
  return {Vec3(axis.x(), axis.y(), 0.0), full_turn * ((first_ + at) / settings_.steps)};
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

Sweep MillingProcess::in_material(std::size_t layer, std::size_t tooth,
                                  const std::array<CutterPlace, 2>& place, double depth,
                                  const Sweep& sweep) const {
  const double z = height(layer);
  const auto in_space = [&](const Vec2& x) { return Vec3(x.x(), x.y(), z); };
  const std::array corner{sweep.from.edge, sweep.from.inner, sweep.to.edge, sweep.to.inner};
  Vec3 low = in_space(corner[0]), high = low;
  for (const Vec2& x : corner) {
    low = low.cwiseMin(in_space(x));
    high = high.cwiseMax(in_space(x));
  }
  if (!part_->begin().may_meet(low, high) && !part_->end().may_meet(low, high)) return sweep;
  const auto back = [&](const HexahedralMap& map, const CutterPlace& at, Rake rake) -> Rake {
    Vec3 edge = map.material(in_space(rake.edge));
    if (cut_.cutter.rounded()) { // a layer that is higher is cut farther up the profile
      CutterPlace beside = at;
      beside.axis.z() += edge.z() - z;
      rake = edges().rake(layer, tooth, beside, depth);
      edge = map.material(in_space(rake.edge));
    }
    return {edge.head<2>(), map.material(in_space(rake.inner)).head<2>()};
  };
  return {back(part_->begin(), place[0], sweep.from), back(part_->end(), place[1], sweep.to)};
}

MillingProcess::PerLayer MillingProcess::relative(const PerLayer& shift) const {
  const auto [at, along] = way_at(static_cast<double>(step_));
  const Vec2 side = at + cut_.cutter.radius() * machined_side(along);
  PerLayer beside = shift;
  for (std::size_t k = 0; k < beside.size(); ++k)
    if (!edges().reaches(k))
      beside[k].setZero(); // no edge is beside the part there
    else
      beside[k] -= part_->end().displacement(Vec3(side.x(), side.y(), height(k)));
  return beside;
}

void MillingProcess::sweep_edges(const PerLayer& shift) {
  const CutterPlace from = place(step_), to = place(step_ + 1);
  const auto shifted = [](CutterPlace place, const Vec3& by) {
    place.axis += by;
    return place;
  };
  const double deep = part_ ? reach(relative(shift)) : reach(shift);
  ParallelFailure failure;
  const double forward = 1.5 * feed_speed_ / settings_.spindle; // nearer to the axis rakes go backwards
#pragma omp parallel for schedule(static) if (bite_.size() >= 256)
  for (std::size_t k = 0; k < layer_.size(); ++k) {
    if (!edges().reaches(k)) {
      for (std::size_t i = k * edges().teeth(); i < (k + 1) * edges().teeth(); ++i) {
        bite_[i] = {};
        way_[i].setZero();
      }
      continue;
    }
    const double r = edges().radius(k), depth = std::min(deep, std::max(r - forward, 0.5 * r));
    const CutterPlace first = shifted(from, shift_[k]), last = shifted(to, shift[k]);
    for (std::size_t j = 0; j < edges().teeth(); ++j) {
      const std::size_t i = k * edges().teeth() + j;
      Sweep& sweep = sweep_[i];
      sweep = {edges().rake(k, j, first, depth), edges().rake(k, j, last, depth)};
      Vec2 turned = Vec2::Zero(); // m, by which the part turns and strains the way
      double lifted = 0.0;        // m, by the part, along the axis
      if (part_) {
        failure.guard(static_cast<std::ptrdiff_t>(k), [&] {
          sweep = in_material(k, j, {first, last}, depth, sweep);
        });
        const Vec2 middle = 0.5 * (sweep.from.edge + sweep.to.edge);
        const Vec3 edge(middle.x(), middle.y(), height(k));
        const Vec3 by = part_->end().displacement(edge) - part_->begin().displacement(edge);
        const auto at = [&](const Vec2& x) { return Vec3(x.x(), x.y(), height(k)); };
        turned = (part_->end().displacement(at(sweep.to.edge)) -
                  part_->begin().displacement(at(sweep.from.edge)) - by)
                     .head<2>();
        lifted = by.z();
        edge_[i] = edge;
      }
      const Vec2 way = sweep.to.edge - sweep.from.edge + turned;
      way_[i] = {way.x(), way.y(), last.axis.z() - first.axis.z() - lifted};
    }
  }
  failure.rethrow();
}

template<class TakeBite>
EdgeLoad MillingProcess::bear(const PerLayer& shift, PerLayer& force, TakeBite&& bite) {
  const CutterPlace from = place(step_), to = place(step_ + 1);
  sweep_edges(shift); // of all edges before any bites: rakes that have no place in the material end the step
#pragma omp parallel for schedule(static) if (bite_.size() >= 256)
  for (std::size_t k = 0; k < layer_.size(); ++k) {
    if (!edges().reaches(k)) continue;
    const CutterPlace last{to.axis + shift[k], to.angle};
    for (std::size_t i = k * edges().teeth(), j = 0; j < edges().teeth(); ++i, ++j) {
      bite_[i] = bite(k, sweep_[i]);
      if (flanks_) pressed_[i] = flanks_->pressed(i, edges().arm(k, j, last), way_of(i));
    }
  }
  if (part_) part_->unload();
  EdgeLoad load;
  for (std::size_t k = 0, i = 0; k < layer_.size(); ++k) {
    const Vec3 below = load.force;
    for (std::size_t j = 0; j < edges().teeth(); ++j, ++i) {
      const Vec3 others = load.force;
      edges().add(load, k, j, bite_[i], way_[i], dt_, from, to);
      if (flanks_)
        edges().plough(load, k, j, 0.5 * (flanks_->before(i) + pressed_[i]), way_[i], dt_, from, to);
      if (part_) part_->press(edge_[i], others - load.force);
    }
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
  if (part_) {
    const double damped = part_->energy().damping;
    part_->take();
    const EnergyLedger& energy = part_->energy();
    ledger_.damping += energy.damping - damped;
    ledger_.chips = energy.chips;
    ledger_.kinetic += energy.kinetic;
    ledger_.elastic += energy.elastic;
  }
  ledger_.cutting += load.work;
  ledger_.ploughing += load.ploughed;
  ledger_.spindle += load.torque * (to.angle - from.angle);
  // A cutter that is fed along a mode whose shape changes there goes with that shape: the feed does that.
  ledger_.feed -= load.force.dot(to.axis - from.axis) + of_shift - of_modes;
}

ProcessStep MillingProcess::advance() {
  begin_step();
  const PerLayer force = force_; // questions of a step that is not made leave theirs
  const Eigen::VectorXd load = part_ ? part_->load() : Eigen::VectorXd();
  try {
    return make_step();
  } catch (...) {
    force_ = force;
    if (part_) part_->go_back(load);
    throw;
  }
}

double MillingProcess::rubbing(double chip) const {
  double give = 0.0; // m/N
  for (std::size_t i = 0; i < modes_.size(); ++i)
    give += modes_[i].participation().squaredNorm() / modes_[i].stiffness *
            std::abs(1.0 - free_[i].of_state(0, 0));
  return give * edges().bears(chip, settings_.spindle * cut_.cutter.radius());
}

double MillingProcess::finer(double times) const {
  constexpr double spare = 1.25, tens = 10.0;
  return tens * std::ceil(spare * times * settings_.steps / tens);
}

ProcessStep MillingProcess::make_step() {
  take_shapes();
  PerLayer shift = shift_of(moved(force_));
  if (part_) part_->answer();
  // Where an edge only just touches its force comes and goes from one question to the next: what that moves
  // is told from a failure by its size. Spring passes do little else.
  constexpr int enough = 5, most = 30;
  constexpr double close = 1e-12; // m
  const double touch = 1e-6 * cut_.feed;
  const double rubbed = rubbing(touch), least = 1e-4 * cut_.feed, greatest = 1e-2 * cut_.feed;
  const double rubs = std::clamp(rubbed, least, greatest);
  double unsettled = 0.0;
  for (int iteration = 0; !modes_.empty() || part_; ++iteration) {
    bear(shift, force_, [&](std::size_t k, const Sweep& sweep) { return layer_[k].ask(sweep); });
    PerLayer next = shift_of(moved(force_));
    double change = 0.0;
    for (std::size_t k = 0; k < layer_.size(); ++k) change = std::max(change, (next[k] - shift[k]).norm());
    shift = std::move(next);
    if (part_) {
      const PerLayer before = relative(shift);
      part_->answer();
      const PerLayer after = relative(shift);
      for (std::size_t k = 0; k < layer_.size(); ++k)
        change = std::max(change, (after[k] - before[k]).norm());
    }
    if (change < close || (iteration >= enough && change < touch)) break;
    if (iteration >= most && change < rubs) {
      unsettled = change;
      break;
    }
    if (iteration >= most && part_) part_->check(); // what folds need not agree with anything
    // An impulse of a force that comes or goes moves a mode by the square of the step, and `rubbed` falls
    // with it: smaller steps meet but a bound of `rubs`.
    if (iteration >= most)
      throw DivergenceError(
          fmt::format("forces and vibration of a step do not agree: the shift of the cutter still changes by "
                      "{:.3g} m, where {:.3g} m is little; expected smaller steps, dexels.steps = {:.0f} or "
                      "more",
                      change, rubs, finer(std::sqrt(change / (change < rubbed ? greatest : least)))),
          -1, "displacement");
  }
  if (part_) part_->check();
  ProcessStep step;
  static_cast<EdgeLoad&>(step) =
      bear(shift, force_, [&](std::size_t k, const Sweep& sweep) { return layer_[k].erase(sweep); });
  if (flanks_)
    for (std::size_t i = 0; i < pressed_.size(); ++i) flanks_->note(i, way_of(i), pressed_[i]);
  step.unsettled = unsettled;
  step.time = time() + 0.5 * dt_;
  step.angle = motion_.steady() ? settings_.spindle * step.time + full_turn * (first_ / settings_.steps)
                                : place(step_).angle + 0.5 * full_turn / settings_.steps;
  Eigen::MatrixXd state = moved(force_);
  const PerLayer seen = part_ ? relative(shift) : shift;
  book(step, state, shift);
  state_ = std::move(state);
  farthest_ = std::max(farthest_, largest(seen));
  for (const Vec3& s : seen)
    if (s.squaredNorm() > step.displacement.squaredNorm()) step.displacement = s;
  shift_ = std::move(shift);
  ++step_;
  return step;
}

void MillingProcess::archive(Archive& archive) {
  archive.integer("milling/step", step_);
  archive.integer("milling/passes_begun", passes_begun_);
  if (passes_begun_ < 0 || pass() >= edges_.size())
    throw IoError(
        fmt::format("milling/passes_begun holds {}, which are no passes of this case", passes_begun_));
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
  if (archive.loading()) take_flanks();
  if (flanks_) flanks_->archive(archive);
  if (part_) part_->archive(archive);
  for (std::size_t k = 0; k < layer_.size(); ++k)
    layer_[k].archive(archive, fmt::format("milling/layer/{}/", k));
}

} // namespace cnem::machining
