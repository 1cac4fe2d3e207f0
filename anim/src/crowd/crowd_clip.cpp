#include <tweenfall/anim/crowd.h>

#include "crowd/compiled_clip.h"
#include "crowd/sample_kernels.h"

namespace tweenfall {

namespace {

bool climbs(const ClipClock& clock) {
  return clock.climbs && clock.cycle != 0;
}

}  // namespace

std::size_t CrowdClip::joints() const noexcept {
  return compiled_->joints;
}

double CrowdClip::duration() const noexcept {
  return compiled_->duration;
}

const Loop& CrowdClip::loop() const noexcept {
  return compiled_->loop;
}

double CrowdClip::error(int round) const noexcept {
  return compiled_->climbs.empty() ? compiled_->errors.first : compiled_->errors.in(round);
}

ClipClock CrowdClip::clock(double at, double speed, double stage_time, Side side) const noexcept {
  return clips::steady_clock(speed < 0 ? compiled_->backwards : compiled_->forwards, at, speed, stage_time, side);
}

void CrowdClip::sample(double clip_time, std::span<CrowdGroup> pose) const noexcept {
  crowd::sample_with(crowd::fastest_sample_kernels(), *compiled_, clip_time, false, 1, pose.data(), nullptr);
}

void CrowdClip::sample(const ClipClock& clock, std::span<CrowdGroup> pose) const noexcept {
  crowd::sample_with(crowd::fastest_sample_kernels(), *compiled_, clock.time, clock.side == Side::in, 1, pose.data(),
                     nullptr);
  if (climbs(clock)) crowd::climb(*compiled_, clock.cycle, pose.data(), nullptr);
}

void CrowdClip::sample(const ClipClock& clock, std::span<CrowdGroup> pose, std::span<CrowdRates> rates) const noexcept {
  crowd::sample_with(crowd::fastest_sample_kernels(), *compiled_, clock.time, clock.side == Side::in, clock.rate,
                     pose.data(), rates.data());
  if (climbs(clock)) crowd::climb(*compiled_, clock.cycle, pose.data(), rates.data());
}

void CrowdClip::sample(std::span<const ClipClock> clocks, std::span<CrowdGroup> poses) const noexcept {
  crowd::sample_many_with(crowd::fastest_sample_kernels(), *compiled_, clocks, poses.data());
  for (std::size_t i = 0; i < clocks.size(); ++i)
    if (climbs(clocks[i])) crowd::climb(*compiled_, clocks[i].cycle, poses.data() + i * groups(), nullptr);
}

}  // namespace tweenfall
