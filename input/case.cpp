#include "input/case.hpp"

#include "mechanics/field_catalogue.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::input {

std::vector<std::string> Domain::piece_names() const {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const CurvePiece& piece : outer.pieces) add(piece.name);
  for (const Hole& hole : holes)
    for (const CurvePiece& piece : hole.outline.pieces) add(piece.name);
  for (const Crack& crack : cracks) {
    add(crack.name + "+");
    add(crack.name + "-");
  }
  return names;
}

std::vector<std::string> field_names(bool adaptive) {
  std::vector<std::string> names;
  for (const FieldInfo& field : field_catalogue())
    if (adaptive || !field.adaptive) names.push_back(field.name);
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

/// Whether a point such as "(0.01, -2e-3)" stands in a text.
bool names_a_place(const std::string& text) {
  constexpr const char* number = "-+.e0123456789";
  for (std::size_t open = text.find('('); open != std::string::npos; open = text.find('(', open + 1)) {
    const std::size_t comma = text.find_first_not_of(number, open + 1);
    if (comma == std::string::npos || comma == open + 1 || text.compare(comma, 2, ", ") != 0) continue;
    const std::size_t close = text.find_first_not_of(number, comma + 2);
    if (close != std::string::npos && close > comma + 2 && text[close] == ')') return true;
  }
  return false;
}

} // namespace

std::string Case::placed(const std::string& message) const {
  if (origin == Vec2(0, 0)) return message;
  if (!names_a_place(message)) return message;
  return fmt::format("{}; places are counted from ({}, {}) m", message, origin.x(), origin.y());
}

} // namespace cnem::input
