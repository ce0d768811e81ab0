#pragma once
// Sizes that constants have, with room on both sides.
#include "app/plausibility/list.hpp"

namespace cnem::app {

struct Usual {
  const char* key; ///< in the table of what has it
  const char* unit;
  double low, high;
  const char* of;          ///< who has it
  const char* before = ""; ///< the value in the sentence
};

/// `table`: key of what has the value; zero: it is without.
void doubt_size(const input::Case& input, const std::string& table, const Usual& usual, double value,
                Doubts& doubts);

} // namespace cnem::app
