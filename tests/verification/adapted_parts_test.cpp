// Adaptation of bodies of several parts: bonded interfaces, periodic sides and cracks stay what they are
// while their nodes come and go.
#include "app/adaptation.hpp"
#include "core/error.hpp"
#include "core/geometry/mates.hpp"
#include "input/case_reader.hpp"
#include "results/adaptation_log.hpp"
#include "tests/shared_cases.hpp"
#include "tests/solver_of.hpp"
#include "tests/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <stdexcept>

namespace cnem::testing {
namespace {

using Texts = std::vector<std::string>;

// An interface divides the block under the punch.
const std::string layered_block = punched_block + soft_metal + R"toml(
[time]
end = "10 us"
[domain.interfaces.joint]
points = ["0 1.4 mm", "4 1.4 mm"]
[boundary.side]
pieces = ["right"]
symmetry = true
[adapt]
resample = true
[adapt.indicator]
field = "plastic_strain"
h_min = "0.1 mm"
)toml";

const std::string lower_soft = "domain.regions={ below = { at = \"1 0.5 mm\", material = \"soft\" } }";
const std::string whole = "domain.interfaces={}";

/// A run step by step, with the cloud renewed every 20 steps, and `look` after that.
class Course {
public:
  Course(const std::string& text, const Texts& overrides)
      : folder_("parts"), input_(input::read_case_text(text, "case.toml", overrides)),
        solver_(solver_of(input_)), adaptation_(input_, solver_) {
    adaptation_.start_log(folder_.path());
  }

  template<class Look> void run(const Look& look) {
    while (solver_.state().time < input_.time.end) {
      for (int n = 0; n < 20 && solver_.state().time < input_.time.end; ++n)
        solver_.advance(std::min(solver_.stable_step().dt, input_.time.end - solver_.state().time));
      try {
        adaptation_.renew(solver_, [](const Resampling<2>&) {});
      } catch (const GeometryError&) {
        ++not_renewed; // as a run does, which goes on with the reference it has
        continue;
      }
      look();
    }
  }
  void fit() {
    adaptation_.fit_to_tools(solver_, [](const Resampling<2>&) {});
  }
  void step() { solver_.advance(solver_.stable_step().dt); }
  void run() {
    run([] {});
  }

  int not_renewed = 0; ///< times
  const ExplicitSolver<2>& solver() const { return solver_; }
  double counted(const std::string& what) const {
    for (const auto& [name, value] : adaptation_.metrics())
      if (name == "adapt." + what) return value;
    throw std::out_of_range(what);
  }
  /// The least distance of two nodes on a piece, m.
  double finest(const std::string& name) const {
    double least = 1.0;
    const Cloud<2>& cloud = solver_.conditions().cloud;
    for (const Facet<2>& facet : cloud.facets)
      if (cloud.piece_names[facet.piece] == name)
        least = std::min(least, (at(facet.node[1]) - at(facet.node[0])).norm());
    return least;
  }
  Vec2 at(NodeIndex i) const {
    const auto& position = solver_.state().node.position;
    return {position[0][index_of(i)], position[1][index_of(i)]};
  }
  /// Mass of each material, kg/m.
  std::map<std::int32_t, double> masses() const {
    std::map<std::int32_t, double> sum;
    const auto& node = solver_.state().node;
    for (std::size_t i = 0; i < node.size(); ++i) sum[node.material[i]] += node.mass[i];
    return sum;
  }
  /// Nothing is lost, whatever the parts. allowed: references that could not be renewed.
  void expect_kept(int allowed = 0) const {
    for (const char* what : {"mass_error", "momentum_error", "heat_error"})
      EXPECT_LT(counted(what), 1e-12) << what;
    EXPECT_LT(counted("energy_error"), 1e-10);
    EXPECT_EQ(counted("outside"), 0.0);
    EXPECT_LE(not_renewed, allowed);
    EXPECT_LT(std::abs(solver_.ledger().residual()), 1e-3 * solver_.ledger().external());
  }

private:
  TemporaryFolder folder_;
  input::Case input_;
  ExplicitSolver<2> solver_;
  app::Adaptation adaptation_;
};

/// Mates move as one, to the bit, and stand as far apart as at the start, to rounding; warm: with one
/// temperature.
void expect_bonded(const Course& course, const Vec2& period, bool warm = true) {
  const Cloud<2>& cloud = course.solver().conditions().cloud;
  const auto& node = course.solver().state().node;
  const auto pairs = mated_nodes(cloud);
  ASSERT_FALSE(pairs.empty());
  for (const auto& [a, b] : pairs) {
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(node.velocity[k][index_of(a)], node.velocity[k][index_of(b)]);
      if (period.norm() == 0.0) { ASSERT_EQ(node.position[k][index_of(a)], node.position[k][index_of(b)]); }
    }
    const Vec2 apart = course.at(a) - course.at(b);
    ASSERT_LT(std::min((apart - period).norm(), (apart + period).norm()), 1e-17);
    if (warm) { ASSERT_EQ(node.temperature[index_of(a)], node.temperature[index_of(b)]); }
  }
}

