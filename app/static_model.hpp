#pragma once
// A static problem made ready, solved, and looked at.
#include "app/registry.hpp"
#include "app/snapshot.hpp"
#include "fracture/enrichment.hpp"
#include "fracture/interaction_integral.hpp"
#include "mechanics/statics.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

/// What a static analysis works on.
struct StaticModel {
  explicit StaticModel(const io::Case& input);

  StaticProblem problem() const;

  const io::Case& input;
  Setup setup;
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
  double spread = 0.0; ///< largest change of (K_I, K_II) over the rings, over |K|
};
std::vector<TipResult> evaluate_tips(const StaticModel& model, const StaticSolution& solution);

/// The rings a tip is evaluated in, the one that counts last.
std::vector<fracture::Ring> rings(const io::Fracture& spec, const fracture::CrackTip& tip);

/// One sentence for each crack whose faces overlap: linear statics lets them.
std::vector<std::string> closed_cracks(const StaticModel& model, const StaticSolution& solution);

/// The solution as a state: positions X + u, and stresses averaged over each cell, kept so that their Cauchy
/// stress is the linear one.
State<2> as_state(const StaticModel& model, const StaticSolution& solution);

} // namespace cnem::app
