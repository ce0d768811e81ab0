#include "machining/structure/newmark_motion.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <cassert>
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

NewmarkMotion::Frozen::Frozen(const NewmarkMotion& motion, double time)
    : matrices(matrices_of(motion.part_, motion.presence_(time), motion.settings_.damping)),
      factor(motion.newmark_.effective(matrices)), answer(motion.follow_.cols(), motion.follow_.rows()) {
  const SparseMatrix press = motion.follow_.transpose();
  for (Eigen::Index i = 0; i < press.cols(); ++i) answer.col(i) = 2.0 * factor.solve(press.col(i));
  seen = motion.follow_ * answer;
}

NewmarkMotion::NewmarkMotion(Part part, SparseMatrix follow, const Settings& settings, PresenceAt presence)
    : part_(std::move(part)), follow_(std::move(follow)), settings_(settings), presence_(std::move(presence)),
      newmark_(settings.dt), q_(Eigen::VectorXd::Zero(part_.unknowns())), velocity_(q_) {
  assert(follow_.cols() == part_.unknowns() && settings.interval >= 0);
  freeze(0);
  prepare();
}

void NewmarkMotion::freeze(std::int64_t begin) {
  const bool goes_on = after_ && begin == frozen_at_ + settings_.interval;
  before_ = goes_on ? after_ : std::make_shared<const Frozen>(*this, time(begin));
  frozen_at_ = begin;
  after_ = before_;
  if (settings_.interval > 0 &&
      presence_(time(begin)) != presence_(time(begin + settings_.interval))) // else nothing goes
    after_ = std::make_shared<const Frozen>(*this, time(begin + settings_.interval));
}

void NewmarkMotion::prepare() {
  if (settings_.interval > 0 && step_ >= frozen_at_ + settings_.interval)
    freeze(step_ - step_ % settings_.interval);
  eta_ = before_ == after_
             ? 0.0
             : static_cast<double>(step_ + 1 - frozen_at_) / static_cast<double>(settings_.interval);
  const auto without_forces = [&](const Frozen& of) { // (13) and what stays of Q at the begin
    const Matrices& m = of.matrices;
    return of.factor.solve(m.mass * (newmark_.a0 * q_ + newmark_.a2 * velocity_) +
                           newmark_.a1 * (m.damping * q_) - m.stiffness * q_);
  };
  free_ = without_forces(*before_);
  if (before_ != after_) free_ = (1.0 - eta_) * free_ + eta_ * without_forces(*after_); // (20)
}

Eigen::VectorXd NewmarkMotion::ask(const Eigen::VectorXd& load) const {
  Eigen::VectorXd seen = follow_ * free_ + (1.0 - eta_) * (before_->seen * load);
  if (eta_ > 0.0) seen += eta_ * (after_->seen * load);
  return seen;
}

void NewmarkMotion::take(const Eigen::VectorXd& load) {
  Eigen::VectorXd q = free_ + (1.0 - eta_) * (before_->answer * load);
  if (eta_ > 0.0) q += eta_ * (after_->answer * load);
  velocity_ = 2.0 / settings_.dt * (q - q_) - velocity_;
  q_ = std::move(q);
  ++step_;
  prepare();
}

double NewmarkMotion::frequency() const {
  const std::vector<double> there = presence_(time(step_));
  return lowest_modes(part_.stiffness(there), part_.mass(there), 1).frequency(0);
}

double NewmarkMotion::energy() const {
  return 0.5 * (velocity_.dot(before_->matrices.mass * velocity_) + q_.dot(before_->matrices.stiffness * q_));
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
  if (!archive.loading()) return;
  after_ = nullptr;
  freeze(settings_.interval > 0 ? step_ - step_ % settings_.interval : 0);
  prepare();
}

} // namespace cnem::machining
