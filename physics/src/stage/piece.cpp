#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

#include "handoff/arrival.h"
#include "stage/drive_frame.h"
#include "stage/roster/staged_softs.h"
#include "stage/rules/played_tracks.h"
#include "stage/rules/ramps.h"
#include "stage/stage_data.h"
#include "stage/time/in_order.h"
#include "stage/whole_pose.h"
#include "state/countable.h"

namespace tweenfall::staging {

namespace {

/// Rules and jumps split a step at most this often; what is left then is handled at its end, and reported.
constexpr int most_splits = 1024;

/// The caller's changes that are due after `from`, in order of time.
std::span<const Command> commands_after(std::span<const Command> commands, double from) {
  const auto first = std::ranges::upper_bound(commands, from, {}, &Command::time);
  return commands.subspan(static_cast<std::size_t>(first - commands.begin()));
}

/// Handles everything due up to a sliver after now: reports events, fires rules, makes the caller's changes.
void handle_instant(StageState& state, double step, std::span<const Command> commands,
                    std::vector<Happening>& happenings, std::optional<StageState>& arrived) {
  const double from = state.handled;
  state.handled = state.time + sliver;
  report_events(state, from, state.handled, happenings);
  fire_rules(state, from, step, happenings);
  end_joints(state, from, happenings);
  end_pins(state, from, happenings);
  follow_played_tracks(state, step, happenings);
  follow_ramps(state);
  for (const Command& command : commands_after(commands, state.since)) {
    if (command.time > state.handled) break;
    if (command.at_once != state.at_once) continue;
    if (!arrived) arrived = state;
    make_change(state, command, step, happenings);
  }
  state.jumped = true;
}

/// Moves the world to `end`, or to a caller's change before that. Blows are sought in the whole piece, so that they are
/// where they were before the change was known.
void move_to_change(StageState& state, double end, double change, double step, std::vector<Happening>& happenings) {
  if (!(change < end)) {
    move_world(state, end, step, happenings);
    return;
  }
  StageState whole = state;
  std::vector<Happening> moved;
  move_world(whole, end, step, moved);
  if (whole.time > change) {
    move_world(state, change, step, happenings);
    return;
  }
  state = std::move(whole);
  happenings.insert(happenings.end(), std::make_move_iterator(moved.begin()), std::make_move_iterator(moved.end()));
}

void report_cap(const StageState& state, std::vector<Happening>& happenings) {
  const std::string many = std::to_string(most_splits);
  happenings.push_back(
      {state.time,
       StageEvent{.time = state.time, .name = "split limit", .data = "{\"splits\": " + many + "}", .nodes = {}}});
}

}  // namespace

Motion moved_on(const Motion& motion, const Vec3& center, double seconds) {
  if (seconds == 0) return motion;
  const Vec3 arm = motion.pose.rotation * center;
  const Twist twist = shifted(motion.twist, arm);
  Motion later = motion;
  later.pose.rotation = exp_map(twist.angular * seconds) * motion.pose.rotation;
  later.pose.rotation.normalize();
  const Vec3 turned = later.pose.rotation * center;
  later.pose.position = motion.pose.position + arm + twist.linear * seconds - turned;
  later.twist = shifted(twist, -turned);
  return later;
}

const Motion& bearable(const StageState& state, const StagedBody& body, const Motion& motion, const char* leader) {
  const auto require = [&](const Vec3& value, const char* does, const char* unit) {
    if (state::countable(value)) return;
    const std::string cause = std::string(leader) + " " + does + " " + number_text(value.cwiseAbs().maxCoeff()) + unit +
                              "; a body bears at most 1e30" + unit;
    throw NodeNotFinite(body.node, (*state.nodes)[body.node].name, NotFinite(body.id, state.time, cause));
  };
  // Excessive speeds first: they are the cause of an excessive position.
  require(motion.twist.angular, "turns it at", " rad/s");
  require(motion.twist.linear, "moves it at", " m/s");
  require(motion.pose.position, "puts it at a distance of", " m");
  require(motion.pose.rotation.coeffs().head<3>(), "turns it by", "");
  return motion;
}

void set_targets(StageState& state, double end) {
  // A path that jumps just before the end is followed to the jump and on at its own velocity: the jump is no movement.
  // At its own instant, rounded, a clock may already be behind it.
  const double landed = std::max(state.time, std::min(state.handled, end));
  const double jump = first_jump(state, state.handled, end), before = handing_over::just_before(jump);
  const double reached = !(jump <= end) ? end : before > landed ? before : jump;
  WholePose leaving_pose(state, landed, Side::out), target_pose(state, reached, Side::in);
  for (StagedBody& body : state.bodies) {
    if (!body.present || state.world.is_fixed(body.id)) continue;
    const Owner owner = state.world.owner(body.id);
    if (owner == Owner::free) continue;
    const Vec3& center = state.world.mass(body.id).center;
    if (state.jumped && owner == Owner::keyed) {
      const Motion leaving = moved_on(rigid(leaving_pose.at(body)), center, state.time - landed);
      const Motion here = state.world.motion(body.id);
      if (!leaving.pose.position.isApprox(here.pose.position, 1e-12) ||
          std::abs(leaving.pose.rotation.dot(here.pose.rotation)) < 1 - 1e-15)
        state.world.set_motion(body.id, bearable(state, body, leaving, "its path"));
    }
    Motion target = moved_on(rigid(target_pose.at(body)), center, end - reached);
    if (owner == Owner::driven) target = carried_along(state, body, target, target_pose, end);
    state.world.set_target(body.id, bearable(state, body, target, "its path"));
  }
  lead_pins(state, target_pose);
  state.jumped = false;
}

void take_piece(StageState& state, double step, std::span<const Command> commands, std::vector<Happening>& happenings,
                std::optional<StageState>& arrived) {
  arrived.reset();
  const std::size_t first = happenings.size();
  if (state.steps < 0) {
    state.steps = 0;
    state.since = state.handled;
    handle_instant(state, step, commands, happenings, arrived);
  } else {
    const double end = static_cast<double>(state.steps + 1) * step, last = end - sliver;
    double to = next_instant(state, last);
    const bool own = to < last, capped = own && state.splits >= most_splits;
    if (capped) to = infinity;
    if (!(to < last)) to = end;
    const auto coming = commands_after(commands, state.handled);
    const double began = state.time;
    move_to_change(state, to, coming.empty() || !(coming.front().time < last) ? infinity : coming.front().time, step,
                   happenings);
    if (state.time > began) {
      state.since = state.handled;
      state.at_once = 0;
    } else {
      ++state.at_once;
    }
    if (own && !capped) ++state.splits;
    if (state.time == end) {
      if (capped) report_cap(state, happenings);
      ++state.steps;
      state.splits = 0;
    }
    handle_instant(state, step, commands, happenings, arrived);
  }
  bring_in_order(std::span(happenings).subspan(first), &Happening::time);
}

}  // namespace tweenfall::staging
