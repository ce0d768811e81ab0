#include "machining/structure/newmark_motion.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace cnem::machining {

namespace {

Matrices matrices_of(const Part& part, const std::vector<double>& presence, const Rayleigh& damping) {
  Matrices matrices{part.mass(presence), {}, part.stiffness(presence)};
  matrices.damping = matrices.mass; // of the same pattern
  matrices.damping.coeffs() =
      damping.mass * matrices.mass.coeffs() + damping.stiffness * matrices.stiffness.coeffs();
  return matrices;
}

} // namespace

NewmarkMotion::Frozen::Frozen(const NewmarkMotion& motion, std::int64_t step)
    : matrices(matrices_of(motion.part_, motion.presence_(step), motion.settings_.damping)),
      factor(motion.newmark_.effective(matrices)), answer(motion.follow_.cols(), motion.follow_.rows()) {
  const SparseMatrix press = motion.follow_.transpose();
  for (Eigen::Index i = 0; i < press.cols(); ++i) answer.col(i) = 2.0 * factor.solve(press.col(i));
  seen = motion.follow_ * answer;
}

NewmarkMotion::NewmarkMotion(Part part, SparseMatrix follow, const Settings& settings,
                             PresenceAtStep presence)
    : part_(std::move(part)), follow_(std::move(follow)), settings_(settings), presence_(std::move(presence)),
      q_(Eigen::VectorXd::Zero(part_.unknowns())), velocity_(q_) {
  assert(follow_.cols() == part_.unknowns() && settings.interval >= 0);
}

void NewmarkMotion::freeze(std::int64_t begin, bool another) {
  const bool goes_on = !another && after_ && begin == frozen_at_ + settings_.interval;
  before_ = goes_on ? after_ : std::make_shared<const Frozen>(*this, begin);
  frozen_at_ = begin;
  after_ = before_;
  if (const std::int64_t end = begin + settings_.interval;
      settings_.interval > 0 && presence_(begin) != presence_(end)) // else nothing goes
    after_ = std::make_shared<const Frozen>(*this, end);
}

void NewmarkMotion::begin(double dt) {
  constexpr double alike = 1e-8; // times are sums of steps
  const bool another = !(std::abs(dt - dt_) <= alike * dt_);
  if (another) {
    dt_ = dt;
    newmark_ = NewmarkStep(dt);
  }
  if (const std::int64_t from = interval_begin(); another || !before_ || from != frozen_at_) {
    freeze(from, another);
    weigh();
  }
  eta_ =
      changes() ? static_cast<double>(step_ + 1 - frozen_at_) / static_cast<double>(settings_.interval) : 0.0;
  const auto without_forces = [&](const Frozen& of) { // (13) and what stays of Q at the begin
    const Matrices& m = of.matrices;
    return of.factor.solve(m.mass * (newmark_.a0 * q_ + newmark_.a2 * velocity_) +
                           newmark_.a1 * (m.damping * q_) - m.stiffness * q_);
  };
  free_ = without_forces(*before_);
  if (changes()) free_ = (1.0 - eta_) * free_ + eta_ * without_forces(*after_); // (20)
}

Eigen::VectorXd NewmarkMotion::ask(const Eigen::VectorXd& load) const {
  Eigen::VectorXd seen = follow_ * free_ + (1.0 - eta_) * (before_->seen * load);
  if (eta_ > 0.0) seen += eta_ * (after_->seen * load);
  return seen;
}

void NewmarkMotion::weigh() {
  const auto held_in = [&](const Matrices& of) {
    return Held{0.5 * velocity_.dot(of.mass * velocity_), 0.5 * q_.dot(of.stiffness * q_)};
  };
  held_after_ = held_before_ = held_in(before_->matrices);
  if (changes()) held_after_ = held_in(after_->matrices);
}

NewmarkMotion::Held NewmarkMotion::held() const {
  return {(1.0 - eta_) * held_before_.kinetic + eta_ * held_after_.kinetic,
          (1.0 - eta_) * held_before_.elastic + eta_ * held_after_.elastic};
}

void NewmarkMotion::take(const Eigen::VectorXd& load) {
  Eigen::VectorXd q = free_ + (1.0 - eta_) * (before_->answer * load);
  if (eta_ > 0.0) q += eta_ * (after_->answer * load);
  const Eigen::VectorXd way = q - q_;
  const Held stays = held();
  energy_.chips += (energy_.kinetic + energy_.elastic) - (stays.kinetic + stays.elastic);
  energy_.work += load.dot(follow_ * way);
  const auto lost = [&](const Matrices& of) { return way.dot(of.damping * way) / dt_; };
  energy_.damping += (1.0 - eta_) * lost(before_->matrices);
  if (eta_ > 0.0) energy_.damping += eta_ * lost(after_->matrices);
  velocity_ = 2.0 / dt_ * way - velocity_;
  q_ = std::move(q);
  weigh();
  const Held now = held();
  energy_.kinetic = now.kinetic;
  energy_.elastic = now.elastic;
  taken_dt_ = dt_;
  ++step_;
}

void NewmarkMotion::rest() {
  lose_what_it_holds();
  q_.setZero();
  velocity_.setZero();
  if (before_) weigh();
}

double NewmarkMotion::frequency() const {
  const std::vector<double> there = presence_(step_);
  return lowest_modes(part_.stiffness(there), part_.mass(there), 1).frequency(0);
}

void NewmarkMotion::archive(Archive& archive) {
  archive.integer("milling/part/step", step_);
  for (const auto& [name, unit, vector] :
       {std::tuple{"milling/part/q", "m", &q_}, {"milling/part/velocity", "m/s", &velocity_}}) {
    std::vector<double> numbers(vector->begin(), vector->end());
    archive.list(name, unit, numbers);
    if (as<Eigen::Index>(numbers.size()) != part_.unknowns())
      throw IoError(fmt::format("{} is not of this case's part", name));
    *vector = Eigen::Map<const Eigen::VectorXd>(numbers.data(), part_.unknowns());
  }
  energy_.archive(archive, "milling/part/energy/");
  archive.number("milling/part/dt", "s", taken_dt_);
  if (!archive.loading()) return;
  dt_ = taken_dt_;
  if (dt_ > 0.0) newmark_ = NewmarkStep(dt_);
  before_ = after_ = nullptr;
}

} // namespace cnem::machining
