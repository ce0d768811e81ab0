#pragma once
// Kinematic predictor-corrector contact of the workpiece with rigid tools and with itself.
#include "contact/body_contact.hpp"
#include "contact/impulse_solver.hpp"
#include "contact/kept_impulses.hpp"
#include "contact/near_tools.hpp"
#include "contact/surface.hpp"
#include "contact/tool_motions.hpp"
#include "core/fields/aligned.hpp"
#include "core/fields/archive.hpp"
#include "core/geometry/cloud.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cnem::contact {

/// A node that may not move freely: `free` projects a vector onto the directions it may be pushed in (zero
/// for a fully prescribed node, 1 − n⊗n on a symmetry plane).
template<int dim> struct NodeConstraint {
  NodeIndex node;
  Mat<dim> free;
};

/// One value per boundary node.
using BoundaryValues = IndexedSpan<BoundaryNodeIndex, const double>;

/// One step as the predictor left it: x* = x_n + Δt₂ v*.
template<int dim> struct ContactStep {
  double time = 0.0; ///< s, t_n (the start of the step)
  double dt = 0.0;   ///< s, Δt₂ = t_{n+1} − t_n
  double dt_mean = 0.0; ///< s, Δt̄ = (Δt₁ + Δt₂)/2; Δt₁ = 0 in the first step, when v_{n−½} means v_0
  Fields<dim>& position; ///< m, [node], at t_{n+1}; corrected in place
  Fields<dim>& velocity; ///< m/s, [node], at t_{n+½}; corrected in place
  const Field& mass;     ///< kg/m^(3−dim), [node]
  /// Index of the material of each boundary node; needed where by_material().
  IndexedSpan<BoundaryNodeIndex, const std::int32_t> material = {};
  BoundaryValues flow_stress = {}; ///< Pa; needed where flow_stress_needed()
  BoundaryValues temperature = {}; ///< K; empty: cold
  BoundaryValues melting = {};     ///< K, of the material; empty: never
  BoundaryValues effusivity = {};  ///< W √s/(m² K), of the workpiece; empty: it keeps all friction
                                   ///< heat
  BoundaryValues window = {}; ///< –, over how many Δt̄ the forces that arrive in this step have gathered;
                              ///< empty: one
};

/// Energies of contact, J per unit thickness in 2D, all but the first two ≥ 0. They balance exactly:
/// workpiece = tool + recovery − friction − impact.
struct ContactWork {
  double workpiece = 0.0; ///< Σ ½(v_{n−½} + v_{n+½})·R Δt̄, received by the nodes
  double tool = 0.0; ///< R·V_tool Δt̄, done by the tool's motion: work of a drive, or taken from a free mass
  double recovery = 0.0; ///< put in by pushing existing penetration out, and by turning round a curved tool
  double friction = 0.0; ///< turned into heat by slip, both shares
  double impact = 0.0;   ///< lost where nodes meet the tool at once
};

ContactWork& operator+=(ContactWork& a, const ContactWork& b);

/// What a tool does to the workpiece.
template<int dim> struct ToolResult {
  Vec<dim> displacement = Vec<dim>::Zero(); ///< m, of the tool at t_{n+1}
  Vec<dim> force = Vec<dim>::Zero();   ///< N/m^(3−dim), on the workpiece: Σ impulses of the step / Δt̄
  Vec<dim> impulse = Vec<dim>::Zero(); ///< N s/m^(3−dim), since the start
  ContactWork step;                    ///< in this step
  ContactWork total;                   ///< since the start
  double heat_to_tool = 0.0;           ///< J/m^(3−dim), friction heat the tool took, since the start
};

/// What parts of the workpiece do to each other.
template<int dim> struct BodyResult {
  double pressing = 0.0; ///< N/m^(3−dim), Σ |normal force| of the step
  ContactWork step;      ///< in this step; no tool's work
  ContactWork total;     ///< since the start
};

/// A boundary node that touches a tool (directly or through an edge that a corner presses on).
template<int dim> struct ContactPoint {
  NodeIndex node{};
  ToolIndex tool{};
  double area = 0.0; ///< m^(dim−1), tributary, current, of what faces the tool: half an edge at a corner
};

/// Friction heat that a tool took from where a boundary node touches it.
struct RubbedTool {
  NodeIndex node{};
  ToolIndex tool{};
  double heat = 0.0; ///< J/m^(3−dim)
};

