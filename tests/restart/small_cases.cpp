// The texts of the small cases.
#include "tests/restart/runs.hpp"
#include "tests/shared_cases.hpp"

#include <fmt/format.h>
#include <stdexcept>

namespace cnem::app {

namespace {

using testing::steel_304l;

// A base without friction and a punch at 60 m/s, with friction and warm contact, on a block 4 mm wide.
std::string base_and_punch(const char* height, const char* ramp) {
  return fmt::format(R"toml(
[boundary.base]
pieces = ["bottom"]
symmetry = true
[tools.punch]
rectangle = {{ from = "-1 {0} mm", to = "1.1 5 mm" }}
velocity = {{ y = {{ value = "-60 m/s", ramp = "{1} us" }} }}
friction = {{ law = "tresca-limited", coefficient = 0.2 }}
heat = {{ conductance = "1e5 W/(m2 K)", effusivity = "1e4 W s^0.5/(m2 K)" }}
)toml",
                     height, ramp);
}

// A punch on a block; references are renewed.
const std::string punched = R"toml(
[time]
end = "12 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.25 mm"
[method]
rereference = { every = 40, strain = 0.05 }
[output]
history_every = "0.1 us"
fields_every = "4 us"
pictures = "6 12 us"
picture_fields = ["plastic_strain"]
probes.corner = { at = "1 1.5 mm", fields = ["temperature", "plastic_strain"] }
lines.middle = { from = "0.1 1 mm", to = "3.9 1 mm", samples = 20, fields = ["stress_yy"] }
[output.checkpoint]
every_steps = 25
every_wall = "0 s"
keep = 3
)toml" + base_and_punch("2", "2") +
                            steel_304l;

// Local time steps and an exchange of pressures in a block that is fine where a punch's corner goes in.
const std::string levels = R"toml(
[time]
end = "1.5 us"
step = { local = true, levels = 4 }
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 3 mm" }
[cloud]
spacing = "0.1 mm"
refine.corner = { points = ["1.1 3 mm"], spacing = "0.0125 mm", growth = 0.3 }
[boundary.side]
pieces = ["right"]
pressure = "20 MPa"
[method]
bulk_viscosity = { linear = 0.06, quadratic = 1.2 }
pressure_exchange = 0.3
rereference = { every = 20, strain = 0.05 }
[output]
history_every = "0 s"
fields_every = "0.5 us"
pictures = "1.5 us"
picture_fields = ["plastic_strain"]
[output.checkpoint]
every_steps = 15
every_wall = "0 s"
keep = 3
)toml" + base_and_punch("3", "0.5") +
                           steel_304l;

// Every load and support, functions of Laplace on a jittered cloud, a row of history at every step.
const std::string loaded = R"toml(
[time]
end = "8 us"
step = { max = "12 ns" }
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "3 1.5 mm" }
[cloud]
spacing = "0.2 mm"
pattern = "jittered"
seed = 7
[boundary.left]
pieces = ["left"]
velocity = { x = "0 m/s" }
temperature = "350 K"
[boundary.bottom]
pieces = ["bottom"]
displacement = { y = { value = "0.02 mm", ramp = "8 us" } }
[boundary.right]
pieces = ["right"]
traction = { x = { value = "600 MPa", ramp = "4 us" } }
convection = { coefficient = "1e4 W/(m2 K)", ambient = "300 K" }
[boundary.top]
pieces = ["top"]
pressure = "20 MPa"
heat_flux = "1e8 W/m2"
[loads]
body_force = "0 -1e6 m/s2"
[initial]
velocity = "5 0 m/s"
[method]
functions = "laplace"
lagrangian = "periodic"
rereference = { every = 30 }
[output]
history_every = "0 s"
fields_every = "0 s"
pictures = "8 us"
picture_fields = ["temperature"]
[output.checkpoint]
every_steps = 0
every_time = "0.3 us"
every_wall = "0 s"
)toml" + steel_304l;

// A round bar on a wall, renewed at every step.
const std::string round_bar = R"toml(
[analysis]
kinematics = "axisymmetric"
[time]
end = "6 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "1.5 4 mm" }
[cloud]
spacing = "0.25 mm"
[boundary.wall]
pieces = ["bottom"]
symmetry = true
[initial]
velocity = "0 -150 m/s"
[method]
lagrangian = "updated"
[output]
fields_every = "2 us"
pictures = "6 us"
picture_fields = ["plastic_strain"]
[output.checkpoint]
every_steps = 20
)toml" + steel_304l;

