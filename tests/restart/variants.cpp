// What is made of the texts of small cases.
#include "tests/restart/runs.hpp"

#include <string_view>

namespace cnem::app {

namespace {

void replace(std::string& text, std::string_view from, std::string_view to) {
  text.replace(text.find(from), from.size(), to);
}

} // namespace

// The table of the method is there.
std::string with_method(std::string text, const std::string& lines) {
  const std::string table = "[method]\n";
  return text.insert(text.find(table) + table.size(), lines);
}

// The slug is round: its axis is the symmetry plane of the other.
std::string of_revolution(std::string text) {
  replace(text, "[boundary.left]\npieces = [\"left\"]\nsymmetry = true\n", "");
  return "[analysis]\nkinematics = \"axisymmetric\"\n" + text;
}

// The cut goes through both layers and what bonds them.
std::string in_layers(std::string text) {
  const std::string outline = "outer.rectangle = { from = \"0 0 mm\", to = \"5 1.5 mm\" }\n";
  return text.insert(text.find(outline) + outline.size(),
                     "interfaces.joint.points = [\"0 0.5 mm\", \"5 1.2 mm\"]\n");
}

// What the method has beside them is left out.
std::string in_triangles(std::string text, const std::string& lagrangian) {
  const std::string from = "pressure_exchange", to = "[output]\n";
  const std::size_t begin = text.find(from);
  return text.replace(begin, text.find(to) - begin, "name = \"fe-triangles\"\n" + lagrangian);
}

// The slug is knocked off by a punch with a mass on a spring, in local time steps of scaled masses.
std::string in_levels(std::string text) {
  replace(
      text, "velocity = \"0 -60 m/s\"\n",
      "velocity = \"0 -60 m/s\"\nmass = \"1 kg/m\"\ndirection = \"0 -1\"\ninitial_velocity = \"0 -60 m/s\"\n"
      "force = \"0 -1e5 N/m\"\nspring = { stiffness = \"1 GN/m2\", preload = \"20 kN/m\", ramp = \"1 us\" }\n"
      "damping = \"1 kN s/m2\"\n");
  replace(text, "tool_spacing = \"0.15 mm\"\n", "tool_spacing = \"0.05 mm\"\n");
  return text + "[time.step]\nlocal = true\n[time.mass_scaling]\nfactor = 2\n";
}

// The punch conducts under a coating; friction is that of a table.
std::string with_conducting_punch(std::string text) {
  replace(text, R"toml(to = "1.1 5 mm")toml", R"toml(to = "1.1 5 mm", names.top = "shank")toml");
  replace(
      text, R"toml(law = "tresca-limited", coefficient = 0.2)toml",
      R"toml(law = "table", coefficient = 0.3, temperature = "300 600 K", over_temperature = [1.0, 0.5])toml");
  replace(text, R"toml(heat = { conductance = "1e5 W/(m2 K)", effusivity = "1e4 W s^0.5/(m2 K)" })toml",
          R"toml(heat.conductance = "1e5 W/(m2 K)"
heat.conductivity = "60 W/(m K)"
heat.density = "15000 kg/m3"
heat.specific_heat = "200 J/(kg K)")toml");
  text += R"toml(
[tools.punch.heat.section]
spacing = "0.3 mm"
held = ["shank"]
heat_capacity_factor = 0.1
refine.corner = { points = ["1.1 2 mm"], factor = 0.4 }
coating = { thickness = "5 um", conductivity = "12 W/(m K)", density = "4700 kg/m3", specific_heat = "600 J/(kg K)" }
)toml";
  return text;
}

// The same in triangles, which do not adapt: it goes back once.
std::string set_back_in_triangles(std::string text) {
  replace(text, "20.8 ns", "13.5 ns");
  replace(text, "strain = 0.4", "strain = 0.35");
  replace(text, "[adapt]\nresample = true\n", "");
  return with_method(text, "name = \"fe-triangles\"\n");
}

} // namespace cnem::app
