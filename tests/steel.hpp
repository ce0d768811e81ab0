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

} // namespace cnem::testing
