#pragma once
// Halves and quarters of bodies, and the whole of which they are a part.
#include "input/case.hpp"
#include "report/picture.hpp"

#include <vector>

namespace cnem::report {

/// Where the body of a case goes on as its image: straight pieces of its outer outline along x or y with
/// `symmetry`, all of it on one side, and the axis of a body of revolution. Of parallel lines the first.
std::vector<SymmetryLine> symmetry_lines(const input::Case& input);

/// What lies behind the line is drawn onto it: cells across it end there, others beyond it are of no size.
void keep_side(results::CellFields& fields, const SymmetryLine& line);

/// The cells with their image behind the line, joined where they meet it. sign: [value] of the image.
void add_image(results::CellFields& fields, const SymmetryLine& line, const std::vector<double>& sign);

/// What a field's value becomes in the image: −1 for components that turn round, such as the velocity across
/// the line and the shear stress.
double image_sign(const FieldInfo<2>& field, const SymmetryLine& line);

} // namespace cnem::report
