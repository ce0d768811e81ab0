// The extended mapping of a deformed workpiece, and cuts in a part that it follows.
#include "machining/hexahedral_map.hpp"

#include "core/error.hpp"
#include "machining/milling_process.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <array>
#include <random>

namespace cnem::machining {
namespace {

const Vec3 low(-1e-3, 2e-3, 0.0), high(11e-3, 5e-3, 6e-3);

HexahedralMap map(const std::array<int, 3>& cells) { return {low, high, cells, Vec3(6e-3, 5e-3, 4e-3)}; }

template<class Field> Eigen::VectorXd nodes(const HexahedralMap& of, Field&& field) {
  Eigen::VectorXd q(of.unknowns());
  for (std::size_t n = 0; n < of.places().size(); ++n)
    q.segment<3>(3 * static_cast<Eigen::Index>(n)) = field(of.places()[n]);
  return q;
}

/// Within the box, and with `beyond` of it around.
std::vector<Vec3> points(double beyond) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> share(-beyond, 1.0 + beyond);
  std::vector<Vec3> all;
  for (int n = 0; n < 200; ++n) {
    const Vec3 at(share(generator), share(generator), share(generator));
    all.emplace_back(low + at.cwiseProduct(high - low));
  }
  return all;
}

} // namespace

TEST(HexahedralMap, LinearFieldsAreInverted) { // (8): in at most three steps, to 1e-12 of the size
  for (const std::array<int, 3>& cells : {std::array{1, 1, 1}, {4, 2, 3}}) {
    HexahedralMap phi = map(cells);
    Mat<3> slope;
    slope << 0.01, -0.02, 0.005, 0.03, 0.004, -0.01, -0.007, 0.02, 0.015;
    const auto field = [&](const Vec3& x) { return Vec3(slope * (x - low) + Vec3(2e-5, -1e-5, 3e-5)); };
    phi.displace(nodes(phi, field));
    for (const Vec3& x : points(0.0)) {
      EXPECT_LT((phi.displacement(x) - field(x)).norm(), 1e-15);
      int steps = 0;
      EXPECT_LT((phi.material(x + field(x), &steps) - x).norm(), 1e-12 * phi.size());
      EXPECT_LE(steps, 3);
    }
    EXPECT_FALSE(phi.folded());
  }
}

TEST(HexahedralMap, FieldsAreInvertedAcrossHexahedra) {
  HexahedralMap phi = map({3, 2, 2});
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> displacement(-2e-4, 2e-4);
  phi.displace(nodes(phi, [&](const Vec3&) {
    return Vec3(displacement(generator), displacement(generator), displacement(generator));
  }));
  for (const Vec3& x : points(2.0)) { // around it, and beyond all, too
    const Vec3 current = x + phi.displacement(x);
    EXPECT_LT((phi.material(current) - x).norm(), 1e-12 * phi.size());
  }
}

TEST(HexahedralMap, NothingMovesBeyondTheOuterNodes) {
  HexahedralMap phi = map({1, 1, 1});
  phi.displace(nodes(phi, [](const Vec3&) { return Vec3(1e-4, 2e-4, -1e-4); }));
  EXPECT_EQ(phi.displacement(high + Vec3(6.1e-3, 0.0, 0.0)), Vec3::Zero());
  EXPECT_LT((phi.displacement(high + Vec3(3e-3, 0.0, 0.0)) - Vec3(0.5e-4, 1e-4, -0.5e-4)).norm(), 1e-15);
  EXPECT_FALSE(phi.may_meet(high + Vec3::Constant(3e-4), high + Vec3::Constant(1e-3)));
  EXPECT_TRUE(phi.may_meet(high + Vec3::Constant(2e-4), high + Vec3::Constant(1e-3)));
}

TEST(HexahedralMap, ForcesWorkAsTheirPointsMove) { // the transpose of (7)
  HexahedralMap phi = map({2, 1, 3});
  const Eigen::VectorXd q = 1e-5 * Eigen::VectorXd::Random(phi.unknowns());
  phi.displace(q);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(phi.unknowns());
  double work = 0.0;
  for (const Vec3& x : points(0.3)) {
    const Vec3 force(1e3 * std::sin(1e3 * x.x()), -2e2, 1e4 * x.z());
    phi.press(x, force, load);
    work += force.dot(phi.displacement(x));
  }
  EXPECT_NEAR(load.dot(q), work, 1e-12 * std::abs(work));
}

TEST(HexahedralMap, FoldsWhereHexahedraAreTurnedInsideOut) {
  HexahedralMap phi = map({1, 1, 1});
  const auto pushed = [&](double way) {
    phi.displace(nodes(phi, [&](const Vec3&) { return Vec3(way, 0.0, 0.0); }));
    return phi.folded();
  };
  EXPECT_FALSE(pushed(5.9e-3)); // the ones beside it are 6 mm wide
  EXPECT_TRUE(pushed(6.1e-3));
  // The box itself: one corner pushed through.
  Eigen::VectorXd q = Eigen::VectorXd::Zero(phi.unknowns());
  q[q.size() - 1] = -4e-3;
  phi.displace(q);
  EXPECT_FALSE(phi.folded());
  q[q.size() - 1] = -6.1e-3;
  phi.displace(q);
  ASSERT_TRUE(phi.folded());
  EXPECT_EQ(*phi.folded(), (std::array{1, 1, 1}));
  EXPECT_NE(phi.name(*phi.folded()).find("hexahedron (1, 1, 1), from (-1, 2, 0) to (11, 5, 6) mm"),
            std::string::npos);
}

