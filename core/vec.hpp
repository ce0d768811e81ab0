#pragma once
// Small fixed-size vectors and matrices for geometry; the fields of a run live in structures of arrays
// (state.hpp).
#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace cnem {

template<int dim> using Vec = Eigen::Matrix<double, dim, 1>;
template<int dim> using Mat = Eigen::Matrix<double, dim, dim>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;
using Mat2 = Mat<2>;

/// "x", "y", "z": for names of components.
constexpr const char* axis_name(std::size_t k) { return std::array{"x", "y", "z"}[k]; }

/// z component of a × b.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// a turned by −90°: the outward normal (not normalised) of a boundary edge a that has the domain on its
/// left.
inline Vec2 right_normal(const Vec2& a) { return {a.y(), -a.x()}; }

/// a turned by +90°.
inline Vec2 left_normal(const Vec2& a) { return {-a.y(), a.x()}; }

} // namespace cnem
