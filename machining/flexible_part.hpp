#pragma once
// A part that deforms where it is milled: its hexahedra follow its coordinates, forces on edges go back into
// them by virtual work (paper 004, (1), (7)).
#include "core/fields/archive.hpp"
#include "machining/hexahedral_map.hpp"
#include "machining/mode.hpp"
#include "machining/structure/energy_ledger.hpp"

#include <memory>
#include <vector>

namespace cnem::machining {

/// How the nodes of the hexahedra answer to forces on them.
class PartMotion {
public:
  virtual ~PartMotion() = default;
  /// Begins a step of a duration, s: before the first question about it.
  virtual void begin(double dt) = 0;
  /// Displacements of the nodes at the end of the step, m [3 · nodes], under forces that act through it, N.
  virtual Eigen::VectorXd ask(const Eigen::VectorXd& load) const = 0;
  /// Goes to the end of the step under them, and books their work.
  virtual void take(const Eigen::VectorXd& load) = 0;
  /// Comes to rest without forces: what it held is lost to damping.
  virtual void rest() = 0;
  virtual void archive(Archive& archive) = 0;
  virtual double frequency() const = 0; ///< Hz, its lowest, as it is now

  const EnergyLedger& energy() const { return energy_; }

protected:
  void lose_what_it_holds() {
    energy_.damping += energy_.kinetic + energy_.elastic;
    energy_.kinetic = energy_.elastic = 0.0;
  }
  EnergyLedger energy_;
};

/// A part reduced to modes, integrated exactly under the mean force of each step. Modes are those of one
/// structure: no matter leaves it.
class ModalMotion final : public PartMotion {
public:
  struct Coordinate {
    double omega = 0.0, damping = 0.0; ///< rad/s, – ζ
  };
  /// follow: [3 · nodes × coordinates], G φ, with φᵀ M φ = 1.
  ModalMotion(Eigen::MatrixXd follow, const std::vector<Coordinate>& coordinates);

  void begin(double dt) override;
  Eigen::VectorXd ask(const Eigen::VectorXd& load) const override;
  void take(const Eigen::VectorXd& load) override;
  void rest() override;
  void archive(Archive& archive) override;
  double frequency() const override;

private:
  /// Where coordinate i would rest under forces.
  double rest_of(std::size_t i, const Eigen::VectorXd& load) const;
  Eigen::MatrixXd moved(const Eigen::VectorXd& load) const;
  Eigen::MatrixXd follow_;
  std::vector<Mode> mode_; ///< of stiffness ω²: per m² kg of a coordinate
  double dt_ = 0.0;        ///< s
  std::vector<FreeMotion> free_;
  std::vector<Mat2> loss_; ///< damping_loss()
  Eigen::MatrixXd state_;  ///< [2 × coordinates] (η, η'/ω)
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

  /// Begins a step of a duration, s.
  void begin_step(double dt) { motion_->begin(dt); }
  /// Comes to rest, not deformed, without forces.
  void rest();
  /// Forces of a question or a step are gathered anew.
  void unload() { load_.setZero(); }
  /// N on the part, at a material point, m.
  void press(const Vec3& material, const Vec3& force) { end_.press(material, force, load_); }
  /// Φ⁺ of the end as these forces have it.
  void answer() { end_.displace(motion_->ask(load_)); }
  /// Throws DivergenceError where Φ⁺ of the end is not one-to-one.
  void check() const;
  /// Ends the step, under the forces that there are now, and books what they did.
  void take();
  /// N, on the nodes [3 · nodes]: those that are gathered, or of the last step.
  const Eigen::VectorXd& load() const { return load_; }
  /// To the begin of the step, when the load was this one.
  void go_back(const Eigen::VectorXd& load);
  void archive(Archive& archive);
  double frequency() const { return motion_->frequency(); }
  const EnergyLedger& energy() const { return motion_->energy(); }

private:
  HexahedralMap begin_, end_;
  Eigen::VectorXd load_; ///< N, on nodes
  std::unique_ptr<PartMotion> motion_;
};

} // namespace cnem::machining
