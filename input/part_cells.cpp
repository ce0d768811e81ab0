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

/// Cells that do not lock, with thin ones beside steps and clamps: 30 along the longest side where that makes
/// few of them, else 20, and fewer where many steps make many all the same.
void divide_finely(machining::PartShape& shape, std::span<const machining::PartSupport> supports) {
  constexpr int usual = 20, finest = 30, coarsest = 10;
  constexpr int few = 1000;            // without the thin ones: seconds
  constexpr std::size_t enough = 3000; // with them: half a minute
  for (int longest = finest;; --longest) {
    shape.divisions = cells_as_long(shape.size, longest);
    if (const auto [x, y, z] = shape.divisions; longest > usual && x * y * z > few) continue;
    shape.more = {};
    const std::array steps = machining::beside_steps(shape),
                     clamps = machining::beside_clamps(shape, supports);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const auto* beside : {&steps[axis], &clamps[axis]})
        shape.more[axis].insert(shape.more[axis].end(), beside->begin(), beside->end());
    if (longest == coarsest || machining::cells_of(shape) <= enough) return;
  }
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

void read_cells(const Setting& part, machining::PartElement element,
                std::span<const machining::PartSupport> supports, machining::PartShape& shape,
                Diagnostics& diagnostics) {
  const Setting* written = part.find("cells");
  std::array<int, 3>& cells = shape.divisions;
  constexpr double along = 1000.0;
  constexpr int usual = 20;
  cells = {1, 1, 1};
  if (written)
    cells = whole_numbers(*written, "cells", along, diagnostics).value_or(cells);
  else if (element == machining::PartElement::hexahedron_27)
    divide_finely(shape, supports);
  else
    cells = cells_as_long(shape.size, usual);
  constexpr int most = 20000;
  if (static_cast<double>(cells[0]) * cells[1] * cells[2] > most)
    diagnostics.add(
        Mistake::range, written ? written->where : part.where, part.path + ".cells",
        fmt::format("{} × {} × {} cells, expected at most {}", cells[0], cells[1], cells[2], most));
}

} // namespace cnem::input
