// A cutter from the STL file of a rake face, from the case to the forces, beside the same one by its angles.
#include "tests/finished_run.hpp"

#include <fmt/format.h>
#include <fstream>
#include <numbers>

namespace cnem::testing {
namespace {

constexpr const char* cut = R"toml(
[analysis]
type = "milling"

[cutting.forces] # Ti6Al4V; the inclination is that of the edge
law = "oblique"
shear_stress = "613 MPa"
friction_angle = "22.6 deg"
rake = "0 deg"
chip_ratio = 1.4
Kte = "24 N/mm"
Kre = "43 N/mm"

[milling]
speed = "3000 rpm"
feed = "0.1 mm"
axial_depth = "2 mm"
radial_depth = "4 mm"
length = "0.8 mm"

[dexels]
layers = 20
steps = 180

[cutter]
diameter = "10 mm"
teeth = 2
)toml";

/// A text of the rake face of a straight or ball end of R 5 mm with a helix, in mm: strips a degree of the
/// profile wide, 1 mm deep, that point at the axis.
std::string face(bool ball, double helix) {
  std::string text = "solid rake\n";
  constexpr double R = 5.0;
  const double top = ball ? R : 3.0;
  constexpr int rows = 60;
  struct Row {
    Vec3 edge, inner;
  };
  const auto row = [&](int k) -> Row {
    const double share = static_cast<double>(k) / rows;
    const double arc = share * std::acos(1.0 - top / R);
    const double z = ball ? R * (1.0 - std::cos(arc)) : top * share, r = ball ? R * std::sin(arc) : R;
    const double lag = z * std::tan(helix) / R;
    const Vec3 out(-std::sin(lag), std::cos(lag), 0.0);
    return {r * out + z * Vec3::UnitZ(), std::max(0.0, r - 1.0) * out + z * Vec3::UnitZ()};
  };
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    if ((b - a).cross(c - a).norm() == 0.0) return;
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Vec3& x : {a, b, c}) text += fmt::format("vertex {:.7e} {:.7e} {:.7e}\n", x.x(), x.y(), x.z());
    text += "endloop\nendfacet\n";
  };
  for (int k = 0; k < rows; ++k) {
    const Row low = row(k), high = row(k + 1);
    add(low.edge, high.edge, low.inner);
    add(low.inner, high.edge, high.inner);
  }
  return text + "endsolid rake\n";
}

} // namespace

TEST(MillingRakeFace, CutsAsTheCutterOfItsAngles) {
  const TemporaryFolder folder("rake_face");
  const auto run = [&](const std::string& cutter) {
    std::ofstream(folder.path() / "case.toml") << cut << cutter;
    return finish(input::read_case((folder.path() / "case.toml").string()));
  };
  for (const bool ball : {false, true}) {
    const double helix = ball ? 0.0 : 30.0 * std::numbers::pi / 180.0; // on a ball a helix changes its angle
    std::ofstream(folder.path() / "rake.stl") << face(ball, helix);
    const FinishedRun known = run(ball ? "end = \"ball\"" : "helix = \"30 deg\"");
    const FinishedRun traced = run("rake_face = { file = \"rake.stl\" }");
    const std::vector<double>& angle = known.of("angle");
    ASSERT_EQ(known.history.rows(), traced.history.rows());
    double most = 0.0, apart = 0.0;
    for (std::size_t k = 0; k < angle.size(); ++k) {
      if (angle[k] < 4.0 * std::numbers::pi) continue;
      Vec3 one, two;
      for (const auto& [axis, name] : {std::pair{0, "Fx"}, {1, "Fy"}, {2, "Fz"}}) {
        one[axis] = known.of(name)[k];
        two[axis] = traced.of(name)[k];
      }
      most = std::max(most, one.norm());
      apart = std::max(apart, (one - two).norm());
    }
    EXPECT_GT(most, 100.0);
    EXPECT_LT(apart, 0.01 * most) << (ball ? "ball" : "flat");
    EXPECT_NEAR(traced.metric("milling.removal_rate") / known.metric("milling.removal_rate"), 1.0, 1e-3);
    EXPECT_NEAR(traced.metric("milling.power") / known.metric("milling.power"), 1.0, 2e-3);
  }
}

} // namespace cnem::testing
