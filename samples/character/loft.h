#pragma once

/// A loft: a closed skin drawn over a row of oval cross-sections, with rounded ends.

#include <tweenfall/anim/mesh.h>

#include <functional>
#include <vector>

namespace tweenfall::character {

/// One cross-section. Its outline is |x/w|^e + |y/d|^e = 1, with another depth on either side.
struct Section {
  Vec3 center{0, 0, 0};
  double half_width = 0;  ///< along the loft's `side`, m
  double front = 0;       ///< depth along the loft's `up`, m
  double back = 0;        ///< depth against it, m
  double roundness = 2;   ///< e: 2 is an ellipse, more is boxier
};

struct Loft {
  Vec3 side{1, 0, 0};  ///< unit
  Vec3 up{0, 0, 1};    ///< unit, perpendicular to `side`
  std::vector<Section> sections = {};
  double start_cap = 0;  ///< how far the rounded end extends beyond the first section, m
  double end_cap = 0;    ///< and beyond the last
  int around = 16;       ///< vertices on a ring
  int rings = 16;        ///< rings from first section to last, not counting the caps
  int cap_rings = 3;     ///< rings on each cap
};

/// The joints that pull on a point of the bind pose.
using Pulls = std::vector<Influence>;
using Weighting = std::function<Pulls(const Vec3& point)>;

/// Moves a point of the surface: dents and bumps.
using Sculpt = std::function<Vec3(const Vec3& point)>;

/// Appends the loft to the mesh, closed and wound counter-clockwise seen from outside, with smooth normals.
void add_loft(Mesh& mesh, const Loft& loft, const Weighting& weighting, const Sculpt& sculpt = {});

}  // namespace tweenfall::character
