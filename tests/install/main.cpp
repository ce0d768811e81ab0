// Reads the case that it is given and says what it understood.
#include "core/error.hpp"
#include "input/case_reader.hpp"

#include <fmt/format.h>

int main(int count, char** arguments) {
  if (count != 2) return 2;
  try {
    const cnem::input::Case input = cnem::input::read_case(arguments[1], {});
    fmt::print("case {} with {} tools\n", input.name, input.tools.size());
  } catch (const cnem::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
