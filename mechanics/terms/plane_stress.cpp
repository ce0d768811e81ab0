// Plane stress in the step: volumes are of the initial thickness, and wave moduli follow the present one.
#include "mechanics/terms/list.hpp"

namespace cnem {

namespace {

template<int dim> class PlaneStress : public Term<dim> {
public:
  /// Per present area of the initial thickness.
  void limit(const Body<dim>& body, StepLimit&) override {
    PointState<dim>& point = body.state.point;
    for (std::size_t p = 0; p < point.size(); ++p)
      if (const plasticity::Material& material = body.material_of(p); !material.ply) {
        const bool confined = material.damage && point.softening[p] == 1.0; // it may keep its thickness
        point.wave_modulus[p] = material.wave_modulus(!confined) * point.stress_free[p] / point.jacobian[p];
      }
  }
};

} // namespace

template<int dim> std::unique_ptr<Term<dim>> plane_stress(const Model<dim>& model) {
  return model.plane_stress ? std::make_unique<PlaneStress<dim>>() : nullptr;
}

template std::unique_ptr<Term<2>> plane_stress(const Model<2>&);
template std::unique_ptr<Term<3>> plane_stress(const Model<3>&);

} // namespace cnem
