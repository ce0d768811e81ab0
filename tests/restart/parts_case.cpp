// The text of the small case of several parts that adapt.
#include "tests/restart/runs.hpp"
#include "tests/steel.hpp"

namespace cnem::app {
namespace {

const std::string followed = R"toml([method]
rereference = { every = 30, strain = 0.1 }
[adapt]
resample = true
[adapt.indicator]
field = "plastic_strain"
h_min = "0.12 mm"
[output.checkpoint]
every_steps = 35
)toml";

} // namespace

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
[output]
history_every = "0.1 us"
fields_every = "4 us"
pictures = "8 us"
picture_fields = ["plastic_strain", "level", "temperature"]
)toml" + followed +
         testing::soft_metal + testing::steel_304l;
}

// Layers that come apart under a punch beside which one is held, on a bond that is open at one end; passes go
// over faces that have separated, are pressed together, and rub on each other.
std::string delaminating_case() {
  return R"toml(
[time]
end = "8 us"
[analysis]
thermal = false
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
regions.below = { at = "1 0.5 mm", material = "soft" }
[domain.interfaces.joint]
points = ["0 1.2 mm", "2 1 mm", "4 1.2 mm"]
[domain.interfaces.joint.cohesive]
stiffness = "2e15 Pa/m"
strength = "120 MPa"
shear_strength = "90 MPa"
energy = "60 J/m2"
shear_energy = "120 J/m2"
eta = 1.5
open = ["0 1.2 mm", "0.5 1.15 mm"]
[cloud]
spacing = "0.25 mm"
[contact]
deformable = true
friction = { law = "coulomb", coefficient = 0.2 }
[boundary.base]
pieces = ["bottom"]
velocity = "0 0 m/s"
[tools.punch]
rectangle = { from = "2.3 2 mm", to = "5 5 mm" }
velocity = { y = { value = "-60 m/s", ramp = "1 us" } }
friction = { law = "coulomb", coefficient = 0.1, by_material.steel.coefficient = 0.3 }
[output]
history_every = "0.1 us"
fields_every = "4 us"
pictures = "8 us"
picture_fields = ["plastic_strain", "level"]
)toml" + followed +
         testing::soft_metal + testing::steel_304l;
}

} // namespace cnem::app
