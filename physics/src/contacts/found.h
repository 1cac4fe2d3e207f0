#pragma once

#include <vector>

#include "collision/passage.h"
#include "contacts/contact_constraint.h"
#include "pairs/broad_phase.h"

namespace tweenfall::contacts {

/// A pair that was told apart in the step before.
struct KnownApart {
  pairs::Pair pair;
  collision::Apart apart;
};

/// The memories of a pair of bodies: one, or one for each pair of parts that touched; places in the sorted list.
struct PairMemories {
  std::uint32_t first = 0, count = 0;
};

/// What a part of the pairs comes to, in their order.
struct FoundPart {
  std::vector<ContactConstraint> contacts;
  std::vector<KnownApart> aparts;
};

}  // namespace tweenfall::contacts
