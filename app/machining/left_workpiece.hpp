#pragma once
// Workpieces that milling runs hand on: `workpiece.h5` in their folders.
#include "input/case.hpp"
#include "machining/blank.hpp"

#include <memory>
#include <optional>
#include <string>

namespace cnem::app {

/// The content of the file.
std::string left_workpiece_file(const machining::LeftWorkpiece& left);

/// What the earlier run that the case names has left; none where it names none. Throws InputError with the
/// reason: there is no such run, it is no milling run of passes, it has not finished, its file is damaged or
/// of another version of the program, or tips of passes lie over it.
std::shared_ptr<const machining::LeftWorkpiece> workpiece_of_earlier_run(const input::Case& input);

/// The workpiece of passes, also of an earlier run; none of a cut straight along x. Throws InputError as
/// workpiece_of_earlier_run does.
std::optional<machining::Blank> blank_of(const input::Case& input);

} // namespace cnem::app