namespace {

const Mode swinging{.frequency = 900.0, .damping = 0.02, .stiffness = 1e6, .direction = Vec3(0.6, 0.8, 0.0)};

MillingCut helical(Engagement::Side side) {
  MillingCut cut = milling_cut(3, 767e6, 168.8e6, side, 0.25);
  cut.cutter.helix = std::numbers::pi / 6.0;
  return cut;
}

ProcessSettings few_turns() {
  return {.spindle = 800.0, .axial_depth = 2e-3, .length = 9e-4, .pitch = 1e-4, .layers = 4, .steps = 360};
}

/// A part that moves by share(x) of the direction in one mode. own: of it.
template<class Share>
std::unique_ptr<FlexiblePart> part(const MillingCut& cut, const ProcessSettings& settings, const Mode& own,
                                   Share&& share) {
  const Workpiece block = workpiece_of(cut, settings);
  HexahedralMap over = hexahedra_over(block.low, block.high, cut.cutter.radius());
  const Eigen::VectorXd shape =
      nodes(over, [&](const Vec3& x) { return Vec3(share(x) * own.direction / std::sqrt(own.mass())); });
  return std::make_unique<FlexiblePart>(
      std::move(over),
      std::make_unique<ModalMotion>(shape, std::vector{ModalMotion::Coordinate{own.omega(), own.damping}},
                                    full_turn / settings.spindle / settings.steps));
}

std::vector<ProcessStep> steps_of(MillingProcess process) {
  std::vector<ProcessStep> steps;
  while (!process.at_end()) steps.push_back(process.advance());
  return steps;
}

void expect_the_same_chips(const std::vector<ProcessStep>& a, const std::vector<ProcessStep>& b,
                           double close) {
  ASSERT_EQ(a.size(), b.size());
  double most = 0.0, strongest = 0.0, farthest = 0.0;
  for (const ProcessStep& step : a) {
    most = std::max(most, step.removed);
    strongest = std::max(strongest, step.force.norm());
    farthest = std::max(farthest, step.displacement.norm());
  }
  EXPECT_GT(farthest, 2e-5);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(a[k].removed, b[k].removed, close * most) << k;
    EXPECT_LT((a[k].force - b[k].force).norm(), close * strongest) << k;
  }
}

} // namespace

TEST(FlexiblePart, ATranslationIsThatOfTheToolTheOtherWay) {
  for (const Engagement::Side side : {Engagement::Side::up, Engagement::Side::down})
    for (const double corner : {0.0, 1e-3}) { // flat and bull ends
      MillingCut cut = helical(side);
      cut.cutter.corner = corner;
      const std::vector<ProcessStep> of_tool = steps_of(MillingProcess(cut, {swinging}, few_turns()));
      const std::vector<ProcessStep> of_part = steps_of(MillingProcess(
          cut, {}, few_turns(), part(cut, few_turns(), swinging, [](const Vec3&) { return 1.0; })));
      expect_the_same_chips(of_tool, of_part, 1e-9);
    }
}

TEST(FlexiblePart, MovesAsAModeWhoseShapeChangesOverTheHeight) {
  const MillingCut cut = helical(Engagement::Side::down);
  Mode mode = swinging;
  mode.of = Mode::Of::part;
  mode.height.size = mode.shape_over_height.size = 2;
  mode.height.value[0] = 0.0;
  mode.height.value[1] = 2e-3;
  mode.shape_over_height.value[0] = 0.5;
  mode.shape_over_height.value[1] = 1.0;
  const std::vector<ProcessStep> shaped = steps_of(MillingProcess(cut, {mode}, few_turns()));
  const std::vector<ProcessStep> mapped =
      steps_of(MillingProcess(cut, {}, few_turns(), part(cut, few_turns(), swinging, [](const Vec3& x) {
                                return 0.5 + 0.25 * x.z() / 1e-3;
                              })));
  expect_the_same_chips(shaped, mapped, 1e-9);
}

TEST(FlexiblePart, TakesWhatDrivesPutInBeyondTheCut) { // also where it is lifted along the axis
  MillingCut cut = helical(Engagement::Side::down);
  LinearLaw law{.Ktc = 767e6};
  law.Krc = 168.8e6;
  law.Kac = 222e6;
  cut.law = CuttingLaw(law);
  Mode lifting = swinging;
  lifting.direction = Vec3(0.0, 0.6, 0.8);
  MillingProcess process(cut, {}, few_turns(), part(cut, few_turns(), lifting, [](const Vec3& x) {
                           return 1.0 + 0.1 * x.z() / 1e-3;
                         }));
  while (!process.at_end()) process.advance();
  EXPECT_GT(process.ledger().part, 0.0);
  EXPECT_LT(process.ledger().share(), 1e-4);
}

TEST(FlexiblePart, EndsWhereItIsNotOneToOneAnyMore) {
  const MillingCut cut = helical(Engagement::Side::down);
  Mode heavy = swinging; // goes away from the cutter, slowly, in two halves
  heavy.frequency = 1.0;
  heavy.stiffness = 0.02 * heavy.omega() * heavy.omega();
  MillingProcess process(cut, {}, few_turns(), part(cut, few_turns(), heavy, [](const Vec3& x) {
                           return x.x() > 3e-3 ? 1.0 : -1.0;
                         }));
  const double volume = process.volume();
  try {
    while (!process.at_end()) process.advance();
    FAIL() << "a wall as soft as that folds";
  } catch (const DivergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("hexahedron ("), std::string::npos) << error.what();
  }
  EXPECT_LE(process.volume(), volume);
  EXPECT_TRUE(std::isfinite(process.volume()));
}

} // namespace cnem::machining
