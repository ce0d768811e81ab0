#include "machining/structure/removal.hpp"
#include "tests/unit/structure/paper_plate.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace cnem;
using namespace cnem::machining;

namespace {

const Part& coarse() {
  static const Part part(plate({4, 2, 2}), PartElement::hexahedron_8, {&base, 1});
  return part;
}

PresenceAt unchanged(const Part& part) {
  return [&part](double) { return part.presence(); };
}
LoadAt nothing(const Part& part) {
  return [n = part.unknowns()](double, const Eigen::VectorXd&) -> Eigen::VectorXd {
    return Eigen::VectorXd::Zero(n);
  };
}

/// Swings in its first mode, from the turning point.
RemovalState swinging(const Part& part) {
  const Eigenmodes first = modes(part, 1);
  const double omega = first.omega[0];
  RemovalState state = RemovalState::at_rest(part.unknowns());
  state.motion.q = first.shape.col(0);
  state.motion.acceleration = -omega * omega * first.shape.col(0);
  return state;
}

double largest(const std::vector<double>& u) {
  double most = 0.0;
  for (const double x : u) most = std::max(most, std::abs(x));
  return most;
}
/// (21), the largest of it.
double error(const std::vector<double>& u, const std::vector<double>& reference) {
  double most = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) most = std::max(most, std::abs(u[i] - reference[i]));
  return most / largest(reference);
}

/// Paper 004, 3.3.2, with half of the steps: a tool goes along the plate in 0.01 s, and a force goes with it.
struct Course {
  std::vector<double> path; ///< m, of the corner that is left
  std::vector<EnergyLedger> energy;
  int iterations = 0; ///< most in a step
};
Course course(std::int64_t interval, EffectiveInverse inverse) {
  const Part& part = coarse();
  constexpr double dt = 1e-5, duration = 0.01, omega = 21002.66;
  const std::vector<Vec3> corner{Vec3(0.1, 0.04, 0.0)};
  const SparseMatrix at = part.displacement_at(corner);
  const auto tool = [&](double time) { return 0.1 * std::min(time / duration, 1.0); };
  Course made;
  RemovalState state = RemovalState::at_rest(part.unknowns());
  machine(
      part,
      {.dt = dt, .steps = 1000, .interval = interval, .damping = {0.0, 0.02 / omega}, .inverse = inverse},
      state,
      [&](double time) {
        return presence_without(part, Vec3(0.0, 0.02, 0.002), Vec3(tool(time), 0.04, 0.004), 0.9);
      },
      [&](double time, const Eigen::VectorXd&) -> Eigen::VectorXd {
        const std::vector<Vec3> point{Vec3(tool(time), 0.04, 0.0)};
        return part.displacement_at(point).transpose() * Vec3(0.0, 0.0, std::cos(omega * time));
      },
      [&](const RemovalStep& step) {
        made.path.push_back((at * step.motion.q)[2]);
        made.energy.push_back(step.energy);
        made.iterations = std::max(made.iterations, step.iterations);
      });
  return made;
}

} // namespace

TEST(Newmark, IsOfSecondOrderAndKeepsTheEnergy) {
  const Part& part = coarse();
  const RemovalState start = swinging(part);
  const double omega = modes(part, 1).omega[0], duration = 2.0 * 2.0 * std::numbers::pi / omega;
  std::vector<double> errors;
  for (const std::int64_t steps : {80, 160, 320}) {
    Eigen::VectorXd end;
    double drift = 0.0, first = 0.0;
    RemovalState state = start;
    machine(part,
            {.dt = duration / static_cast<double>(steps), .steps = steps, .interval = steps, .damping = {}},
            state, unchanged(part), nothing(part), [&](const RemovalStep& step) {
              const double energy = step.energy.kinetic + step.energy.elastic;
              if (first == 0.0) first = energy;
              drift = std::max(drift, std::abs(energy - first));
              end = step.motion.q;
            });
    EXPECT_LT(drift, 1e-10 * first);
    EXPECT_NEAR(first / (0.5 * omega * omega), 1.0, 1e-9);
    errors.push_back((end - start.motion.q).norm() / start.motion.q.norm());
  }
  // Of the phase, of which what is left at the turning point is the square.
  EXPECT_NEAR(0.5 * std::log2(errors[0] / errors[1]), 2.0, 0.1);
  EXPECT_NEAR(0.5 * std::log2(errors[1] / errors[2]), 2.0, 0.1);
}

// From rest under a force that is there at once: with an acceleration of 0 at the begin the order is 1.
TEST(Newmark, IsOfSecondOrderUnderAForce) {
  PartShape block = plate({2, 1, 1});
  block.size = Vec3(0.1, 0.04, 0.04);
  const Part part(block, PartElement::hexahedron_8, {&base, 1});
  const std::vector<Vec3> corner{Vec3(0.1, 0.04, 0.0)};
  const SparseMatrix at = part.displacement_at(corner);
  const Eigen::VectorXd force = at.transpose() * Vec3(0.0, 0.0, 1000.0);
  const auto path = [&](std::int64_t steps, const Rayleigh& damping) { // at 30 times in 60 us
    std::vector<double> made;
    RemovalState state = RemovalState::at_rest(part.unknowns());
    machine(
        part,
        {.dt = 60e-6 / static_cast<double>(steps), .steps = steps, .interval = steps, .damping = damping},
        state, unchanged(part), [&](double, const Eigen::VectorXd&) -> Eigen::VectorXd { return force; },
        [&, n = 0](const RemovalStep& step) mutable {
          const double held = step.energy.kinetic + step.energy.elastic + step.energy.damping;
          EXPECT_NEAR(held, step.energy.work, 1e-10 * std::abs(step.energy.work)) << n;
          if (++n % (steps / 30) == 0) made.push_back((at * step.motion.q)[2]);
        });
    return made;
  };
  for (const Rayleigh& damping : {Rayleigh{}, Rayleigh{.mass = 0.0, .stiffness = 5e-8}}) {
    const std::vector<double> fine = path(2400, damping);
    const double coarse = error(path(150, damping), fine), half = error(path(300, damping), fine);
    EXPECT_NEAR(std::log2(coarse / half), 2.0, 0.1) << damping.stiffness;
  }
}

