// The text of a cut through a window that moves.
#include "tests/restart/runs.hpp"
#include "tests/shared_cases.hpp"

namespace cnem::app {

std::string window_case() {
  return R"toml(
[cutting]
feed = "0.4 mm"
width = "4 mm"
rake = "17.5 deg"
clearance = "7 deg"
edge_radius = "80 um"
speed = "6000 m/min"
length = "1.6 mm"
window = true
[domain]
material = "steel"
outer.rectangle = { from = "0 -0.8 mm", to = "1.7 0.4 mm" }
[cloud]
spacing = "0.2 mm"
refine.layer.spacing = "0.1 mm"
[adapt]
tool_spacing = "0.04 mm"
surface_spacing = "0.08 mm"
indicator.h_min = "0.05 mm"
window = { ahead = "1.6 mm", behind = "0.4 mm", chip = "0.4 mm" }
[output]
history_every = "0.1 us"
fields_every = "8 us"
pictures = "16 us"
picture_fields = ["temperature"]
[output.checkpoint]
every_steps = 300
every_wall = "0 s"
keep = 3
)toml" + testing::steel_304l;
}

} // namespace cnem::app
