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
    ModalMotion exact(follow * all.shape, coordinates, dt);
    NewmarkMotion newmark(part, follow, {.dt = dt, .interval = 0, .damping = damping},
                          [&](double) { return part.presence(); });
    const std::vector<double> u = pulse(newmark, dt, duration), reference = pulse(exact, dt, duration);
    double most = 0.0, error = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      most = std::max(most, std::abs(reference[k]));
      error = std::max(error, std::abs(u[k] - reference[k]));
    }
    errors.push_back(error / most);
  }
  EXPECT_LT(errors[1], 3e-3); // the modes beyond are left out of the other one, too
  EXPECT_LT(errors[1], 0.6 * errors[0]);
}

TEST(NewmarkMotion, KeepsTheEnergyWithoutForces) {
  const Part part = small_plate();
  NewmarkMotion motion(part, part.displacement_at(corners), {.dt = 1e-5, .interval = 0, .damping = {}},
                       [&](double) { return part.presence(); });
  pulse(motion, 1e-5, 1e-3);
  const double energy = motion.energy();
  EXPECT_GT(energy, 0.0);
  for (int step = 0; step < 500; ++step) motion.take(Eigen::VectorXd::Zero(6));
  EXPECT_NEAR(motion.energy() / energy, 1.0, 1e-10);
}

TEST(NewmarkMotion, GoesToTheMotionOfFactorsInEachStepAsIntervalsGetShorter) {
  const Part part = small_plate();
  constexpr double dt = 1e-5, duration = 5e-3;
  const auto run = [&](std::int64_t interval) {
    NewmarkMotion motion(part, part.displacement_at(corners),
                         {.dt = dt, .interval = interval, .damping = {0.0, 1e-6}}, [&](double time) {
                           const double way = 0.1 * std::min(time / duration, 1.0);
                           return presence_without(part, Vec3(0.0, 0.02, 0.002), Vec3(way, 0.04, 0.004), 0.9);
                         });
    return pulse(motion, dt, duration);
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
