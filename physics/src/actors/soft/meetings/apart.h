#pragma once

#include <span>
#include <vector>

#include "actors/soft/sub_step.h"

namespace tweenfall::soft {

/// A soft body with a thickness, at the end of a sub-step, after the solver.
struct Thick {
  SoftBody* body = nullptr;
  const std::vector<Vec3>* before = nullptr;  ///< where its nodes were at the start
  std::span<Held> held;
};

/// Whether the nodes of two soft bodies keep apart: by the mean of their thicknesses.
[[nodiscard]] bool meet_each_other(const SoftSettings& one, const SoftSettings& other);

/// Keeps the nodes of a soft body apart by its thickness, as balls that do not bounce, with friction.
/// @param h  length of the sub-step, s @param push_out_speed  greatest speed of overlapping nodes, m/s
void keep_apart(const Thick& thick, Partners& partners, double h, bool backward, double push_out_speed);
/// The same for nodes of different soft bodies that meet each other.
/// @return by soft body, whether another pushed it; valid until the next call in this thread
[[nodiscard]] const std::vector<char>& keep_apart_from_each_other(std::span<const Thick> thick, Partners& partners,
                                                                  double h, bool backward, double push_out_speed);

}  // namespace tweenfall::soft
