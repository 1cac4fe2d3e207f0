#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/inputs.h>

#include "document/read/values.h"
#include "json/json_string.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tweenfall {

namespace document::inputs {
namespace {

std::string string_text(std::string_view text) {
  std::string out;
  json::append_string(out, text);
  return out;
}

/// Degrees that are read as exactly these radians, if there are any.
double degrees_of(double angle) {
  const double near = degrees(angle);
  for (const double toward : {HUGE_VAL, -HUGE_VAL})
    for (double each = near, left = 4; left > 0; --left, each = std::nextafter(each, toward))
      if (radians(each) == angle) return each;
  return near;
}

/// The fields of one object; defaults are left out.
class Fields {
 public:
  void add(const std::string& name, const std::string& json) {
    text_ += (text_.empty() ? "" : ", ") + string_text(name) + ": " + json;
  }
  void add(const std::string& name, double number, double standard) {
    if (number != standard) add(name, number_text(number));
  }
  [[nodiscard]] std::string object() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

std::string vector_text(const Vec3& v) {
  return "[" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + "]";
}

std::string keys_text(const PlayKeys& keys) {
  if (keys.size() == 1 && keys.front().time == 0) return number_text(keys.front().value);
  std::string text;
  for (const PlayKey& key : keys) {
    text += (text.empty() ? "[" : ", [") + number_text(key.time) + ", " + number_text(key.value);
    text += (key.ease == PlayKey{}.ease ? "" : ", " + string_text(key.ease.name())) + "]";
  }
  return "[" + text + "]";
}

std::string fade_text(const Fade& fade) {
  if (fade.ease == Fade{}.ease) return number_text(fade.seconds);
  return "{\"seconds\": " + number_text(fade.seconds) + ", \"ease\": " + string_text(fade.ease.name()) + "}";
}

const char* loop_word(LoopMode mode) {
  constexpr const char* words[] = {"once", "repeat", "repeat-offset", "pingpong"};
  return words[static_cast<int>(mode)];
}

using Said = std::pair<const char*, std::string>;

struct OfAction {
  const std::string& play;

  Said operator()(const playing::Start& start) const {
    Fields fields = named();
    if (start.clip.empty()) return {"start", fields.object()};
    const playing::Start usual{};
    fields.add("clip", string_text(start.clip));
    fields.add("from", start.from, 0);
    if (start.to) fields.add("to", number_text(*start.to));
    fields.add("offset", start.offset, 0);
    if (start.reverse) fields.add("direction", "\"reverse\"");
    if (start.loop) {
      fields.add("loop", string_text(loop_word(start.loop->mode)));
      if (start.loop->mode != LoopMode::once) fields.add("count", start.loop->count, 0);
    }
    if (!(start.speed == usual.speed)) fields.add("speed", keys_text(start.speed));
    if (!(start.weight == usual.weight)) fields.add("weight", keys_text(start.weight));
    if (!(start.fade_in == usual.fade_in)) fields.add("fade_in", fade_text(start.fade_in));
    if (!(start.fade_out == usual.fade_out)) fields.add("fade_out", fade_text(start.fade_out));
    std::string mask;
    for (const std::string& name : start.mask) mask += (mask.empty() ? "" : ", ") + string_text(name);
    if (!mask.empty()) fields.add("mask", "[" + mask + "]");
    if (start.fill != usual.fill) fields.add("fill", string_text(fill_words[static_cast<std::size_t>(start.fill)]));
    return {"start", fields.object()};
  }
  Said operator()(const playing::Stop& stop) const {
    Fields fields = named();
    fields.add("seconds", stop.seconds, 0);
    if (stop.ease) fields.add("ease", string_text(stop.ease->name()));
    return {"stop", fields.object()};
  }
  Said operator()(const playing::FadeTo& fade) const {
    Fields fields = named();
    fields.add("weight", number_text(fade.weight));
    fields.add("seconds", fade.seconds, 0);
    if (fade.ease) fields.add("ease", string_text(fade.ease->name()));
    return {"fade", fields.object()};
  }
  Said operator()(const playing::Weigh& weigh) const {
    Fields fields = named();
    fields.add("weight", keys_text(weigh.weight));
    return {"weigh", fields.object()};
  }
  Said operator()(const playing::SetSpeed& set) const {
    Fields fields = named();
    fields.add("speed", keys_text(set.speed));
    fields.add("seconds", set.seconds, 0);
    return {"speed", fields.object()};
  }
  Said operator()(const playing::Seek& seek) const {
    Fields fields = named();
    fields.add("to", number_text(seek.time));
    if (seek.events) fields.add("events", "true");
    fields.add("fade", seek.fade, 0);
    return {"seek", fields.object()};
  }

