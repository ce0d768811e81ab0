#pragma once
// Orthogonal cutting in the words of machinists: the table [cutting] of a case as read. What follows from it
// (workpiece, tool, supports, nodes, times) is in the ordinary keys of the case; input/cutting.hpp writes
// them there.
#include <optional>
#include <string>

namespace cnem::input {

/// A land between flank and rake face.
struct ChamferedEdge {
  double width = 0.0; ///< m, of the land itself
  double angle = 0.0; ///< rad, from the rake face to the land: that has the rake γ − angle
};

/// The tool moves along +x; the uncut surface is at y = `feed`, the one it leaves behind at y = 0.
struct CuttingSetup {
  std::string tool;         ///< name of one of the tools of the case
  double feed = 0.0;        ///< m, uncut chip thickness
  double width = 0.0;       ///< m, of cut, out of the plane: forces in N are those per thickness times it
  double rake = 0.0;        ///< rad
  double clearance = 0.0;   ///< rad
  double edge_radius = 0.0; ///< m, where flank and what follows it meet
  double friction = 0.0;    ///< –, coefficient with chip and workpiece; 0 where its law has none
  std::optional<ChamferedEdge> chamfer; ///< absent: the rake face begins at the edge
  double speed = 0.0;                   ///< m/s
  double length = 0.0;                  ///< m, of cut
  bool exit = false;                    ///< the tool leaves through the far end, which is free
  bool window = false;                  ///< the workpiece goes with the tool
};

} // namespace cnem::input
