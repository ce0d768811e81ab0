#pragma once
// The variables of a case: what [let] names, and the values that are calculated from them.
#include "input/case.hpp"
#include "input/schema/diagnostics.hpp"
#include "input/schema/document.hpp"

#include <string>
#include <vector>

namespace cnem::input {

/// Puts values in the place of expressions, wherever the schema expects quantities, vectors, functions or
/// whole numbers, and in the table `let`, whose variables it returns in the order they were written. After
/// that the document stands without them. Variables of the file itself that nothing names where others are
/// named go to `warnings`: where none is, the document is resolved already.
/// `changed`: keys that were set beside the file; a variable among them that nothing names is a mistake.
std::vector<Variable> apply_variables(Value& document, const std::vector<Override>& changed,
                                      Diagnostics& diagnostics, std::vector<std::string>& warnings);

/// Throws InputError when the change sets a variable that the document does not define.
void check_variable_of(const Value& document, const Override& change);

} // namespace cnem::input
