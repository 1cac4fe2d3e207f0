#pragma once

// The steps that place the handles of keys by their kinds.

#include <tweenfall/curves/handles.h>

namespace tweenfall::handling {

[[nodiscard]] inline bool is_smooth(TangentKind kind) noexcept {
  return kind == TangentKind::automatic || kind == TangentKind::auto_clamped;
}

/// One side of a key: how far its handle reaches, in time (s, > 0 away from the key) and value.
struct HandleReach {
  double time = 0, value = 0;
};

/// A key while its handles are being placed.
struct PlacedKey {
  double time, value;
  TangentKind in_kind, out_kind;
  HandleReach in, out;  ///< value is from the handle to the key, and from the key to the handle
  bool locked = false;  ///< flat, whatever its neighbors are
};

/// Gives automatic and auto-clamped keys the slopes that make the acceleration continuous.
void smooth_handles(std::vector<PlacedKey>& keys, Ends ends);

/// Places aligned and mirrored handles opposite the other handle of their key.
void align_handles(PlacedKey& key) noexcept;

}  // namespace tweenfall::handling
