// Tools on springs and dampers: oscillators, presses whose frame gives, gas springs, energy.
#include "masses.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

LinearSpring linear(double stiffness, double preload = 0.0) {
  LinearSpring law;
  law.stiffness = stiffness;
  law.preload = preload;
  return law;
}

/// A tool far from everything, on a spring that pushes it down.
Tool<2> hung(double mass, const Spring& spring, double damping = 0.0, double height = 10.0) {
  Tool<2> made = tool(box({-1, height}, {2, height + 1}));
  made.drive = ToolDrive<2>{mass, {TimeTable(0.0), TimeTable(0.0)}};
  made.drive->free = Vec2(0, 1) * Vec2(0, 1).transpose();
  made.drive->spring = ToolSpring<2>{spring, {0, -1}};
  made.drive->damping = damping;
  return made;
}

double height_of(const Masses& scene, std::size_t t = 0) {
  return scene.contact->displacement(t, scene.time).y();
}

/// Σ of the ledger: what tools hold and lose less what they have received, J/m.
double balance(const Masses& scene) {
  const DriveEnergy energy = scene.contact->drive_energy();
  return energy.kinetic + energy.springs + energy.damping - energy.work;
}

} // namespace

TEST(SprungTool, SwingsAtItsFrequencyAndDecaysAsItsDamperSays) {
  const double mass = 2.5, stiffness = 40.0, omega = std::sqrt(stiffness / mass);
  for (const double ratio : {0.0, 0.05, 0.3}) {
    Masses scene = block(3, 3, 0.1, {0.0, 0.0}, 0.0);
    Tool<2> made = hung(mass, linear(stiffness), 2.0 * ratio * mass * omega);
    made.drive->initial_velocity = {0.3, -0.2}; // its guide takes what is across
    scene.start({made});
    const double damped = omega * std::sqrt(1.0 - ratio * ratio), amplitude = 0.2 / damped;
    double dt = 2e-3, worst = 0.0, energy = 0.0;
    while (scene.time < 5.0 * 2.0 * std::numbers::pi / omega) {
      scene.step(dt);
      dt *= scene.time < 1.0 ? 1.0002 : 1.0 / 1.0001;
      const double t = scene.time;
      worst = std::max(worst, std::abs(height_of(scene) +
                                       amplitude * std::exp(-ratio * omega * t) * std::sin(damped * t)));
      energy = std::max(energy, std::abs(balance(scene) - 0.5 * mass * 0.04));
    }
    EXPECT_LT(worst, 1e-3 * amplitude) << ratio;
    EXPECT_LT(energy, 1e-4 * 0.5 * mass * 0.04) << ratio;
    EXPECT_EQ(scene.contact->displacement(0, scene.time).x(), 0.0);
  }
}

TEST(SprungTool, IsStableWithAnyDamper) {
  Masses scene = block(3, 3, 0.1, {0.0, 0.0}, 0.0);
  scene.start({hung(1.0, linear(10.0, 5.0), 1e6)});
  for (int i = 0; i < 1000; ++i) scene.step(1e-2);
  EXPECT_NEAR(height_of(scene), -5.0 / 1e6 * scene.time, 1e-2 * 5.0 / 1e6 * scene.time) << "it creeps";
}

TEST(SprungTool, KnowsTheStepThatItsSpringBears) {
  Masses scene = block(3, 3, 0.1, {0.0, 0.0}, 0.0);
  scene.start({hung(0.1, linear(4000.0)), tool(box({-1, 20}, {1, 21}))});
  const double bound = scene.contact->stable_step(0.0);
  EXPECT_NEAR(bound, 2.0 / std::sqrt(4000.0 / 0.1), 1e-15);
  for (const double share : {0.99, 1.01}) {
    Tool<2> made = hung(0.1, linear(4000.0));
    made.drive->initial_velocity = {0, -1e-3};
    scene.start({made});
    double farthest = 0.0;
    for (int i = 0; i < 2000 && farthest < 0.5; ++i) {
      scene.step(share * bound);
      farthest = std::max(farthest, std::abs(height_of(scene)));
    }
    EXPECT_EQ(farthest < 0.5, share < 1.0);
  }
}

