#include "machining/milling_ledger.hpp"

#include "machining/gauss.hpp"

namespace cnem::machining {

Mat2 damping_loss(const Mode& mode, double time) {
  // c q̇² = 2ζ √(km) (ω z₂)² = 2ζωk z₂².
  const double scale = 2.0 * mode.damping * mode.omega() * mode.stiffness;
  const int pieces = std::max(1, static_cast<int>(std::ceil(mode.omega() * time)));
  const GaussRule& rule = gauss_rule(8);
  const double width = time / pieces;
  Mat2 loss = Mat2::Zero();
  for (int k = 0; k < pieces; ++k)
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const Vec2 speed = FreeMotion(mode, (k + rule.node[i]) * width).of_state.row(1).transpose();
      loss += rule.weight[i] * width * scale * speed * speed.transpose();
    }
  return loss;
}

} // namespace cnem::machining
