#pragma once

// A property of an object through all layers of a stack.

#include "fbx/motion/stacks.h"

#include <tweenfall/curves/rotation.h>

#include <array>

namespace tweenfall::fbx {

/// A property of three numbers, or its value at rest where no stack is given or nothing in it drives the property.
[[nodiscard]] Channel<Vec3> vector_channel(const Objects& objects, std::size_t object, const std::string& property,
                                           const Vec3& otherwise, const Stack* stack);

/// A property of one number, likewise.
[[nodiscard]] Channel<double> number_channel(const Objects& objects, std::size_t object, const std::string& property,
                                             double otherwise, const Stack* stack);

/// A property of three angles in degrees, as a rotation. @param order extrinsic
[[nodiscard]] Channel<Quat> rotation_channel(const Objects& objects, std::size_t object, const std::string& property,
                                             const EulerOrder& order, const Stack* stack);

/// A curve times a number; its spans stay spans.
[[nodiscard]] Curve<double> times(const Curve<double>& curve, double factor);

}  // namespace tweenfall::fbx
