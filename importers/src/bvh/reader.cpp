#include "bvh/reader.h"

#include "model/model_names.h"

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/keys.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace tweenfall::bvh {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// Words between white space, with the line of each.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::string place() const { return "line " + std::to_string(line_); }

  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) step();
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) step();
    return text_.substr(from, at_ - from);
  }

  /// The rest of the line, up to an opening brace, without white space around it.
  std::string rest_of_line() {
    const std::size_t from = at_;
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '{') step();
    std::string_view rest = text_.substr(from, at_ - from);
    while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
    while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
    return std::string(rest);
  }

  std::optional<double> number() {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failed != std::errc{} || end != word.data() + word.size() || word.empty() || !std::isfinite(value))
      return std::nullopt;
    return value;
  }

 private:
  void step() {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

struct Channel {
  bool rotation = false;
  int axis = 0;
};

struct Joint {
  std::vector<Channel> channels;
  std::size_t first = 0;  ///< index of its first number in a frame
};

class BvhReader {
 public:
  BvhReader(std::string_view text, models::ModelProblems& problems) : words_(text), problems_(problems) {}

  /// Stops at the first fault, because nothing after a misread word can be trusted.
  bool read(Model& model) { return read_skeleton(model) && read_motion(model); }

 private:
  bool fail(const std::string& what) {
    problems_.add(words_.place(), what);
    return false;
  }

  bool expect(const char* wanted) {
    const std::string_view word = words_.next();
    if (lower(word) == lower(wanted)) return true;
    return fail(std::string("must be \"") + wanted + "\", not \"" + std::string(word.substr(0, 40)) + "\"");
  }

  bool read_skeleton(Model& model) {
    if (!expect("HIERARCHY")) return false;
    std::vector<std::size_t> open;
    while (true) {
      const std::string word = lower(words_.next());
      if (word == "motion")
        return open.empty() && !model.nodes.empty() ? true : fail("MOTION comes before the skeleton ends");
      if (word == "}") {
        if (open.empty()) return fail("a \"}\" closes nothing");
        open.pop_back();
      } else if ((word == "root" && open.empty()) || (word == "joint" && !open.empty())) {
        if (!open_joint(words_.rest_of_line(), open, model)) return false;
      } else if (word == "end" && !open.empty()) {
        static_cast<void>(words_.rest_of_line());
        if (!open_joint("EndSite_" + model.nodes[open.back()].name, open, model)) return false;
      } else if (word == "offset" && !open.empty()) {
        if (!read_offset(model.nodes[open.back()].rest.position)) return false;
      } else if (word == "channels" && !open.empty()) {
        if (!read_channels(joints_[open.back()])) return false;
      } else {
        return fail(word.empty() ? "the file ends inside the skeleton"
                                 : "\"" + word.substr(0, 40) + "\" is not expected here");
      }
    }
  }

  bool open_joint(const std::string& name, std::vector<std::size_t>& open, Model& model) {
    Node node;
    node.name = names_.unique(name.empty() ? "node_" + std::to_string(model.nodes.size()) : name);
    node.parent = open.empty() ? no_node : open.back();
    open.push_back(model.nodes.size());
    model.nodes.push_back(std::move(node));
    joints_.emplace_back();
    return expect("{");
  }

  bool read_offset(Vec3& offset) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto number = words_.number();
      if (!number) return fail("OFFSET needs three finite numbers");
      offset[axis] = *number;
    }
    return true;
  }

  bool read_channels(Joint& joint) {
    const auto count = words_.number();
    if (!count || *count < 0 || *count > 6 || std::floor(*count) != *count)
      return fail("CHANNELS needs a count from 0 to 6");
    if (!joint.channels.empty()) return fail("the joint has CHANNELS twice");
    joint.first = channel_count_;
    for (int i = 0; i < static_cast<int>(*count); ++i) {
      const std::string word = lower(words_.next());
      const bool rotation = word.ends_with("rotation"), position = word.ends_with("position");
      if (word.size() != 9 || !(rotation || position) || word[0] < 'x' || word[0] > 'z')
        return fail("\"" + word.substr(0, 40) +
                    "\" must be Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation");
      joint.channels.push_back({rotation, word[0] - 'x'});
    }
    channel_count_ += joint.channels.size();
    return true;
  }

  bool read_motion(Model& model) {
    if (!expect("Frames:")) return false;
    const auto frames = words_.number();
    if (!frames || *frames < 0 || std::floor(*frames) != *frames) return fail("Frames: needs a whole number");
    if (!expect("Frame") || !expect("Time:")) return false;
    const auto frame_time = words_.number();
    if (!frame_time || !(*frame_time > 0)) return fail("Frame Time: must be above 0 s");
    if (channel_count_ == 0 || *frames == 0) return true;
    std::vector<double> numbers;
    while (static_cast<double>(numbers.size()) < *frames * static_cast<double>(channel_count_)) {
      const auto number = words_.number();
      if (!number)
        return fail("frame " + std::to_string(numbers.size() / channel_count_ + 1) + " of " +
                    std::to_string(static_cast<long long>(std::min(*frames, 9e15))) + " must hold " +
                    std::to_string(channel_count_) + " finite numbers");
      numbers.push_back(*number);
    }
    make_clip(numbers, *frame_time, model);
    return true;
  }

  void make_clip(const std::vector<double>& numbers, double frame_time, Model& model) const {
    const std::size_t frames = numbers.size() / channel_count_;
    Clip clip;
    clip.name = "Motion";
    clip.duration = static_cast<double>(frames - 1) * frame_time;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const Joint& joint = joints_[i];
      const auto turns = std::count_if(joint.channels.begin(), joint.channels.end(),
                                       [](const Channel& channel) { return channel.rotation; });
      std::vector<Key<Vec3>> positions;
      std::vector<Key<Quat>> rotations;
      for (std::size_t frame = 0; frame < frames; ++frame) {
        const double* first = numbers.data() + frame * channel_count_ + joint.first;
        const double time = static_cast<double>(frame) * frame_time;
        const Pose pose = pose_of(joint, first, model.nodes[i].rest.position);
        if (static_cast<std::size_t>(turns) < joint.channels.size())
          positions.push_back({.time = time, .value = pose.position, .ease = straight_});
        if (turns > 0) rotations.push_back({.time = time, .value = pose.rotation, .ease = straight_});
      }
      const std::string& name = model.nodes[i].name;
      if (!positions.empty())
        clip.tracks.push_back({name, "position", keyed_curve<Vec3>(std::span<const Key<Vec3>>(positions))});
      if (!rotations.empty())
        clip.tracks.push_back({name, "rotation", keyed_curve<Quat>(std::span<const Key<Quat>>(rotations))});
    }
    model.clips.push_back(std::move(clip));
  }

  /// Turns apply in the order of the channels, each about the axes turned so far.
  static Pose pose_of(const Joint& joint, const double* numbers, const Vec3& offset) {
    Pose pose;
    pose.position = offset;
    for (std::size_t i = 0; i < joint.channels.size(); ++i) {
      const Channel channel = joint.channels[i];
      if (!channel.rotation) {
        pose.position[channel.axis] = numbers[i];
        continue;
      }
      const double degrees = std::fmod(numbers[i], 720.0);
      const auto half = elementary::sin_cos(degrees * (std::numbers::pi / 360));
      Quat turn(half.cos, 0, 0, 0);
      turn.vec()[channel.axis] = half.sin;
      pose.rotation = pose.rotation * turn;
    }
    return pose;
  }

  Words words_;
  models::ModelProblems& problems_;
  models::UniqueNames names_;
  std::vector<Joint> joints_;
  std::size_t channel_count_ = 0;
  Ease straight_ = Ease::linear();
};

}  // namespace

Model read_bvh(std::string_view text, const std::filesystem::path& file, models::ModelProblems& problems) {
  Model model;
  BvhReader(text, problems).read(model);
  problems.throw_if_any(file);
  return model;
}

}  // namespace tweenfall::bvh