/// Two springs in series, the frame of a press and a column of the workpiece: half of the stroke of the slide
/// goes into each where they are as stiff.
TEST(SprungTool, APunchLagsBehindItsSlideAndSpringsForwardWhenTheWorkpieceGives) {
  const int nx = 6, ny = 4;
  const double column = nx * 200.0 / 3.0, frame = 150.0, stroke = 0.01;
  Masses scene = block(nx, ny, 0.1, {0.0, 0.0}, 0.0);
  scene.springs.clear();
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i < nx; ++i) scene.link(j * nx + i, (j + 1) * nx + i, 200.0, 12.0);
  Tool<2> punch = hung(5.0, linear(frame), 0.0, 0.3);
  punch.motion.velocity = {TimeTable(0.0), TimeTable({0.0, 4.0, 8.0}, {0.0, -stroke / 4.0, 0.0})};
  scene.start({tool(box({-1, -1}, {2, 0})), punch});
  while (scene.time < 20.0) scene.step(5e-4);
  const double force = stroke * frame * column / (frame + column);
  EXPECT_NEAR(scene.contact->results()[1].force.y(), -force, 2e-3 * force);
  EXPECT_NEAR(scene.contact->spring_force(1, scene.time), force, 2e-3 * force);
  EXPECT_NEAR(height_of(scene, 1), -force / column, 2e-3 * stroke) << "it lags by force/frame";
  const double stored = 0.5 * force * force / frame;
  const DriveEnergy loaded = scene.contact->drive_energy();
  EXPECT_NEAR(loaded.springs, stored, 5e-3 * stored);
  EXPECT_NEAR(loaded.work, stored * (1.0 + frame / column), 2e-2 * stored) << "with the column's dashpots";

  // The workpiece is gone: all that the frame held goes into the punch, which swings round its slide.
  Masses gap = block(3, 3, 0.1, {0.0, 0.0}, 0.0);
  Tool<2> freed = hung(5.0, linear(frame, force));
  gap.start({freed});
  double fastest = 0.0, worst = 0.0;
  while (gap.time < 3.0) {
    gap.step(5e-4);
    fastest = std::max(fastest, -gap.contact->velocity(0, gap.time).y());
    worst = std::max(worst, std::abs(balance(gap)));
  }
  EXPECT_NEAR(fastest, force / std::sqrt(frame * 5.0), 1e-3 * fastest);
  EXPECT_LT(worst, 1e-5 * stored);
}

TEST(SprungTool, GasAndTablesPushAsTheySay) {
  GasSpring gas;
  gas.preload = 6.0;
  gas.length = 0.5;
  for (const double exponent : {1.0, 1.4}) {
    gas.exponent = exponent;
    EXPECT_NEAR(gas.force(0.25), 6.0 * std::pow(2.0, exponent), 1e-12);
    double sum = 0.0;
    for (int k = 0; k < 1000; ++k) sum += 0.25e-3 * gas.force(0.25e-3 * (k + 0.5));
    EXPECT_NEAR(gas.energy(0.25), sum, 1e-6 * sum);
    EXPECT_NEAR(gas.slope(0.2), (gas.force(0.2 + 1e-6) - gas.force(0.2 - 1e-6)) / 2e-6,
                1e-5 * gas.slope(0.2));
  }
  SpringTable table;
  table.travel = {{0.0, 0.1, 0.3}, 3};
  table.forces = {{2.0, 4.0, 5.0}, 3};
  const Spring spring(table);
  EXPECT_NEAR(spring.force(0.2), 4.5, 1e-12);
  EXPECT_EQ(spring.force(0.4), 5.0);
  EXPECT_NEAR(spring.energy(0.3), 0.3 + 0.9, 1e-12);
  EXPECT_NEAR(spring.slope(0.05), 20.0, 1e-9);
  EXPECT_EQ(spring.slope(0.5), 0.0);
  table.forces.size = 2;
  EXPECT_THROW(Spring{table}, InputError);
}

TEST(SprungTool, AGasSpringThatIsChargedSlowlyHoldsAndFollowsItsLaw) {
  const int nx = 6, ny = 4;
  Masses scene = block(nx, ny, 0.1, {0.0, 0.0}, 0.0);
  scene.springs.clear();
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i < nx; ++i) scene.link(j * nx + i, (j + 1) * nx + i, 200.0, 12.0);
  GasSpring gas;
  gas.preload = 6.0;
  gas.length = 0.1;
  Spring charged(gas);
  charged.charge = TimeTable({0.0, 5.0}, {0.0, 1.0});
  scene.start({tool(box({-1, -1}, {2, 0})), hung(5.0, charged, 10.0, 0.3)});
  double most = 0.0;
  for (int i = 0; i < 30000; ++i) {
    scene.step(5e-4);
    most = std::max(most, scene.contact->results()[1].force.norm());
  }
  const double travel = height_of(scene, 1); // it has gone out by as much as the column was pressed in
  EXPECT_LT(travel, -0.01);
  const double force = 6.0 * std::pow(1.0 - travel / 0.1, -1.4);
  EXPECT_NEAR(scene.contact->results()[1].force.y(), -force, 1e-7 * force);
  EXPECT_NEAR(-travel * nx * 200.0 / 3.0, force, 1e-6 * force);
  EXPECT_LT(most, 1.05 * force);
}

TEST(SprungTool, SaysWhenAGasSpringIsAtItsEnd) {
  for (const double exponent : {1.0, 1.4, 2.0}) {
    Masses scene = block(3, 3, 0.1, {0.0, 0.0}, 0.0);
    GasSpring gas;
    gas.preload = 1.0;
    gas.length = 0.05;
    gas.exponent = exponent;
    Tool<2> made = hung(1e6, Spring(gas));
    made.motion.velocity = {TimeTable(0.0), TimeTable(-1.0)};
    scene.start({made});
    try {
      for (int i = 0; i < 200; ++i) scene.step(7e-4);
      FAIL() << "it went on, exponent " << exponent;
    } catch (const DivergenceError& error) {
      EXPECT_NE(std::string(error.what()).find("spring.length"), std::string::npos) << error.what();
    }
  }
}
