#include "tests/restart/runs.hpp"

namespace cnem::app {

// A crack that runs between two notches of a strip in tension; the growth of damage is averaged.
std::string cracked_case() {
  return R"toml(
[time]
end = "40 us"
[domain]
material = "steel"
[domain.outer]
start = "0 0 mm"
path = [{ to = "4 0 mm", name = "bottom" }, { to = "4 2.3 mm" }, { to = "3 2.5 mm" }, { to = "4 2.7 mm" }, { to = "4 7 mm" }, { to = "0 7 mm", name = "top" }, { to = "0 4.7 mm" }, { to = "1 4.5 mm" }, { to = "0 4.3 mm" }, { to = "0 0 mm" }]
[cloud]
spacing = "0.22 mm"
pattern = "jittered"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "500 MPa" }
[materials.steel.damage]
law = "johnson-cook"
D1 = 0.005
D2 = 0
D3 = 0
fracture_energy = "50 kJ/m2"
length = "0.4 mm"
[contact]
deformable = true
[boundary.bottom]
pieces = ["bottom"]
velocity = { y = "-4 m/s" }
[boundary.top]
pieces = ["top"]
velocity = { y = "4 m/s" }
[method]
rereference = { every = 40, strain = 0.2 }
[adapt]
resample = true
separate = true
cracks = true
[output]
history_every = "0.5 us"
fields_every = "20 us"
pictures = "40 us"
picture_fields = ["softening"]
[output.checkpoint]
every_steps = 150
)toml";
}

} // namespace cnem::app
