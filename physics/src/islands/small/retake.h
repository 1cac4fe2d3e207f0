#pragma once

#include <vector>

#include "contacts/found.h"
#include "islands/small/part_of_step.h"

namespace tweenfall::small {

/// Where a movable body was before a part of the step.
struct Before {
  Vec3 center{0, 0, 0};
  Quat rotation{1, 0, 0, 0};
  Twist twist;
};

/// A small island that takes a step again, in parts that are as short as they must be.
class Retake {
 public:
  /// @param contacts, bodies  as solved for the whole step, of which nothing is kept
  Retake(const islands::IslandContents& island, const std::vector<state::Body>& bodies);

  [[nodiscard]] PartsOfStep& parts() { return parts_; }
  [[nodiscard]] const std::vector<pairs::Pair>& pairs() const { return pairs_; }
  contacts::FoundPart found;  ///< the contacts of the present part

  /// The contacts found start from the impulses of the part before.
  void inherit();
  /// Adds the result of the contacts found to what the island's contacts report.
  void accept();
  /// Reports everything as if it had happened in one step.
  void finish(double dt);

 private:
  /// That contact of the island which reports one found: of the same parts, or of the surface that faces most alike.
  [[nodiscard]] contacts::ContactConstraint& told(const contacts::ContactConstraint& contact) const;

  std::span<contacts::ContactConstraint* const> contacts_;
  std::vector<double> impact_times_;  ///< of the contacts, s
  std::vector<pairs::Pair> pairs_;
  std::vector<contacts::ContactConstraint> known_;  ///< as they were at the end of the part before
  PartsOfStep parts_;
};

}  // namespace tweenfall::small
