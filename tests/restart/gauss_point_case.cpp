// The text of the small case of functions at Gauss points, into which a punch goes by springs.
#include "tests/restart/runs.hpp"
#include "tests/shared_cases.hpp"
#include "tests/steel.hpp"

namespace cnem::app {

std::string gauss_point_case() {
  return testing::steel_block + testing::left_punch + R"toml(friction = { law = "coulomb", coefficient = 0.2 }
[time]
end = "6 us"
[analysis]
thermal = false
[contact]
scheme = "central-difference"
[method]
name = "efg"
lagrangian = "total"
[output]
history_every = "0.1 us"
fields_every = "3 us"
pictures = "6 us"
picture_fields = ["plastic_strain"]
[output.checkpoint]
every_steps = 25
)toml";
}

} // namespace cnem::app
