#pragma once

#include <span>
#include <vector>

#include "collision/passage.h"
#include "contacts/found.h"

namespace tweenfall::contacts {

/// Two bodies on their ways if the one that moves neither sinks into what it lies on nor is in it.
class LyingBody {
 public:
  /// @param contacts  of the two; those at the start of the step hold it
  LyingBody(std::span<const ContactConstraint> contacts, const collision::Passage& way_a,
            const collision::Passage& way_b);
  LyingBody(const LyingBody&) = delete;
  LyingBody& operator=(const LyingBody&) = delete;
  ~LyingBody() = default;

  /// Whether some contacts are there at the start of the step and others only later, which are then to be found on
  /// these ways: freely falling, it would meet edges that it passes over.
  [[nodiscard]] static bool matters(std::span<const ContactConstraint> contacts);

  [[nodiscard]] const collision::Passage& way_a() const { return way_a_; }
  [[nodiscard]] const collision::Passage& way_b() const { return way_b_; }

 private:
  state::Body body_;
  collision::Passage way_a_, way_b_;
};

/// Drops those contacts of a pair of bodies, of which at least one is a compound, that parts of it have only because
/// the search saw them alone: at a seam, an edge of one part lies on, or in, its neighbor, and what slides or rolls
/// over both must not be caught by it. A contact is kept if something of its part is bare there, such as the face of a
/// wall or a step, and at least one of those with one part of the other body is always kept. Sources: the active edges
/// of Jolt Physics (Rouwe, 2022), the internal edge utility of Bullet (Coumans), ghost vertices of Box2D (Catto).
/// @param first  of the pair's contacts among those found; the others follow
/// @param until  only those up to this time in the step are looked at, s
/// @return those that were dropped
std::vector<ContactHead> drop_contacts_of_seams(FoundContacts& found, std::size_t first,
                                                const collision::Passage& way_a, const collision::Passage& way_b,
                                                double until);

/// The contact that a body which passes a seam has with the part behind it when it is well over the seam, within the
/// step: with a ramp, for example. Without points if there is none.
/// @param from  when it meets the seam, s
void find_behind_seam(ContactConstraint& contact, const collision::Passage& way_a, const collision::Passage& way_b,
                      double from, double dt);

/// Whether a contact found later in the step lies in the plane of one at its start, which holds for all of the step.
/// @param is_a  the first body is the ground
[[nodiscard]] bool in_known_plane(const ContactConstraint& later, std::span<const ContactConstraint> contacts,
                                  const collision::Passage& ground, bool is_a, double near);

/// Drops those without points.
void drop_empty(FoundContacts& found, std::size_t first);

}  // namespace tweenfall::contacts