/// A boundary node that touches a facet of the workpiece, another body's or its own.
template<int dim> struct BodyTouch {
  NodeIndex node{};
  std::array<NodeIndex, dim> facet{}; ///< nodes of the facet
  std::array<double, dim> weight{};   ///< of these at the place of the node
  double area = 0.0; ///< m^(dim−1), of the touching surfaces: half of what is tributary to the node, as both
                     ///< sides are listed
};

/// A node inside a tool, or a ridge of a tool inside the workpiece (then node is the nearer end of the edge).
template<int dim> struct Overlap {
  ToolIndex tool{};
  NodeIndex node{};
  double depth = 0.0;                   ///< m, > 0
  Vec<dim> position = Vec<dim>::Zero(); ///< m
  double spacing = 0.0;                 ///< m, of the boundary nodes there
  bool ridge = false;
};

/// Tools with a mass of their own take part: every impulse on the workpiece acts on its tool in the same
/// step, so that their common momentum is exact and no mass is too light.
///
/// Order of calls: set_boundary whenever nodes or boundary change (prepare()); in each step `remember` before
/// the velocities are updated, then the prediction, then `correct`. Serial, so that results do not depend on
/// threads; looks at boundary nodes alone, and closely at those near tools or other bodies.
template<int dim> class RigidContact {
public:
  explicit RigidContact(std::vector<Tool<dim>> tools, Space space = Space::plane, BodyContactLaw bodies = {});

  /// Whether there is anything to touch.
  bool active() const { return !tools_.empty() || law_.active; }
  bool bodies_touch() const { return law_.active; } ///< whether parts of the workpiece see each other
  const BodyContactLaw& body_law() const { return law_; }

  /// Takes the boundary of the cloud and the nodes that are not free. group, ≥ 0: nodes that are tied have
  /// the same number; all of them are held in the same directions, and an impulse on one moves them all.
  /// Empty: none is tied. Costs O(nodes + facets).
  void set_boundary(const std::vector<Facet<dim>>& facets, std::size_t nodes,
                    const std::vector<NodeConstraint<dim>>& constraints,
                    IndexedSpan<NodeIndex, const std::int32_t> group = {});

  /// What of all boundaries to come repeats.
  void repeat(Repetition<dim> repetition) requires(dim == 3) { bodies_.repeat(std::move(repetition)); }

  /// Faces that cohesive interfaces hold together; none after set_boundary.
  void set_bonds(const Bonds& bonds) { bodies_.set_bonds(bonds); }

  /// Keeps v_{n−½} of the boundary nodes for the work of this step.
  void remember(const Fields<dim>& velocity);

  /// Corrects x_{n+1} and v_{n+½} so that nothing that was outside a tool or another part of the workpiece is
  /// inside, with friction, and existing penetration shrinks at no more than half the tool's (or the node's
  /// slip) speed. Tools with another response push nodes that were inside at t_n, and no corners. Throws
  /// InputError when a shear factor is set and no flow stress given, DivergenceError when a node would go
  /// through a tool in this step.
  void correct(const ContactStep<dim>& step);

  /// Between these two calls `correct` is called once in each of several steps, and then all results are
  /// those of one step over `duration` (s, the sum of their Δt̄): sums, and mean forces.
  void begin_sub_steps();
  void end_sub_steps(double duration);

  const Tools<dim>& tools() const { return tools_; }
  /// Displacement since t = 0, m, of a tool at `time`, which is that of the last step for free tools.
  Vec<dim> displacement(std::size_t tool, double time) const {
    return motions_.displacement(tools_[tool], tool, time);
  }
  /// m/s, prescribed at `time`; of free tools at t_{n−½}.
  Vec<dim> velocity(std::size_t tool, double time) const {
    return motions_.velocity(tools_[tool], tool, time);
  }
  /// Of all free tools at t_{n−½}.
  DriveEnergy drive_energy() const { return motions_.energy(tools_); }
  /// Of the spring of a tool at `time`, which is that of the last step, N/m^(3−dim); 0 without one.
  double spring_force(std::size_t tool, double time) const {
    return motions_.spring_force(tools_[tool], tool, time);
  }
  /// What the springs of tools bear at `time`, s; infinite without any.
  double stable_step(double time) const { return motions_.stable_step(tools_, time); }
  bool flow_stress_needed() const;
  bool rubs() const;        ///< whether there is any friction
  bool by_material() const; ///< whether it differs between materials
  /// Nodes of the boundary in increasing order.
  const IndexedVector<BoundaryNodeIndex, NodeIndex>& boundary_nodes() const { return surface_.node; }

  const IndexedVector<ToolIndex, ToolResult<dim>>& results() const { return results_; }
  const BodyResult<dim>& body_result() const { return body_result_; }
  const BodyContact<dim>& bodies() const { return bodies_; }
  const NearTools<dim>& near() const { return near_; }
  const std::vector<ContactPoint<dim>>& points() const { return points_; } ///< touching in the last step
  /// In the last step; listed where the law has a conductance.
  const std::vector<BodyTouch<dim>>& touches() const { return touches_; }
  /// Tools' shares of the friction heat of the last step.
  const std::vector<RubbedTool>& rubbed_tools() const { return rubbed_; }
  /// Workpiece's share of the friction heat of the last step, J/m^(3−dim).
  const IndexedVector<BoundaryNodeIndex, double>& friction_heat() const { return heat_; }
  /// Contact impulse of the last step, N s/m^(3−dim), before constraints take their part.
  const IndexedVector<BoundaryNodeIndex, Vec<dim>>& nodal_impulse() const { return nodal_impulse_; }

  /// Nodes inside tools at a time, tool by tool.
  std::vector<Overlap<dim>> nodes_inside(const Fields<dim>& position, double time) const;
  /// These and ridges inside the workpiece, deepest first: what `check` prints. Both only for a boundary that
  /// has been set.
  std::vector<Overlap<dim>> overlaps(const Fields<dim>& position, double time) const;

  /// Carries the totals and last forces of the tools out or in; all else is made anew in each step.
  void archive(Archive& archive);

private:
  IndexedVector<BoundaryNodeIndex, Vec<dim>> places(const Fields<dim>& position) const;
  double gather(const ContactStep<dim>& step);
  void move(Poses<dim>& poses, double dt);
  void look_for_passages(const Poses<dim>& poses, const ContactStep<dim>& step, double longest) const;
  bool stands(ToolIndex tool) const;
  void set_tied(IndexedSpan<NodeIndex, const std::int32_t> group);
  void take(const Contact<dim>& contact, const ContactStep<dim>& step);
  void take(BoundaryNodeIndex node, const ContactStep<dim>& step);
  Vec<dim> change(BoundaryNodeIndex node) const { return reactions_[mover(reactions_, node)].change; }
  double gap(const Contact<dim>& contact, double dt) const;
  void respond(const Poses<dim>& poses, const ContactStep<dim>& step);
  void answer(Contact<dim>& contact, double depth, const ContactStep<dim>& step);
  Contact<dim> on_face(ToolIndex tool, BoundaryNodeIndex node, const SurfacePoint<dim>& at,
                       const ContactStep<dim>& step) const;
  bool find_on_faces(const Poses<dim>& poses, const ContactStep<dim>& step);
  std::span<const RidgePair> moved_among(std::span<const RidgePair> pairs) requires(dim == 3);
  bool find_on_ridges(const Poses<dim>& poses, const ContactStep<dim>& step);
  bool find_on_edges(const Pose<dim>& rest, const ContactStep<dim>& step) requires(dim == 3);
  bool find_on_bodies(const Poses<dim>& poses, const ContactStep<dim>& step);
  bool waits(const Contact<dim>& contact, double missing);
  void begin_with_kept(const ContactStep<dim>& step);
  bool add(Contact<dim> contact, double start, double level, const Pose<dim>& pose,
           const ContactStep<dim>& step);
  struct Twin;
  /// The one that stands for a node and all that are tied to it.
  BoundaryNodeIndex first_of(BoundaryNodeIndex node) const {
    return exists(tied_[node].first) ? tied_[node].first : node;
  }
  bool tied_alike(const Contact<dim>& one, const Contact<dim>& other) const;
  std::optional<std::size_t> twin_of(const Contact<dim>& contact,
                                     const std::vector<Contact<dim>>& among) const;
  double mass_of(const Contact<dim>& contact, const Field& mass) const;
  bool join(Contact<dim>& bearing, const Contact<dim>& contact, std::size_t of, std::vector<Twin>& twins,
            const Field& mass) const;
  void share_out(std::vector<Contact<dim>>& contacts, std::vector<Twin>& twins, const Field& mass) const;
  template<class Area>
  void set_friction(Contact<dim>& contact, const ContactStep<dim>& step, Area&& rubbing_area) const;
  double rubbing_area(BoundaryNodeIndex node, const Vec<dim>& normal, BoundaryValues window) const;
  const Friction& friction_of(const Contact<dim>& contact, const ContactStep<dim>& step) const;
  void share_heat(const Contact<dim>& contact, double heat, const ContactStep<dim>& step);
  void scatter(const ContactStep<dim>& step);
  void book(const Poses<dim>& poses, const ContactStep<dim>& step);
  void list_points();
  void list_touches();
  void merge_points();
  void merge_touches();
  void add_sub_step(double dt_mean);

  Tools<dim> tools_;
  ToolMotions<dim> motions_;
  Space space_ = Space::plane;
  BodyContactLaw law_;
  BodyContact<dim> bodies_;
  Surface<dim> surface_;
  IndexedVector<BoundaryNodeIndex, Mat<dim>> free_;
  struct Tied {
    BoundaryNodeIndex first, next; ///< of those that are tied to each other; none
  };
  IndexedVector<BoundaryNodeIndex, Tied> tied_;
  double size_ = 0.0; ///< m, of the largest tool, or of the workpiece: the scale of rounding

  // The step in hand.
  IndexedVector<BoundaryNodeIndex, Vec<dim>> before_; ///< m/s, v_{n−½}
  double spread_ = 0.0; ///< m/s, standard deviation of before_; bodies part no faster than half of it
  IndexedVector<BoundaryNodeIndex, Vec<dim>> start_; ///< m, x_n
  IndexedVector<BoundaryNodeIndex, Vec<dim>> end_;   ///< m, x_{n+1} as corrected so far
  ReactionsOfNodes<dim> reactions_;                  ///< of the nodes that contacts have taken
  std::vector<BoundaryNodeIndex> taken_;             ///< these
  IndexedVector<BoundaryNodeIndex, char> is_taken_;
  ReactionsOfTools<dim> tool_reactions_;
  NearTools<dim> near_;
  std::vector<BoundaryNodeIndex> inside_; ///< the box of a tool
  std::vector<Vec<dim>> from_, to_;       ///< m, of these as the tool sees them
  std::vector<Entry<dim>> entries_;
  std::vector<RidgePair> moved_;       ///< 3D
  std::vector<Contact<dim>> contacts_; ///< in `correct` the exact ones, then all
  std::vector<Contact<dim>> answered_; ///< of tools whose response is not exact
  /// What of a contact bears the same impulse as another: one of tied nodes where all touch alike.
  struct Twin {
    Contact<dim> contact;
    std::size_t of; ///< the one that is solved for
  };
  std::vector<Twin> twins_, answered_twins_; ///< of contacts_, of answered_
  ImpulseSolver<dim> solver_;
  KeptImpulses<dim> kept_;
  std::size_t from_earlier_passes_ = 0; ///< how many of them
  bool first_pass_ = false;
  double deepest_ = 0.0; ///< m, in space, where images of a contact bear one load, so far in the step

  IndexedVector<ToolIndex, ToolResult<dim>> results_;
  BodyResult<dim> body_result_;
  std::vector<ContactPoint<dim>> points_;
  std::vector<BodyTouch<dim>> touches_;
  std::vector<RubbedTool> rubbed_;
  IndexedVector<BoundaryNodeIndex, double> heat_;
  IndexedVector<BoundaryNodeIndex, Vec<dim>> nodal_impulse_;

  /// What several steps that are reported as one have added up to.
  struct SubSteps {
    IndexedVector<ToolIndex, ToolResult<dim>> start;
    ContactWork bodies;    ///< at their start
    double pressing = 0.0; ///< N s/m^(3−dim), between bodies
    std::vector<ContactPoint<dim>> points;
    std::vector<BodyTouch<dim>> touches;
    std::vector<RubbedTool> rubbed;
    IndexedVector<BoundaryNodeIndex, double> heat;
    IndexedVector<BoundaryNodeIndex, Vec<dim>> nodal_impulse;
  };
  bool in_sub_steps_ = false;
  SubSteps sub_steps_;
};

extern template class RigidContact<2>;
extern template class RigidContact<3>;

} // namespace cnem::contact
