#include "input/case_parts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {
namespace {

/// Those of the list, and those of an interval.
void read_times(const Setting& table, Case& result, Diagnostics& diagnostics) {
  std::vector<double>& times = result.output.pictures;
  times = table.get<std::vector<double>>("pictures");
  constexpr double most = 1000.0;
  if (const Setting* every = table.find("pictures_every")) {
    const double interval = std::get<double>(every->value), end = result.time.end;
    if (interval < end / most)
      diagnostics.add(Mistake::range, every->where, every->path,
                      fmt::format("found {:g} s, expected at least {:g} s, a thousandth of time.end",
                                  interval, end / most));
    else
      for (int k = 0; k * interval <= end * (1.0 + 1e-9); ++k) times.push_back(std::min(k * interval, end));
  }
  std::sort(times.begin(), times.end());
  const auto same = [&](double one, double other) { return other - one <= 1e-9 * result.time.end; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
}

PictureNote read_note(const Setting& table, const Output& output) {
  PictureNote note{table.get<double>("at"), table.maybe<std::string>("field").value_or(""),
                   table.get<std::string>("text")};
  if (note.field.empty() && !output.picture_fields.empty()) note.field = output.picture_fields.front();
  return note;
}

Vec3 read_direction(const Setting& setting, Diagnostics& diagnostics) {
  const Vec3 direction = std::get<Vec3>(setting.value);
  if (!(direction.norm() > 0.0))
    diagnostics.add(Mistake::range, setting.where, setting.path,
                    "found no direction, expected one that is not zero");
  return direction;
}

Drawing drawing_of(const Setting& table, Diagnostics& diagnostics) {
  const Setting& given = *table.find("drawing");
  Drawing drawing;
  drawing.percentile = given.maybe<double>("percentile");
  drawing.common = given.get<bool>("common");
  if (given.find("eye"))
    drawing.eye = read_direction(*given.find("eye"), diagnostics);
  else
    drawing.mirror = given.get<bool>("mirror");
  if (const Setting* view = given.find("view")) drawing.view = read_box(*view, diagnostics);
  const Setting* ranges = table.find("ranges");
  if (!ranges) return drawing;
  for (const Setting& range : ranges->members) {
    const auto& ends = std::get<std::vector<double>>(range.value);
    if (ends.size() == 2 && ends[0] < ends[1])
      drawing.ranges[range.name] = {ends[0], ends[1]};
    else
      diagnostics.add(Mistake::range, range.where, range.path,
                      fmt::format("found {:g}, expected two numbers that rise, the ends of the colours (SI)",
                                  fmt::join(ends, " ")));
  }
  return drawing;
}

} // namespace

void read_pictures(const Setting& table, Case& result, Diagnostics& diagnostics) {
  read_times(table, result, diagnostics);
  Output& output = result.output;
  output.picture_fields = table.get<std::vector<std::string>>("picture_fields");
  if (const Setting& drawn = *table.find("picture_fields"); output.picture_fields.empty())
    diagnostics.add(Mistake::type, drawn.where, drawn.path,
                    "found an empty array, expected fields such as [\"plastic_strain\"]; for a run without "
                    "pictures write output.pictures = []");
  output.drawing = drawing_of(table, diagnostics);
  for (const Setting& section : table.entries("sections"))
    output.sections.push_back(
        {section.name, section.get<Vec3>("at"), read_direction(*section.find("normal"), diagnostics)});
  for (const Setting& note : table.entries("notes")) output.notes.push_back(read_note(note, output));
}

} // namespace cnem::input
