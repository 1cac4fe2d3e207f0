#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::queries {

// Each throws std::invalid_argument, naming what is wrong.

/// @param name  with its article, to start a sentence
void require_finite(const Vec3& value, const char* name);
void require_amount(double value, const char* name);  ///< not negative; may be infinite
void require_place(const Pose& pose);
void require_no_plane(const Shape& shape);
/// Requires that not both are planes, and that both are at finite positions.
void require_pair(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

}  // namespace tweenfall::queries