TEST(AdaptedParts, a_bonded_block_is_as_good_as_a_whole_one) {
  Course one(layered_block, {whole}), two(layered_block, {});
  one.run();
  two.run([&] { expect_bonded(two, Vec2::Zero()); });
  for (const Course* course : {&one, &two}) {
    course->expect_kept();
    EXPECT_GT(course->counted("inserted"), 100);
  }
  EXPECT_LT(two.finest("joint+"), 0.2e-3);
  const EnergyLedger a = one.solver().ledger(), b = two.solver().ledger();
  for (const char* what : {"plastic", "tool_work", "heat_content"})
    EXPECT_NEAR(b[what], a[what], 0.005 * a[what]) << what;
  EXPECT_LT(two.counted("angular_momentum_change"), 2.0 * one.counted("angular_momentum_change") + 1e-6);
}

TEST(AdaptedParts, matter_stays_with_its_material) {
  Course course(layered_block, {lower_soft});
  const auto before = course.masses();
  ASSERT_EQ(before.size(), 2U);
  course.run([&] { expect_bonded(course, Vec2::Zero()); });
  course.expect_kept();
  for (const auto& [material, mass] : course.masses()) EXPECT_NEAR(mass, before.at(material), 1e-12 * mass);
  EXPECT_GT(course.counted("inserted_boundary"), 20);
  // each point has the material of its side: the interface has come down, but its ends hold no slag
  const auto& state = course.solver().state();
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    ASSERT_EQ(state.node.material[i], state.point.material[i]);
    if (state.node.initial_position[1][i] > 1.45e-3) { EXPECT_EQ(state.node.material[i], 0); }
    if (state.node.initial_position[1][i] < 1.35e-3) { EXPECT_EQ(state.node.material[i], 1); }
  }
}

TEST(AdaptedParts, heat_crosses_a_conductance_between_new_nodes) {
  Course course(layered_block, {"domain.interfaces.joint.conductance=\"1e5 W/(m2 K)\"",
                                "domain.regions={ below = { at = \"1 0.5 mm\", temperature = \"500 K\" } }"});
  course.run([&] { expect_bonded(course, Vec2::Zero(), false); });
  course.expect_kept();
  EXPECT_LT(course.finest("joint+"), 0.2e-3);
  const Cloud<2>& cloud = course.solver().conditions().cloud;
  const Field& temperature = course.solver().state().node.temperature;
  double jump = 0.0;
  for (const auto& [a, b] : mated_nodes(cloud))
    jump = std::max(jump, std::abs(temperature[index_of(a)] - temperature[index_of(b)]));
  EXPECT_GT(jump, 50.0) << "a resistance";
  EXPECT_LT(std::abs(course.solver().ledger().heat_residual()),
            1e-10 * course.solver().ledger()["heat_content"]);
}

