#pragma once

#include <memory>
#include <vector>

#include "actors/soft/sub_step.h"
#include "flat/section.h"

namespace tweenfall::soft {

/// A body that a soft one may meet in a step.
struct Near {
  std::uint32_t partner = 0;
  Bounds around{Vec3(0, 0, 0), Vec3(0, 0, 0)};     ///< its whole path, world
  double friction = 0;                             ///< with the soft body
  bool slips = false;                              ///< it is thinner than the space between nodes
  std::shared_ptr<const flat::Section> section{};  ///< in a planar world: its section

  /// How a ball touches the body; the normal points out of it. In a planar world both lie in the plane.
  /// @param node  of the body @param ball  its center, world, m
  /// @param reach  gaps up to this are reported, m
  [[nodiscard]] Manifold touch(const state::Body& rigid, const Pose& node, const Vec3& ball, double radius,
                               double reach) const;
};

/// @param bodies  all bodies of the world, as the step has left them @param near  what it held is replaced
void find_near(const SoftBody& body, const std::vector<state::Body>& bodies, Partners& partners,
               const WorldSettings& settings, double dt, std::vector<Near>& near);

/// The planes in front of which nodes must end a sub-step. A node that is fast enough to reach a surface gets its plane
/// before it is there: so none passes through a thin wall.
void find_contacts(const SoftBody& body, const std::vector<Near>& near, const std::vector<state::Body>& bodies,
                   const Partners& partners, const Vec3& gravity, double push_out_speed, double h,
                   std::vector<NodeContact>& contacts);

}  // namespace tweenfall::soft
