#include "page/content/page_particles.h"

#include <tweenfall/curves/number_text.h>

#include "json/json_string.h"
#include "page/content/page_frames.h"
#include "recording/base64.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace tweenfall::page {

namespace {

constexpr std::size_t most_shown = 300'000;  // in all frames together, of 32 bytes each

void append_kind(std::string& out, const ParticlesRecord& particles, const Color& color,
                 const std::vector<std::size_t>& frames) {
  std::size_t all = 0;
  for (const std::size_t frame : frames) all += particles.frame.at(frame).positions.size();
  const std::uint64_t every = std::max<std::size_t>(1, (all + most_shown - 1) / most_shown);
  constexpr std::uint64_t of_emitter = (std::uint64_t{1} << 40) - 1;
  std::vector<float> numbers;
  std::vector<std::uint32_t> starts;
  for (const std::size_t frame : frames) {
    starts.push_back(static_cast<std::uint32_t>(numbers.size() / 6));
    const StageParticles& there = particles.frame[frame];
    for (std::size_t i = 0; i < there.positions.size(); ++i) {
      if ((there.numbers[i] & of_emitter) % every != 0) continue;
      for (int axis = 0; axis < 3; ++axis) numbers.push_back(single(there.positions[i][axis]));
      for (int axis = 0; axis < 3; ++axis) numbers.push_back(single(there.velocities[i][axis]));
    }
  }
  starts.push_back(static_cast<std::uint32_t>(numbers.size() / 6));
  out += "{\"name\":";
  json::append_string(out, particles.name);
  out += ",\"radius\":" + number_text(particles.radius) + ",\"every\":" + std::to_string(every) + ",\"color\":[";
  for (int i = 0; i < 3; ++i) out += (i > 0 ? "," : "") + short_text(color.rgba[i], 4);
  out += "],\"starts\":\"" + recordings::base64(std::span<const std::uint32_t>(starts)) + "\",\"numbers\":\"" +
         recordings::base64(numbers) + "\"}";
}

}  // namespace

void append_page_particles(std::string& out, const Recording& recording, const StageDescription& stage,
                           const std::vector<std::size_t>& frames) {
  if (recording.particles.empty()) return;
  out += ",\n\"particles\":[";
  for (std::size_t i = 0; i < recording.particles.size(); ++i) {
    if (i > 0) out += ",\n";
    const auto own = i < stage.particles.size() ? stage.particles[i].color : std::optional<Color>();
    append_kind(out, recording.particles[i], own.value_or(Color{Vec4(0.05, 0.33, 0.7, 1)}), frames);
  }
  out += ']';
}

}  // namespace tweenfall::page
