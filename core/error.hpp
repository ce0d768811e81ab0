#pragma once
// The kinds of failure a run can end with; app/ maps each to its documented exit code (docs/user_guide.md).
#include <stdexcept>
#include <string>

namespace cnem {

/// Documented exit codes (docs/user_guide.md).
enum Exit : int { done = 0, bad_input = 2, diverged = 3, io_failed = 4, interrupted = 5 };

/// Wrong case, wrong geometry or wrong usage: exit code 2. The message says where, what and what was
/// expected.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A cloud or domain that cannot be triangulated: becomes an InputError that names the file once app/ catches
/// it.
struct GeometryError : InputError {
  using InputError::InputError;
};

/// The simulation left the range where it means anything: exit code 3.
struct DivergenceError : std::runtime_error {
  DivergenceError(const std::string& message, int node_, std::string field_)
      : std::runtime_error(message), node(node_), field(std::move(field_)) {}
  int node;          ///< node (or stress point) where it was first seen
  std::string field; ///< the field that left its range
};

/// Reading or writing failed: exit code 4.
struct IoError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace cnem
