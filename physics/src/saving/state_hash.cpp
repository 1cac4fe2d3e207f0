#include "saving/state_hash.h"

#include "state/world_data.h"

namespace tweenfall {

std::uint64_t World::state_hash() const noexcept {
  if (!implementation_) return 0;
  saving::StateHash hash;
  walk(hash, static_cast<const state::WorldState&>(*implementation_));
  if (implementation_->flat.has_value()) hash.number(implementation_->flat.value().hash());
  return hash.value();
}

}  // namespace tweenfall
