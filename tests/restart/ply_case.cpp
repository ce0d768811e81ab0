#include "tests/restart/runs.hpp"

#include <fmt/format.h>

namespace cnem::app {

namespace {

// Knocked off its support in plane stress, while new nodes are made of what has failed or flowed.
std::string knocked_off(const char* material, const char* fields) {
  return fmt::format(R"toml(
[analysis]
kinematics = "plane stress"
thermal = false
[time]
end = "6 us"
[domain]
material = "ply"
outer.rectangle = {{ from = "0 0 mm", to = "4 2 mm" }}
[cloud]
spacing = "0.25 mm"
[method]
rereference = {{ every = 30, strain = 0.1 }}
[adapt]
resample = true
quiet_every = 60
tool_spacing = "0.15 mm"
{}[boundary.base]
pieces = ["bottom"]
velocity = "0 0 m/s"
[tools.punch]
rectangle = {{ from = "-1 2 mm", to = "1.1 5 mm" }}
velocity = {{ y = {{ value = "-40 m/s", ramp = "1 us" }} }}
friction = {{ law = "coulomb", coefficient = 0.3 }}
[output]
history_every = "0.1 us"
fields_every = "3 us"
pictures = "6 us"
{}[output.checkpoint]
every_steps = 25
)toml",
                     material, fields);
}

} // namespace

// In all modes.
std::string ply_case() {
  return knocked_off(R"toml([materials.ply]
density = "1580 kg/m3"
elastic = { law = "orthotropic", E1 = "34.28 GPa", E2 = "11.57 GPa", nu12 = 0.24244, G12 = "2.05 GPa", angle = "30 deg" }
[materials.ply.failure]
law = "larc02"
Xc = "443.76 MPa"
Yt = "89.7216 MPa"
Yc = "148.33 MPa"
S = "33.1 MPa"
eps1t = 0.023
Gft = "12.5 kJ/m2"
Gfc = "12.5 kJ/m2"
Gmt = "1 kJ/m2"
Gmc = "1 kJ/m2"
)toml",
                     R"toml(picture_fields = ["matrix_compression_damage", "fibre_angle"]
probes.corner = { at = "0.5 1.5 mm", fields = ["shear_index", "matrix_tension_damage"] }
)toml");
}

std::string flowing_ply_case() {
  return knocked_off(R"toml([materials.ply]
density = "1500 kg/m3"
elastic = { law = "orthotropic", E1 = "50 GPa", E2 = "12 GPa", nu12 = 0.178, G12 = "3.4 GPa", angle = "30 deg" }
plastic = { law = "table", strain = [0, 0.01, 0.1], stress = "300 700 750 MPa" }
anisotropy = { law = "hill48-ratios", R22 = 0.2, R33 = 0.2, R12 = 0.1 }
damage = { law = "johnson-cook", D1 = 0.05, D2 = 0, D3 = 0, cut_off = -1e9, fracture_energy = "2 kJ/m2" }
)toml",
                     R"toml(picture_fields = ["plastic_strain", "softening"]
probes.corner = { at = "0.5 1.5 mm", fields = ["plastic_strain", "damage"] }
)toml");
}

} // namespace cnem::app
