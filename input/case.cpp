#include "input/case.hpp"

#include "input/space_domain.hpp"
#include "mechanics/field_catalogue.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::input {

std::vector<std::string> Domain::piece_names() const {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  if (block && block->grid)
    for (const std::string& face : block->faces()) add(face);
  for (const std::string& name : faceted_pieces) add(name);
  if ((block && !block->grid) || sweep) {
    std::ranges::for_each(pieces_of(space_domain(*this)), add);
    return names;
  }
  for (const CurvePiece& piece : outer.pieces) add(piece.name);
  for (const Hole& hole : holes)
    for (const CurvePiece& piece : hole.outline.pieces) add(piece.name);
  for (const Crack& crack : cracks) {
    add(crack.name + "+");
    add(crack.name + "-");
  }
  return names;
}

bool moves(const VectorFunction& velocity) {
  return std::any_of(velocity.begin(), velocity.end(), [](const std::optional<TimeTable>& component) {
    return component && std::any_of(component->values().begin(), component->values().end(),
                                    [](double v) { return v != 0.0; });
  });
}

std::array<std::string, 6> Block::faces() const {
  if (shape == Shape::box) return {"x-", "x+", "y-", "y+", "z-", "z+"};
  return {part == Part::quarter ? "x-" : "side",
          "side",
          part == Part::whole ? "side" : "y-",
          "side",
          "bottom",
          "top"};
}

std::array<Vec3, 2> Block::bounds() const {
  if (shape == Shape::box) return {from.cwiseMin(to), from.cwiseMax(to)};
  const bool no_left = part == Part::quarter || part == Part::eighth;
  const bool all_round = part == Part::whole || part == Part::sector;
  const bool ball = shape == Shape::sphere;
  return {centre - Vec3(no_left ? 0.0 : radius, all_round ? radius : 0.0,
                        ball && part != Part::eighth ? radius : 0.0),
          centre + Vec3(radius, radius, ball ? radius : length)};
}

std::vector<std::string> field_names(int dimensions, bool adaptive) {
  std::vector<std::string> names;
  const auto add = [&](const auto& catalogue) {
    for (const auto& field : catalogue)
      if (adaptive || !field.adaptive) names.push_back(field.name);
  };
  dimensions == 3 ? add(field_catalogue<3>()) : add(field_catalogue<2>());
  return names;
}

const plasticity::Material& Case::material(const std::string& wanted) const {
  const auto found =
      std::find_if(materials.begin(), materials.end(),
                   [&](const plasticity::Material& candidate) { return candidate.name == wanted; });
  if (found == materials.end())
    throw error("materials", fmt::format("found no material '{}', expected one that is defined", wanted));
  return *found;
}

InputError Case::error(const std::string& key, const std::string& message) const {
  std::string written = key;
  while (!written.empty() && !location.contains(written)) {
    const auto cut = written.find_last_of(".[");
    written.resize(cut == std::string::npos ? 0 : cut);
  }
  return InputError(
      fmt::format("{}: key '{}': {}", written.empty() ? path : location.at(written), key, placed(message)));
}

namespace {

/// Whether a point such as "(0.01, -2e-3)" or "(0.01, -2e-3, 4)" stands in a text.
bool names_a_place(const std::string& text) {
  constexpr const char* number = "-+.e0123456789";
  for (std::size_t open = text.find('('); open != std::string::npos; open = text.find('(', open + 1)) {
    std::size_t begin = open + 1, numbers = 0;
    while (true) {
      const std::size_t end = text.find_first_not_of(number, begin);
      if (end == std::string::npos || end == begin) break;
      ++numbers;
      if (text[end] == ')' && numbers >= 2) return true;
      if (text.compare(end, 2, ", ") != 0) break;
      begin = end + 2;
    }
  }
  return false;
}

} // namespace

std::string Case::placed(const std::string& message) const {
  if (origin == Vec3(0, 0, 0)) return message;
  if (!names_a_place(message)) return message;
  if (analysis.dimensions() == 3)
    return fmt::format("{}; places are counted from ({}, {}, {}) m", message, origin.x(), origin.y(),
                       origin.z());
  return fmt::format("{}; places are counted from ({}, {}) m", message, origin.x(), origin.y());
}

} // namespace cnem::input
