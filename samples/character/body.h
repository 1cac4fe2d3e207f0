#pragma once

/// The figure's body: one mesh over the skeleton's bind pose, something between a wooden mannequin and a person.

#include <tweenfall/anim/mesh.h>

namespace tweenfall::character {

/// Influences refer to joints in the order of `Joint`.
[[nodiscard]] Mesh make_body();

}  // namespace tweenfall::character
