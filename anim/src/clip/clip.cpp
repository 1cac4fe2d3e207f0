#include <tweenfall/anim/clip.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall {

double natural_duration(const Clip& clip) noexcept {
  double latest = 0;
  bool any_finite = false, any_endless = false;
  for (const Track& track : clip.tracks) {
    const double end = extent(track.curve).second;
    if (std::isfinite(end)) {
      latest = std::max(latest, end);
      any_finite = true;
    } else {
      any_endless = true;
    }
  }
  for (const ClipEvent& event : clip.events) {
    latest = std::max({latest, event.from, event.to});
    any_finite = true;
  }
  return any_endless && !any_finite ? std::numeric_limits<double>::infinity() : latest;
}

}  // namespace tweenfall
