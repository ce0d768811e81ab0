#pragma once
// The conductor of the tests: steel of the field's benchmarks.

namespace cnem::testing {

inline constexpr double k = 50.0, rho = 7850.0, c = 477.0; // W/(m K), kg/m3, J/(kg K)
inline constexpr double diffusivity = k / (rho * c);

} // namespace cnem::testing