TEST(Newmark, ForcesOfTheMotionAreMet) { // a spring at a corner, which Newton's trials find
  const Part& part = coarse();
  RemovalState start = swinging(part);
  const std::vector<Vec3> corner{Vec3(0.1, 0.04, 0.0)};
  const Eigen::MatrixXd at = part.displacement_at(corner);
  const double dt = 1e-5, spring = 1e5;
  const NewmarkStep newmark(dt);
  Matrices matrices{part.mass(part.presence()), {}, part.stiffness(part.presence())};
  matrices.damping = 0.0 * matrices.mass;
  start.motion.acceleration = // as the run finds it
      -Eigen::MatrixXd(matrices.mass)
           .ldlt()
           .solve(Eigen::VectorXd(matrices.stiffness * start.motion.q +
                                  spring * at.row(2).transpose() * (at.row(2) * start.motion.q)));
  const Eigen::MatrixXd with_spring =
      Eigen::MatrixXd(newmark.effective(matrices)) + spring * at.row(2).transpose() * at.row(2);
  const Eigen::VectorXd exact = with_spring.ldlt().solve(newmark.carried(start.motion, matrices));
  RemovalState state = start;
  machine(
      part, {.dt = dt, .steps = 1, .interval = 1, .damping = {}}, state, unchanged(part),
      [&](double, const Eigen::VectorXd& trial) -> Eigen::VectorXd {
        return -spring * at.row(2).transpose() * (at.row(2) * trial);
      },
      [&](const RemovalStep& step) { EXPECT_LT((step.motion.q - exact).norm(), 1e-9 * exact.norm()); });
}

TEST(Removal, InversesAgree) {
  const Course exact = course(1, EffectiveInverse::factored),
               iterated = course(100, EffectiveInverse::conjugate_gradients);
  EXPECT_LT(error(iterated.path, exact.path), 1e-8);
  EXPECT_LT(iterated.iterations, 40);
  // Falls with the interval; as printed, with one Q_total, it is not even near.
  double before = 1.0;
  for (const std::int64_t interval : {125, 50, 25, 10}) {
    const double now = error(course(interval, EffectiveInverse::interpolated).path, exact.path);
    EXPECT_LT(now, 0.8 * before) << interval;
    EXPECT_LT(3.0 * now, error(course(interval, EffectiveInverse::interpolated_common).path, exact.path));
    before = now;
  }
  EXPECT_LT(before, 5e-3);
}

TEST(Removal, Ledger) {
  const Course run = course(1, EffectiveInverse::factored);
  const EnergyLedger& end = run.energy.back();
  EXPECT_GT(end.damping, 0.0);
  for (std::size_t i = 1; i < run.energy.size(); ++i) {
    EXPECT_GE(run.energy[i].chips,
              run.energy[i - 1].chips - 1e-12 * end.chips); // what leaves takes energy along
    EXPECT_GE(run.energy[i].damping, run.energy[i - 1].damping);
  }
  // Matter goes at once at the begin of a step, whose accelerations are still those with it.
  EXPECT_LT(std::abs(end.imbalance()), 0.02 * end.work);
}

TEST(Removal, LedgerAddsUpWithoutRemoval) {
  const Part& part = coarse();
  const std::vector<Vec3> corner{Vec3(0.1, 0.04, 0.0)};
  const SparseMatrix at = part.displacement_at(corner);
  RemovalState state = swinging(part);
  machine(
      part, {.dt = 1e-5, .steps = 300, .interval = 100, .damping = {0.0, 1e-6}}, state, unchanged(part),
      [&](double time, const Eigen::VectorXd&) -> Eigen::VectorXd {
        return at.transpose() * Vec3(0.0, 0.0, 1e3 * std::sin(9e3 * time));
      },
      [&](const RemovalStep& step) {
        EXPECT_LT(std::abs(step.energy.imbalance()), 1e-9 * step.energy.work);
      });
}

TEST(Removal, ShareThatIsTaken) {
  const Part& part = coarse(); // cells of 25 × 20 × 2 mm
  const std::vector<double> presence =
      presence_without(part, Vec3(0.0, 0.02, 0.002), Vec3(0.03, 0.04, 0.004), 0.9);
  for (std::size_t c = 0; c < part.cells(); ++c) {
    const Vec3 low = part.low(c);
    const bool above = low.y() > 0.01 && low.z() > 0.001;
    EXPECT_NEAR(presence[c],
                above && low.x() < 0.01   ? 0.1
                : above && low.x() < 0.04 ? 1.0 - 0.9 * 0.2
                                          : 1.0,
                1e-12);
  }
}