/// A strip of an endless layer that is pressed; what holds one side holds the other.
TEST(AdaptedParts, periodic_sides_stay_a_period_apart) {
  Course course(layered_block, {whole, "boundary.side={ pieces = [\"right\"], temperature = \"300 K\" }",
                                "periodic.strip.pieces=[\"left\", \"right\"]",
                                "tools.punch.rectangle={ from = \"-1 2 mm\", to = \"6 5 mm\" }",
                                "adapt.indicator.tolerance=0.01",
                                "initial.imperfections.line={ points = [\"0 1 mm\", "
                                "\"4 1.6 mm\"], width = \"0.3 mm\", reduction = 0.2 }"});
  course.run([&] { expect_bonded(course, Vec2(4e-3, 0.0)); });
  course.expect_kept();
  EXPECT_LT(course.finest("left"), 0.2e-3);
  EXPECT_NEAR(course.finest("left"), course.finest("right"), 1e-15);
  course.step(); // supports take hold of new nodes
  const auto& node = course.solver().state().node;
  for (const auto& [a, b] : mated_nodes(course.solver().conditions().cloud))
    EXPECT_EQ(node.temperature[index_of(a)], 300.0);
}

/// Before the first step a crack beside a tool is refined, both faces alike; then it slips, and they are two.
TEST(AdaptedParts, faces_of_a_crack_match_until_they_part) {
  Course course(layered_block, {whole, "contact.deformable=true", "adapt.tool_spacing=\"0.03 mm\"",
                                "domain.cracks.cut={ points = [\"1.15 2 mm\", \"1.15 0.8 mm\"] }"});
  const auto matched = [&] {
    const auto& mates = course.solver().conditions().cloud.mates;
    return std::count_if(mates.begin(), mates.end(), [](CloudFacetIndex f) { return exists(f); });
  };
  const auto start = matched();
  course.fit();
  EXPECT_GT(matched(), start + 4);
  EXPECT_LT(course.finest("cut+"), 0.07e-3);
  for (const auto& [a, b] : mated_nodes(course.solver().conditions().cloud))
    EXPECT_EQ(course.at(a), course.at(b));
  course.run();
  course.expect_kept();
  EXPECT_LT(matched(), start);
  EXPECT_GT(course.counted("inserted_boundary"), 20);
}

// Two layers, bonded and not along the sheet, between a punch and a die.
const std::string layered_sheet = blanked_slug + R"toml(
[time]
end = "11 us"
[domain.interfaces.joint]
points = ["0 0.5 mm", "5 1.2 mm"]
[contact]
deformable = true
)toml";

/// Bodies that nothing joins: neither cells nor mates.
int bodies(const Cloud<2>& cloud) {
  const adapt::Structure structure = adapt::build_structure(cloud);
  IndexedVector<NodeIndex, std::vector<NodeIndex>> joined(cloud.position.size());
  for (const NodeIndex i : joined.indices()) {
    const auto around = structure.neighbours(i);
    joined[i].assign(around.begin(), around.end());
  }
  for (const auto& [a, b] : mated_nodes(cloud)) {
    joined[a].push_back(b);
    joined[b].push_back(a);
  }
  IndexedVector<NodeIndex, char> seen(joined.size(), 0);
  int count = 0;
  for (const NodeIndex i : joined.indices()) {
    if (seen[i]) continue;
    ++count;
    std::vector<NodeIndex> front{i};
    seen[i] = 1;
    while (!front.empty()) {
      const NodeIndex k = front.back();
      front.pop_back();
      for (const NodeIndex next : joined[k])
        if (!seen[next]) {
          seen[next] = 1;
          front.push_back(next);
        }
    }
  }
  return count;
}

TEST(AdaptedParts, a_cut_goes_through_an_interface) {
  Course course(layered_sheet, {"cloud.spacing=\"0.305 mm\""}); // what breaks on both faces is chance
  EXPECT_EQ(bodies(course.solver().conditions().cloud), 1);
  course.run([&] { expect_bonded(course, Vec2::Zero()); });
  course.expect_kept();
  EXPECT_EQ(course.counted("cuts"), 1.0);
  EXPECT_EQ(bodies(course.solver().conditions().cloud), 2) << "a slug of two layers, and the rest";
}

} // namespace
} // namespace cnem::testing
