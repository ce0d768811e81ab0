// What a node and step of a case will cost.
#include "input/case_reader.hpp"
#include "tests/unit/app/forecast_fixture.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

const std::string block = R"toml(
[time]
end = "20 us"
[domain]
material = "matter"
outer.rectangle = { from = "0 0 mm", to = "4 4 mm" }
[cloud]
spacing = "0.2 mm"
[boundary.low]
pieces = ["bottom"]
velocity = "0 0 m/s"
[method]
lagrangian = "total"
[materials.matter]
density = "1580 kg/m3"
)toml";

const std::string metal = block + R"toml(elastic = { young = "10 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "100 MPa" }
)toml";

const std::string ply =
    block +
    R"toml(elastic = { law = "orthotropic", E1 = "34 GPa", E2 = "12 GPa", E3 = "12 GPa", nu12 = 0.24, nu13 = 0.24, nu23 = 0.24, G12 = "2 GPa" }
)toml";

std::string failing(const std::string& law) {
  return ply + "[materials.matter.failure]\nlaw = \"" + law + "\"\n" +
         (law == "larc02" ? "eps1t = 0.023\n" : "Xt = \"700 MPa\"\n") +
         (law == "max-stress" ? "Gs = \"1 kJ/m2\"\n" : "") + R"toml(Xc = "440 MPa"
Yt = "90 MPa"
Yc = "148 MPa"
S = "33 MPa"
Gft = "12 kJ/m2"
Gfc = "12 kJ/m2"
Gmt = "1 kJ/m2"
Gmc = "1 kJ/m2"
)toml";
}

/// ns of a node and step.
double cost_of(const input::Case& input) {
  const Forecast expected = expected_of(input);
  return 1e9 * expected.seconds / (expected.nodes_mean * expected.steps);
}

double cost_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return cost_of(input::read_case_text(text, "case.toml", overrides));
}

TEST(ForecastOfCosts, PliesAndTheirFailureCostMoreThanMetal) {
  const double of_metal = cost_of(metal), of_ply = cost_of(ply);
  EXPECT_NEAR(of_metal, 90.0, 0.1) << "steps are rounded up";
  EXPECT_GT(of_ply, 2.0 * of_metal);
  EXPECT_GT(cost_of(ply + "plastic = { law = \"perfect\", yield = \"100 MPa\" }\n"), 1.3 * of_ply);
  EXPECT_GT(cost_of(failing("hashin")), 1.3 * of_ply);
  EXPECT_NEAR(cost_of(failing("max-stress")), cost_of(failing("hashin")), 0.1);
  EXPECT_GT(cost_of(failing("larc02")), 2.0 * cost_of(failing("hashin"))) << "it searches planes of fracture";
}

TEST(ForecastOfCosts, SheetsThatFlowCostMore) {
  const std::vector<std::string> sheet{"analysis.kinematics=plane stress"};
  EXPECT_GT(cost_of(metal, sheet), 1.5 * cost_of(metal));
  EXPECT_NEAR(cost_of(ply, sheet), cost_of(ply), 0.1) << "plies are flat in any case";
}

TEST(ForecastOfCosts, OfMethodsIsThatOfTheirPointsAndRows) {
  const double cells = cost_of(ply), wide = cost_of(ply, {"method.functions=mls"}),
               triangles = cost_of(ply, {"method.name=fe-triangles"}),
               gauss = cost_of(ply, {"method.name=efg"});
  EXPECT_GT(wide, 1.2 * cells);
  EXPECT_GT(triangles, 1.5 * cells) << "two points a node";
  EXPECT_GT(gauss, 5.0 * cells) << "six points a node, with wide rows";
}

TEST(ForecastOfCosts, OfBondedFibresIsThatOfRunsBondsAndDebris) {
  const auto with = [](std::vector<std::string> overrides) {
    overrides.emplace_back("output.pictures=[]");
    return cost_of(
        input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/composites/flax_pla/case.toml", overrides));
  };
  const std::string one = "domain.fibres.flax.material=pla", whole = "adapt.separate=false",
                    film = "adapt.thinnest_film=0 um";
  const double fibres = with({}), alike = with({one}), bonded = with({one, whole, film});
  EXPECT_GT(fibres, alike + 120.0) << "points of two materials in turns";
  EXPECT_GT(alike, bonded + 130.0) << "debris, and passes of it";
}

TEST(ForecastOfCosts, OfBondsAddsToTheBody) {
  const std::string bond = R"toml([domain.interfaces.joint]
points = ["0 2 mm", "4 2 mm"]
cohesive = { stiffness = "40 GPa/mm", strength = "60 MPa", energy = "300 J/m2" }
)toml";
  const double bonded = cost_of(metal + bond), body = cost_of(metal);
  EXPECT_GT(bonded, body + 2.0);
  EXPECT_LT(bonded, body + 10.0) << "20 elements among more than 400 nodes";
}

} // namespace
} // namespace cnem::app
