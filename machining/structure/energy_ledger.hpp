#pragma once
// Energies of a structure that bears forces and may lose matter.
#include "core/fields/archive.hpp"

#include <string>
#include <utility>

namespace cnem::machining {

/// J since the begin.
struct EnergyLedger {
  double kinetic = 0.0, elastic = 0.0; ///< of what is there
  double work = 0.0;                   ///< of the forces
  double damping = 0.0;                ///< lost
  double chips = 0.0;                  ///< left with what was taken

  /// What does not add up: 0 but for what an inverse is not exact by, and for matter that goes within a step.
  double imbalance() const { return kinetic + elastic + damping + chips - work; }

  /// Under a path of names that ends with "/".
  void archive(Archive& archive, const std::string& path) {
    for (const auto& [name, number] : {std::pair{"kinetic", &kinetic},
                                       {"elastic", &elastic},
                                       {"work", &work},
                                       {"damping", &damping},
                                       {"chips", &chips}})
      archive.number(path + name, "J", *number);
  }
};

} // namespace cnem::machining