 private:
  [[nodiscard]] Fields named() const {
    Fields fields;
    fields.add("play", string_text(play));
    return fields;
  }
};

std::string velocity_text(const TakeOver& settings) {
  Fields fields;
  if (settings.velocity == TakeOver::Velocity::average) fields.add("average", number_text(settings.average_over));
  if (settings.velocity == TakeOver::Velocity::step) fields.add("source", "\"step\"");
  if (settings.velocity == TakeOver::Velocity::zero) fields.add("source", "\"zero\"");
  fields.add("scale", settings.scale, 1);
  Fields added;
  const Twist& add = settings.add;
  if (!add.linear.isZero(0)) added.add("linear", vector_text(add.linear));
  if (!add.angular.isZero(0))
    added.add("angular",
              vector_text(Vec3(degrees_of(add.angular[0]), degrees_of(add.angular[1]), degrees_of(add.angular[2]))));
  if (added.object() != "{}") fields.add("add", added.object());
  return fields.object();
}

void add_take_over(Fields& fields, const TakeOver& settings) {
  if (const std::string velocity = velocity_text(settings); velocity != "{}") fields.add("velocity", velocity);
  constexpr const char* words[] = {"push", "ignore", "rewind", "veto"};
  if (settings.overlap == TakeOver::Overlap::rewind && settings.rewind_within != TakeOver{}.rewind_within)
    fields.add("overlap", "{\"rewind\": " +
                              number_text(std::min(settings.rewind_within, std::numeric_limits<double>::max())) + "}");
  else if (settings.overlap != TakeOver{}.overlap)
    fields.add("overlap", string_text(words[static_cast<int>(settings.overlap)]));
}

void add_hand_back(Fields& fields, const HandBack& settings) {
  Fields path;
  constexpr const char* clocks[] = {"run", "hold", "restart"};
  constexpr const char* anchors[] = {"keep", "here", "ground"};
  constexpr const char* settles[] = {"quintic", "half_life", "dead_blend"};
  if (!settings.clip.empty()) path.add("clip", string_text(settings.clip));
  if (settings.clock != HandBack{}.clock) path.add("time", string_text(clocks[static_cast<int>(settings.clock)]));
  if (settings.anchor != HandBack{}.anchor) path.add("anchor", string_text(anchors[static_cast<int>(settings.anchor)]));
  if (path.object() != "{}") fields.add("path", path.object());
  fields.add("settle", "{" + string_text(settles[static_cast<int>(settings.settle.kind)]) + ": " +
                           number_text(settings.settle.seconds) + "}");
}

std::string drive_text(const Drive& drive) {
  if (drive.owner() != Owner::driven) return drive.owner() == Owner::keyed ? "\"keyed\"" : "\"free\"";
  Fields fields;
  const Drive usual;
  constexpr const char* frames[] = {"world", "parent", "anchor"};
  fields.add("hz", number_text(drive.hz));
  fields.add("zeta", drive.zeta, usual.zeta);
  fields.add("max_force", drive.max_force, usual.max_force);
  fields.add("max_torque", drive.max_torque, usual.max_torque);
  fields.add("gravity_compensation", drive.gravity_compensation, usual.gravity_compensation);
  if (drive.frame != usual.frame) fields.add("frame", string_text(frames[static_cast<int>(drive.frame)]));
  return fields.object();
}

struct OfInput {
  Said operator()(const input::Ask& ask) const { return std::visit(OfAction{ask.play}, ask.action); }
  Said operator()(const input::Release& release) const {
    Fields fields;
    fields.add("body", string_text(release.body));
    add_take_over(fields, release.settings);
    return {"release", fields.object()};
  }
  Said operator()(const input::Recover& recover) const {
    Fields fields;
    fields.add("body", string_text(recover.body));
    add_hand_back(fields, recover.settings);
    return {"recover", fields.object()};
  }
  Said operator()(const input::HandOver& handed) const {
    Fields fields;
    const Owner to = handed.change.to.owner();
    fields.add("body", string_text(handed.body));
    fields.add("to", drive_text(handed.change.to));
    fields.add("ramp", handed.change.ramp, 0);
    if (to != Owner::keyed) add_take_over(fields, handed.change.take_over);
    if (to != Owner::free) add_hand_back(fields, handed.change.hand_back);
    return {"hand_over", fields.object()};
  }
  Said operator()(const input::Push& push) const {
    Fields fields;
    fields.add("body", string_text(push.body));
    fields.add("impulse", vector_text(push.impulse));
    fields.add("point", vector_text(push.point));
    return {"push", fields.object()};
  }
  Said operator()(const input::Set& set) const {
    Fields fields;
    fields.add("graph", string_text(set.graph));
    fields.add("parameter", string_text(set.parameter));
    fields.add("value", number_text(set.value));
    return {"set", fields.object()};
  }
  Said operator()(const input::Send& send) const {
    Fields fields;
    fields.add("graph", string_text(send.graph));
    fields.add("event", string_text(send.event));
    return {"send", fields.object()};
  }
  Said operator()(const input::Control& told) const {
    Fields fields;
    fields.add("vehicle", string_text(told.vehicle));
    const auto add = [&](const char* name, const std::optional<double>& value, double low) {
      if (value) fields.add(name, number_text(std::clamp(*value, low, 1.0)));
    };
    add("throttle", told.control.throttle, -1);
    add("brake", told.control.brake, 0);
    add("steer", told.control.steer, -1);
    return {"control", fields.object()};
  }
};

}  // namespace
}  // namespace document::inputs

std::string inputs_json(std::span<const TimedInput> inputs) {
  std::string rows;
  for (const TimedInput& input : inputs) {
    const auto [word, said] = std::visit(document::inputs::OfInput{}, input.what);
    const std::string after =
        input.after_blows > 0 ? "\"after_blows\": " + std::to_string(input.after_blows) + ", " : "";
    rows += (rows.empty() ? "\n    " : ",\n    ") + std::string("{\"at\": ") + number_text(input.time) + ", " + after +
            document::inputs::string_text(word) + ": " + said + "}";
  }
  return "{\n  \"tweenfall\": 1,\n  \"inputs\": [" + rows + (rows.empty() ? "" : "\n  ") + "]\n}\n";
}

}  // namespace tweenfall
