#pragma once
// What stress points of plies, and points in plane stress, are where they are made of the matter of several.
#include "core/fields/state.hpp"
#include "core/operators/parcels.hpp"
#include "plasticity/material.hpp"

#include <utility>
#include <vector>

namespace cnem {

/// F₀ of points; empty where no material is a ply.
template<int dim> using PlyDeformation = std::vector<std::pair<std::size_t, Mat<2>>>;

/// F₀ = R U of the new points that are plies, averaged over their parcels as ln U and the angle of R, so that
/// the mean is objective and its change of area additive. Where matter is damaged each component of ln U in
/// the axes of the ply counts by the stiffness that is left of it, so that mixing stores no energy. Expects
/// F₀ pushed forward and nothing carried over; mass [old point] kg/m.
template<int dim>
PlyDeformation<dim> mixed_plies(const PointRows& parcels, const Field& mass,
                                const std::vector<plasticity::Material>& materials, bool plane_stress,
                                const PointState<dim>& point);
/// Gives points their F₀, and the C_p⁻¹ = F₀ F₀ᵀ that belongs to it. elastic_volume: as mix_elastic takes it,
/// det F₀ where cells tile the matter.
template<int dim>
void set_plies(const PlyDeformation<dim>& plies, const Field& elastic_volume, PointState<dim>& point);

/// Draws the stress of plies that flow back to the yield surface of the averaged state, by a plastic strain
/// that does no work of its own. Expects set_plies.
template<int dim>
void draw_back_plies(const PlyDeformation<dim>& plies, const std::vector<plasticity::Material>& materials,
                     PointState<dim>& point);

/// Lets go of how broken plies that flow have been sheared: their F₀ becomes √J R with the same change of
/// area J and the fibre where it points, ε^p follows so that the elastic strain stays. They bear a pressure,
/// which knows no more of F₀; with it debris that is sheared on and on has stretches of 10⁴, whose squares
/// leave no digit of the smaller, and gives them to what it is mixed with. Expects F₀ pushed forward.
template<int dim>
void let_go_of_shear(const std::vector<plasticity::Material>& materials, PointState<dim>& point);

/// In plane stress C_p⁻¹_zz is counted from the initial thickness: with that of the present one it is b_e, as
/// mixing takes it, and back.
template<int dim> void to_present_thickness(PointState<dim>& point);
template<int dim> void to_initial_thickness(PointState<dim>& point);

} // namespace cnem
