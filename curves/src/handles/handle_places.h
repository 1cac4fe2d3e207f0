#pragma once

// Where the handles of keys are put by their kinds, one step at a time.

#include <tweenfall/curves/handles.h>

namespace tweenfall::handling {

[[nodiscard]] inline bool is_smooth(TangentKind kind) noexcept {
  return kind == TangentKind::automatic || kind == TangentKind::auto_clamped;
}

/// One side of a key: how far its handle reaches, in time (s, > 0 away from the key) and value.
struct HandleReach {
  double time = 0, value = 0;
};

/// A key while its handles are being put.
struct PlacedKey {
  double time, value;
  TangentKind in_kind, out_kind;
  HandleReach in, out;  ///< value is from the handle to the key, and from the key to the handle
  bool locked = false;  ///< flat whatever its neighbors do
};

/// Gives automatic and auto-clamped keys the slopes of continuous acceleration.
void smooth_handles(std::vector<PlacedKey>& keys, Ends ends);

/// Puts aligned and mirrored handles opposite to their key's other one.
void align_handles(PlacedKey& key) noexcept;

}  // namespace tweenfall::handling
