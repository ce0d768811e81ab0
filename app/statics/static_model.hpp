#pragma once
// A static problem made ready, solved, and looked at.
#include "app/problem/registry.hpp"
#include "fracture/enrichment.hpp"
#include "fracture/interaction_integral.hpp"
#include "mechanics/statics/statics.hpp"
#include "results/snapshot.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

/// What a static analysis works on.
struct StaticModel {
  explicit StaticModel(const input::Case& input);

  StaticProblem<2> problem() const;

  const input::Case& input;
  Setup<2> setup;
  Approximation<2> approximation;
  std::vector<fracture::CrackTip> tips;
  std::vector<double> enrichment_radius; ///< [tip] m, 0: none
  fracture::EnrichedOperators enriched;
  Fields<2> position; ///< [k][node] m
  std::vector<fracture::FacetLoad> loads;
  Fields<2> force; ///< [k][function] N/m
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
std::vector<TipResult> evaluate_tips(const StaticModel& model, const StaticSolution<2>& solution);

/// What there is to doubt in K: a spread beyond 1% of |K| and of the load, or a tip without enrichment whose
/// spacing is beyond 1% of the crack. Empty when there is nothing.
std::string doubt(const TipResult& tip);

/// The rings a tip is evaluated in, the one that counts last. The first has no plateau: those that leave the
/// tip out agree with each other by discrete equilibrium, however badly the cells there follow √r.
std::vector<fracture::Ring> rings(const input::Fracture& spec, const fracture::CrackTip& tip);

/// Says how much of the body would flow; empty while nothing does.
std::string beyond_yield(const StaticModel& model, const StaticSolution<2>& solution);

/// One sentence for each crack whose faces overlap: linear statics lets them.
std::vector<std::string> closed_cracks(const StaticModel& model, const StaticSolution<2>& solution);

/// The solution as a state: positions X + u, and stresses averaged over each cell, kept so that their Cauchy
/// stress is the linear one.
State<2> as_state(const StaticModel& model, const StaticSolution<2>& solution);

} // namespace cnem::app
