#include "input/part_cells.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::input {
namespace {

/// Of a number along the longest side of a box.
std::array<int, 3> cells_as_long(const Vec3& size, int longest) {
  std::array<int, 3> cells{};
  for (int axis = 0; axis < 3; ++axis)
    cells[index_of(axis)] =
        std::max(1, static_cast<int>(std::ceil(longest * size[axis] / size.maxCoeff() - 1e-9)));
  return cells;
}

std::array<int, 3> default_cells(const Vec3& size, machining::PartElement element) {
  constexpr int least = 20, most = 30, few = 1000; // cells that take seconds
  int longest = least;
  if (element == machining::PartElement::hexahedron_27)
    for (longest = most; longest > least; --longest)
      if (const auto [x, y, z] = cells_as_long(size, longest); x * y * z <= few) break;
  return cells_as_long(size, longest);
}

} // namespace

std::optional<std::array<int, 3>> whole_numbers(const Setting& written, const char* what, double most,
                                                Diagnostics& diagnostics) {
  std::array<int, 3> numbers{};
  for (int axis = 0; axis < 3; ++axis) {
    const double count = std::get<Vec3>(written.value)[axis];
    if (count < 1.0 || count > most || count != std::floor(count)) {
      diagnostics.add(Mistake::range, written.where, written.path,
                      fmt::format("found {:g} {} along {}, expected a whole number from 1 to {:g}", count,
                                  what, axis_name(index_of(axis)), most));
      return std::nullopt;
    }
    numbers[index_of(axis)] = static_cast<int>(count);
  }
  return numbers;
}

std::array<int, 3> read_cells(const Setting& part, const Vec3& size, machining::PartElement element,
                              Diagnostics& diagnostics) {
  const Setting* written = part.find("cells");
  constexpr double along = 1000.0;
  std::array<int, 3> cells{1, 1, 1};
  if (written)
    cells = whole_numbers(*written, "cells", along, diagnostics).value_or(cells);
  else
    cells = default_cells(size, element);
  constexpr int most = 20000;
  if (static_cast<double>(cells[0]) * cells[1] * cells[2] > most)
    diagnostics.add(
        Mistake::range, written ? written->where : part.where, part.path + ".cells",
        fmt::format("{} × {} × {} cells, expected at most {}", cells[0], cells[1], cells[2], most));
  return cells;
}

} // namespace cnem::input
