#pragma once
// The fields that users ask for by name, in pictures, probes, lines and files: those that are declared as
// shown (core/state.hpp), and those derived from the state, one line each (field_catalogue.cpp).
#include "core/state.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cnem {

/// What shown fields are made from.
struct FieldSource {
  const State<2>& state;
  const AdaptationFields* adaptation = nullptr; ///< null: the cloud is not adapted
};

/// A field by its case-file name.
struct FieldInfo {
  std::string name; ///< "plastic_strain", as in case files and history columns
  std::string unit; ///< SI unit, "" when dimensionless
  Shown shown;
  bool at_nodes = false;  ///< lives at nodes (else at stress points)
  bool adaptive = false;  ///< only where the cloud is adapted
  bool of_damage = false; ///< zero unless a material has a damage law: then left out of files
  std::function<double(const FieldSource&, std::size_t)> at; ///< value at a stress point or node
};

/// All fields, in the order files list them.
const std::vector<FieldInfo>& field_catalogue();

/// Throws InputError for an unknown name.
const FieldInfo& field_info(const std::string& name);

} // namespace cnem
