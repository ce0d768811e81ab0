// Workpiece of three-dimensional analyses, of the case reader.
#include "input/case_parts.hpp"
#include "input/curve_checks.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::input {

namespace {

/// What goes together of a cylinder or a sphere.
void check_round(const Setting& table, Block& block, Diagnostics& diagnostics) {
  const auto conflict = [&](const char* key, const std::string& message) {
    const Setting& setting = *table.find(key);
    diagnostics.add(Mistake::conflict, setting.where, setting.path, message);
  };
  using enum Block::Part;
  if (block.inner_radius >= block.radius)
    conflict("inner_radius", fmt::format("found {:g} m, expected less than the radius, {:g} m",
                                         block.inner_radius, block.radius));
  if (block.part == eighth && block.shape == Block::Shape::cylinder)
    conflict("part", "found an eighth of a cylinder, expected it of a sphere");
  const Setting* angle = table.find("angle");
  if (angle && block.part != sector)
    conflict("angle", "found an angle, expected it with part = \"sector\" only");
  if (block.part == sector && !angle)
    diagnostics.add(Mistake::missing_key, table.where, table.path + ".angle",
                    "missing, expected it with part = \"sector\"");
  if (angle) block.angle = std::get<double>(angle->value);
  if (!block.grid) return;
  if (block.inner_radius > 0.0)
    conflict("grid", "found a grid in a tube, expected grid = false with inner_radius");
  if (block.part == sector) conflict("grid", "found a grid in a sector, expected grid = false with it");
}

} // namespace

Block read_block(const Setting& table, Diagnostics& diagnostics) {
  Block block;
  block.shape = table.choice<Block::Shape>("shape");
  block.grid = table.maybe<bool>("grid").value_or(false);
  if (block.shape != Block::Shape::box) {
    block.centre = table.vector("centre");
    block.radius = table.get<double>("radius");
    block.inner_radius = table.maybe<double>("inner_radius").value_or(0.0);
    block.length = table.maybe<double>("length").value_or(0.0);
    block.part = table.choice<Block::Part>("part");
    check_round(table, block, diagnostics);
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
  if (block.shape == Block::Shape::box) return in_box ? "" : "outside domain.block";
  const Vec3 away = x - block.centre;
  const double radius = block.shape == Block::Shape::sphere ? away.norm() : away.head<2>().norm();
  const bool in_shell = radius <= block.radius + tolerance && radius >= block.inner_radius - tolerance;
  double angle = std::atan2(away.y(), away.x());
  if (angle < -1e-9) angle += 2.0 * std::numbers::pi;
  const bool in_sector =
      block.part != Block::Part::sector || away.head<2>().norm() <= tolerance || angle <= block.angle + 1e-9;
  return in_box && in_shell && in_sector ? "" : "outside domain.block";
}

} // namespace cnem::input
