#pragma once
// The workpiece divided along the axis of the cutter: what a layer of dexels stands for.
#include <span>
#include <vector>

namespace cnem::machining {

/// m, heights in the workpiece.
struct Slice {
  double low = 0.0, thickness = 0.0;
  double middle() const { return low + 0.5 * thickness; }
};

/// From 0 to a height, the lowest first: none thicker than `most`, and each height of `between`, in [0,
/// height], lies between two of them. Equally thick where that can be. m
std::vector<Slice> slices(double height, double most, std::vector<double> between = {});
/// The same of slices that are there: those that need not be divided stay as they are, to the bit.
std::vector<Slice> divided(std::span<const Slice> slices, double most, std::vector<double> between);

} // namespace cnem::machining
