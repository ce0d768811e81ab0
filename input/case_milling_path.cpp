// Reads how a cutter goes through which workpiece: passes, a blank, speed and feed over time.
#include "input/case_machining.hpp"
#include "input/case_parts.hpp"
#include "input/left_workpiece.hpp"
#include "input/outline.hpp"
#include "input/triangle_file.hpp"

#include "core/error.hpp"
#include "core/geometry/box.hpp"
#include "machining/milling_process.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace cnem::input {
namespace {

/// The largest of a function that has to be positive at all times.
double largest(const Setting& milling, const char* name, Diagnostics& diagnostics) {
  const Setting& setting = *milling.find(name);
  const std::vector<double>& values = std::get<TimeTable>(setting.value).values();
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (!(*least > 0.0))
    diagnostics.add(
        Mistake::range, setting.where, setting.path,
        fmt::format("found {:g} {}, expected more than 0 at any time{}", *least,
                    describe(setting.key->dimension).si_unit,
                    values.size() > 1 ? " (a ramp begins at `from`, which is 0 without it)" : ""));
  return std::max(*most, 1e-300);
}

std::vector<machining::ToolPath> read_passes(const Setting& milling, Diagnostics& diagnostics) {
  std::vector<machining::ToolPath> passes;
  for (const Setting& pass : milling.entries("passes")) try {
      passes.emplace_back(pieces_of_path(pass), pass.get<double>("tip"));
    } catch (const OutlineError& error) {
      diagnostics.add(Mistake::range, pass.where, pass.path + "." + error.key, error.what());
    }
  return passes;
}

/// The folder of the table `workpiece`, from the root; the checksum of what the run there has left stands in
/// the table then. Where nothing is left there, the run says why.
std::string read_earlier_run(Setting& table, const std::string& case_path, Diagnostics& diagnostics) {
  Setting& run = *table.find("run");
  for (const char* other : {"from", "to", "height", "stl"})
    if (const Setting* given = table.find(other))
      diagnostics.add(
          Mistake::conflict, given->where, given->path,
          fmt::format("found beside {}, expected one workpiece: an earlier run has left all of it",
                      run.path));
  std::string folder = from_case(std::get<std::string>(run.value), case_path);
  while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
  run.value = folder;
  if (const std::optional<std::string> bytes = bytes_of_file(folder + '/' + left_workpiece))
    take_checksum(table, "run", *bytes, diagnostics);
  return folder;
}

std::optional<machining::Blank> read_blank(Setting& table, const std::string& case_path,
                                           Diagnostics& diagnostics) {
  machining::Blank blank;
  blank.height = table.get<double>("height");
  const Setting *from = table.find("from"), *to = table.find("to");
  Setting* stl = table.find("stl");
  if (stl ? from || to : !from || !to) {
    diagnostics.add(
        stl ? Mistake::conflict : Mistake::missing_key, table.where, table.path,
        stl ? "found corners and triangles, expected either `from` and `to` or `stl`"
            : "missing, expected two opposite corners, `from` and `to`, or `stl`, or the folder of "
              "an earlier `run`");
    return std::nullopt;
  }
  if (!stl) {
    blank.low = std::get<Vec2>(from->value);
    blank.high = std::get<Vec2>(to->value);
    if (!((blank.high - blank.low).array() > 0.0).all())
      diagnostics.add(Mistake::range, to->where, to->path,
                      "found a corner that is not beyond `from` along x and y, expected the opposite one");
    return blank;
  }
  const std::optional<FacetSoup> soup = read_triangles(*stl, case_path, diagnostics);
  if (!soup) return std::nullopt;
  blank.surface = joined(*soup);
  for (Vec3& point : blank.surface.points) point += stl->vector("shift");
  try {
    check_closed(blank.surface);
  } catch (const GeometryError& error) {
    diagnostics.add(Mistake::geometry, stl->where, stl->find("file")->path, error.what());
    return std::nullopt;
  }
  const Box<3> box = box_of<3>(blank.surface.points);
  if (box.high.z() <= 0.0 || box.low.z() >= blank.height)
    diagnostics.add(Mistake::range, stl->where, stl->path + ".shift",
                    fmt::format("puts the workpiece from {:g} to {:g} m, expected part of it between 0 and "
                                "{}.height = {:g} m",
                                box.low.z(), box.high.z(), table.path, blank.height));
  blank.low = box.low.head<2>();
  blank.high = box.high.head<2>();
  return blank;
}

/// Tips lie within the workpiece.
void check_tips(const Setting& milling, double height, Diagnostics& diagnostics) {
  for (const Setting& pass : milling.entries("passes"))
    if (const Setting& tip = *pass.find("tip"); std::get<double>(tip.value) >= height)
      diagnostics.add(Mistake::range, tip.where, tip.path,
                      fmt::format("found {:g} m, expected less than milling.workpiece.height = {:g} m: the "
                                  "cutter is over the workpiece",
                                  std::get<double>(tip.value), height));
}

} // namespace

