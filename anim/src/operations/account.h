#pragma once

// The description of an operation: its words, its operands, and a number that changes with any of its settings.

#include <tweenfall/anim/graph.h>

#include "graph/digest.h"

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tweenfall::graphs {

class Account {
 public:
  std::string words;
  std::vector<GraphOperand> operands;

  /// Adds a pose that it uses; an empty name is ignored.
  void pose(const std::string& name, std::string role);
  void clip(const std::string& name);

  /// Adds its other settings, in order.
  template <class... Told>
  void tell(const Told&... told) {
    (add(told), ...);
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return digest_.value(); }

 private:
  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void add(Number number) {
    if constexpr (std::is_floating_point_v<Number>)
      digest_.number(number);
    else
      digest_.number(static_cast<std::uint64_t>(number));
  }
  void add(const std::string& text) { digest_.text(text); }
  void add(const Vec2& vector) { tell(vector.x(), vector.y()); }
  void add(const Vec3& vector) { tell(vector.x(), vector.y(), vector.z()); }
  void add(const Quat& turn) { tell(turn.w(), turn.x(), turn.y(), turn.z()); }
  void add(const Curve<double>& curve);
  void add(const GraphNumber& number);
  void add(const GraphPlace& place);
  void add(const Loop& loop) { tell(loop.mode, loop.count); }
  void add(const MaskPart& part) { tell(part.joints, part.weight, part.below); }
  void add(const JointLimit& limit);
  void add(const GraphCondition& condition) { tell(condition.kind, condition.name, condition.value); }
  void add(const GraphChange& change);
  template <class Told>
  void add(const std::optional<Told>& told) {
    add(told.has_value());
    if (told) add(*told);
  }
  template <class Told>
  void add(const std::vector<Told>& told) {
    add(told.size());
    for (const Told& each : told) add(each);
  }

  Digest digest_;
  friend class Fingerprint;
};

/// A short text: "0.5", "speed", "keys"; "ball", "[0, 1, 0]".
[[nodiscard]] std::string words_of(const GraphNumber& number);
[[nodiscard]] std::string words_of(const GraphPlace& place);

/// The weight of a change, as a text to follow its words: empty where it is always 1.
[[nodiscard]] std::string share_in_words(const GraphNumber& weight);

}  // namespace tweenfall::graphs
