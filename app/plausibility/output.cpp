// Output that will never be written, or fills disks.
#include "app/plausibility/list.hpp"

#include <fmt/format.h>

namespace cnem::app {

void doubt_output(const input::Case& input, Doubts& doubts) {
  const double end = input.time.end;
  const auto never = [&](const std::string& key, const std::string& what, double time) {
    doubts.push_back(doubt_about(
        input, key, fmt::format("{} at {:.4g} s, but the run ends at {:.4g} s (time.end)", what, time, end)));
  };
  // Rounding of a time that is written as the end.
  constexpr double near = 1e-9;
  int late = 0;
  for (const double time : input.output.pictures) late += time > end * (1.0 + near);
  if (late > 0)
    never("output.pictures",
          late == 1 ? "a picture is asked for" : fmt::format("{} pictures are asked for, the last", late),
          input.output.pictures.back());
  if (input.output.fields_every > end * (1.0 + near))
    never("output.fields_every", "the first fields after the start are asked for", input.output.fields_every);
  if (input.output.history_every > end * (1.0 + near))
    never("output.history_every", "the first row after the start is asked for", input.output.history_every);
  constexpr double most = 1000.0, enough = 100.0; // frames
  if (const double every = input.output.fields_every; every > 0.0 && end > most * every * (1.0 + near))
    doubts.push_back(doubt_about(input, "output.fields_every",
                                 fmt::format("{:.0f} files of fields by time.end, where films have 24 to 200 "
                                             "frames: expected about {:.2g} s",
                                             end / every, end / enough)));
}

} // namespace cnem::app
