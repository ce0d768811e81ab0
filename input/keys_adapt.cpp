// Keys of adaptation.
#include "input/keys.hpp"

namespace cnem::input {

void add_adaptation(Keys& k) {
  using enum Type;
  namespace d = dimension;
  k.add("adapt", table, "The cloud follows the deformation (explicit analyses in the plane, method cnem).")
      .always();
  k.add("adapt.resample", boolean,
        "At each new reference nodes that crowd are removed, gaps are filled, the boundary is split and "
        "thinned, "
        "and mass is exchanged between neighbours whose cells no longer fit it; all of it conservative.")
      .fallback("false");
  k.add("adapt.separate", boolean,
        "At each new reference the cloud is cut along edges between broken nodes (materials with `damage`) "
        "where broken matter joins two parts of the boundary: nodes are doubled, nothing is deleted, the new "
        "faces are the piece `fracture`. Needs `contact.deformable`.")
      .fallback("false");
  k.add("adapt.placement", choice,
        "Where nodes are added: half-way between neighbours, or at vertices of Voronoi cells (boundary edges "
        "are "
        "split in the middle in any case).")
      .one_of({"between nodes", "voronoi vertices"})
      .fallback("\"between nodes\"");
  k.add("adapt.growth", quantity, "How fast the wanted spacing may change: per unit of distance.")
      .in({.low = 0.0, .high = 1.0, .low_open = true})
      .fallback("0.3");
  k.add(
       "adapt.tool_spacing", quantity,
       "Wanted spacing at corners and arcs of tools, from where it grows; about half the radius of the edge.")
      .unit(d::length)
      .in(positive)
      .example("\"0.02 mm\"");
  k.add("adapt.indicator", table, "Refinement where a field is not resolved (paper 004, (80)-(82)).")
      .always();
  k.add("adapt.indicator.field", choice,
        "The field: `none` keeps the spacing of the cloud. The indicator of a cell is the L2 distance of the "
        "interpolated field from the value of the cell. `plastic_power` is von Mises stress times plastic "
        "rate, "
        "`damage` needs a material with damage.")
      .one_of({"none", "plastic_strain", "plastic_power", "temperature", "damage"})
      .fallback("\"none\"");
  k.add("adapt.indicator.tolerance", quantity,
        "A cell is refined when its indicator exceeds this part of the norm of the field, shared out among "
        "the cells.")
      .in(positive)
      .fallback("0.1");
  k.add("adapt.indicator.coarsen", quantity,
        "A cell is made coarser when its indicator falls below this part of the limit; 0: never.")
      .in({.low = 0.0, .high = 0.25})
      .fallback("0.05");
  k.add("adapt.indicator.h_min", quantity, "Least spacing.")
      .unit(d::length)
      .in(positive)
      .computed("a quarter of `cloud.spacing`")
      .example("\"0.05 mm\"");
  k.add("adapt.indicator.h_max", quantity, "Largest spacing.")
      .unit(d::length)
      .in(positive)
      .computed("`cloud.spacing`")
      .example("\"0.4 mm\"");
  k.add("adapt.indicator.max_nodes", integer,
        "The tolerance is raised when more nodes than this were needed.")
      .in({.low = 10, .high = 1e8})
      .fallback("100000");
}

} // namespace cnem::input
