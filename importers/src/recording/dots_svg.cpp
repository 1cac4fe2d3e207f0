#include "recording/dots_svg.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tweenfall::recordings {

namespace {

constexpr std::size_t most_frames = 90;
constexpr std::size_t most_dots = 12'000;  // in all frames together, of about ten bytes each

/// Particles are counted within their emitter.
bool is_drawn(std::uint64_t number, std::uint64_t every) {
  constexpr std::uint64_t of_emitter = (std::uint64_t{1} << 40) - 1;
  return (number & of_emitter) % every == 0;
}

}  // namespace

void draw_dots(plotting::SvgWriter& svg, const DotsPicture& picture, const ParticlesRecord& particles,
               const std::string& color) {
  const std::size_t count = std::min(particles.frame.size(), picture.recording.times.size());
  if (count == 0) return;
  std::vector<std::size_t> frames;
  const std::size_t shown = std::min(count, most_frames);
  for (std::size_t i = 0; i < shown; ++i) frames.push_back(shown > 1 ? i * (count - 1) / (shown - 1) : 0);
  std::size_t dots = 0;
  for (const std::size_t frame : frames) dots += particles.frame[frame].positions.size();
  const std::uint64_t every = std::max<std::size_t>(1, (dots + most_dots - 1) / most_dots);
  const auto path = [&](std::size_t frame) {
    const StageParticles& there = particles.frame[frame];
    std::string text;
    for (std::size_t i = 0; i < there.positions.size(); ++i) {
      if (!is_drawn(there.numbers[i], every)) continue;
      const Vec2 at = picture.view.place(there.positions[i]);
      if (!at.allFinite() || at.cwiseAbs().maxCoeff() > 1e5) continue;
      text += "M" + short_text(at.x(), 0) + " " + short_text(at.y(), 0) + "h0";
    }
    return text.empty() ? std::string("M-9 -9h0") : text;
  };
  const double width = std::max(3.0, 2 * particles.radius * picture.view.scale);
  svg.open("g", {{"fill", "none"},
                 {"stroke", color},
                 {"stroke-opacity", "0.8"},
                 {"stroke-width", plotting::px(width)},
                 {"stroke-linecap", "round"}});
  svg.text("title", {}, particles.name);
  std::string values, times;
  for (const std::size_t frame : frames) {
    values += path(frame) + ";";
    times += short_text((picture.recording.times[frame] - picture.start) / (picture.length + picture.rest), 5) + ";";
  }
  values += path(frames.back());
  times += "1";
  // Viewers without animation show the middle frame.
  svg.open("path", {{"d", path(frames[frames.size() / 2])}});
  svg.leaf("animate", {{"attributeName", "d"},
                       {"calcMode", "discrete"},
                       {"dur", short_text(picture.length + picture.rest, 4) + "s"},
                       {"repeatCount", "indefinite"},
                       {"keyTimes", times},
                       {"values", values}});
  svg.close();
  svg.close();
}

}  // namespace tweenfall::recordings
