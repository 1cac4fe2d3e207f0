#include <tweenfall/anim/crowd.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "compiling/choice.h"
#include "compiling/encode.h"
#include "compiling/exact_pose.h"
#include "compiling/fit.h"
#include "compiling/reach.h"
#include "crowd/compiled_clip.h"

namespace tweenfall {

namespace crowd {
namespace {

constexpr Kind kinds[] = {Kind::translation, Kind::rotation, Kind::scale};

/// Relative resolution of a float.
constexpr double float_resolution = 1.2e-7;

/// How far off a number of a kind may be if it alone moves the points of the figure by `share`.
double room_for(const Reach& reach, std::size_t joint, Kind kind, double share) {
  if (joint >= reach.joints.size()) return std::numeric_limits<double>::infinity();
  const Reach::OfJoint& of = reach.joints[joint];
  double room = share / of.stretch;
  if (kind == Kind::rotation) room = std::min(share / (2 * of.farthest), 0.05);
  if (kind == Kind::scale) room = share / of.farthest_unscaled;
  return std::max(room, float_resolution * of.largest[static_cast<std::size_t>(kind)]);
}

std::array<double, lane_count> rooms(const Reach& reach, std::size_t group, Kind kind, double share) {
  std::array<double, lane_count> all{};
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    all[lane] = room_for(reach, group * lane_count + lane, kind, share);
  return all;
}

struct FittedChannel {
  std::uint32_t group;
  Fitted fit;
};

std::vector<Survey> surveys_of(const std::vector<FittedChannel>& fits) {
  std::vector<Survey> all;
  all.reserve(fits.size());
  for (const FittedChannel& channel : fits) all.emplace_back(channel.fit);
  return all;
}

std::vector<FittedChannel> fitted_channels(const ExactPose& exact, const CurveKnots& knots, const Reach& reach,
                                           double share) {
  std::vector<FittedChannel> all;
  all.reserve(3 * crowd_groups(exact.nodes().size()));
  for (std::uint32_t group = 0; group < crowd_groups(exact.nodes().size()); ++group)
    for (const Kind kind : kinds)
      all.push_back({group, fitted(exact, knots, group, kind, rooms(reach, group, kind, share))});
  return all;
}

Steps steps_for(const Fitted& fit, const std::array<double, lane_count>& room) {
  double longest = 0;
  for (std::size_t i = 1; i < fit.knots.size(); ++i) longest = std::max(longest, fit.knots[i] - fit.knots[i - 1]);
  Steps steps(fit.slots(), room);
  // An error e of a rate moves a cubic by 4/27 e h.
  for (std::size_t slot = components(fit.kind); slot < steps.size(); ++slot)
    for (double& step : steps[slot]) step *= 3 / longest;
  return steps;
}

/// Interleaves the rows of the channels of a run.
void weave(const std::vector<Encoded>& channels, std::vector<std::int32_t> Encoded::*part, std::size_t rows,
           std::vector<std::int32_t>& out) {
  for (std::size_t row = 0; row < rows; ++row)
    for (const Encoded& channel : channels) {
      const std::vector<std::int32_t>& words = channel.*part;
      const std::size_t length = words.size() / rows;
      const auto begin = words.begin() + static_cast<std::ptrdiff_t>(row * length);
      out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
    }
}

void add_run(CompiledClip& clip, const std::vector<FittedChannel>& fits, const Form& form,
             const std::vector<std::size_t>& members) {
  clip.runs.push_back({.form = form,
                       .first = static_cast<std::uint32_t>(clip.channels.size()),
                       .count = static_cast<std::uint32_t>(members.size())});
  std::vector<Encoded> stored;
  stored.reserve(members.size());
  for (const std::size_t i : members) {
    const Encoded& channel = stored.emplace_back(encoded(fits[i].fit, form));
    clip.channels.push_back({fits[i].group, fits[i].fit.kind, static_cast<std::uint32_t>(clip.numbers.size())});
    clip.numbers.insert(clip.numbers.end(), channel.numbers.begin(), channel.numbers.end());
  }
  const std::size_t knots = form.timeline == Form::no_timeline ? 0 : clip.timelines[form.timeline].knots.size();
  weave(stored, &Encoded::base, form.base_rows(knots), clip.words);
  weave(stored, &Encoded::fine, form.fine == Packing::none ? 0 : knots, clip.words);
}

/// The gain of a relative track applies within the rest pose.
void add_climbs(CompiledClip& clip, const ExactPose& exact) {
  if (exact.clip().loop.mode != LoopMode::repeat_offset) return;
  for (const pose::BoundClip::Entry& entry : exact.bound().entries()) {
    Vec3 gain = entry.gain, turn = entry.turn;
    if (gain == Vec3(0, 0, 0) && turn == Vec3(0, 0, 0)) continue;
    const Pose& rest = exact.nodes()[entry.node].rest;
    if (entry.relative & pose::position_part) gain = rest.rotation * Vec3(rest.scale.cwiseProduct(gain));
    if (entry.relative & pose::rotation_part) turn = rest.rotation * turn;
    Climb climb{.joint = static_cast<std::uint32_t>(entry.node)};
    std::copy_n(gain.data(), 3, climb.gain);
    std::copy_n(turn.data(), 3, climb.turn);
    clip.climbs.push_back(climb);
  }
}

std::shared_ptr<CompiledClip> assembled(const ExactPose& exact, const std::vector<FittedChannel>& fits,
                                        const std::vector<Survey>& surveys, const Reach& reach, double share,
                                        bool smallest) {
  auto clip = std::make_shared<CompiledClip>();
  clip->joints = static_cast<std::uint32_t>(exact.nodes().size());
  clip->duration = exact.duration();
  clip->loop = exact.clip().loop;
  std::map<std::vector<double>, std::uint32_t> timelines;
  std::vector<std::vector<Way>> choices;
  choices.reserve(fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Fitted& fit = fits[i].fit;
    std::vector<Way>& of_channel =
        choices.emplace_back(surveys[i].ways(steps_for(fit, rooms(reach, fits[i].group, fit.kind, share)), smallest));
    if (of_channel.front().form.is_constant()) continue;
    const auto [found, added] = timelines.try_emplace(fit.knots, static_cast<std::uint32_t>(clip->timelines.size()));
    if (added) {
      clip->timelines.emplace_back().knots = fit.knots;
      clip->timelines.back().index();
    }
    for (Way& way : of_channel) way.form.timeline = found->second;
  }
  std::map<Form, std::vector<std::size_t>> runs;
  const std::vector<Form> forms = chosen(choices);
  for (std::size_t i = 0; i < forms.size(); ++i) runs[forms[i]].push_back(i);
  for (const auto& [form, members] : runs) add_run(*clip, fits, form, members);
  lay_out(*clip);
  add_climbs(*clip, exact);
  return clip;
}

/// Every time at which something changes, and some between.
std::vector<double> measured_times(const std::vector<FittedChannel>& fits, double duration) {
  std::vector<double> knots{0.0};
  if (duration > 0) knots.push_back(duration);
  for (const FittedChannel& channel : fits)
    knots.insert(knots.end(), channel.fit.knots.begin(), channel.fit.knots.end());
  std::ranges::sort(knots);
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  std::vector<double> times;
  times.reserve(4 * knots.size());
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    times.push_back(knots[i]);
    for (const double u : {0.27639320225002, 0.50931847710375, 0.77185319624461})
      times.push_back(knots[i] + u * (knots[i + 1] - knots[i]));
  }
  times.push_back(knots.back());
  return times;
}

/// Finds the coarsest steps that keep the tolerance. @param best_error written: the smallest error measured
std::shared_ptr<CompiledClip> coarsest(const ExactPose& exact, const std::vector<FittedChannel>& fits,
                                       const Reach& reach, const CrowdSettings& settings, double& best_error) {
  // The error at times between the measured ones is hardly larger.
  const double allowed = 0.97 * settings.tolerance;
  const std::vector<double> times = measured_times(fits, exact.duration());
  const std::vector<Survey> surveys = surveys_of(fits);
  std::shared_ptr<CompiledClip> best;
  double holds = 0, fails = 0, share = 0.4 * settings.tolerance;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const std::shared_ptr<CompiledClip> clip = assembled(exact, fits, surveys, reach, share, settings.smallest);
    clip->error = largest_error(exact, *clip, settings.arm, times);
    best_error = std::min(best_error, clip->error);
    if (clip->error <= allowed) {
      best = clip;
      holds = share;
      if (clip->timelines.empty()) break;
      share = fails > 0 ? std::sqrt(share * fails)
                        : share * std::clamp(0.9 * allowed / std::max(clip->error, 1e-300), 1.2, 4.0);
    } else {
      fails = share;
      share = holds > 0 ? std::sqrt(share * holds) : share * std::clamp(0.9 * allowed / clip->error, 0.1, 0.8);
    }
    if (holds > 0 && fails > 0 && fails < 1.05 * holds) break;
  }
  return best;
}

void check(const Clip& clip, const CrowdSettings& settings) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(settings.tolerance > 0 && std::isfinite(settings.tolerance),
          "the tolerance of a crowd must be > 0 and finite; it is " + number_text(settings.tolerance) + " m");
  require(settings.arm >= 0 && std::isfinite(settings.arm),
          "the arm of a crowd's joints must be >= 0 and finite; it is " + number_text(settings.arm) + " m");
  require(clip.duration >= 0 && std::isfinite(clip.duration),
          "clip \"" + clip.name + "\" cannot be compiled for a crowd, for it has no end: its duration is " +
              number_text(clip.duration) + " s");
}

}  // namespace
}  // namespace crowd

CrowdClip compile(const Clip& clip, const Hierarchy& nodes, const CrowdSettings& settings) {
  using namespace crowd;
  check(clip, settings);
  const ExactPose exact(clip, nodes);
  const Reach reach = reach_of(exact, settings.arm);
  const CurveKnots knots(clip, nodes);
  double error = std::numeric_limits<double>::infinity();
  for (double share = 0.3 * settings.tolerance; share > 1e-3 * settings.tolerance; share *= 0.2)
    if (const auto best = coarsest(exact, fitted_channels(exact, knots, reach, share), reach, settings, error))
      return CrowdClip(best);
  throw std::invalid_argument("clip \"" + clip.name + "\" cannot be kept within " + number_text(settings.tolerance) +
                              " m in float; the nearest is " + number_text(error) + " m");
}

}  // namespace tweenfall
