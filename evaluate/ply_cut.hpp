#pragma once
// What a tool has broken of plies, in the frame of the tool (chip.hpp): whether broken matter goes through
// from the edge to the free surface, along which line, and how deep below the cut fibres and matrix are hurt.
#include "evaluate/chip.hpp"
#include "results/snapshot.hpp"

#include <cstddef>
#include <span>

namespace cnem::evaluate {

/// At one moment, as docs/cutting.md defines it.
struct PlyCut {
  bool parted = false;    ///< a chain of broken matrix leads from the edge to the free surface
  double plane = unknown; ///< rad, from the way of the tool: the side of that chain towards the workpiece
  double fibre_depth = 0.0, matrix_depth = 0.0; ///< m below the cut, of the deepest cell that has lost half
  double fibre_area = 0.0, matrix_area = 0.0;   ///< m², Σ d V
};

/// place: [node] m, in the frame of the tool; feed, cut: m. Depths are of cells that the tool has gone over
/// or has before it.
PlyCut look_at_plies(const PointState<2>& point, const Approximation<2>& approximation,
                     std::span<const Vec2> place, double feed, double cut);

/// A chip that breaks off, over the rows of its cut.
struct BrokenChip {
  double peak = unknown;     ///< the largest force until half of it is lost
  double engaged = unknown;  ///< m of cut: the force has first reached nine tenths of its peak
  double released = unknown; ///< m of cut: it has fallen below that again, or the chip is completed
  double completed =
      unknown;          ///< m of cut: broken through, or half of the peak is lost; not-a-number: neither
  std::size_t last = 0; ///< row of completion, else the last one
};

/// cut: [row] m; force: [row], filtered; parted: [row] whether it was broken through.
BrokenChip broken_chip(std::span<const double> cut, std::span<const double> force,
                       std::span<const double> parted);

} // namespace cnem::evaluate
