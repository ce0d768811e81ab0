#include "core/error.hpp"
#include "core/fields/memory_archive.hpp"
#include "machining/structure/newmark_motion.hpp"
#include "tests/unit/structure/paper_plate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace cnem;
using namespace cnem::machining;

namespace {

Part small_plate() { return {plate({4, 2, 2}), PartElement::hexahedron_8, {&base, 1}}; }
const std::array<Vec3, 2> corners{Vec3(0.1, 0.04, 0.0), Vec3(0.0, 0.04, 0.0)};

/// A pulse on the corners, and where the first one is after it, m.
std::vector<double> pulse(PartMotion& motion, double dt, double duration) {
  std::vector<double> u;
  for (std::int64_t step = 0; static_cast<double>(step) * dt < duration - 0.5 * dt; ++step) {
    const double time = (static_cast<double>(step) + 0.5) * dt;
    const Vec3 force(0.0, 0.0, std::sin(2e3 * time));
    Eigen::VectorXd load(6);
    load << force, 0.5 * force;
    motion.begin(dt);
    u.push_back(motion.ask(load)[2]);
    motion.take(load);
  }
  return u;
}

} // namespace

TEST(NewmarkMotion, IsThatOfAllModes) {
  const Part part = small_plate();
  const SparseMatrix follow = part.displacement_at(corners);
  const Eigenmodes all = modes(part, 60);
  std::vector<ModalMotion::Coordinate> coordinates;
  const Rayleigh damping{20.0, 1e-6};
  for (Eigen::Index i = 0; i < all.count(); ++i)
    coordinates.push_back({all.omega[i], std::min(damping.of_mode(all.omega[i]), 0.9)});
  constexpr double duration = 2e-3;
  std::vector<double> errors;
  for (const double dt : {4e-6, 2e-6}) {
    ModalMotion exact(follow * all.shape, coordinates);
    NewmarkMotion newmark(part, follow, {.interval = 0, .damping = damping},
                          [&](std::int64_t) { return part.presence(); });
    const std::vector<double> u = pulse(newmark, dt, duration), reference = pulse(exact, dt, duration);
    double most = 0.0, error = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      most = std::max(most, std::abs(reference[k]));
      error = std::max(error, std::abs(u[k] - reference[k]));
    }
    errors.push_back(error / most);
  }
  EXPECT_LT(errors[1], 3e-3); // the modes beyond are left out of the other one, too
  EXPECT_LT(errors[1], 0.45 * errors[0]);
}

TEST(NewmarkMotion, KeepsTheEnergyWithoutForces) {
  const Part part = small_plate();
  NewmarkMotion motion(part, part.displacement_at(corners), {.interval = 0, .damping = {}},
                       [&](std::int64_t) { return part.presence(); });
  pulse(motion, 1e-5, 1e-3);
  const double energy = motion.energy().kinetic + motion.energy().elastic;
  EXPECT_GT(energy, 0.0);
  EXPECT_NEAR(motion.energy().work / energy, 1.0, 1e-10);
  for (int step = 0; step < 500; ++step) {
    motion.begin(1e-5);
    motion.take(Eigen::VectorXd::Zero(6));
  }
  EXPECT_NEAR((motion.energy().kinetic + motion.energy().elastic) / energy, 1.0, 1e-10);
  EXPECT_EQ(motion.energy().chips, 0.0);
}

namespace {

constexpr double passing = 5e-3; // s, of a tool along the plate

/// [cell] of a plate whose upper half is taken along its free edge while pulse() is on it.
std::vector<double> thinned(const Part& part, double time) {
  const double way = 0.1 * std::min(time / passing, 1.0);
  return presence_without(part, Vec3(0.0, 0.02, 0.002), Vec3(way, 0.04, 0.004), 0.9);
}

NewmarkMotion thinning(const Part& part, double dt, std::int64_t interval) {
  return {part,
          part.displacement_at(corners),
          {.interval = interval, .damping = {0.0, 1e-6}},
          [&part, dt](std::int64_t step) { return thinned(part, static_cast<double>(step) * dt); }};
}

} // namespace

TEST(NewmarkMotion, EnergiesAddUpWhileMatterLeaves) {
  const Part part = small_plate();
  constexpr double dt = 5e-6; // 250 steps a cell: intervals end where D has its kinks
  std::vector<double> residual;
  for (const std::int64_t interval : {1, 5, 10, 25}) {
    NewmarkMotion motion = thinning(part, dt, interval);
    pulse(motion, dt, passing);
    const EnergyLedger& energy = motion.energy();
    EXPECT_GT(energy.chips, 0.01 * energy.work) << interval;
    EXPECT_GT(energy.damping, 0.0);
    residual.push_back(std::abs(energy.imbalance()) / energy.work);
  }
  EXPECT_LT(residual[0], 1e-10) << "with a factor a step each step is one of a system that is there";
  const auto order = [&](std::size_t fine, double times) {
    return std::log(residual[fine + 1] / residual[fine]) / std::log(times);
  };
  EXPECT_NEAR(order(1, 2.0), 2.0, 0.1) << "between factors: of second order in what an interval changes";
  EXPECT_NEAR(order(2, 2.5), 2.0, 0.1);
}

