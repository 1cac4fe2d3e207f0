#include "json/scan_json.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace tweenfall::json {

namespace {

enum class Sort : unsigned char { other, space, quote, single_quote, open, close, comma, colon, slash, word };

constexpr std::array<Sort, 256> sorts = [] {
  std::array<Sort, 256> out{};
  for (const char c : {' ', '\t', '\n', '\r'}) out[static_cast<unsigned char>(c)] = Sort::space;
  for (int c = '0'; c <= '9'; ++c) out[static_cast<std::size_t>(c)] = Sort::word;
  for (int c = 'a'; c <= 'z'; ++c)
    out[static_cast<std::size_t>(c)] = out[static_cast<std::size_t>(c - 32)] = Sort::word;
  for (const char c : {'+', '-', '.', '_'}) out[static_cast<unsigned char>(c)] = Sort::word;
  out['"'] = Sort::quote;
  out['\''] = Sort::single_quote;
  out['['] = out['{'] = Sort::open;
  out[']'] = out['}'] = Sort::close;
  out[','] = Sort::comma;
  out[':'] = Sort::colon;
  out['/'] = Sort::slash;
  return out;
}();

Sort sort_of(char c) {
  return sorts[static_cast<unsigned char>(c)];
}

// The place after the closing quote; a text ends on its line.
std::size_t quoted_end(std::string_view text, std::size_t at) {
  for (++at; at < text.size(); ++at) {
    if (text[at] == '"') return at + 1;
    if (text[at] == '\\')
      ++at;
    else if (text[at] == '\n')
      return at;
  }
  return text.size();
}

// Whether a number out of range is too small: its first nonzero digit is far after the point.
bool is_tiny(std::string_view number) {
  if (number.front() == '-') number.remove_prefix(1);
  const std::size_t mark = number.find_first_of("eE");
  const std::string_view digits = number.substr(0, mark);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) return true;
  double power = first < point ? static_cast<double>(point - first) : -static_cast<double>(first - point);
  if (mark != std::string_view::npos) {
    std::string_view exponent = number.substr(mark + 1);
    const bool negative = exponent.front() == '-';
    if (exponent.front() == '-' || exponent.front() == '+') exponent.remove_prefix(1);
    double size = 0;
    for (const char c : exponent) size = std::min(size * 10 + (c - '0'), 1e18);
    power += negative ? -size : size;
  }
  return power < 0;
}

// A well-formed number that is too large for a double.
bool is_huge(std::string_view word) {
  constexpr std::size_t never_huge = 300;  // digits without an exponent
  if (word.size() < never_huge && word.find_first_of("eE") == std::string_view::npos) return false;
  double number = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), number);
  return result.ec == std::errc::result_out_of_range && result.ptr == word.data() + word.size() && !is_tiny(word);
}

class Surveyor {
 public:
  Surveyor(std::string_view text, bool comments) : text_(text), comments_(comments) {}

  Survey whole() {
    constexpr std::size_t none = std::string_view::npos;
    std::size_t comma = none;  // the last one, while only space follows it
    for (std::size_t at = 0; at < text_.size();) {
      const char c = text_[at];
      const Sort sort = sort_of(c);
      if (sort == Sort::space) {
        ++at;
        continue;
      }
      if (sort == Sort::slash && comments_) {
        const std::size_t after = skip_space(text_, at, true);
        at = std::max(after, at + 1);
        continue;
      }
      if (sort == Sort::close && comma != none) {
        note(at, 1,
             std::string(c == '}' ? "expected a name in quotes" : "expected a value") + " after ',', found '" + c +
                 "'; leave the last ',' out");
        mend(comma, 1, ' ');
      }
      comma = none;
      switch (sort) {
        case Sort::quote:
          at = quoted_end(text_, at);
          break;
        case Sort::single_quote:
          at = single_quoted(at);
          break;
        case Sort::word:
          at = word(at);
          break;
        case Sort::comma:
          comma = at;
          [[fallthrough]];
        case Sort::open:
          ++out_.most_values;
          [[fallthrough]];
        default:
          ++at;
      }
    }
    return std::move(out_);
  }

