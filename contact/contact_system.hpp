#pragma once
// A group of contacts as equations for its impulses.
#include "contact/reaction.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cnem::contact {

template<int dim> class Sweeper;

/// Newton's method for the conditions of Signorini and Coulomb (semi-smooth: Alart and Curnier 1991): each
/// contact is open, sticks or slips, as its impulses less a multiple of its gap and slip say; what is then
/// linear is solved (in space with the turn of the direction in which it slips), and the states are looked at
/// again until they stay. The matrix is banded, contacts being numbered breadth first (Cuthill and McKee
/// 1969). Redundant contacts, of which any may bear the load, are made unique by a compliance of 1e-12 of
/// their own.
template<int dim> class ContactSystem {
public:
  enum class Outcome : std::int8_t { settled, unsettled, costly };

  /// Starts from the impulses that a connected group has. `depth` (m) is how deep its deepest contact was;
  /// known_depth ≥ depth (m), in space that of the deepest of the step so far, is what rest is measured by.
  /// `settled` when the states have; then impulses and reactions are those of the solution. Else nothing has
  /// changed: `unsettled` when
  /// - they have not, or in space a pivot vanishes or something slips along what holds it;
  /// - contacts contradict each other: the solution does not close them, or throws one further than
  ///   known_depth and a hundred times the depth, in space along the surface also further than a hundred
  ///   times the way of the fastest that slips;
  /// `costly` when a free tool has many contacts, or in space the band is wide: so it is whatever the
  /// impulses.
  Outcome settle(std::vector<Contact<dim>>& contacts, std::span<const std::int32_t> group,
                 ReactionsOfNodes<dim>& nodes, ReactionsOfTools<dim>& tools, double dt, double depth,
                 double known_depth);

private:
  enum class State : std::int8_t { open, pressing, sticking, slipping };

  /// A contact of the group; [0] along the normal, the others along the surface. Impulses in N s, velocities
  /// in m/s.
  struct Member {
    std::int32_t contact = 0;
    std::array<Vec<dim>, dim> axis{};
    std::array<double, dim> mobility{}; ///< 1/kg, of its own; 0 where nodes are held
    double sideways = 0.0;              ///< 1/kg, the largest along the surface
    std::array<double, dim> given{};    ///< impulses at the start
    std::array<double, dim> change{};   ///< of these, by the last solution
    std::array<double, dim> before{};   ///< gap/Δt and slip at the start
    std::array<double, dim> velocity{}; ///< the same after the last solution
    State state = State::open;
    Vec<dim - 1> direction = Vec<dim - 1>::Zero(); ///< –, along the surface, of the friction where it slips
    double wanted = 0.0;                           ///< N s, the friction that would let it stick
    double impulse(std::size_t k) const { return given[k] + change[k]; }
  };
  /// A node of a contact.
  struct End {
    BoundaryNodeIndex node;
    std::int32_t member;
    double weight;
  };
  /// Two members that share a node or tool: what an impulse on the other does to the velocity of the one.
  struct Link {
    std::int32_t one, other;
    double weight;           ///< –, of both
    const Mat<dim>* inverse; ///< 1/kg, of the node or tool
  };

  bool take(std::int32_t c, const Contact<dim>& contact, const Sweeper<dim>& sweeper, double dt);
  void take_axes(Member& member, const Contact<dim>& contact, const Sweeper<dim>& sweeper) const;
  bool couple(const std::vector<Contact<dim>>& contacts, const ReactionsOfNodes<dim>& nodes,
              const ReactionsOfTools<dim>& tools);
  bool surely_wide();
  void number();
  void fill();
  State state_of(const Contact<dim>& contact, const Member& member, Vec<dim - 1>& friction) const;
  bool look(const std::vector<Contact<dim>>& contacts);
  bool solve(const std::vector<Contact<dim>>& contacts);
  void set_rows(const std::vector<Contact<dim>>& contacts);
  void set_slip(const Contact<dim>& contact, std::int32_t m, std::size_t k);
  bool eliminate();
  bool consistent(double dt, double depth, double known_depth) const;

  bool wide(std::size_t band) const;
  std::size_t width() const { return rubs_ ? dim : 1; }
  std::size_t row(std::int32_t member, std::size_t k) const;
  double* row_of(std::vector<double>& matrix, std::size_t row) const;

  bool rubs_ = false;    ///< whether any has friction: as many unknowns each as dimensions, else one
  std::size_t band_ = 0; ///< half-width
  std::vector<Member> member_;
  std::vector<End> end_;
  std::vector<Link> link_;
  std::vector<std::size_t> first_link_; ///< [member], once sorted, and where the last ends
  std::vector<std::array<std::size_t, Contact<dim>::slots>> first_end_; ///< [member] of those at its nodes
  std::vector<std::int32_t> place_, queue_; ///< [member] number, and [number] member
  std::vector<double> mobility_, matrix_;   ///< rows of 2 band + 1
  std::vector<double> right_, diagonal_;    ///< right_: and the solution; diagonal_: before elimination
};

extern template class ContactSystem<2>;
extern template class ContactSystem<3>;

} // namespace cnem::contact