void read_drive(const Setting& milling, MachiningCase& read, Analysis::Type type, Diagnostics& diagnostics) {
  read.speed = largest(milling, "speed", diagnostics);
  read.cut.feed = largest(milling, "feed", diagnostics);
  const auto &speed = milling.get<TimeTable>("speed"), &feed = milling.get<TimeTable>("feed");
  if (speed.values().size() == 1 && feed.values().size() == 1) return;
  read.drive = {speed, feed};
  const Setting& given = *milling.find(speed.values().size() > 1 ? "speed" : "feed");
  if (type == Analysis::Type::stability)
    diagnostics.add(Mistake::conflict, given.where, given.path,
                    "found a function of time, expected a constant: lobes are those of a steady cut; "
                    "analysis.type = \"milling\" takes any");
}

void read_path(Setting& root, MachiningCase& read, const std::string& case_path, Diagnostics& diagnostics) {
  Setting& milling = *root.find("milling");
  Setting* workpiece = milling.find("workpiece");
  const Setting* passes = milling.find("passes");
  if (!workpiece && !passes) return;
  if (!workpiece || !passes) {
    diagnostics.add(Mistake::missing_key, workpiece ? workpiece->where : passes->where,
                    milling.path + (workpiece ? ".passes" : ".workpiece"),
                    workpiece ? "missing, expected ways of the axis through the workpiece, "
                                "[[milling.passes]] with start and path"
                              : "missing, expected what the passes go through, such as { from = \"0 0 mm\", "
                                "to = \"40 20 mm\" }");
    return;
  }
  const Setting* length = milling.find("length");
  Setting* start = milling.find("start");
  for (const Setting* other : {length, static_cast<const Setting*>(start)})
    if (other && other->given && (other == length || read.start == machining::ProcessSettings::Start::inside))
      diagnostics.add(Mistake::conflict, other->where, other->path,
                      other == length
                          ? "found a length and milling.passes, expected one of them"
                          : "found \"inside\", expected \"outside\" or \"hole\": passes begin beside "
                            "the workpiece or in a hole");
  if (read.start == machining::ProcessSettings::Start::inside) { // its default
    read.start = machining::ProcessSettings::Start::outside;
    start->value = std::string("outside");
  }
  read.passes = read_passes(milling, diagnostics);
  if (milling.entries("passes").empty())
    diagnostics.add(Mistake::range, passes->where, passes->path, "found no pass, expected at least one");
  read.length = 0.0;
  for (const machining::ToolPath& pass : read.passes) read.length += pass.length();
  if (workpiece->find("run")) {
    read.earlier_run = read_earlier_run(*workpiece, case_path, diagnostics);
    return;
  }
  double highest = 0.0;
  for (const machining::ToolPath& pass : read.passes) highest = std::max(highest, pass.tip());
  workpiece->set_default("height", highest + read.axial_depth);
  read.blank = read_blank(*workpiece, case_path, diagnostics);
  if (!read.blank || read.passes.empty()) return;
  check_tips(milling, read.blank->height, diagnostics);
  if (const std::string doubt = too_many_cells(read, read.blank->high - read.blank->low, *read.blank);
      !doubt.empty())
    diagnostics.add(Mistake::range, workpiece->where, workpiece->path, doubt);
}

std::string too_many_cells(const MachiningCase& read, const Vec2& size, const machining::Blank& blank) {
  constexpr double most = 2e8, degrees = 60.0;
  const double cell = std::max(read.dexels.pitch, read.cut.cutter.radius() / degrees),
               of_layer = size.x() / cell * (size.y() / cell),
               least = std::max(1.0, blank.height / read.axial_depth) * read.dexels.layers;
  double cells = of_layer * least;
  if (cells <= most) // which bounds how many there are to list
    cells = of_layer * static_cast<double>(machining::slices_of(read.cut, {.axial_depth = read.axial_depth,
                                                                           .layers = read.dexels.layers,
                                                                           .steps = read.dexels.steps,
                                                                           .passes = read.passes,
                                                                           .blank = blank})
                                               .size());
  if (cells <= most) return "";
  return fmt::format("holds {:.3g} cells of dexels, expected at most {:g}: a smaller workpiece, fewer "
                     "dexels.layers or a larger dexels.pitch",
                     cells, most);
}

} // namespace cnem::input
