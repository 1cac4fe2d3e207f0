#pragma once

// The last poses of an operation, so that repeated requests are fast.

#include <tweenfall/anim/play.h>
#include <tweenfall/curves/pose.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tweenfall::graphs {

class RecentPoses {
 public:
  /// What determines a pose of one operation of one graph.
  struct Question {
    double time = -1;  // below 0: none
    double start = 0;
    double instant = 0;  // the last one at which something happened that is seen
    Side side = Side::out;

    bool operator==(const Question&) const = default;
  };

  RecentPoses() = default;
  // A copy has the memory, but remembers nothing: the results are the same.
  RecentPoses(const RecentPoses& other) : nodes_(0) { make_room(other.nodes_); }
  RecentPoses(RecentPoses&&) noexcept = default;
  RecentPoses& operator=(RecentPoses&&) noexcept = default;
  RecentPoses& operator=(const RecentPoses& other) {
    *this = RecentPoses(other);
    return *this;
  }
  ~RecentPoses() = default;

  /// Allocates all memory.
  void make_room(std::size_t nodes) {
    nodes_ = nodes;
    motions_.resize(kept * nodes);
  }

  /// Whether the pose is remembered; if so, writes it.
  [[nodiscard]] bool recall(const Question& question, std::span<Motion> out) const noexcept {
    for (std::size_t i = 0; i < kept; ++i) {
      if (questions_[i] != question || out.size() != nodes_) continue;
      std::copy_n(motions_.begin() + static_cast<std::ptrdiff_t>(i * nodes_), nodes_, out.begin());
      return true;
    }
    return false;
  }
  void remember(const Question& question, std::span<const Motion> pose) noexcept {
    if (pose.size() != nodes_) return;
    questions_[next_] = question;
    std::ranges::copy(pose, motions_.begin() + static_cast<std::ptrdiff_t>(next_ * nodes_));
    next_ = (next_ + 1) % kept;
  }
  void forget_from(double time) noexcept {
    for (Question& question : questions_)
      if (question.time >= time) question.time = -1;
  }

 private:
  static constexpr std::size_t kept = 4;
  std::array<Question, kept> questions_{};
  std::vector<Motion> motions_;
  std::size_t nodes_ = 0, next_ = 0;
};

}  // namespace tweenfall::graphs
