#pragma once
// The cutting law of a tool: any of machining/laws/list.hpp.
#include "core/law_variant.hpp"
#include "machining/laws/list.hpp"

#include <utility>

namespace cnem::machining {

class CuttingLaw {
public:
  CuttingLaw() = default;
  /// Throws InputError where constants of the law do not fit together.
  template<class Law>
  requires requires(const Law& law) { law.at(Cut{}); }
  CuttingLaw(const Law& law) : law_(law) {
    if constexpr (requires { law.complete(); }) law.complete();
  }

  /// Of a chip that is there: thickness > 0.
  LawPoint at(const Cut& cut) const;
  /// Whether forces are in proportion to the chip thickness, but for those of the edge: their slope is the
  /// same at any.
  bool linear() const;
  /// Smallest and largest chip thickness that the law knows of, m; (0, infinite) where it does not say.
  std::pair<double, double> thicknesses() const;
  /// For a law of inclined edges that does not say how much: that of a cutter's helix, rad.
  void incline(double helix);

private:
  VariantOf<CuttingLaws> law_;
};

} // namespace cnem::machining
