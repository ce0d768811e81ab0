// Places are counted from beside the workpiece where it is far from (0, 0), and from (0, 0) where it is near.
#include "input/local_origin.hpp"

#include "input/schema/schema.hpp"
#include "tests/unit/input/case_text.hpp"

#include <fmt/format.h>
#include <set>

namespace cnem::input {
namespace {

/// A case with every kind of place, its parts at (x, y) m.
std::string everywhere(double x, double y, const std::string& kinematics = "plane strain") {
  const auto at = [&](double dx, double dy) { return fmt::format("\"{} {} m\"", x + dx, y + dy); };
  return fmt::format(
      R"toml(analysis.kinematics = "{}"
time.end = "1 us"
[domain]
material = "steel"
outer = {{ start = {}, path = [{{ to = {} }}, {{ to = {}, fillet = "0.1 m" }}, {{ to = {} }}] }}
holes.bore.circle = {{ centre = {}, radius = "0.1 m" }}
cracks.main.points = [{}, {}]
interfaces.bond.points = [{}, {}]
regions.half.at = {}
[cloud]
spacing = "0.25 m"
refine.a = {{ box = [{}, {}], spacing = "0.1 m" }}
refine.b = {{ points = [{}], spacing = "0.1 m" }}
refine.c = {{ tips = ["main"], spacing = "0.1 m" }}
[materials.steel]
density = "7850 kg/m3"
elastic = {{ young = "210 GPa", poisson = 0.3 }}
plastic = {{ law = "perfect", yield = "1 MPa" }}
heat = {{ specific_heat = "500 J/(kg K)", conductivity = "15 W/(m K)" }}
[boundary.hold]
points = [{}]
velocity = {{ x = "0 m/s" }}
[initial]
spin = {{ rate = "1 rad/s", centre = {} }}
velocity_gradient = {{ xx = "1 1/s", centre = {} }}
imperfections.weak = {{ points = [{}], width = "0.1 m", reduction = 0.1 }}
[tools.punch]
circle = {{ centre = {}, radius = "0.5 m" }}
heat.conductivity = "60 W/(m K)"
heat.density = "15000 kg/m3"
heat.specific_heat = "200 J/(kg K)"
[tools.punch.heat.section]
spacing = "0.2 m"
refine.a = {{ box = [{}, {}], spacing = "0.1 m" }}
refine.b = {{ points = [{}], spacing = "0.1 m" }}
[coolants.jet]
coefficient = "1e4 W/(m2 K)"
temperature = "293 K"
box = [{}, {}]
[output]
windows.corner.box = [{}, {}]
probes.p = {{ at = {}, fields = ["pressure"] }}
lines.l = {{ from = {}, to = {}, fields = ["pressure"] }}
)toml",
      kinematics, at(0, 0), at(4, 0), at(4, 2), at(0, 2), at(1, 0.5), at(2.5, 1), at(2.75, 1), at(3, 0),
      at(3, 2), at(3.5, 0.5), at(0, 0), at(1, 1), at(0.5, 0.5), at(4, 0), at(2, 1), at(1, 1), at(1.5, 1.5),
      at(2, 2.5), at(2, 2), at(2.5, 3), at(1.5, 2.5), at(1, 1), at(2, 1.5), at(0, 0), at(1, 1), at(0.5, 1),
      at(0.25, 0.5), at(2, 0.5));
}

std::vector<Vec2> places(const Case& c) {
  std::vector<Vec2> all;
  const auto add = [&](const std::vector<Vec2>& points) {
    all.insert(all.end(), points.begin(), points.end());
  };
  const auto add_places = [&](const std::vector<Vec3>& points) {
    for (const Vec3& x : points) all.emplace_back(x.head<2>());
  };
  const auto outline = [&](const Curve& curve) {
    for (const CurvePiece& piece : curve.pieces) {
      add({piece.from, piece.to});
      if (piece.is_arc()) add({piece.centre});
    }
  };
  outline(c.domain.outer);
  outline(c.domain.holes.at(0).outline);
  add(c.domain.cracks.at(0).path);
  add(c.domain.interfaces.at(0).path);
  add({c.domain.regions.at(0).at});
  for (const clouds::Refinement& refinement : c.cloud.refinements) add(refinement.points);
  add_places(c.boundary.at(0).points);
  add({c.coolants.at(0).box->front(), c.coolants.at(0).box->back()});
  add({c.initial.spin->centre, c.initial.gradient->centre});
  add(c.initial.imperfections.at(0).points);
  outline(c.tools.at(0).outline);
  for (const clouds::Refinement& refinement : c.tools.at(0).section->spacing.refinements)
    add(refinement.points);
  add({c.output.windows.at(0).lower, c.output.windows.at(0).upper});
  add_places({c.output.probes.at(0).at, c.output.lines.at(0).from, c.output.lines.at(0).to});
  return all;
}

Case read(double x, double y, const std::string& kinematics = "plane strain") {
  return read_case_text(everywhere(x, y, kinematics), "case.toml");
}

TEST(LocalOrigin, every_place_is_counted_from_it) {
  const Case near = read(0, 0), far = read(4096, -8192);
  EXPECT_EQ(near.origin, Vec3(0, 0, 0));
  EXPECT_LT((far.origin - Vec3(4098, -8191, 0)).norm(), 4.0) << "beside the middle of the workpiece";
  const std::vector<Vec2> expected = places(near), found = places(far);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_LT((expected[k] - (found[k] + far.origin.head<2>() - Vec2(4096, -8192))).norm(), 1e-11) << k;
  EXPECT_NE(far.resolved.find("4096"), std::string::npos) << "the resolved case says where things are";
}

TEST(LocalOrigin, stays_where_the_workpiece_is_near) {
  EXPECT_EQ(read(2, 3).origin, Vec3(0, 0, 0));
  EXPECT_EQ(read(0, 1000).origin.x(), 0.0) << "each axis by itself";
  EXPECT_GT(read(0, 1000).origin.y(), 900.0);
}

TEST(LocalOrigin, leaves_the_radius_of_round_bodies) {
  std::string text = everywhere(1000, 1000, "axisymmetric");
  for (const char* gone : {"spin =", "velocity_gradient =", "cracks.main", "refine.c"}) {
    const auto begin = text.find(gone);
    text.erase(begin, text.find('\n', begin) - begin);
  }
  const Case round = read_case_text(text, "case.toml");
  EXPECT_EQ(round.origin.x(), 0.0);
  EXPECT_GT(round.origin.y(), 900.0);
}

TEST(LocalOrigin, of_a_node_list) {
  const std::string list = R"(time.end = "1 us"
domain = { material = "steel", outer.rectangle = { from = "1024 0 m", to = "1025 1 m" } }
cloud = { pattern = "list", nodes = ["1024 0 m", "1025 0 m", "1025 1 m", "1024 1 m", "1024.5 0.5 m"] }
materials.steel = { density = "7850 kg/m3", elastic = { young = "210 GPa", poisson = 0.3 } }
)";
  const Case c = read_case_text(list, "case.toml");
  EXPECT_EQ(c.cloud.nodes[4] + c.origin.head<2>(), Vec2(1024.5, 0.5));
  EXPECT_LT(c.cloud.nodes[4].norm(), 2.0);
}

