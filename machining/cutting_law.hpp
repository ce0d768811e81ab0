#pragma once
// The cutting law of a tool: any of machining/laws/list.hpp.
#include "core/law_variant.hpp"
#include "machining/laws/list.hpp"

namespace cnem::machining {

/// From where to where a law holds; everywhere unless it says.
struct LawRange {
  Range thickness; ///< m
  Range speed;     ///< m/s, of the edge
  Range rake;      ///< rad

  bool several_rakes() const { return rake.bounded() && rake.high > rake.low; }
};

/// Where both hold.
LawRange common(const LawRange& a, const LawRange& b);

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
  /// What the law knows of itself: the points of a table, the rake of an oblique law.
  LawRange known() const;
  /// For a law of inclined edges that does not say how much: that of a cutter's helix, rad.
  void incline(double helix);
  /// For a law over several rakes: forces are those of this one, rad.
  void take_rake(double rake);

private:
  VariantOf<CuttingLaws> law_;
};

} // namespace cnem::machining
