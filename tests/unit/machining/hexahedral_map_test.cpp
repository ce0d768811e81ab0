// The extended mapping of a deformed workpiece, and cuts in a part that it follows.
#include "machining/hexahedral_map.hpp"

#include "core/error.hpp"
#include "core/fields/memory_archive.hpp"
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
      std::make_unique<ModalMotion>(shape, std::vector{ModalMotion::Coordinate{own.omega(), own.damping}}));
}

std::vector<ProcessStep> steps_of(MillingProcess process) {
  std::vector<ProcessStep> steps;
  while (!process.at_end()) steps.push_back(process.advance());
  return steps;
}

/// Names and bits of what evolves.
class Bits final : public Archive {
public:
  bool loading() const override { return false; }
  std::string text;

private:
  std::size_t extent(const std::string&) override { return 0; }
  void carry(const std::string& name, const char*, std::span<double> values) override {
    text.append(name).append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void carry(const std::string& name, std::span<std::int64_t> values) override {
    text.append(name).append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void carry(const std::string& name, std::string& value) override { text.append(name).append(value); }
};

/// What a checkpoint holds of it.
std::string state_of(MillingProcess& process) {
  Bits bits;
  process.archive(bits);
  return bits.text;
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
  const MillingLedger& ledger = process.ledger();
  EXPECT_GT(ledger.kinetic, 0.0);
  EXPECT_GT(ledger.elastic, 0.0);
  EXPECT_GT(ledger.damping, 0.0);
  EXPECT_EQ(ledger.chips, 0.0) << "modes of one structure";
  EXPECT_LT(ledger.share(), 1e-4);
  const EnergyLedger& part = process.part()->energy();
  EXPECT_LT(std::abs(part.imbalance()), 1e-9 * part.work);
}

namespace {

/// Two passes round a corner of a block, the second into what the first has left.
ProcessSettings round_a_corner(const std::optional<DriveTables>& drive) {
  std::vector<ToolPath> passes;
  for (const double off : {5.6e-3, 5.2e-3}) {
    const Vec2 corner(2e-3, -2e-3), from(-8e-3, off), top(2e-3, off), side(2e-3 + off + 2e-3, -2e-3);
    passes.emplace_back(std::vector<CurvePiece>{
        {.from = from, .to = top, .name = ""},
        {.from = top, .to = side, .centre = corner, .radius = off + 2e-3, .clockwise = true, .name = ""},
        {.from = side, .to = side + Vec2(0.0, -9e-3), .name = ""}});
  }
  return {.spindle = 800.0,
          .axial_depth = 2e-3,
          .start = ProcessSettings::Start::outside,
          .pitch = 2e-4,
          .layers = 3,
          .steps = 90,
          .passes = std::move(passes),
          .blank = Blank{.low = Vec2(0.0, -6e-3), .high = Vec2(4e-3, 0.0), .height = 2e-3},
          .drive = drive};
}

} // namespace

TEST(FlexiblePart, ATranslationIsThatOfTheToolInPassesAndWhileTheSpeedChanges) {
  MillingCut cut = helical(Engagement::Side::down);
  cut.feed = 2e-4;
  const DriveTables drive{TimeTable({0.0, 0.4, 0.6}, {800.0, 800.0, 500.0}), TimeTable(2e-4)};
  for (const auto& changes : {std::optional<DriveTables>{}, std::optional<DriveTables>{drive}}) {
    const ProcessSettings settings = round_a_corner(changes);
    const std::vector<ProcessStep> of_tool = steps_of(MillingProcess(cut, {swinging}, settings));
    const std::vector<ProcessStep> of_part = steps_of(
        MillingProcess(cut, {}, settings, part(cut, settings, swinging, [](const Vec3&) { return 1.0; })));
    expect_the_same_chips(of_tool, of_part, 1e-9);
  }
}

TEST(FlexiblePart, GoesOnFromWhatACheckpointHoldsWithinPasses) {
  MillingCut cut = helical(Engagement::Side::down);
  cut.feed = 4e-4;
  const ProcessSettings settings =
      round_a_corner(DriveTables{TimeTable({0.0, 0.15, 0.4}, {800.0, 800.0, 500.0}), TimeTable(4e-4)});
  const auto process = [&] {
    return MillingProcess(cut, {}, settings, part(cut, settings, swinging, [](const Vec3&) { return 1.0; }));
  };
  MillingProcess whole = process(), rest = process();
  const std::int64_t second = whole.motion().passes()[1].begin;
  for (const std::int64_t at : {second / 2, second, second + 1, second + second / 2}) {
    while (whole.steps() < at) whole.advance();
    MemoryArchive checkpoint;
    whole.archive(checkpoint);
    checkpoint.recall();
    rest = process();
    rest.archive(checkpoint);
    EXPECT_EQ(state_of(rest), state_of(whole)) << at;
    for (int step = 0; step < 100; ++step) {
      whole.advance();
      rest.advance();
    }
    EXPECT_EQ(state_of(rest), state_of(whole)) << at;
  }
}

TEST(FlexiblePart, IsAtRestBetweenPasses) {
  const MillingCut cut = helical(Engagement::Side::down);
  const ProcessSettings settings = round_a_corner(std::nullopt);
  MillingProcess process(cut, {}, settings, part(cut, settings, swinging, [](const Vec3&) { return 1.0; }));
  const std::int64_t second = process.motion().passes()[1].begin;
  while (process.steps() < second) process.advance();
  EXPECT_GT(process.part()->end().largest(), 0.0);
  const MillingLedger before = process.ledger();
  process.advance(); // in the air
  EXPECT_EQ(process.part()->end().largest(), 0.0);
  EXPECT_EQ(process.ledger().kinetic + process.ledger().elastic, 0.0);
  EXPECT_EQ(process.ledger().damping, before.damping + (before.kinetic + before.elastic));
  while (!process.at_end()) process.advance();
  EXPECT_LT(process.ledger().share(), 1e-3) << "90 steps a turn";
}

TEST(FlexiblePart, EndsWhereItIsNotOneToOneAnyMore) {
  const MillingCut cut = helical(Engagement::Side::down);
  Mode heavy = swinging; // goes away from the cutter, slowly, in two halves
  heavy.frequency = 1.0;
  heavy.stiffness = 0.02 * heavy.omega() * heavy.omega();
  MillingProcess process(cut, {}, few_turns(), part(cut, few_turns(), heavy, [](const Vec3& x) {
                           return x.x() > 3e-3 ? 1.0 : -1.0;
                         }));
  std::string before;
  try {
    while (!process.at_end()) {
      before = state_of(process);
      process.advance();
    }
    FAIL() << "a wall as soft as that folds";
  } catch (const DivergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("hexahedron ("), std::string::npos) << error.what();
  }
  EXPECT_EQ(state_of(process), before) << "to the bit";
}

TEST(FlexiblePart, AStepThatIsNotMadeLeavesNothing) { // forces and vibration do not agree
  MillingCut cut = helical(Engagement::Side::up);
  Mode soft = swinging; // an edge of its stiffness passes far beyond it in a step
  soft.frequency = 2e4;
  soft.stiffness = 1e3;
  for (const bool mapped : {false, true}) {
    ProcessSettings settings = few_turns();
    settings.steps = 90;
    MillingProcess process(cut, mapped ? std::vector<Mode>{} : std::vector<Mode>{soft}, settings,
                           mapped ? part(cut, settings, soft, [](const Vec3&) { return 1.0; }) : nullptr);
    std::string before;
    bool failed = false;
    while (!process.at_end() && !failed) {
      before = state_of(process);
      try {
        process.advance();
      } catch (const DivergenceError&) { failed = true; }
    }
    ASSERT_TRUE(failed) << mapped;
    EXPECT_EQ(state_of(process), before) << mapped;
    EXPECT_THROW(process.advance(), DivergenceError) << "the same step once more";
    EXPECT_EQ(state_of(process), before) << mapped;
  }
}

} // namespace cnem::machining
