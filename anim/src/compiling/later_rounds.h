#pragma once

// How much larger the errors of a compiled clip are in later rounds of a loop with offset.

#include <span>
#include <vector>

#include "compiling/exact_pose.h"
#include "crowd/compiled_clip.h"

namespace tweenfall::crowd {

/// What moves on from round to round takes what is below it further away, so that an error of a rotation above tells
/// more and more; what turns on sums up errors in other directions than in the first round. And floats are coarser far
/// away.
///
/// A joint that turns on is the top of a segment: all down to the next such joints, which keep their places within it
/// but for what moves on. Within a segment errors are vectors that grow evenly, to be added as such; from one to the
/// next their lengths are, and the changes of lengths by errors of the axes above.
class LaterRounds {
 public:
  /// @param arm  as in `CrowdSettings`
  LaterRounds(const Hierarchy& nodes, std::span<const Climb> climbs, double arm);

  /// `later` and `growth` of the errors at an instant: of the whole figure, over all rounds but the first.
  /// @param wanted  the joints on the exact path in the first round  @param found  those of the compiled clip
  [[nodiscard]] RoundErrors errors(std::span<const Motion> wanted, std::span<const Motion> found);

 private:
  /// A length that grows evenly: at the first round, and per round.
  struct Growing {
    double first = 0, growth = 0;
  };
  /// Where a joint is within its segment.
  struct Place {
    Mat3 axes;
    Vec3 origin, gain;  ///< gain of the origin per round

    [[nodiscard]] Place moved(const Vec3& way, const Vec3& gain_of_it) const {
      return {axes, origin + axes * way, gain + axes * gain_of_it};
    }
  };
  /// The joints of a segment down to one, with their distances from it along all in between.
  struct Levers {
    double count = 0, sum = 0, squares = 0;

    void lengthen(double length) {
      squares += length * (2 * sum + count * length);
      sum += count * length;
    }
  };
  struct Joint {
    Place wanted, found;
    double stretch = 1;  ///< bound on the factor of lengths from the joint to the segment
    Growing rounding;    ///< how far roundings of places take its origin
    Levers first, growth;
    std::size_t segment = 0;
  };
  struct Segment {
    Growing error;          ///< of its origin
    double axes_error = 0;  ///< of the axes in which it lies
    double stretch = 1;     ///< bound on the factor of lengths from these axes to the figure
    double turn_error = 0;  ///< of what turns it on
  };

  [[nodiscard]] Growing error_at(const Joint& joint, const Vec3& wanted, const Vec3& found) const;

  const Hierarchy& nodes_;
  double arm_;
  std::vector<Climb> climbs_;  // of all joints
  std::vector<Joint> joints_;
  std::vector<Segment> segments_;
};

}  // namespace tweenfall::crowd