// Finite elements, total Lagrangian, Coulomb friction.
const std::string triangles = R"toml(
[time]
end = "10 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.3 mm"
[boundary.base]
pieces = ["bottom"]
velocity = "0 0 m/s"
[tools.roll]
circle = { centre = "2 3 mm", radius = "1 mm" }
velocity = "10 -30 m/s"
friction = { law = "coulomb", coefficient = 0.3 }
[method]
name = "fe-triangles"
lagrangian = "total"
[output]
pictures = "10 us"
picture_fields = ["pressure"]
[output.checkpoint]
every_steps = 15
keep = 1
)toml" + steel_304l;

// A bar that breaks in the middle, with and without renewals on the way.
const std::string breaking = R"toml(
[time]
end = "14 us"
[domain]
material = "steel"
outer.rectangle = { from = "-1 0 mm", to = "1 0.6 mm" }
[cloud]
spacing = "0.15 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "500 MPa" }
damage = { law = "johnson-cook", D1 = 0.01, D2 = 0.02, D3 = -1.5, D4 = 0.002, fracture_energy = "5 kJ/m2" }
heat = { specific_heat = "500 J/(kg K)", conductivity = "15 W/(m K)" }
[initial]
imperfections.weak = { points = ["0 -1 mm", "0 1 mm"], width = "0.2 mm", reduction = 0.1 }
[boundary.left]
pieces = ["left"]
velocity = { x = "-10 m/s" }
[boundary.right]
pieces = ["right"]
velocity = { x = "10 m/s" }
[output]
history_every = "0.2 us"
fields_every = "7 us"
pictures = "14 us"
picture_fields = ["damage", "softening"]
[output.checkpoint]
every_steps = 50
)toml";

// A cloud that refines itself where a punch goes in, and metal that breaks there.
const std::string adapted = R"toml(
[time]
end = "8 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.3 mm"
[method]
pressure_exchange = 2.0
stress_annealing = 1.0
rereference = { every = 30, strain = 0.1 }
[adapt]
resample = true
quiet_every = 60
tool_spacing = "0.15 mm"
surface_spacing = "0.2 mm"
rest_factor = 1.5
[adapt.indicator]
field = "plastic_strain"
h_min = "0.12 mm"
[output.lines.across]
from = "0.1 0.5 mm"
to = "1.5 0.6 mm"
samples = 9
fields = ["plastic_strain"]
[output]
history_every = "0.1 us"
fields_every = "4 us"
pictures = "8 us"
picture_fields = ["plastic_strain", "level", "indicator", "age", "softening"]
probes.corner = { at = "1 1.5 mm", fields = ["plastic_strain"] }
[output.checkpoint]
every_steps = 35
)toml" + testing::brittle + base_and_punch("2", "1") +
                            steel_304l;

// A slug that comes off: the cloud is cut, and the faces touch.
const std::string separated = testing::blanked_slug + R"toml(
[time]
end = "20 us"
[contact]
deformable = true
conductance = "1e6 W/(m2 K)"
friction = { law = "coulomb", coefficient = 0.1 }
[output]
history_every = "0.2 us"
fields_every = "10 us"
pictures = "20 us"
picture_fields = ["softening"]
[output.checkpoint]
every_steps = 100
)toml";

// Two parts with a crack between them, pressed together by a tool that slides: friction, heat, renewals.
const std::string touching = R"toml(
[time]
end = "8 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "3 2 mm" }
cracks.cut = { points = ["0 1 mm", "3 1 mm"] }
regions.above = { at = "1 1.5 mm", velocity = "20 -40 m/s" }
[cloud]
spacing = "0.25 mm"
[boundary.base]
pieces = ["bottom"]
velocity = "0 0 m/s"
[contact]
deformable = true
conductance = "1e6 W/(m2 K)"
friction = { law = "tresca-limited", coefficient = 0.2 }
[tools.plate]
rectangle = { from = "-1 2 mm", to = "4 3 mm" }
velocity = "10 -40 m/s"
friction = { law = "coulomb", coefficient = 0.1 }
[method]
rereference = { every = 60, strain = 0.1 }
[output]
history_every = "0.1 us"
fields_every = "4 us"
pictures = "8 us"
picture_fields = ["plastic_strain"]
[output.checkpoint]
every_steps = 25
)toml" + steel_304l;

