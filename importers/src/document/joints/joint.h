#pragma once

// A joint of a document: its kind, its two ends, its place, and when it ends.

#include "document/fields/table.h"

#include <span>
#include <string>
#include <vector>

namespace tweenfall::document::joints {

struct JointBeingRead {
  JointDescription joint;
  json::Value kind;  // the value of its kind
  json::Value at;    // the value of its place, if given
  Vec3 axis{1, 0, 0}, second_axis{0, 0, 0};
  std::vector<Vec3> points;  // one for both ends, or one for each; empty if none are given
  std::optional<Quat>
      toward;  // for a swing-twist joint: how its second node is turned from rest, in the document's axes

  template <class Kind>
  [[nodiscard]] Kind& as() {
    return std::get<Kind>(joint.kind);
  }
};

// Limits and motors of angles and of lengths
[[nodiscard]] fields::FormOf angle_limits_form(double lowest, double highest);
[[nodiscard]] fields::FormOf length_limits_form(bool from_zero);
// @param unit factor from the document's numbers to the program's
[[nodiscard]] std::optional<Limits> read_limits(const json::Value& value, double unit, Building& building);
[[nodiscard]] fields::FormOf motor_form(bool of_angle);
[[nodiscard]] Motor read_motor(const json::Value& value, bool of_angle, Building& building);

// One field for each kind of joint
[[nodiscard]] std::vector<fields::Row<JointBeingRead>> kinds();

// Sets the joint's frames on its nodes from their rest poses; reports faults. @param rests of all nodes, in the world
void place(JointBeingRead& read, std::span<const Pose> rests, Building& building);

}  // namespace tweenfall::document::joints
