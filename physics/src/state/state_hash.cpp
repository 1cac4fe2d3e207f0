#include <bit>

#include "state/walk.h"
#include "state/word_hash.h"
#include "state/world_data.h"

namespace tweenfall {

namespace state {
namespace {

class StateHash : public Teller<StateHash> {
 public:
  static constexpr bool skips_zeros = true;
  template <class T>
  void number(const T& value) {
    if constexpr (std::is_same_v<T, double>)
      hash_.add(std::bit_cast<std::uint64_t>(value));
    else
      hash_.add(static_cast<std::uint64_t>(value));
  }
  void hull(const ConvexHull& hull) {
    for (const Vec3& vertex : hull.vertices()) walk(*this, vertex);
    for (const ConvexHull::Face& face : hull.faces())
      for (const std::uint32_t corner : hull.corners(face)) number(corner);
  }
  void field(const Field&) {}
  [[nodiscard]] std::uint64_t value() const { return hash_.value(); }

 private:
  WordHash hash_;
};

}  // namespace
}  // namespace state

std::uint64_t World::state_hash() const noexcept {
  if (!implementation_) return 0;
  state::StateHash hash;
  walk(hash, static_cast<const state::WorldState&>(*implementation_));
  return hash.value();
}

}  // namespace tweenfall
