#pragma once

// Converts times as written to seconds of a clip.

#include "document/report/problems.h"

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::document {

// The parts of a key or event; none where absent or faulty.
struct KeyParts {
  json::Value time, value, ease, in, out, value_in;
};
[[nodiscard]] KeyParts key_parts(const json::Value& key);

class ClipTimes {
 public:
  // `fps` empty: "12f" is a problem. `duration` empty: "50%" is one, for the given reason.
  ClipTimes(std::optional<double> fps, std::optional<double> duration, std::string no_duration_reason)
      : fps_(fps), duration_(duration), no_duration_reason_(std::move(no_duration_reason)) {}

  // Seconds of one time; `previous` is what "+0.25" counts from. Problems are noted.
  [[nodiscard]] std::optional<double> seconds(const json::Value& time, std::optional<double> previous,
                                              Problems& problems) const;

  // One for each key, empty where faulty; checks that they increase.
  [[nodiscard]] std::vector<std::optional<double>> of_keys(const json::Value& keys, Problems& problems) const;

 private:
  std::optional<double> fps_, duration_;
  std::string no_duration_reason_;
};

// The duration of a clip: the one stated, else its latest key or event that does not depend on a "%".
// Infinity for functions only; 0 for nothing at all.
[[nodiscard]] double clip_duration(const json::Value& clip, std::optional<double> fps);

}  // namespace tweenfall::document
