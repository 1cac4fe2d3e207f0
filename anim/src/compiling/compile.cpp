#include <tweenfall/anim/crowd.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "compiling/choice.h"
#include "compiling/encode.h"
#include "compiling/exact_pose.h"
#include "compiling/fit.h"
#include "compiling/measuring.h"
#include "compiling/reach.h"
#include "crowd/compiled_clip.h"

namespace tweenfall {

namespace crowd {
namespace {

constexpr Kind kinds[] = {Kind::translation, Kind::rotation, Kind::scale};

/// Relative resolution of a float.
constexpr double float_resolution = 1.2e-7;

/// The longest stretch of a formula that is looked at as one at first, s. It is looked at in seven places.
constexpr double longest_look = 1.0 / 16;

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
           LineVector<std::int32_t>& out) {
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

/// The cost of reading a slot from a further row, in lines per knot. Small clips fit the cache anyway: in these time
/// counts more.
double line_for_row(const std::vector<FittedChannel>& fits, bool smallest) {
  constexpr double of_large = 0.06, of_small = 0.24, large = 8000;  // knots of all channels
  if (smallest) return 0;
  double knots = 0;
  for (const FittedChannel& channel : fits)
    if (channel.fit.knots.size() > 1) knots += static_cast<double>(channel.fit.knots.size());
  return std::clamp(of_large * large / knots, of_large, of_small);
}

/// The clips that fitted channels make for different steps. Few of them differ: what was made once is kept.
class Assembly {
 public:
  struct Made {
    std::vector<Form> forms;  ///< of all channels: they tell the clip
    std::shared_ptr<CompiledClip> clip;
    LargestError at_some = {};  ///< largest error at some instants
    std::size_t measured = 0;   ///< at how many of them
  };

  Assembly(const ExactPose& exact, const std::vector<FittedChannel>& fits, const Reach& reach,
           const CrowdSettings& settings)
      : exact_(exact),
        fits_(fits),
        reach_(reach),
        settings_(settings),
        surveys_(surveys_of(fits)),
        line_for_row_(line_for_row(fits, settings.smallest)) {
    std::map<std::vector<double>, std::uint32_t> numbers;
    timelines_.reserve(fits.size());
    for (const FittedChannel& channel : fits)
      timelines_.push_back(
          numbers.try_emplace(channel.fit.knots, static_cast<std::uint32_t>(numbers.size())).first->second);
  }

  /// @param share  how far a number may move a point, m
  [[nodiscard]] Made& made(double share) {
    constexpr std::uint32_t unused = Form::no_timeline;
    std::vector<std::uint32_t> numbers(fits_.size(), unused);  // of the timelines that some channel needs
    std::vector<std::size_t> owners;
    std::vector<std::vector<Way>> choices;
    choices.reserve(fits_.size());
    for (std::size_t i = 0; i < fits_.size(); ++i) {
      const FittedChannel& channel = fits_[i];
      const Steps steps = steps_for(channel.fit, rooms(reach_, channel.group, channel.fit.kind, share));
      std::vector<Way>& of_channel = choices.emplace_back(surveys_[i].ways(steps, line_for_row_));
      if (of_channel.front().form.is_constant()) continue;
      std::uint32_t& number = numbers[timelines_[i]];
      if (number == unused) {
        number = static_cast<std::uint32_t>(owners.size());
        owners.push_back(i);
      }
      for (Way& way : of_channel) way.form.timeline = number;
    }
    std::vector<Form> forms = chosen(choices, settings_.smallest);
    for (Made& made : made_)
      if (made.forms == forms) return made;
    std::shared_ptr<CompiledClip> clip = filled(forms, owners);
    return made_.emplace_back(Made{.forms = std::move(forms), .clip = std::move(clip)});
  }

 private:
  /// @param owners  a channel of each timeline
  [[nodiscard]] std::shared_ptr<CompiledClip> filled(const std::vector<Form>& forms,
                                                     const std::vector<std::size_t>& owners) const {
    auto clip = std::make_shared<CompiledClip>();
    clip->joints = static_cast<std::uint32_t>(exact_.nodes().size());
    clip->duration = exact_.duration();
    clip->loop = exact_.clip().loop;
    for (const std::size_t owner : owners) {
      clip->timelines.emplace_back().knots = fits_[owner].fit.knots;
      clip->timelines.back().index();
    }
    std::map<Form, std::vector<std::size_t>> runs;
    for (std::size_t i = 0; i < forms.size(); ++i) runs[forms[i]].push_back(i);
    for (const auto& [form, members] : runs) add_run(*clip, fits_, form, members);
    lay_out(*clip);
    add_climbs(*clip, exact_);
    return clip;
  }

  const ExactPose& exact_;
  const std::vector<FittedChannel>& fits_;
  const Reach& reach_;
  const CrowdSettings& settings_;
  std::vector<Survey> surveys_;
  double line_for_row_;
  std::vector<std::uint32_t> timelines_;  // by channel: the same number for the same knots
  std::deque<Made> made_;
};

/// Where the errors of fitted channels tell the most.
std::vector<Instant> instants_of(const std::vector<FittedChannel>& fits, const CurveKnots& knots, double duration) {
  std::vector<const std::vector<double>*> channels;
  channels.reserve(fits.size());
  for (const FittedChannel& channel : fits) channels.push_back(&channel.fit.knots);
  std::vector<double> bends;
  for (const auto& kind : knots.of)
    for (const std::vector<double>& of_node : kind) bends.insert(bends.end(), of_node.begin(), of_node.end());
  return telling_instants(channels, std::move(bends), duration);
}

/// Finds the coarsest steps with which fitted channels keep the tolerance.
class Search {
 public:
  Search(const ExactPose& exact, const CurveKnots& knots, const std::vector<FittedChannel>& fits, const Reach& reach,
         const CrowdSettings& settings)
      : tolerance_(settings.tolerance),
        measuring_(exact, settings.arm, reach.rounding, settings.rounds - 1,
                   instants_of(fits, knots, exact.duration())),
        assembly_(exact, fits, reach, settings) {}

  /// @param error  written: that of what is returned, or else of the nearest
  /// @return null if the fits do not keep it, however fine the steps
  [[nodiscard]] std::shared_ptr<CompiledClip> run(LargestError& error) {
    // What does not hold at some instants does not at all of them; where one fails at others, they count from then on.
    constexpr int most_rounds = 12;
    double share = first_share * tolerance_;
    for (int round = 0; round < most_rounds; ++round) {
      if (!holds(finest_share * tolerance_, error)) return nullptr;
      share = coarsest_from(share);
      if (share == 0) return nullptr;
      Assembly::Made& made = assembly_.made(share);
      error = measuring_.at_all(*made.clip, tolerance_);
      if (error.distance <= tolerance_) {
        made.clip->errors = error.errors;
        return made.clip;
      }
    }
    return nullptr;
  }

 private:
  static constexpr double first_share = 0.4, finest_share = 1e-4;  // of the tolerance

  [[nodiscard]] bool holds(double share, LargestError& error) {
    Assembly::Made& made = assembly_.made(share);
    measuring_.at_some(*made.clip, made.at_some, made.measured);
    error = made.at_some;
    return error.distance <= tolerance_;
  }

  /// The largest share that holds at some instants, sought from another on; 0 for none.
  [[nodiscard]] double coarsest_from(double share) {
    double good = 0, bad = 0;
    for (int attempt = 0; attempt < 12; ++attempt) {
      LargestError error;
      if (holds(share, error)) {
        good = share;
        if (assembly_.made(share).clip->timelines.empty()) break;
        share = bad > 0 ? std::sqrt(share * bad)
                        : share * std::clamp(0.9 * tolerance_ / std::max(error.distance, 1e-300), 1.2, 4.0);
      } else {
        bad = share;
        share = good > 0 ? std::sqrt(share * good) : share * std::clamp(0.9 * tolerance_ / error.distance, 0.1, 0.8);
      }
      if (good > 0 && bad > 0 && bad < 1.05 * good) break;
    }
    return good;
  }

  double tolerance_;
  Measuring measuring_;
  Assembly assembly_;
};

void check(const Clip& clip, const CrowdSettings& settings) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(settings.tolerance > 0 && std::isfinite(settings.tolerance),
          "the tolerance of a crowd must be > 0 and finite; it is " + number_text(settings.tolerance) + " m");
  require(settings.arm >= 0 && std::isfinite(settings.arm),
          "the arm of a crowd's joints must be >= 0 and finite; it is " + number_text(settings.arm) + " m");
  require(settings.rounds >= 1 && settings.rounds <= 100'000'000,
          "a crowd can keep its tolerance for 1 to 100 million rounds; it is told " + std::to_string(settings.rounds));
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
  const Reach reach = reach_of(exact, settings.arm, settings.rounds - 1);
  LargestError nearest{.distance = std::numeric_limits<double>::infinity()};
  const auto is_fine = [&] { return nearest.distance < 100 * float_resolution * reach.extent; };
  double look = longest_look;
  for (double share = 0.3 * settings.tolerance; share > 1e-3 * settings.tolerance;) {
    const CurveKnots knots(clip, nodes, look);
    const std::vector<FittedChannel> fits = fitted_channels(exact, knots, reach, share);
    LargestError error;
    if (const auto best = Search(exact, knots, fits, reach, settings).run(error)) return CrowdClip(best);
    if (error.distance < nearest.distance) nearest = error;
    if (!is_fine()) look /= 8;  // something went unseen
    // As much finer as the error was too large, and a little.
    share *= std::clamp(0.7 * settings.tolerance / error.distance, 0.2, 0.5);
  }
  const bool all_rounds = settings.rounds > 1 && clip.loop.mode == LoopMode::repeat_offset;
  throw std::invalid_argument("clip \"" + clip.name + "\" cannot be kept within " + number_text(settings.tolerance) +
                              " m" + (all_rounds ? " for " + std::to_string(settings.rounds) + " rounds" : "") +
                              (is_fine() ? " in float" : "") + "; the nearest is " + number_text(nearest.distance) +
                              " m, at " + number_text(nearest.time) + " s" +
                              (is_fine() ? "" : ", where it changes faster than can be found"));
}

}  // namespace tweenfall
