#pragma once
// A group of contacts in the plane as equations for its impulses.
#include "contact/reaction.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cnem::contact {

/// Newton's method for the conditions of Signorini and Coulomb (semi-smooth: Alart and Curnier 1991): each
/// contact is open, sticks or slips one way, as its impulses less a multiple of its gap and slip say; what is
/// then linear is solved, and the states are looked at again until they stay. The matrix is banded, contacts
/// being numbered breadth first (Cuthill and McKee 1969). Redundant contacts, of which any may bear the load,
/// are made unique by a compliance of 1e-12 of their own.
class ContactSystem {
public:
  /// Starts from the impulses that a connected group has. `depth` (m) is how deep its deepest contact was.
  /// True when the states have settled; then impulses and reactions are those of the solution. False, and
  /// nothing has changed, when they have not, or when contacts contradict each other: the solution does not
  /// close them, or throws one more than a hundred times as far as the depth.
  bool settle(std::vector<Contact<2>>& contacts, std::span<const std::int32_t> group,
              ReactionsOfNodes<2>& nodes, ReactionsOfTools<2>& tools, double dt, double depth);

private:
  enum class State : std::int8_t { open, pressing, sticking, forwards, backwards };

  /// A contact of the group; [0] along the normal, [1] along the surface. Impulses in N s, velocities in m/s.
  struct Member {
    std::int32_t contact = 0;
    std::array<Vec2, 2> axis{};
    std::array<double, 2> mobility{}; ///< 1/kg, of its own; 0 where nodes are held
    std::array<double, 2> given{};    ///< impulses at the start
    std::array<double, 2> change{};   ///< of these, by the last solution
    std::array<double, 2> before{};   ///< gap/Δt and slip at the start
    std::array<double, 2> velocity{}; ///< the same after the last solution
    State state = State::open;
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
    Mat2 inverse;
  };

  bool couple(const std::vector<Contact<2>>& contacts, const ReactionsOfNodes<2>& nodes,
              const ReactionsOfTools<2>& tools);
  void number();
  void fill();
  State state_of(const Contact<2>& contact, const Member& member) const;
  bool look(const std::vector<Contact<2>>& contacts);
  bool solve(const std::vector<Contact<2>>& contacts);
  void set_rows(const std::vector<Contact<2>>& contacts);
  bool eliminate();

  std::size_t width() const { return rubs_ ? 2 : 1; }
  std::size_t row(std::int32_t member, std::size_t k) const;
  double* row_of(std::vector<double>& matrix, std::size_t row) const;

  bool rubs_ = false;    ///< whether any has friction: two unknowns each, else one
  std::size_t band_ = 0; ///< half-width
  std::vector<Member> member_;
  std::vector<End> end_;
  std::vector<Link> link_;
  std::vector<std::int32_t> place_, queue_; ///< [member] number, and [number] member
  std::vector<double> mobility_, matrix_;   ///< rows of 2 band + 1
  std::vector<double> right_;               ///< and the solution
};

} // namespace cnem::contact
