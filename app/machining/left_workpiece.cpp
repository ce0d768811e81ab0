#include "app/machining/left_workpiece.hpp"

#include "core/error.hpp"
#include "input/case_machining.hpp"
#include "input/left_workpiece.hpp"
#include "input/schema/document.hpp"
#include "results/checkpoint.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "results/status.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace cnem::app {

namespace {

namespace fs = std::filesystem;

/// Why a folder holds no workpiece.
std::string what_is_there(const fs::path& folder) {
  if (!fs::is_directory(folder)) return "there is no such folder";
  if (!fs::exists(folder / results::files::resolved_case)) return "no run is in that folder";
  const fs::path resolved = folder / results::files::resolved_case;
  const input::Value root = input::parse_document(results::read_file(resolved), resolved.string());
  if (const input::Member* analysis = root.find("analysis"))
    if (const input::Member* type = analysis->value.find("type"); type && type->value.text != "milling")
      return fmt::format("the run there is of analysis.type = \"{}\"", type->value.text);
  if (const input::Member* milling = root.find("milling"); milling && !milling->value.find("passes"))
    return "the run there goes straight along x, which leaves no workpiece";
  if (!fs::exists(folder / results::files::status)) return "the run there has not ended";
  const results::RunStatus status = results::read_status(folder);
  if (status.exit != 0)
    return fmt::format("the run there did not finish (exit code {}: {})", status.exit, status.reason);
  return fmt::format("{} is missing there", input::left_workpiece);
}

} // namespace

std::string left_workpiece_file(const machining::LeftWorkpiece& left) {
  results::CheckpointWriter writer;
  machining::LeftWorkpiece copy = left;
  copy.archive(writer);
  return writer.content();
}

std::shared_ptr<const machining::LeftWorkpiece> workpiece_of_earlier_run(const input::Case& input) {
  const input::MachiningCase& milling = *input.machining;
  if (milling.earlier_run.empty()) return nullptr;
  const fs::path folder = milling.earlier_run, file = folder / input::left_workpiece;
  const char* key = "milling.workpiece.run";
  if (!fs::exists(file))
    throw input.error(key, fmt::format("found '{}': {}, expected the folder of a finished run of "
                                       "milling.passes",
                                       folder.string(), what_is_there(folder)));
  auto left = std::make_shared<machining::LeftWorkpiece>();
  try {
    results::CheckpointReader reader(results::read_file(file));
    left->archive(reader);
  } catch (const IoError& error) {
    throw input.error(key, fmt::format("cannot take '{}': {}, expected what a run of this version has left",
                                       file.string(), error.what()));
  }
  const machining::DexelLayer& layer = left->layers.front();
  if (const std::string doubt = input::too_many_cells(milling, layer.high() - layer.low(),
                                                      {.height = left->height(), .left = left});
      !doubt.empty())
    throw input.error(key, doubt);
  for (std::size_t k = 0; k < milling.passes.size(); ++k)
    if (const double tip = milling.passes[k].tip(); tip >= left->height())
      throw input.error(fmt::format("milling.passes[{}].tip", k),
                        fmt::format("found {}, expected less than {}, the height of the workpiece that '{}' "
                                    "has left",
                                    results::si_format(tip, "m"), results::si_format(left->height(), "m"),
                                    folder.string()));
  return left;
}

std::optional<machining::Blank> blank_of(const input::Case& input) {
  const auto left = workpiece_of_earlier_run(input);
  if (!left) return input.machining->blank;
  return machining::Blank{.low = left->layers.front().low(),
                          .high = left->layers.front().high(),
                          .height = left->height(),
                          .left = left};
}

} // namespace cnem::app
