#pragma once
// The table [cutting] of a case: what follows from it becomes ordinary keys before the case is read, so that
// nothing downstream knows of it. docs/cutting.md says what it makes and why.
#include "input/case_cutting.hpp"
#include "input/schema/settings.hpp"

namespace cnem::input {

/// Its values, with defaults filled in. What is wrong with them together goes to `diagnostics`.
CuttingSetup read_cutting(Setting& table, Diagnostics& diagnostics);

/// Puts the keys that follow from [cutting], where a document has it, beside those that the document gives:
/// these win, key by key. Messages about what was put there name the place of [cutting] and say so.
void take_from_cutting(Value& document, Diagnostics& diagnostics);

} // namespace cnem::input
