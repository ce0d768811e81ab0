#pragma once
// A part that deforms where it is milled: its hexahedra follow its coordinates, forces on edges go back into
// them by virtual work (paper 004, (1), (7)).
#include "core/fields/archive.hpp"
#include "machining/hexahedral_map.hpp"
#include "machining/mode.hpp"

#include <memory>
#include <vector>

namespace cnem::machining {

/// How the nodes of the hexahedra answer to forces on them.
class PartMotion {
public:
  virtual ~PartMotion() = default;
  /// Displacements of the nodes at the end of the step, m [3 · nodes], under forces that act through it, N.
  virtual Eigen::VectorXd ask(const Eigen::VectorXd& load) const = 0;
  /// Goes to the end of the step under them.
  virtual void take(const Eigen::VectorXd& load) = 0;
  virtual void archive(Archive& archive) = 0;
  virtual double frequency() const = 0; ///< Hz, its lowest, as it is now
};

/// A part reduced to modes, integrated exactly under the mean force of each step.
class ModalMotion final : public PartMotion {
public:
  struct Coordinate {
    double omega = 0.0, damping = 0.0; ///< rad/s, – ζ
  };
  /// follow: [3 · nodes × coordinates], G φ, with φᵀ M φ = 1. dt: s.
  ModalMotion(Eigen::MatrixXd follow, const std::vector<Coordinate>& coordinates, double dt);

  Eigen::VectorXd ask(const Eigen::VectorXd& load) const override;
  void take(const Eigen::VectorXd& load) override;
  void archive(Archive& archive) override;
  double frequency() const override;

private:
  Eigen::MatrixXd moved(const Eigen::VectorXd& load) const;
  Eigen::MatrixXd follow_;
  std::vector<FreeMotion> free_;
  Eigen::VectorXd flexibility_; ///< 1/ω²
  Eigen::MatrixXd state_;       ///< [2 × coordinates] (η, η'/ω)
};

/// Over a workpiece from low to high, m, and half a radius of the cutter beside it, so that rakes which are
/// partly in it go with it as a whole. cells: along each axis; without them none is longer than the radius.
HexahedralMap hexahedra_over(const Vec3& low, const Vec3& high, double radius,
                             const std::optional<std::array<int, 3>>& cells = std::nullopt);

/// Φ⁺ at both ends of a step, in axes of the cut.
class FlexiblePart {
public:
  FlexiblePart(HexahedralMap map, std::unique_ptr<PartMotion> motion)
      : begin_(map), end_(std::move(map)), load_(Eigen::VectorXd::Zero(end_.unknowns())),
        motion_(std::move(motion)) {}

  const HexahedralMap& begin() const { return begin_; }
  const HexahedralMap& end() const { return end_; }

  /// Forces of a question or a step are gathered anew.
  void unload() { load_.setZero(); }
  /// N on the part, at a material point, m.
  void press(const Vec3& material, const Vec3& force) { end_.press(material, force, load_); }
  /// Φ⁺ of the end as these forces have it.
  void answer() { end_.displace(motion_->ask(load_)); }
  /// J, of these forces between both ends of the step.
  double work() const { return load_.dot(end_.displacements() - begin_.displacements()); }
  /// Throws DivergenceError where Φ⁺ of the end is not one-to-one.
  void check() const;
  /// Ends the step, under the forces that there are now.
  void take();
  void archive(Archive& archive);
  double frequency() const { return motion_->frequency(); }

private:
  HexahedralMap begin_, end_;
  Eigen::VectorXd load_; ///< N, on nodes
  std::unique_ptr<PartMotion> motion_;
};

} // namespace cnem::machining
