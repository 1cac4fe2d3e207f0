#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "islands/free_islands.h"
#include "islands/island_contents.h"
#include "shapes/mirrored.h"

namespace tweenfall::islands {

/// Islands that are their own mirror images: all their bodies are, in one plane, and move within it. By symmetry they
/// never leave it, and turn about its normal alone. But the points of a contact need not be mirror images of each
/// other, nor are impulses found for all of them at once; so their bodies are solved as if each impulse came together
/// with its mirror image, and what is left of motion across the plane is rounding and is removed after the step.
class MirroredIslands {
 public:
  /// Call it before the islands of a step.
  void begin(std::size_t bodies);
  /// Finds those among islands that are about to be solved, and marks their bodies.
  void find(std::span<const IslandContents> islands, std::vector<state::Body>& bodies,
            const std::vector<forces::Load>& loads, double dt);
  /// Takes their bodies back into their planes. @param start_of  a FreeStart by index
  template <class StartOf>
  void keep(std::vector<state::Body>& bodies, const StartOf& start_of) const {
    for (const Member& member : kept_)
      if (!bodies[member.index].asleep) keep(bodies[member.index], start_of(member.index), member.normal);
    for (const Touch& touch : touches_) keep(*touch.contact, touch.normal);
  }
  /// Unmarks their bodies.
  void end(std::vector<state::Body>& bodies) const;
  [[nodiscard]] bool any() const { return !kept_.empty(); }

 private:
  struct Member {
    std::uint32_t index = 0;
    Vec3 normal;  ///< of a plane that it must not leave, unit
  };
  struct Touch {
    contacts::ContactConstraint* contact;
    Vec3 normal;  ///< of a plane in which it pushes, unit
  };
  struct Scene {
    const std::vector<state::Body>& bodies;
    const std::vector<forces::Load>& loads;
    double dt;
  };

  /// @return whether it is its own image in a plane with this normal; its bodies are in `members_` then
  bool is_mirrored(const IslandContents& island, const Scene& scene, const Vec3& normal);
  bool is_mover_mirrored(std::uint32_t index, const Scene& scene, const shapes::Mirror& mirror);
  /// Takes `members_` in, which are those of the island. If joints hold them, these must find all of their inertia.
  void take(const IslandContents& island, std::vector<state::Body>& bodies, const Vec3& normal);
  static void forget(const IslandContents& island, std::vector<state::Body>& bodies);
  static void keep(state::Body& body, const FreeStart& start, const Vec3& normal);
  /// The mirror image of what it told takes away what leads out of the plane.
  static void keep(contacts::ContactConstraint& contact, const Vec3& normal);

  std::vector<std::uint32_t> looked_at_;  ///< by body: the look that found it to be its own image
  std::uint32_t look_ = 0;
  std::vector<std::uint32_t> members_;
  std::vector<Member> kept_;
  std::vector<Touch> touches_;
};

}  // namespace tweenfall::islands
