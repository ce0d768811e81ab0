#include "machining/structure/removal.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <tuple>

namespace cnem::machining {

namespace {

/// M, C, K as matter goes.
class ChangingMatrices {
public:
  ChangingMatrices(const Part& part, const Rayleigh& damping, std::vector<double> presence)
      : part_(part), rayleigh_(damping),
        presence_(std::move(presence)), matrices_{part.mass(presence_), {}, part.stiffness(presence_)} {
    damp();
  }

  const Matrices& now() const { return matrices_; }
  /// Whether anything has changed.
  bool go_to(const std::vector<double>& presence) {
    bool changed = false;
    for (std::size_t c = 0; c < presence.size(); ++c) {
      if (presence[c] == presence_[c]) continue;
      part_.add_cell(c, presence[c] - presence_[c], matrices_.stiffness, matrices_.mass);
      changed = true;
    }
    presence_ = presence;
    if (changed) damp();
    return changed;
  }

private:
  void damp() { // all matrices of a part have the same pattern
    matrices_.damping = matrices_.mass;
    matrices_.damping.coeffs() =
        rayleigh_.mass * matrices_.mass.coeffs() + rayleigh_.stiffness * matrices_.stiffness.coeffs();
  }
  const Part& part_;
  Rayleigh rayleigh_;
  std::vector<double> presence_;
  Matrices matrices_;
};

/// A state at an end of an interval, with the factor of its K̂.
struct Frozen {
  Frozen(const NewmarkStep& newmark, const Matrices& of) : matrices(of), factor(newmark.effective(of)) {}
  Matrices matrices;
  SparseCholesky factor;
};

double energy(const SparseMatrix& matrix, const Eigen::VectorXd& x) { return 0.5 * x.dot(matrix * x); }

/// The ledger of a step that keeps its sum for Newmark's scheme with 1/4 and 1/2, which is the trapezoidal
/// rule.
void book(EnergyLedger& ledger, const Matrices& of, const Motion& from, const Motion& to,
          const Eigen::VectorXd& force_before, const Eigen::VectorXd& force) {
  const Eigen::VectorXd way = to.q - from.q;
  ledger.chips +=
      ledger.kinetic + ledger.elastic - energy(of.mass, from.velocity) - energy(of.stiffness, from.q);
  ledger.kinetic = energy(of.mass, to.velocity);
  ledger.elastic = energy(of.stiffness, to.q);
  ledger.work += 0.5 * way.dot(force_before + force);
  ledger.damping += 0.5 * way.dot(of.damping * (from.velocity + to.velocity));
}

} // namespace

int conjugate_gradients(const SparseMatrix& effective, const SparseCholesky& factor,
                        const Eigen::VectorXd& load, double tolerance, Eigen::VectorXd& q) {
  const double close = tolerance * load.norm();
  Eigen::VectorXd residual = load - effective * q;
  Eigen::VectorXd preconditioned = factor.solve(residual), direction = preconditioned;
  double product = residual.dot(preconditioned);
  constexpr int most = 1000;
  for (int iteration = 0; iteration < most; ++iteration) {
    if (!(residual.norm() > close)) return iteration;
    const Eigen::VectorXd image = effective * direction;
    const double length = product / direction.dot(image);
    q += length * direction;
    residual -= length * image;
    preconditioned = factor.solve(residual);
    const double next = residual.dot(preconditioned);
    direction = preconditioned + next / product * direction;
    product = next;
  }
  throw DivergenceError(
      fmt::format("conjugate gradients did not come to {:g} of the load in {} iterations: "
                  "the part has changed much since its last factor, expected shorter intervals",
                  tolerance, most),
      0, "displacement");
}

RemovalState RemovalState::at_rest(Eigen::Index unknowns) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(unknowns);
  return {.step = 0, .motion = {zero, zero, zero}, .energy = {}, .force = zero};
}

void RemovalState::archive(Archive& archive, const std::string& path) {
  archive.integer(path + "step", step);
  for (const auto& [name, unit, vector] : {std::tuple{"q", "m", &motion.q},
                                           {"velocity", "m/s", &motion.velocity},
                                           {"acceleration", "m/s^2", &motion.acceleration},
                                           {"force", "N", &force}}) {
    std::vector<double> numbers(vector->begin(), vector->end());
    archive.list(path + name, unit, numbers);
    if (archive.loading() && as<Eigen::Index>(numbers.size()) != motion.q.size())
      throw IoError(fmt::format("{}{} is not of this case's part", path, name));
    *vector = Eigen::Map<const Eigen::VectorXd>(numbers.data(), as<Eigen::Index>(numbers.size()));
  }
  energy.archive(archive, path);
}

