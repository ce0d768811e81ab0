#include "tests/restart/runs.hpp"
#include "tests/shared_cases.hpp"

namespace cnem::app {

// A crack that runs between two notches; the growth of damage is averaged.
std::string cracked_case() {
  return testing::notched_strip + R"toml(
fracture_energy = "50 kJ/m2"
length = "0.4 mm"
[time]
end = "40 us"
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