TEST(NewmarkMotion, ChipsTakeWhatTheyTakeInBox1) {
  const Part part = small_plate();
  constexpr double dt = 1e-5;
  NewmarkMotion motion = thinning(part, dt, 1);
  pulse(motion, dt, passing);
  const SparseMatrix press = part.displacement_at(corners).transpose();
  RemovalState state = RemovalState::at_rest(part.unknowns());
  machine(
      part,
      {.dt = dt,
       .steps = std::llround(passing / dt),
       .interval = 1,
       .damping = {0.0, 1e-6},
       .inverse = EffectiveInverse::factored},
      state, [&](double time) { return thinned(part, time); },
      [&](double time, const Eigen::VectorXd&) -> Eigen::VectorXd {
        Eigen::VectorXd load(6);
        const Vec3 force(0.0, 0.0, std::sin(2e3 * time));
        load << force, 0.5 * force;
        return press * load;
      },
      [](const RemovalStep&) {});
  EXPECT_NEAR(motion.energy().chips / state.energy.chips, 1.0, 0.02);
}

TEST(NewmarkMotion, IsThatOfNewFactorsWhereStepsChange) {
  const Part part = small_plate();
  const SparseMatrix follow = part.displacement_at(corners);
  const Rayleigh damping{0.0, 1e-6};
  const auto whole = [&](std::int64_t) { return part.presence(); };
  NewmarkMotion changes(part, follow, {.interval = 0, .damping = damping}, whole);
  // Half of the steps twice as long: energies add up, and the motion is that of short ones to their order.
  NewmarkMotion fine(part, follow, {.interval = 0, .damping = damping}, whole);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6);
  load[2] = 1.0;
  for (int step = 0; step < 300; ++step) {
    changes.begin(step < 100 ? 2e-6 : 1e-6);
    changes.take(load);
  }
  for (int step = 0; step < 400; ++step) {
    fine.begin(1e-6);
    fine.take(load);
  }
  changes.begin(1e-6);
  fine.begin(1e-6);
  EXPECT_NEAR(changes.ask(load)[2] / fine.ask(load)[2], 1.0, 1e-2);
  EXPECT_LT(std::abs(changes.energy().imbalance()), 1e-10 * changes.energy().work);
}

TEST(NewmarkMotion, GoesToTheMotionOfFactorsInEachStepAsIntervalsGetShorter) {
  const Part part = small_plate();
  constexpr double dt = 1e-5;
  const auto run = [&](std::int64_t interval) {
    NewmarkMotion motion = thinning(part, dt, interval);
    return pulse(motion, dt, passing);
  };
  const std::vector<double> exact = run(1);
  std::vector<double> errors;
  for (const std::int64_t interval : {50, 10}) {
    const std::vector<double> u = run(interval);
    double most = 0.0, error = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      most = std::max(most, std::abs(exact[k]));
      error = std::max(error, std::abs(u[k] - exact[k]));
    }
    errors.push_back(error / most);
  }
  EXPECT_LT(errors[0], 0.05);
  EXPECT_LT(errors[1], 0.5 * errors[0]);
}

TEST(NewmarkMotion, GoesOnBitForBitAfterARestart) {
  const Part part = small_plate();
  constexpr double dt = 1e-5;
  const Eigen::VectorXd load = Eigen::VectorXd::Constant(6, 0.3);
  const auto step = [&](NewmarkMotion& motion, double length) {
    motion.begin(length);
    motion.take(load);
  };
  const auto state = [](NewmarkMotion& motion) {
    const EnergyLedger& energy = motion.energy();
    motion.begin(dt);
    std::vector<double> numbers{energy.work, energy.chips, energy.damping, energy.kinetic, energy.elastic};
    const Eigen::VectorXd u = motion.ask(Eigen::VectorXd::Unit(6, 2));
    numbers.insert(numbers.end(), u.begin(), u.end());
    return numbers;
  };
  for (const int at : {1, 19, 20, 27}) { // within intervals, at the ends of some, in steps of either length
    NewmarkMotion whole = thinning(part, dt, 10), rest = thinning(part, dt, 10);
    for (int n = 0; n < at; ++n) step(whole, n % 2 ? dt : 2.0 * dt);
    MemoryArchive checkpoint;
    whole.archive(checkpoint);
    checkpoint.recall();
    rest.archive(checkpoint);
    for (int n = at; n < at + 15; ++n) {
      step(whole, n % 2 ? dt : 2.0 * dt);
      step(rest, n % 2 ? dt : 2.0 * dt);
    }
    EXPECT_EQ(state(whole), state(rest)) << at;
    EXPECT_GT(whole.energy().chips, 0.0);
  }
}

TEST(NewmarkMotion, RefusesTheStateOfAnotherPart) {
  const Part part = small_plate(), other(plate({2, 2, 2}), PartElement::hexahedron_8, {&base, 1});
  NewmarkMotion motion = thinning(part, 1e-5, 10);
  MemoryArchive checkpoint;
  motion.archive(checkpoint);
  checkpoint.recall();
  NewmarkMotion another(other, other.displacement_at(corners), {.interval = 0, .damping = {}},
                        [&](std::int64_t) { return other.presence(); });
  EXPECT_THROW(another.archive(checkpoint), IoError);
}