TEST(LocalOrigin, of_where_an_interface_is_open) {
  const Case c = read_case_text(R"(time.end = "1 us"
analysis.thermal = false
[domain]
material = "steel"
outer.rectangle = { from = "1024 0 m", to = "1026 1 m" }
interfaces.joint.points = ["1024 0.5 m", "1026 0.5 m"]
interfaces.joint.cohesive = { stiffness = "1e12 Pa/m", strength = "1 MPa", energy = "10 J/m2", open = ["1024 0.5 m", "1025 0.5 m"] }
[cloud]
spacing = "0.5 m"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
)",
                                "case.toml");
  const Interface& interface = c.domain.interfaces.at(0);
  EXPECT_EQ(interface.open.at(1) + c.origin.head<2>(), Vec2(1025, 0.5));
  EXPECT_LT(interface.open.at(1).norm(), 2.0);
  EXPECT_EQ(interface.cohesive->shear_strength, 1e6);
  EXPECT_EQ(interface.cohesive->shear_energy, 10.0);
}

TEST(LocalOrigin, shifts_blocks_and_planes) {
  const auto at = [](double x) {
    return read_case_text(fmt::format(R"(analysis.kinematics = "three-dimensional"
time.end = "1 us"
[domain]
material = "steel"
block = {{ from = "{0} 0 {0} m", to = "{1} 2 {1} m" }}
[cloud]
spacing = "1 m"
[materials.steel]
density = "7850 kg/m3"
elastic = {{ young = "210 GPa", poisson = 0.3 }}
[method]
lagrangian = "total"
[boundary.hold]
points = ["{0} 0 {0} m"]
velocity = "0 0 0 m/s"
[tools.wall]
plane = {{ at = "{0} 0 {0} m", normal = "0 0 1" }}
[tools.punch]
plane = {{ at = "{1} 0 {1} m", normal = "0 0 -1" }}
velocity = "0 0 -1 m/s"
[report.blanking]
centre = "{0} 2 {1} m"
[output]
probes.p = {{ at = "{1} 1 {1} m", fields = ["stress_yz"] }}
lines.l = {{ from = "{0} 1 {0} m", to = "{1} 1 {1} m", fields = ["velocity_z"] }}
sections.s = {{ at = "{0} 1 {1} m", normal = "0 -1 0" }}
)",
                                      x, x + 2.0),
                          "case.toml");
  };
  const Case near = at(0.0), far = at(4096.0);
  EXPECT_EQ(near.origin, Vec3(0, 0, 0));
  EXPECT_LT((far.origin - Vec3(4097, 0, 4097)).norm(), 4.0);
  const auto places = [](const Case& c) {
    return std::vector<Vec3>{c.domain.block->from,       c.domain.block->to,      c.boundary[0].points[0],
                             c.tools[0].solid->plane.at, c.output.probes[0].at,   c.output.lines[0].from,
                             c.output.lines[0].to,       c.output.sections[0].at, *c.report.blanking->centre};
  };
  for (std::size_t k = 0; k < places(near).size(); ++k)
    EXPECT_EQ(places(near)[k] + Vec3(4096, 0, 4096), places(far)[k] + far.origin) << k;
  EXPECT_EQ(near.domain.block->centre + Vec3(0, 0, 0), Vec3(0, 0, 0));
  EXPECT_TRUE(
      far.placed("at (1, 2, 3) m")
          .ends_with(fmt::format("places are counted from ({}, 0, {}) m", far.origin.x(), far.origin.z())));
}

