#pragma once
// Crack tips of a static analysis of the plane: the functions that enrich it there, and what K is.
#include "app/problem/registry.hpp"
#include "fracture/enrichment.hpp"
#include "fracture/interaction_integral.hpp"
#include "mechanics/statics/statics.hpp"

#include <string>
#include <vector>

namespace cnem::app {

template<int dim> struct StaticModel;

struct Cracks {
  /// Throws InputError where the case asks for what cannot be done at a tip.
  Cracks(const input::Case& input, const Cloud<2>& cloud, const Approximation<2>& approximation);
  /// External forces on all functions, [k][function] N/m. `position`: [k][node] m.
  Fields<2> load(const input::Case& input, const Problem<2>& model, const Fields<2>& position);

  std::vector<fracture::CrackTip> tips;
  std::vector<double> enrichment_radius; ///< [tip] m, 0: none
  fracture::EnrichedOperators enriched;
  std::vector<fracture::FacetLoad> loads;
};

/// K at one tip, from rings of several sizes.
struct TipResult {
  std::string name;
  fracture::StressIntensity intensity; ///< of the default or the given ring
  fracture::Ring ring;
  double difference = 0.0; ///< Pa √m, largest change of (K_I, K_II) over the rings
  double spread = 0.0;     ///< the same over |K|
  double scale = 0.0; ///< Pa √m, of the load: σ√(πR), σ the mean norm of stress within R = ring.outer
  bool enriched = false;
  double spacing_over_half_length = 0.0; ///< – at the tip: the order of the error of K without enrichment
};
/// Throws DivergenceError when one is not a number.
std::vector<TipResult> evaluate_tips(const StaticModel<2>& model, const StaticSolution<2>& solution);

/// What there is to doubt in K: a spread beyond 1% of |K| and of the load, or a tip without enrichment whose
/// spacing is beyond 1% of the crack. Empty when there is nothing.
std::string doubt(const TipResult& tip);

/// The rings a tip is evaluated in, the one that counts last. The first has no plateau: those that leave the
/// tip out agree with each other by discrete equilibrium, however badly the cells there follow √r.
std::vector<fracture::Ring> rings(const input::Fracture& spec, const fracture::CrackTip& tip);

/// One sentence for each crack whose faces overlap: linear statics lets them.
std::vector<std::string> closed_cracks(const StaticModel<2>& model, const StaticSolution<2>& solution);

} // namespace cnem::app
