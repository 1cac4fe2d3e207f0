#include "limbs/reach_state.h"

#include "chains/state_bytes.h"

namespace tweenfall::graphs {

std::vector<std::byte> ReachState::bytes() const {
  chains::StateWriter out;
  out.number(step);
  const std::vector<std::byte> turns = memory.bytes();
  out.bytes.insert(out.bytes.end(), turns.begin(), turns.end());
  return out.bytes;
}

ReachState ReachState::from_bytes(std::span<const std::byte> bytes) {
  chains::StateReader in{bytes, "chain state"};
  if (bytes.size() < 8) in.require_size(8);
  ReachState state;
  state.step = in.number();
  if (state.step < -1 || state.step > most_steps)
    throw std::invalid_argument("chain state: it stands at no time of its clock");
  state.memory = ChainMemory::from_bytes(bytes.subspan(8));
  return state;
}

}  // namespace tweenfall::graphs
