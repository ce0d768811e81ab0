#pragma once
// 304L of paper 004, section 5.4.3, as a part of cases, with the conductivity of steel.
#include <string>

namespace cnem::testing {

inline const std::string steel_304l = R"toml(
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "johnson-cook", A = "253 MPa", B = "685 MPa", n = 0.312, C = 0.0973, rate0 = "1 /s", m = 2.044, T0 = "296 K", Tmelt = "1698 K" }
heat = { specific_heat = "500 J/(kg K)", conductivity = "15 W/(m K)" }
)toml";

/// A metal that is softer, lighter and conducts better.
inline const std::string soft_metal = R"toml(
[materials.soft]
density = "2700 kg/m3"
elastic = { young = "70 GPa", poisson = 0.33 }
plastic = { law = "johnson-cook", A = "80 MPa", B = "120 MPa", n = 0.3, C = 0.01, rate0 = "1 /s", m = 1.0, T0 = "296 K", Tmelt = "900 K" }
heat = { specific_heat = "900 J/(kg K)", conductivity = "200 W/(m K)" }
)toml";

} // namespace cnem::testing
