// The texts of small cases of several parts that adapt, and what becomes of a sheet that is cut.
#include "tests/restart/runs.hpp"
#include "tests/steel.hpp"

namespace cnem::app {

// Parts that adapt: an interface between two materials with a resistance, periodic sides and a crack, whose
// nodes come and go together.
std::string parts_case() {
  return R"toml(
[time]
end = "8 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
interfaces.joint = { points = ["0 1.4 mm", "4 1.4 mm"], conductance = "1e5 W/(m2 K)" }
regions.below = { at = "1 0.5 mm", material = "soft", temperature = "400 K" }
cracks.cut = { points = ["1 0.6 mm", "2.2 1 mm"] }
[periodic.strip]
pieces = ["left", "right"]
[cloud]
spacing = "0.25 mm"
[contact]
deformable = true
[boundary.base]
pieces = ["bottom"]
symmetry = true
[tools.punch]
rectangle = { from = "1.4 2 mm", to = "2.7 5 mm" }
velocity = { y = { value = "-60 m/s", ramp = "1 us" } }
[method]
rereference = { every = 30, strain = 0.1 }
[adapt]
resample = true
[adapt.indicator]
field = "plastic_strain"
h_min = "0.12 mm"
[output]
history_every = "0.1 us"
fields_every = "4 us"
pictures = "8 us"
picture_fields = ["plastic_strain", "level", "temperature"]
[output.checkpoint]
every_steps = 35
)toml" + testing::soft_metal +
         testing::steel_304l;
}

// The slug is round: its axis is the symmetry plane of the other.
std::string of_revolution(std::string text) {
  const std::string plane = "[boundary.left]\npieces = [\"left\"]\nsymmetry = true\n";
  text.erase(text.find(plane), plane.size());
  return "[analysis]\nkinematics = \"axisymmetric\"\n" + text;
}

// The cut goes through both layers and what bonds them.
std::string in_layers(std::string text) {
  const std::string outline = "outer.rectangle = { from = \"0 0 mm\", to = \"5 1.5 mm\" }\n";
  return text.insert(text.find(outline) + outline.size(),
                     "interfaces.joint.points = [\"0 0.5 mm\", \"5 1.2 mm\"]\n");
}

/// The same in triangles.
std::string in_triangles(std::string text, const std::string& lagrangian) {
  const std::string from = "pressure_exchange", to = "[output]\n";
  const std::size_t begin = text.find(from);
  return text.replace(begin, text.find(to) - begin, "name = \"fe-triangles\"\n" + lagrangian);
}

/// The slug is knocked off by a punch with a mass, in local time steps of scaled masses.
std::string in_levels(std::string text) {
  const std::string motion = "velocity = \"0 -60 m/s\"\n", spacing = "tool_spacing = \"0.15 mm\"\n";
  text.replace(text.find(motion), motion.size(),
               "mass = \"1 kg/m\"\ninitial_velocity = \"0 -60 m/s\"\nforce = \"0 -1e5 N/m\"\n");
  text.replace(text.find(spacing), spacing.size(), "tool_spacing = \"0.05 mm\"\n");
  return text + "[time.step]\nlocal = true\n[time.mass_scaling]\nfactor = 2\n";
}

} // namespace cnem::app
