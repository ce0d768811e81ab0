// The text of the small case in space.
#include "tests/restart/runs.hpp"
#include "tests/steel.hpp"

#include <fmt/format.h>

namespace cnem::app {
namespace {

const std::string frequent_output = R"toml([output]
history_every = "0.1 us"
fields_every = "2 us"
[output.checkpoint]
every_steps = 15
every_wall = "0 s"
keep = 3
)toml";

std::string in_space(const std::string& end, const std::string& block, const std::string& spacing) {
  return fmt::format(R"toml(
[analysis]
kinematics = "three-dimensional"
[time]
end = "{}"
[domain]
material = "steel"
block = {{ {} }}
[cloud]
spacing = "{}"
)toml",
                     end, block, spacing);
}

} // namespace

// A bar of tetrahedra in flight that hits a warm wall with friction and is pressed from above.
std::string space_case() {
  return in_space("12 us", R"(shape = "cylinder", part = "half", radius = "1 mm", length = "4 mm")",
                  "0.4 mm") +
         R"toml(
[method]
lagrangian = "total"
[initial]
velocity = "20 0 -200 m/s"
[boundary.symmetry]
pieces = ["y-"]
symmetry = true
[boundary.top]
pieces = ["top"]
pressure = { value = "50 MPa", ramp = "3 us" }
convection = { coefficient = "1e5 W/(m2 K)", ambient = "400 K" }
[tools.wall]
plane = { at = "0 0 0 mm", normal = "0 0 1" }
friction = { law = "tresca-limited", coefficient = 0.2 }
heat = { conductance = "1e5 W/(m2 K)", effusivity = "1e4 W s^0.5/(m2 K)" }
[output]
history_every = "0.1 us"
fields_every = "4 us"
probes.corner = { at = "0.9 0 0.1 mm", fields = ["temperature", "plastic_strain", "stress_zx"] }
lines.axis = { from = "0 0.1 0.1 mm", to = "0 0.1 3.9 mm", samples = 20, fields = ["stress_zz"] }
[output.checkpoint]
every_steps = 25
every_wall = "0 s"
keep = 3
)toml" + testing::steel_304l;
}

// A bar in flight that hits a wall: the foot is refined as it spreads.
std::string space_refined() {
  return in_space("4 us", R"(shape = "cylinder", part = "quarter", radius = "1 mm", length = "2 mm")",
                  "0.4 mm") +
         R"toml(
[method]
rereference = { every = 20, strain = 0.25 }
[adapt]
resample = true
indicator = { field = "plastic_strain", h_min = "0.2 mm", max_nodes = 600 }
[initial]
velocity = "0 0 -300 m/s"
[boundary.symmetry]
pieces = ["x-", "y-"]
symmetry = true
[tools.wall]
plane = { at = "0 0 0 mm", normal = "0 0 1" }
)toml" + frequent_output +
         testing::steel_304l;
}

// A block into which the edge of a box goes: nodes come where it stands.
std::string space_edge() {
  return in_space("1.5 us", R"(from = "0 0 0 mm", to = "1 0.4 0.5 mm")", "0.2 mm") + R"toml(
[method]
rereference = { every = 20, strain = 0.25 }
[adapt]
resample = true
tool_spacing = "0.08 mm"
[boundary.bed]
pieces = ["z-"]
velocity = "0 0 0 m/s"
[tools.box]
shape = "box"
box = { from = "-1 -1 0.5 mm", to = "0.4 2 2 mm" }
velocity = ["0 m/s", "0 m/s", "-50 m/s"]
)toml" + frequent_output +
         testing::steel_304l;
}

// A strip that a punch with a mass shears off over a die: the cloud follows, breaks and parts; its parts
// touch.
std::string space_sheared() {
  return in_space("12.5 us", R"(from = "0 0 0 mm", to = "4 0.8 1 mm")", "0.25 mm") + R"toml(
[method]
rereference = { every = 60, strain = 0.2 }
[adapt]
resample = true
separate = true
[contact]
deformable = true
friction = { law = "coulomb", coefficient = 0.1 }
[boundary.sides]
pieces = ["y-", "y+"]
symmetry = true
[boundary.middle]
pieces = ["x-"]
symmetry = true
[tools.punch]
shape = "box"
box = { from = "-1 -1 1 mm", to = "1.9 2 3 mm" }
mass = "1 g"
direction = "0 0 -1"
initial_velocity = "0 0 -60 m/s"
friction = { law = "coulomb", coefficient = 0.2 }
[tools.die]
shape = "extruded"
start = "2 0 mm"
path = [{ to = "6 0 mm" }, { to = "6 -2 mm" }, { to = "2 -2 mm", fillet = "0.1 mm" }]
place = { at = "0 0 0 mm", axis = "0 -1 0" }
[output]
history_every = "0.5 us"
fields_every = "5 us"
pictures = "12.5 us"
sections.side = { at = "0 0.3 0 mm", normal = "0 -1 0" }
[output.checkpoint]
every_steps = 40
every_wall = "0 s"
keep = 3
)toml" + testing::steel_304l +
         R"toml(
[materials.steel.damage]
law = "johnson-cook"
D1 = 0.09
D2 = 0.2
D3 = -1.5
fracture_energy = "10 kJ/m2"
)toml";
}

// A slab between periodic planes that a punch dents and drags along: passes add and take out nodes on both.
std::string space_periodic() {
  return in_space("4 us", R"(from = "0 0 0 mm", to = "2 0.6 1 mm", grid = false)", "0.2 mm") + R"toml(
[method]
rereference = { every = 20, strain = 0.1 }
[adapt]
resample = true
[periodic.slab]
pieces = ["y-", "y+"]
[boundary.base]
pieces = ["z-"]
velocity = "0 0 0 m/s"
[tools.punch]
shape = "box"
box = { from = "0.5 -1 1 mm", to = "1.5 2 2 mm" }
velocity = "0 60 -100 m/s"
friction = { law = "coulomb", coefficient = 0.3 }
)toml" + frequent_output +
         testing::steel_304l;
}

// A slot between periodic planes that a punch closes and drags along: lips meet images of each other while
// passes add and take out nodes.
std::string space_images() {
  return R"toml(
[analysis]
kinematics = "three-dimensional"
[time]
end = "4 us"
[domain]
material = "steel"
outer.start = "0 0 mm"
outer.path = [
  { to = "1.2 0 mm", name = "base" }, { to = "1.2 0.4 mm" }, { to = "0.4 0.4 mm" }, { to = "0.4 0.5 mm" },
  { to = "1.2 0.5 mm" }, { to = "1.2 0.9 mm" }, { to = "0 0.9 mm" }, { to = "0 0 mm" },
]
extrude = { to = "0.6 mm" }
[cloud]
spacing = "0.16 mm"
[method]
rereference = { every = 20, strain = 0.1 }
[adapt]
resample = true
tool_spacing = "0.1 mm"
[contact]
deformable = true
friction = { law = "coulomb", coefficient = 0.2 }
[periodic.slab]
pieces = ["z-", "z+"]
[boundary.base]
pieces = ["base"]
velocity = "0 0 0 m/s"
[tools.punch]
shape = "box"
box = { from = "0.2 0.9 -1 mm", to = "2 2 2 mm" }
velocity = "0 -120 200 m/s"
friction = { law = "coulomb", coefficient = 0.3 }
)toml" + frequent_output +
         testing::steel_304l;
}

} // namespace cnem::app
