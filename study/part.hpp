#pragma once
// A share of the runs of a study, so that several machines work at one.
#include <cstddef>
#include <string>

namespace cnem::study {

struct Part {
  std::size_t number = 1; ///< from 1
  std::size_t count = 1;  ///< of parts

  /// Whether it has the run with this index, from 0: runs are dealt out in turn, so that slow ones, which
  /// tend to be neighbours in the list, are spread.
  bool holds(std::size_t run) const { return run % count == number - 1; }
};

/// Reads "2/8". Throws InputError for what is none.
Part read_part(const std::string& text);

} // namespace cnem::study
