#include "document/read/times.h"

#include <charconv>

namespace tweenfall::document {

std::optional<TimeInWords> time_in_words(std::string_view text) {
  TimeInWords time;
  if (!text.empty() && text.front() == '+') {
    time.after_previous = true;
    text.remove_prefix(1);
  }
  if (!text.empty() && (text.back() == 'f' || text.back() == '%')) {
    time.unit = text.back() == 'f' ? TimeInWords::Unit::frames : TimeInWords::Unit::percent;
    text.remove_suffix(1);
  }
  // At most as many digits as seconds can need, so that none is lost.
  const std::size_t point = text.find('.');
  const auto digits = [](std::string_view part) {
    return !part.empty() && part.size() <= 12 && part.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (!digits(text.substr(0, point)) || (point != std::string_view::npos && !digits(text.substr(point + 1)))) return {};
  std::from_chars(text.data(), text.data() + text.size(), time.amount);
  if (time.unit == TimeInWords::Unit::percent && time.after_previous) return {};
  return time;
}

}  // namespace tweenfall::document
