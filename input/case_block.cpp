// Workpiece of three-dimensional analyses, of the case reader.
#include "input/case_parts.hpp"
#include "input/curve_checks.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem::input {

Block read_block(const Setting& table, Diagnostics& diagnostics) {
  Block block;
  block.shape = table.choice<Block::Shape>("shape");
  if (block.shape == Block::Shape::cylinder) {
    block.centre = table.vector("centre");
    block.radius = table.get<double>("radius");
    block.length = table.get<double>("length");
    block.part = table.choice<Block::Part>("part");
    return block;
  }
  block.from = table.vector("from");
  block.to = table.vector("to");
  const Setting& to = *table.find("to");
  if (!((block.to - block.from).cwiseAbs().minCoeff() > 0.0))
    diagnostics.add(Mistake::geometry, to.where, to.path,
                    fmt::format("a box from {} to {} has no volume, expected two opposite corners such as {}",
                                show(block.from), show(block.to), to.key->example_text()));
  return block;
}

std::string outside_reason(const Block& block, const Vec3& x) {
  const auto [low, high] = block.bounds();
  const double tolerance = 1e-9 * (high - low).norm();
  const bool in_box = ((x - low).array() >= -tolerance).all() && ((high - x).array() >= -tolerance).all();
  const bool in_disc =
      block.shape == Block::Shape::box ||
      std::hypot(x.x() - block.centre.x(), x.y() - block.centre.y()) <= block.radius + tolerance;
  return in_box && in_disc ? "" : "outside domain.block";
}

} // namespace cnem::input
