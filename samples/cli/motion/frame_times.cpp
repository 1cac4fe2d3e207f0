#include "motion/frame_times.h"

#include "line/arguments.h"

#include <tweenfall/curves/number_text.h>

#include <cmath>

namespace tweenfall::cli {

void require_frames(double fps, double until) {
  constexpr double most_fps = 100000, most_frames = 1e6;
  if (!(fps > 0) || fps > most_fps)
    throw UsageError("--fps must be above 0 and at most " + brief_text(most_fps) + ", not " + brief_text(fps));
  if (!(until >= 0)) throw UsageError("--until must be 0 or later, not " + brief_text(until));
  if (until * fps > most_frames) {
    const double enough = most_frames / until;
    throw UsageError(brief_text(until) + " s at " + brief_text(fps) +
                     " frames per second are more than a million frames; give --fps " +
                     brief_text(enough < 1 ? enough : std::floor(enough)) + " or less");
  }
}

std::vector<double> frame_times(double until, double fps) {
  // A last frame closer than this to the end is the end, as in recordings.
  constexpr double same = 1e-9;
  std::vector<double> times{0};
  for (double frame = 1; frame / fps < until - same; ++frame) times.push_back(frame / fps);
  if (until > 0) times.push_back(until);
  return times;
}

}  // namespace tweenfall::cli