TEST(LocalOrigin, is_named_by_messages_with_places) {
  const Case far = read(4096, 0), near = read(0, 0);
  const std::string place = "the tip at (0.25, -1e-3) m";
  EXPECT_EQ(near.placed(place), place);
  EXPECT_EQ(far.placed("nothing holds it"), "nothing holds it");
  EXPECT_EQ(far.placed(place), place + "; places are counted from (4098, 0) m");
  EXPECT_TRUE(std::string(far.error("domain", place).what()).ends_with("from (4098, 0) m"));
}

TEST(LocalOrigin, knows_every_key_with_a_place) {
  // Whoever adds a key with a place counts it from the origin in use_local_origin() and adds it to
  // everywhere().
  std::set<std::string> found;
  for (const Key& key : schema())
    if ((key.type == Type::vector || key.type == Type::vectors) && key.dimension == dimension::length)
      found.insert(key.path);
  std::set<std::string> known{"domain.block.from",
                              "domain.block.to",
                              "domain.block.centre",
                              "domain.revolve.origin",
                              "domain.stl.shift",
                              "domain.stl.names[].at",
                              "tools.*.plane.at",
                              "domain.cracks.*.points",
                              "domain.cracks.*.rotate.centre",
                              "domain.interfaces.*.points",
                              "domain.interfaces.*.cohesive.open",
                              "domain.fibres.*.centre", // of interfaces and regions
                              "domain.regions.*.at",
                              "cloud.nodes",
                              "cloud.refine.*.box",
                              "cloud.refine.*.points",
                              "tools.*.heat.section.refine.*.box",
                              "tools.*.heat.section.refine.*.points",
                              "boundary.*.points",
                              "coolants.*.box",
                              "initial.spin.centre",
                              "initial.velocity_gradient.centre",
                              "initial.imperfections.*.points",
                              "output.drawing.view",
                              "output.windows.*.box",
                              "output.probes.*.at",
                              "output.sections.*.at",
                              "output.lines.*.from",
                              "output.lines.*.to",
                              "report.blanking.centre"};
  for (const std::string outline : {"domain.outer", "domain.holes.*", "tools.*"})
    for (const char* key : {".start", ".path[].to", ".path[].centre", ".rectangle.from", ".rectangle.to",
                            ".circle.centre", ".rotate.centre"})
      known.insert(outline + key);
  // What tools in space are made of is counted from their own place.
  known.insert("tools.*.place.at");
  std::erase_if(found, [](const std::string& path) {
    return path.starts_with("tools.*.box.") || path.starts_with("tools.*.profile.") ||
           path.starts_with("tools.*.stl.");
  });
  // A part whose modes are sought has axes of its own, and so have milling cuts, which have no cloud.
  std::erase_if(found, [](const std::string& path) {
    return path.starts_with("part.") || path.starts_with("milling.") || path.starts_with("cutter.") ||
           path.starts_with("removal.");
  });
  // What a drawing is placed by is used before the case is read, in paths.
  std::erase_if(found, [](const std::string& path) {
    return path.find(".drawing.") != std::string::npos && !path.starts_with("output.");
  });
  EXPECT_EQ(found, known);
}

} // namespace
} // namespace cnem::input
