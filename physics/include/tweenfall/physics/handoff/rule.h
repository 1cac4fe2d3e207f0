#pragma once

/// Rules of the hand-off: when a body changes owner, to which one, and how.
///
/// A rule is active while the body's owner differs from its `to`. Its trigger acts at an exact time:
/// the step that contains it is split there.

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
  std::string who;     ///< name or pattern of what enters; empty: the rule's own body
};
struct Leave {
  std::string region;  ///< the same, for what leaves
  std::string who;
};
struct Saturated {
  double seconds = 0;  ///< how long the drive of a driven body has been at its greatest force or torque, s
};
struct Error {
  double distance = 0;  ///< of a driven body's node from its path, m
};
struct SpeedPeak {
};  ///< the speed at which the center of mass of a keyed or driven body follows its path has a local maximum
}  // namespace when

struct When;
using Trigger = std::variant<when::At, when::Marker, when::Event, when::ClipEnd, when::ContactHit, when::Asleep,
                             when::Enter, when::Leave, when::Saturated, when::Error, when::SpeedPeak>;

/// Any of the triggers, or, with `all`, every one: instants latch, conditions must hold. What is known only after a
/// step (sensors, saturation, the error) acts at its end.
struct When {
  std::vector<Trigger> triggers;
  bool all = false;
};

/// The velocity a released body starts with.
struct TakeOver {
  enum class Velocity { curve, step, zero, average };
  /// `curve`: the curve's own derivative, from the side that was shown. A body that its drive lets go has a velocity of
  /// its own, which is used instead.
  Velocity velocity = Velocity::curve;
  double average_over = 0.1;  ///< s, for `average`
  double scale = 1;           ///< multiplies the velocity
  Twist add = {};             ///< added after that
  /// What happens to a body that overlaps others when it leaves its path.
  enum class Overlap {
    push,    ///< it is pushed out at no more than the world's `push_out_speed`, and gains no energy by it
    ignore,  ///< it passes through them until they are apart
    rewind,  ///< it leaves from where its path was last clear of them, as they are now, with its velocity there
    veto,    ///< it stays, with an event "vetoed"; a rule tries again after each step
  };
  Overlap overlap = Overlap::push;
  double rewind_within = 1;  ///< s; if its path was not clear for that long, it is pushed
};

/// How the difference to the path dies away after a hand-back.
struct Settle {
  enum class Kind { quintic, half_life, dead_blend };
  Kind kind = Kind::quintic;
  double seconds = 0.3;  ///< duration, or half-life
};

/// Where the path of a recovered body continues.
struct HandBack {
  std::string clip;  ///< empty: the plays as they are
  enum class Clock { run, hold, restart };
  Clock clock = Clock::run;  ///< run: as if never released; hold: paused at the release; restart: from the clip's start
  enum class Anchor { keep, here, ground };
  /// keep: the path where it was authored; here: moved to the body; ground: moved and turned on the ground only. The
  /// path of a body that joints hold to the bodies above it, as in a ragdoll, is moved as that of the topmost one.
  Anchor anchor = Anchor::keep;
  Settle settle = {};
};

/// A change of who moves a body.
struct OwnerChange {
  Drive to = Drive::free();
  TakeOver take_over = {};
  HandBack hand_back = {};
  /// How long the drive takes to get there, s. Its frequency changes evenly in the logarithm between 0.01 Hz and 1000
  /// Hz, which stand for free and keyed; limits and damping change evenly. A drive without limits and damping of its
  /// own, free or keyed, takes those of the other. During the ramp the body is driven.
  double ramp = 0;
};

/// A change that comes some time after the one before it.
struct NextChange {
  double after = 0;  ///< s, after the start of the one before
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
  then,  ///< a later change of a rule, from its `then`
  ramp,  ///< the end of the ramp of the body's drive
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
