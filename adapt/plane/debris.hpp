#pragma once
// Broken matter that flies apart.
#include "adapt/matter.hpp"

namespace cnem::adapt {

/// Broken matter bears no tension; what has opened beyond twice its volume is debris. It keeps its nodes: the
/// spacing that is wanted of it grows with it. Filled up at the old one, shreds of a brittle matrix took four
/// nodes of five.
void spread_debris(NodeProperties& node);

} // namespace cnem::adapt
