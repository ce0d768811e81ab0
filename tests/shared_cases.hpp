#pragma once
// Cases that several tests share, each without times and output.
#include "tests/steel.hpp"

namespace cnem::testing {

/// A block in tension, in equilibrium.
inline const std::string pulled_block = R"toml(
[analysis]
type = "static"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.25 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "100 MPa" }
[boundary.base]
pieces = "bottom"
displacement = { x = "0 m", y = "0 m" }
[boundary.top]
pieces = "top"
traction = "0 20 MPa"
)toml";

/// A free block of a metal that flows at a constant stress.
inline const std::string free_block = R"toml(
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "2 1 mm" }
[cloud]
spacing = "0.2 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "400 MPa" }
)toml";

/// A block that slides on its base.
inline const std::string steel_block = steel_304l + R"toml(
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.25 mm"
[boundary.base]
pieces = ["bottom"]
symmetry = true
)toml";

/// A punch for its left; a test may go on with its friction.
inline const std::string left_punch = R"toml([tools.punch]
rectangle = { from = "-1 2 mm", to = "1.1 5 mm" }
velocity = { y = { value = "-60 m/s", ramp = "2 us" } }
)toml";

/// A punch goes into the left of a block.
inline const std::string punched_block = steel_block + left_punch + R"toml(
[method]
rereference = { every = 40, strain = 0.1 }
)toml";

/// Damage of steel_304l that is not far from where it begins to flow.
inline const std::string brittle = R"toml(
[materials.steel.damage]
law = "johnson-cook"
D1 = 0.05
D2 = 0.1
D3 = -1.5
fracture_energy = "20 kJ/m2"
)toml";

/// A cut of perfectly plastic metal.
inline const std::string aluminium_cut = R"toml(
[cutting]
feed = "0.3 mm"
width = "4 mm"
rake = "10 deg"
clearance = "7 deg"
edge_radius = "60 um"
speed = "1600 m/min"
length = "0.3 mm"
[domain]
material = "aluminium"
[materials.aluminium]
density = "2700 kg/m3"
elastic = { young = "70 GPa", poisson = 0.33 }
plastic = { law = "perfect", yield = "440 MPa" }
)toml";

/// Half of a blank between punch, die and holder, which is cut; without [contact].
inline const std::string blanked_slug = steel_304l + R"toml(
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "5 1.5 mm" }
[cloud]
spacing = "0.3 mm"
[materials.steel.damage]
law = "johnson-cook"
D1 = 0.1
D2 = 0.1
D3 = -1.5
fracture_energy = "20 kJ/m2"
residual_strength = 0.3
[boundary.left]
pieces = ["left"]
symmetry = true
[tools.punch]
rectangle = { from = "-1 1.5 mm", to = "2.5 5 mm" }
velocity = "0 -60 m/s"
[tools.die]
rectangle = { from = "2.65 -3 mm", to = "9 0 mm" }
[tools.holder]
rectangle = { from = "2.7 1.5 mm", to = "9 3 mm" }
[method]
rereference = { every = 40, strain = 0.2 }
[adapt]
resample = true
separate = true
tool_spacing = "0.15 mm"
)toml";

/// Steel that breaks early, in which cracks run. It ends in the table of damage, whose energy is missing.
inline const std::string cracking_steel = R"toml(
[adapt]
resample = true
separate = true
cracks = true
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "500 MPa" }
[materials.steel.damage]
law = "johnson-cook"
D1 = 0.005
D2 = 0
D3 = 0
cut_off = -1000 # none: it breaks wherever it flows
)toml";

/// A strip in tension between two notches at 45 degrees, whose ligament is 2√2 mm, of cracking_steel.
inline const std::string notched_strip = R"toml(
[domain]
material = "steel"
[domain.outer]
start = "0 0 mm"
path = [{ to = "4 0 mm", name = "bottom" }, { to = "4 2.8 mm" }, { to = "3 3 mm" }, { to = "4 3.2 mm" }, { to = "4 8 mm" }, { to = "0 8 mm", name = "top" }, { to = "0 5.2 mm" }, { to = "1 5 mm" }, { to = "0 4.8 mm" }, { to = "0 0 mm" }]
[cloud]
spacing = "0.2 mm"
pattern = "jittered"
[contact]
deformable = true
[initial]
velocity_gradient = { centre = "0 4 mm", yy = "1000 1/s" }
[boundary.bottom]
pieces = ["bottom"]
velocity = { y = "-4 m/s" }
[boundary.top]
pieces = ["top"]
velocity = { y = "4 m/s" }
[method]
rereference = { every = 50, strain = 0.2 }
)toml" + cracking_steel;

} // namespace cnem::testing
