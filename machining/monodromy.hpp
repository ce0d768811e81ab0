#pragma once
// What one period makes of a disturbance of a milling cut: the map whose eigenvalues are Floquet's
// multipliers. Derived in docs/theory.md, "Stability of milling".
#include "machining/engaged_edges.hpp"
#include "machining/mode.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

#include <complex>
#include <span>
#include <vector>

namespace cnem::machining {

/// q̈ + 2ζω q̇ + ω² q = pᵀF/m for every mode, F = Σ W_j(t) (u(t) − u(t − τ_j)) + C_j(t) u̇, u = Σ p q. Between
/// entries and exits of teeth the displacements are polynomials through Gauss points (collocation); modes are
/// integrated exactly under the forces that belong to these, so that steps need not follow the period of a
/// mode.
class Monodromy {
public:
  /// Multipliers are found to about 1e-7 for a linear law and edges at one radius.
  Monodromy(const MillingCut& cut, std::span<const Mode> modes, double spindle, double depth);

  /// Unknowns: (q, v/ω) of all modes, then displacements at the nodes of the last period; velocities beside
  /// them, over the fastest ω, where flanks plough.
  Eigen::Index size() const { return states_ + displacements_; }
  double period() const { return period_; } ///< s
  void operator()(const Eigen::VectorXd& from, Eigen::VectorXd& to) const;

  /// rad/s: the frequency of largest vibration among (arg μ + 2πk)/T, of a multiplier and its eigenvector.
  double strongest_frequency(std::complex<double> multiplier, const Eigen::VectorXcd& vector) const;

private:
  /// A part of the period in which teeth neither enter nor leave.
  struct Element {
    double begin = 0.0, length = 0.0; ///< s
    bool cutting = false;
    Eigen::Index first = 0;      ///< of its unknowns
    Eigen::MatrixXd move, shift; ///< states at its end, from those at its begin and from modal forces
    Eigen::MatrixXd from_states, from_delayed;
    std::vector<Eigen::MatrixXd> factors; ///< [node] modal forces per unknown
    struct Delayed {
      std::size_t node;
      Eigen::Index first;          ///< of the displacements in the element it falls into
      bool previous;               ///< of the period before
      std::vector<double> weights; ///< of its nodes; empty: the node itself
      Eigen::MatrixXd factors;     ///< modal forces per displacement
    };
    std::vector<Delayed> delayed;
  };

  void divide(const MillingCut& cut, const EngagedEdges& edges, double spindle);
  void couple(const MillingCut& cut, const EngagedEdges& edges, double spindle);
  void solve(Element& element, std::span<const Mode> modes);
  template<class See> void march(const Eigen::VectorXd& from, Eigen::VectorXd& to, const See& see) const;

  std::vector<Mode> modes_;
  Eigen::MatrixXd participation_; ///< [3 × modes]
  Eigen::MatrixXd basis_;         ///< [3 × d] of the displacements that modes make and chips know
  Eigen::MatrixXd shape_;         ///< [d × modes] basis coordinates of one unit of a mode
  bool ploughs_ = false;          ///< flanks do
  std::vector<Element> elements_;
  double period_ = 0.0, fastest_ = 0.0;
  Eigen::Index states_ = 0, displacements_ = 0, d_ = 0, each_ = 0; // each_: unknowns of a node
};

} // namespace cnem::machining
