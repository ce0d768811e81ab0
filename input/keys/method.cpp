// Keys of the method and of adaptation.
#include "adapt/indicated_fields.hpp"
#include "input/keys/keys.hpp"
#include "methods/registry.hpp"

namespace cnem::input {

void add_method(Keys& k) {
  using enum Type;
  k.add("method", table, "How it is solved.").always();
  k.add("method.name", choice,
        "Constrained natural elements, linear triangles, corrected particles (SPH), particles that have "
        "constant "
        "stress in balance (sph-consistent), natural elements where the cloud is fine and triangles beyond "
        "(hybrid), or Gauss points with moving least squares (efg): docs/methods.md.")
      .one_of(methods::names_in(2))
      .in_space_one_of(methods::names_in(3))
      .fallback("\"cnem\"");
  k.add("method.functions", choice,
        "Natural neighbour functions (cnem; in space with `method.cells = \"voronoi\"`), or in the plane "
        "moving "
        "least "
        "squares, `mls`.")
      .one_of({"sibson", "laplace", "mls"})
      .in_space_one_of({"sibson", "laplace"})
      .fallback("\"sibson\"");
  k.add("method.support", quantity,
        "Supports of moving least squares in spacings (efg; cnem with `method.functions = \"mls\"`); each "
        "node "
        "counts "
        "the mean distance to its Delaunay neighbours as its spacing.")
      .in({.low = 1.5, .high = 5.0})
      .fallback("2.5");
  k.add("method.gauss_points", integer,
        "Per edge of a Voronoi cell (cnem, hybrid); axisymmetric analyses take at least 2. In space per "
        "facet of "
        "one: 1, or more for one in each of its triangles.")
      .in({.low = 1, .high = 3})
      .example("2")
      .computed("2; in space 1");
  k.add(
       "method.cells", choice,
       "Cells of natural elements in space: `median`, quarters of tetrahedra with their linear functions, or "
       "`voronoi` with natural neighbour functions.")
      .one_of({"voronoi", "median"})
      .fallback("\"median\"")
      .when("name", {"cnem"});
  k.add("method.kernel", choice, "Kernel of the particles.")
      .one_of({"cubic_spline", "wendland_c2"})
      .fallback("\"cubic_spline\"")
      .when("name", {"sph", "sph-consistent"});
  k.add("method.smoothing", quantity,
        "Support of the kernel in spacings, twice the smoothing length; each node counts the distance to its "
        "natural "
        "neighbours as its spacing.")
      .in({.low = 1.5, .high = 5.0})
      .fallback("2.4")
      .when("name", {"sph", "sph-consistent"});
  k.add("method.zone_spacing", quantity,
        "Natural elements where all edges of a triangle between nodes are at most so long, linear triangles "
        "beyond: with adaptation the zone follows the tool and what flows.")
      .unit(dimension::length)
      .in(not_negative)
      .when("name", {"hybrid"})
      .example("\"0.1 mm\"")
      .computed("three quarters of `cloud.spacing`");
  k.add("method.stabilisation", quantity,
        "Factor of the edge-defect stabilisation; 0: off (cnem, sph, sph-consistent, hybrid).")
      .in(not_negative)
      .example("0.1")
      .computed("0.05; in axisymmetric analyses 0.2");
  k.add("method.pressure_exchange", quantity,
        "Factor of the exchange of volume between flowing neighbours, which smooths their pressure; 0: off "
        "(cnem, sph, sph-consistent, hybrid). 0.3 to 2 where pressures matter: docs/pressure_exchange.md.")
      .in(not_negative)
      .fallback("0.0");
  k.add("method.stress_annealing", quantity,
        "Strength of the annealing of stresses on new references where the metal has lately ceased to flow, "
        "which takes the noise out of residual stresses; 0: off (cnem, sph, sph-consistent, hybrid). 1 where "
        "these matter: "
        "docs/pressure_exchange.md.")
      .in(not_negative)
      .fallback("0.0");
  k.add("method.lagrangian", choice,
        "Reference configuration: `total`: the initial one; `periodic`: renewed as `rereference` says; "
        "`updated`: renewed every step.")
      .one_of({"total", "periodic", "updated"})
      .fallback("\"periodic\"");
  k.add("method.rereference", table, "When `periodic` takes a new reference: whichever comes first.")
      .always();
  k.add("method.rereference.every", integer, "Steps (with local steps the finest ones); 0: not by count.")
      .in({.low = 0, .high = 1e9})
      .fallback("0");
  k.add("method.rereference.strain", quantity,
        "Largest ‖f − 1‖ of a cell since the last reference; 0: not by strain.")
      .in(not_negative)
      .fallback("0.25");
  k.add("method.bulk_viscosity", table, "Smears shocks over a few nodes.").always();
  k.add("method.bulk_viscosity.linear", quantity, "Linear coefficient.").in(not_negative).fallback("0.06");
  k.add("method.bulk_viscosity.quadratic", quantity, "Quadratic coefficient.")
      .in(not_negative)
      .fallback("1.2");
  k.add("method.energy_tolerance", quantity,
        "The run has diverged when, from step 10 on, the energy residual exceeds this part of work done and "
        "initial energy; where there is neither, of the energy of a body at rest. Judged with every row "
        "of the history and at the end.")
      .in(positive)
      .fallback("0.05");
}

namespace {

std::vector<std::string> indicator_choices() {
  std::vector<std::string> names{"none"};
  for (const adapt::IndicatedField& field : adapt::indicated_fields()) names.emplace_back(field.name);
  return names;
}

} // namespace

void add_adaptation(Keys& k) {
  using enum Type;
  namespace d = dimension;
  k.add("adapt", table, "The cloud follows the deformation (explicit analyses).").always();
  k.add("adapt.resample", boolean,
        "At each new reference nodes that crowd are removed, gaps are filled, the boundary is split and "
        "thinned, "
        "and mass is exchanged between neighbours whose cells no longer fit it; all of it conservative.")
      .fallback("false");
  k.add("adapt.separate", boolean,
        "At each new reference the cloud is cut along edges (in space: faces) between broken nodes "
        "(materials with "
        "`damage`) "
        "where broken matter joins two parts of the boundary: nodes are doubled, nothing is deleted, the new "
        "faces are the piece `fracture`. Needs `contact.deformable`.")
      .fallback("false");
  k.add("adapt.cracks", boolean,
        "With `adapt.separate` the cloud is opened too where broken matter does not go through: from the "
        "boundary to a tip inside, which goes on with what breaks ahead of it.")
      .fallback("false");
  k.add("adapt.thinnest_film", quantity,
        "With `adapt.separate` a film, matter between two faces with no node inside, that is thinner than "
        "this "
        "is cut at its waist though it is not broken: what it still bore is lost, its thickness times its "
        "flow stress. Ductile matter that no damage parts is else drawn out without end. Crumbs as thin join "
        "what is near. 0: none.")
      .unit(d::length)
      .in(not_negative)
      .fallback("\"0 m\"")
      .example("\"0.5 um\"");
  k.add("adapt.placement", choice,
        "Where nodes are added: half-way between neighbours, or at vertices of Voronoi cells (boundary edges "
        "are "
        "split in the middle in any case).")
      .one_of({"between nodes", "voronoi vertices"})
      .fallback("\"between nodes\"");
  k.add("adapt.quiet_every", integer,
        "Longest interval between passes by count, in steps: after each pass that changes less than one node "
        "in 200 the interval doubles, from `method.rereference.every` up to this, until a pass changes more. "
        "0: it stays. With separation a crack is seen as much later.")
      .in({.low = 0, .high = 1e9})
      .fallback("0");
  k.add("adapt.growth", quantity, "How fast the wanted spacing may change: per unit of distance.")
      .in({.low = 0.0, .high = 1.0, .low_open = true})
      .fallback("0.3");
  k.add("adapt.tool_spacing", quantity,
        "Wanted spacing at corners and arcs of tools (in space at their convex edges and corners), from "
        "where it grows; about half the radius of the edge.")
      .unit(d::length)
      .in(positive)
      .example("\"0.02 mm\"");
  k.add("adapt.surface_spacing", quantity,
        "Largest wanted spacing of free surfaces that flow, from where it grows; a jump of velocity that "
        "arrives there spreads over an edge of the boundary at least.")
      .unit(d::length)
      .in(positive)
      .example("\"0.02 mm\"");
  k.add("adapt.rest_factor", quantity,
        "Wanted spacing of whole matter that has flowed and rests now, over that which the cloud had there "
        "at the "
        "start: what refinement leaves behind is removed. 0: it stays.")
      .in({.low = 0.0, .high = 100.0})
      .fallback("0");
  k.add("adapt.indicator", table, "Refinement where a field is not resolved (paper 004, (80)-(82)).")
      .always();
  k.add("adapt.indicator.field", choice,
        "The field: `none` keeps the spacing of the cloud. The indicator of a cell is the L2 distance of the "
        "interpolated field from the value of the cell. `plastic_power` is von Mises stress times plastic "
        "rate, `plastic_work` what has been dissipated per volume so far: plastic strain that counts where "
        "the "
        "metal resisted; `damage` needs a material with damage.")
      .one_of(indicator_choices())
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
  const std::string at = "adapt.window";
  k.add(at, table,
        "The workpiece is a window on a longer one, which goes with a tool: at passes a strip of it, an "
        "eighth of `ahead`, is fed in ahead and taken off behind, for any length of cut at the same number "
        "of nodes (docs/cutting.md). What comes is like the strip at the end, at rest and as warm as that "
        "was at the start; what comes and goes is booked.");
  k.add(at + ".follow", text, "The tool, which moves through the workpiece and has a rake face.")
      .example("\"cutter\"")
      .computed("the tool named `cutter`, else the only one that moves");
  k.add(at + ".ahead", quantity,
        "Workpiece ahead of the tip of the tool, at least; at least eight times `cloud.spacing`.")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"4.8 mm\"");
  k.add(at + ".behind", quantity, "Workpiece behind the tip that is kept.")
      .unit(d::length)
      .in(positive)
      .required()
      .example("\"3.2 mm\"");
  k.add(at + ".chip", quantity,
        "Chip that is kept, along the side on the rake face; needs `report.cutting`, whose feed says where a "
        "chip begins. Without it the chip stays whole.")
      .unit(d::length)
      .in(positive)
      .example("\"6 mm\"");
}

} // namespace cnem::input