// A step that falls below its limit where a punch's corner has gone in: the run goes back twice, and through.
const std::string set_back = R"toml(
[time]
end = "6 us"
step.min = "20.8 ns"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.25 mm"
[method]
rereference = { every = 0, strain = 0.4 }
[adapt]
resample = true
[boundary.base]
pieces = ["bottom"]
symmetry = true
[tools.punch]
rectangle = { from = "-1 2 mm", to = "1.1 5 mm" }
velocity = { y = { value = "-200 m/s", ramp = "1 us" } }
friction = { law = "tresca-limited", coefficient = 0.2 }
[output]
history_every = "0.1 us"
fields_every = "0.2 us"
pictures = "2 4 5.4 6 us"
picture_fields = ["plastic_strain"]
[output.checkpoint]
every_steps = 20
every_wall = "0 s"
keep = 3
)toml" + steel_304l;

// Rolled sheet, whose axes turn over references and go over to new nodes.
const char* const rolled = "[materials.steel.anisotropy]\nlaw = \"hill48\"\nr0 = 1.8\nr45 = 1.2\nr90 = 2.3\n";

// Pressure of compressed metal that is not proportional to its strain, while it breaks.
const char* const compressible =
    "[materials.steel.equation_of_state]\nlaw = \"mie-gruneisen\"\nS1 = 1.49\ngamma0 = 2.17\nb = 0.5\n";

} // namespace

const std::vector<SmallCase>& small_cases() {
  static const std::vector<SmallCase> cases{
      {"punched", punched},
      {"levels", levels},
      {"levels_of_triangles", in_triangles(levels, "lagrangian = \"total\"\n")},
      {"levels_of_renewed_triangles", in_triangles(levels, "rereference = { every = 20 }\n")},
      {"loaded", loaded},
      {"round_bar", round_bar},
      {"triangles", triangles},
      {"breaking", breaking},
      {"adapted", adapted},
      {"separated", separated},
      {"cracked", cracked_case()},
      {"round_slug", of_revolution(separated)},
      {"knocked_off", in_levels(separated)},
      {"touching", touching},
      {"conducting_tool", with_conducting_punch(punched)},
      {"parts", parts_case()},
      {"delaminating", delaminating_case()},
      {"window", window_case()},
      {"ply", ply_case()},
      {"flowing_ply", flowing_ply_case()},
      {"thin_breaking", "[analysis]\nkinematics = \"plane stress\"\n" + breaking},
      {"thin", "[analysis]\nkinematics = \"plane stress\"\n" + punched},
      {"layers", in_layers(separated)},
      {"set_back", set_back},
      {"particles", with_method(punched, "name = \"sph\"\nkernel = \"wendland_c2\"\n")},
      {"renewed_triangles", with_method(punched, "name = \"fe-triangles\"\n")},
      {"round_triangles", with_method(round_bar, "name = \"fe-triangles\"\n")},
      {"breaking_triangles", breaking + "[method]\nname = \"fe-triangles\"\nrereference = { every = 25 }\n"},
      {"set_back_triangles", set_back_in_triangles(set_back)},
      {"touching_triangles", with_method(touching, "name = \"fe-triangles\"\n")},
      {"space", space_case()},
      {"space_refined", space_refined()},
      {"space_edge", space_edge()},
      {"space_sheared", space_sheared()},
      {"space_periodic", space_periodic()},
      {"space_images", space_images()},
      {"rolled", adapted + rolled},
      {"compressible", adapted + compressible},
      {"adapted_particles", with_method(adapted, "name = \"sph\"\n")},
      {"hybrid", with_method(adapted, "name = \"hybrid\"\n")},
      {"least_squares", with_method(separated, "functions = \"mls\"\n")},
      {"gauss_points", gauss_point_case()}};
  return cases;
}

const std::string& small_case(const std::string& name) {
  for (const SmallCase& small : small_cases())
    if (small.name == name) return small.text;
  throw std::logic_error("no small case " + name);
}

} // namespace cnem::app
