#include "machining/structure/newmark_motion.hpp"
#include "machining/structure/theoretical_tool.hpp"
#include "tests/unit/machining/benchmarks.hpp"
#include "tests/unit/structure/paper_plate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace cnem;
using namespace cnem::machining;

namespace {

Part coarse() { return {plate({4, 2, 2}), PartElement::hexahedron_8, {&base, 1}}; }
const std::array places{Vec3(0.1, 0.04, 0.0), Vec3(0.0, 0.04, 0.0)};

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
  const Part part = coarse();
  const SparseMatrix follow = part.displacement_at(places);
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
  const Part part = coarse();
  NewmarkMotion motion(part, part.displacement_at(places), {.dt = 1e-5, .interval = 0, .damping = {}},
                       [&](double) { return part.presence(); });
  pulse(motion, 1e-5, 1e-3);
  const double energy = motion.energy();
  EXPECT_GT(energy, 0.0);
  for (int step = 0; step < 500; ++step) motion.take(Eigen::VectorXd::Zero(6));
  EXPECT_NEAR(motion.energy() / energy, 1.0, 1e-10);
}

TEST(NewmarkMotion, GoesToTheMotionOfFactorsInEachStepAsIntervalsGetShorter) {
  const Part part = coarse();
  constexpr double dt = 1e-5, duration = 5e-3;
  const auto run = [&](std::int64_t interval) {
    NewmarkMotion motion(part, part.displacement_at(places),
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

TEST(TheoreticalTool, TakesWhatARigidCutterHasPassed) {
  // A side cut 5 mm along x, 0.5 mm deep, through the upper cells of a block of 20 × 2 × 4 mm.
  const Part part(
      {.size = Vec3(20e-3, 2e-3, 4e-3), .divisions = {10, 2, 2}, .materials = {{1.0, 0.3, 1.0}}, .zones = {}},
      PartElement::hexahedron_8, {&base, 1});
  MillingCut cut = milling_cut(3, 600e6, 0.0, Engagement::Side::down, 0.5 / 12.0);
  const ProcessSettings settings{.spindle = 800.0,
                                 .axial_depth = 2e-3,
                                 .length = 5e-3,
                                 .start = ProcessSettings::Start::hole,
                                 .pitch = 1e-4,
                                 .layers = 2,
                                 .steps = 360};
  MillingProcess rigid(cut, {}, settings);
  const double duration = rigid.duration(), dt = full_turn / 800.0 / 360;
  // The machined side, at the height of the tip: y = 1.5, z = 2 mm in the part.
  const Vec3 origin(0.0, 1.5e-3 + cut.cutter.radius(), 2e-3);
  const TheoreticalTool tool(part, std::move(rigid), [&](const Vec3& x) { return Vec3(x - origin); },
                             {.dt = dt, .interval = 200, .most = 0.9});
  double before = 2.0;
  for (const double share : {0.0, 0.3, 0.6, 1.0}) {
    double sum = 0.0;
    for (const double presence : tool.presence(share * duration)) sum += presence;
    EXPECT_LT(sum, before * static_cast<double>(part.cells()));
    before = sum / static_cast<double>(part.cells());
  }
  for (std::size_t c = 0; c < part.cells(); ++c) {
    const bool outer = part.low(c).y() > 0.5e-3 && part.low(c).z() > 1e-3;
    const double end = tool.presence(duration)[c];
    // Half of the outer upper cells is gone where the axis has been, nothing beyond where the disc reaches.
    if (!outer || part.low(c).x() > 5e-3 + 3e-3)
      EXPECT_EQ(end, 1.0) << c;
    else if (part.high(c).x() < 4.1e-3)
      EXPECT_NEAR(end, 1.0 - 0.9 * 0.5, 1e-12) << c;
    else
      EXPECT_LE(end, 1.0) << c;
  }
}