void machine(const Part& part, const RemovalSettings& settings, RemovalState& state,
             const PresenceAt& presence, const LoadAt& load,
             const std::function<void(const RemovalStep&)>& observe) {
  assert(settings.dt > 0.0 && settings.interval > 0);
  const NewmarkStep newmark(settings.dt);
  const auto interpolates = settings.inverse == EffectiveInverse::interpolated ||
                            settings.inverse == EffectiveInverse::interpolated_common;
  const auto time = [&](std::int64_t step) { return static_cast<double>(step) * settings.dt; };
  std::int64_t& begin = state.step;
  Motion& motion = state.motion;
  EnergyLedger& ledger = state.energy;
  Eigen::VectorXd& force_before = state.force;
  std::unique_ptr<Frozen> after;
  while (begin < settings.steps) {
    const std::int64_t end = std::min(begin + settings.interval, settings.steps);
    ChangingMatrices system(part, settings.damping, presence(time(begin)));
    SparseMatrix effective = newmark.effective(system.now());
    std::unique_ptr<Frozen> before =
        after ? std::move(after) : std::make_unique<Frozen>(newmark, system.now());
    if (interpolates) // K̂(p_i), of the end of the interval
      after = std::make_unique<Frozen>(newmark,
                                       ChangingMatrices(part, settings.damping, presence(time(end))).now());
    if (begin == 0) {
      ledger.kinetic = energy(system.now().mass, motion.velocity);
      ledger.elastic = energy(system.now().stiffness, motion.q);
      ledger.work = ledger.kinetic + ledger.elastic; // what was there
      force_before = load(0.0, motion.q);
      motion.acceleration = // else the scheme is of first order
          SparseCholesky(system.now().mass)
              .solve(force_before - system.now().damping * motion.velocity -
                     system.now().stiffness * motion.q);
    }
    for (std::int64_t step = begin; step < end; ++step) {
      const double now = time(step + 1), eta = (now - time(begin)) / (time(end) - time(begin));
      if (system.go_to(presence(now))) effective = newmark.effective(system.now());
      if (settings.inverse == EffectiveInverse::factored)
        before = std::make_unique<Frozen>(newmark, system.now());
      int iterations = 0;
      const auto invert = [&](const Eigen::VectorXd& force, const Eigen::VectorXd& trial) {
        Eigen::VectorXd q = trial;
        if (settings.inverse == EffectiveInverse::conjugate_gradients) {
          constexpr double tolerance = 1e-10;
          iterations += conjugate_gradients(effective, before->factor,
                                            force + newmark.carried(motion, system.now()), tolerance, q);
        } else if (interpolates) {
          const auto of = [&](const Frozen& frozen) { // (19)
            const Matrices& own =
                settings.inverse == EffectiveInverse::interpolated ? frozen.matrices : system.now();
            return frozen.factor.solve(force + newmark.carried(motion, own));
          };
          q = (1.0 - eta) * of(*before) + eta * of(*after); // (20)
        } else
          q = before->factor.solve(force + newmark.carried(motion, system.now()));
        return q;
      };
      Eigen::VectorXd trial = motion.q, force = load(now, trial);
      constexpr int most = 50;
      constexpr double close = 1e-12;
      for (int iteration = 0;; ++iteration) {
        trial = invert(force, trial);
        if (!trial.allFinite() || iteration == most)
          throw DivergenceError(
              fmt::format("the motion of the part does not come together at {:g} s, expected "
                          "a shorter step or intervals of fewer steps",
                          now),
              0, "displacement");
        Eigen::VectorXd answer = load(now, trial);
        const double change = (answer - force).norm();
        force = std::move(answer);
        if (change <= close * force.norm()) break;
      }
      Motion arrived = newmark.arrive(motion, std::move(trial));
      book(ledger, system.now(), motion, arrived, force_before, force);
      motion = std::move(arrived);
      force_before = std::move(force);
      observe({now, motion, ledger, iterations});
    }
    begin = end;
  }
}

std::vector<double> presence_without(const Part& part, const Vec3& low, const Vec3& high, double most) {
  assert(most >= 0.0 && most < 1.0); // else K̂ is singular
  std::vector<double> presence = part.presence();
  for (std::size_t c = 0; c < presence.size(); ++c) {
    const Vec3 from = part.low(c), to = part.high(c);
    const Vec3 common = (high.cwiseMin(to) - low.cwiseMax(from)).cwiseMax(0.0);
    presence[c] *= 1.0 - most * common.cwiseQuotient(to - from).prod();
  }
  return presence;
}

} // namespace cnem::machining
