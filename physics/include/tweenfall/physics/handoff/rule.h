#pragma once

/// Rules of the hand-off: when a body changes owner, to whom, and how.
///
/// A rule lives while the body's owner differs from its `to`. Its trigger acts at an exact time:
/// the step in which it falls is split there.

#include <tweenfall/physics/drive.h>

#include <tweenfall/curves/pose.h>

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tweenfall {

/// Triggers. Instants first, then conditions.
namespace when {
struct At {
  double time = 0;  ///< stage time, s
};
struct Marker {
  std::string name;  ///< an event of a clip that animates the body or an ancestor
};
struct Event {
  std::string name;  ///< an event of any playing clip
};
struct ClipEnd {};  ///< the last play that animates the body is over
struct ContactHit {
  double impulse = 0;  ///< N s; compared with the impulse that the body would take if it were free
  double speed = 0;    ///< approach speed, m/s
  std::string with;    ///< name or pattern of the other node; empty: any
};
struct Asleep {
  double seconds = 0;  ///< continuous stillness of a free body, s
};
struct Enter {
  std::string region;  ///< name or pattern of a node whose body is a sensor
  std::string who;     ///< name or pattern of what comes in; empty: the rule's own body
};
struct Leave {
  std::string region;  ///< the same, for what goes out
  std::string who;
};
struct Saturated {
  double seconds = 0;  ///< for which the drive of a driven body has been at its greatest force or torque, s
};
struct Error {
  double distance = 0;  ///< of a driven body's node from its path, m
};
struct SpeedPeak {
};  ///< the center of mass of a body that is led is on its path as fast as it gets before it slows down
}  // namespace when

struct When;
using Trigger = std::variant<when::At, when::Marker, when::Event, when::ClipEnd, when::ContactHit, when::Asleep,
                             when::Enter, when::Leave, when::Saturated, when::Error, when::SpeedPeak>;

/// Any of the triggers, or, with `all`, every one: instants latch, conditions must hold. What is known only when a step
/// is over (sensors, saturation, the error) acts at its end.
struct When {
  std::vector<Trigger> triggers;
  bool all = false;
};

/// What velocity a released body starts with.
struct TakeOver {
  enum class Velocity { curve, step, zero, average };
  /// The curve's own derivative, from the side that was shown. What a drive lets go has a velocity of its own in place
  /// of the curve's.
  Velocity velocity = Velocity::curve;
  double average_over = 0.1;  ///< s, for `average`
  double scale = 1;           ///< multiplies it
  Twist add = {};             ///< added after
  /// What becomes of a body that lies in others when it leaves its path.
  enum class Overlap {
    push,    ///< it is taken out of them, at no more than the world's `push_out_speed`, and gains no energy by it
    ignore,  ///< it passes through those until they are apart
    rewind,  ///< it leaves from where its path was last clear of them as they stand, with the velocity there
    veto,    ///< it stays, and an event "vetoed" tells so; a rule tries again after each step
  };
  Overlap overlap = Overlap::push;
  double rewind_within = 1;  ///< s; where its path was not clear for so long, it is pushed
};

/// How the difference to the path dies away after a hand-back.
struct Settle {
  enum class Kind { quintic, half_life, dead_blend };
  Kind kind = Kind::quintic;
  double seconds = 0.3;  ///< duration, or half-life
};

/// Where a recovered body's path takes up again.
struct HandBack {
  std::string clip;  ///< empty: the plays that were there
  enum class Clock { run, hold, restart };
  Clock clock = Clock::run;  ///< run: as if never released; hold: paused at the release; restart: from the clip's start
  enum class Anchor { keep, here, ground };
  Anchor anchor = Anchor::keep;  ///< keep: the path where it was authored; here: moved to the body; ground: moved and
                                 ///< turned on the ground only
  Settle settle = {};
};

/// A change of who moves a body.
struct OwnerChange {
  Drive to = Drive::free();
  TakeOver take_over = {};
  HandBack hand_back = {};
  /// How long the drive takes to get there, s: its frequency even in the logarithm between 0.01 Hz and 1000 Hz, where
  /// the ends are free and keyed; limits and damping even. What has none of its own, because it is free or keyed, has
  /// the other's. On its way the body is driven.
  double ramp = 0;
};

/// A change that comes some time after the one before it.
struct NextChange {
  double after = 0;  ///< s, from when that began
  OwnerChange change = {};
};

/// One line of the hand-off.
struct Rule {
  std::vector<std::string> bodies;  ///< names or patterns ("tower/*") of nodes with bodies
  When when;
  Drive to = Drive::free();
  TakeOver take_over = {};
  HandBack hand_back = {};
  bool once = true;
  double ramp = 0;                    ///< s; see `OwnerChange`
  std::vector<NextChange> then = {};  ///< one after another, until the body changes hands in another way

  [[nodiscard]] OwnerChange change() const { return {to, take_over, hand_back, ramp}; }
};

enum class Cause {
  start,
  at,
  marker,
  event,
  clip_end,
  contact,
  asleep,
  enter,
  leave,
  saturated,
  error,
  speed_peak,
  then,  ///< a change that a rule has come after another
  ramp,  ///< the end of the ramp on which the body's drive was
  caller
};

/// What happened: one change of owner.
struct HandOff {
  std::size_t node = 0;
  Owner from = Owner::keyed, to = Owner::free;
  double time = 0;  ///< stage time, s
  Cause cause = Cause::caller;
  Motion before, after;  ///< just before and after; twists at the center of mass, world axes
};

}  // namespace tweenfall