 private:
  void note(std::size_t offset, std::size_t length, std::string message) {
    constexpr std::size_t most_noted = 10000;
    if (out_.faults.size() < most_noted) out_.faults.push_back({offset, length, std::move(message)});
  }

  // Replaces a stretch by one byte and spaces.
  void mend(std::size_t offset, std::size_t length, char first) {
    if (out_.mended.empty()) out_.mended = text_;
    out_.mended.replace(offset, length, length, ' ');
    out_.mended[offset] = first;
  }

  std::size_t single_quoted(std::size_t at) {
    const std::size_t end = text_.find_first_of("'\"\\\n\r\t", at + 1);
    if (end == std::string_view::npos || text_[end] != '\'') return at + 1;
    const std::string_view inside = text_.substr(at + 1, end - at - 1);
    constexpr std::size_t longest_shown = 40;
    note(at, end + 1 - at,
         "texts must be in double quotes" +
             (inside.size() <= longest_shown ? "; write " + in_quotes(inside) : std::string()));
    mend(at, 1, '"');
    mend(end, 1, '"');
    return end + 1;
  }

  std::size_t word(std::size_t at) {
    const std::size_t end = word_end(text_, at);
    const std::string_view whole = text_.substr(at, end - at);
    const std::string_view plain = whole.front() == '-' || whole.front() == '+' ? whole.substr(1) : whole;
    if (plain == "NaN" || plain == "nan" || plain == "Infinity" || plain == "infinity" || plain == "inf") {
      note(at, whole.size(), std::string(whole) + " is not a number; numbers are finite");
    } else if (is_huge(whole)) {
      constexpr std::size_t longest_shown = 40;
      note(at, whole.size(),
           std::string(whole.substr(0, longest_shown)) + (whole.size() > longest_shown ? "..." : "") +
               " is too large for a number; the largest is about 1.8e308");
    } else {
      return end;
    }
    mend(at, whole.size(), '0');
    out_.faulty_values.push_back(at);
    return end;
  }

  std::string_view text_;
  bool comments_;
  Survey out_;
};

}  // namespace

/// What ends a comment of one line in nlohmann's lexer.
constexpr std::string_view comment_ends("\n\r\0", 3);

std::size_t skip_space(std::string_view text, std::size_t at, bool comments) {
  while (at < text.size()) {
    if (sort_of(text[at]) == Sort::space) {
      ++at;
      continue;
    }
    if (text[at] != '/' || !comments) return at;
    const std::string_view mark = text.substr(at, 2);
    if (mark == "//") {
      at = std::min(text.find_first_of(comment_ends, at), text.size());
    } else if (mark == "/*") {
      const std::size_t end = text.find("*/", at + 2);
      if (end == std::string_view::npos) return at;
      at = end + 2;
    } else {
      return at;
    }
  }
  return text.size();
}

std::size_t word_end(std::string_view text, std::size_t at) {
  while (at < text.size() && sort_of(text[at]) == Sort::word) ++at;
  return at;
}

std::size_t value_end(std::string_view text, std::size_t at, bool comments) {
  std::size_t depth = 0;
  while (at < text.size()) {
    const std::size_t from = at;
    switch (sort_of(text[at])) {
      case Sort::quote:
        at = quoted_end(text, at);
        break;
      case Sort::word:
        at = word_end(text, at);
        break;
      case Sort::space:
      case Sort::slash:
        at = std::max(skip_space(text, at, comments), at + 1);
        break;
      case Sort::open:
        ++depth;
        ++at;
        break;
      case Sort::close:
        if (depth > 0) --depth;
        ++at;
        break;
      default:
        ++at;
    }
    if (depth == 0 && sort_of(text[from]) != Sort::space) return at;
  }
  return text.size();
}

Survey survey(std::string_view text, bool comments) {
  return Surveyor(text, comments).whole();
}

}  // namespace tweenfall::json
