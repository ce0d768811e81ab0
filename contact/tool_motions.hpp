#pragma once
// Where tools are and how fast: led by prescribed velocities, or free bodies of a given mass under a force,
// springs, dampers and what the workpiece does to them.
#include "contact/reaction.hpp"
#include "contact/tool.hpp"
#include "core/fields/archive.hpp"

#include <vector>

namespace cnem::contact {

/// A tool during the step t_n → t_{n+1}; at rest unless told otherwise.
template<int dim> struct Pose {
  Vec<dim> start = Vec<dim>::Zero(), end = Vec<dim>::Zero();       ///< m, displacement at t_n and t_{n+1}
  Vec<dim> before = Vec<dim>::Zero(), velocity = Vec<dim>::Zero(); ///< m/s, at t_{n−½} and t_{n+½}
  double recovery = 0.0; ///< m/s, half the speed of the fastest tool
};

template<int dim> using Poses = IndexedVector<ToolIndex, Pose<dim>>;

/// What free tools hold and have received, J/m^(3−dim).
struct DriveEnergy {
  double kinetic = 0.0; ///< Σ ½ M V² at t_{n−½}
  double work = 0.0;    ///< of the forces F(t), of mounts that move and of charging springs, since the start
  double springs = 0.0; ///< stored since the start, at t_{n−½}
  double damping = 0.0; ///< dissipated by dampers since the start
};

/// Free tools move by central differences as nodes do, over [t_{n−½}, t_{n+½}] of length Δt̄:
///
///   M (V_{n+½} − V_{n−½}) = P (∫F dt + Δt̄ S(s_n) d − c Δt̄ (V̄ − V_m) − Σ contact impulses)
///
/// P the projector on the directions they may move in, V̄ the mean of both velocities, V_m that of the mount.
/// The impulse of F is exact; the spring pushes along d by its force at t_n, s = (u_m − u)·d; the damper is
/// taken at the mean velocity, so that it is stable for any c and loses c Δt̄ |V̄ − V_m|² exactly.
template<int dim> class ToolMotions {
public:
  ToolMotions() = default;
  explicit ToolMotions(const Tools<dim>& tools);

  /// Poses of the step [time, time + dt] without contact; dt_mean = (Δt₁ + Δt₂)/2.
  Poses<dim> predict(const Tools<dim>& tools, double time, double dt, double dt_mean);
  /// How tools answer impulses: not at all where their motion is prescribed.
  ReactionsOfTools<dim> reactions(const Tools<dim>& tools, const Poses<dim>& poses) const;
  /// Takes over the motion of free tools, with contact, and books the work of their forces.
  void accept(const Tools<dim>& tools, const Poses<dim>& poses);

  /// Displacement since t = 0, m, of the tool of index t; `time` is that of the present state for free ones.
  Vec<dim> displacement(const Tool<dim>& tool, std::size_t t, double time) const;
  /// Velocity, m/s: prescribed at `time`, of free tools at t_{n−½}.
  Vec<dim> velocity(const Tool<dim>& tool, std::size_t t, double time) const;
  /// At t_{n−½}: the force of contact at t_n, which would carry it on, is known only with the next step.
  DriveEnergy energy(const Tools<dim>& tools) const;
  /// N/m^(3−dim), of the spring of a tool at `time`, which is that of the present state; 0 without one.
  double spring_force(const Tool<dim>& tool, std::size_t t, double time) const;
  /// The largest step that the springs of free tools bear, s: 2 √(M/S'); infinite without one.
  double stable_step(const Tools<dim>& tools, double time) const;

  void archive(Archive& archive, std::size_t t);

private:
  struct Body {
    Vec<dim> displacement = Vec<dim>::Zero(), velocity = Vec<dim>::Zero();
    double work = 0.0;    ///< J/m^(3−dim), of all that acts from outside
    double stored = 0.0;  ///< J/m^(3−dim), in the spring, at t_{n−½}
    double damping = 0.0; ///< J/m^(3−dim), dissipated
  };
  /// What acts on a free tool in the step in hand.
  struct Acting {
    Vec<dim> force = Vec<dim>::Zero();  ///< N s/m^(3−dim), impulse of F
    Vec<dim> spring = Vec<dim>::Zero(); ///< N s/m^(3−dim), impulse of the spring
    Vec<dim> mount = Vec<dim>::Zero();  ///< m/s, its velocity
    double travel = 0.0;                ///< m, of the mount along the spring, at t_{n+½}
    double charge = 1.0;                ///< of the spring at t_{n+½}
    double charging = 0.0;              ///< J/m^(3−dim), work of what charges it
    double dt_mean = 0.0;               ///< s
  };
  void act(const Tool<dim>& tool, ToolIndex t, double time, double from, double to);
  double travel(const Tool<dim>& tool, ToolIndex t, double time) const;

  IndexedVector<ToolIndex, Body> body_; ///< unused where motion is prescribed
  IndexedVector<ToolIndex, Acting> acting_;
};

extern template class ToolMotions<2>;
extern template class ToolMotions<3>;

} // namespace cnem::contact
