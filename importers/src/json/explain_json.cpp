#include "json/explain_json.h"

#include "json/scan_json.h"
#include "json/text_place.h"

#include <algorithm>
#include <vector>

namespace tweenfall::json {

namespace {

using After = Stop::After;

// Length of the UTF-8 character at `at`; 0 when it is invalid, including stray bytes, overlong forms and surrogates.
std::size_t character_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u; };
  const unsigned lead = byte(0);
  const std::size_t size = lead < 0x80                   ? 1
                           : lead >= 0xc2 && lead < 0xe0 ? 2
                           : lead >> 4 == 14             ? 3
                           : lead >= 0xf0 && lead < 0xf5 ? 4
                                                         : 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  if (size == 3 && ((lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xed && byte(1) >= 0xa0))) return 0;
  if (size == 4 && ((lead == 0xf0 && byte(1) < 0x90) || (lead == 0xf4 && byte(1) >= 0x90))) return 0;
  return size;
}

class Explainer {
 public:
  Explainer(std::string_view text, const Stop& stop, bool comments)
      : text_(text), stop_(stop), at_(skip_space(text, stop.at, comments)), comments_(comments) {}

  Fault fault() {
    if (comments_ && text_.substr(at_, 2) == "/*") return here("this comment has no end; expected \"*/\"");
    if (at_ > 0 && at_ == stop_.at && text_[at_ - 1] == '0' && next() >= '0' && next() <= '9')
      return here("a number does not start with 0 before other digits");
    switch (stop_.after) {
      case After::nothing:
        if (done()) return here("the text is empty; a document is an object, starting with '{'");
        return value("a value");
      case After::whole:
        return here("expected the end of the text after the document, found " + found());
      case After::open_object:
        return name("a name in quotes or '}'");
      case After::open_list:
        return value("a value or ']'");
      case After::name:
        if (next() != ':') return missing("':' after " + in_quotes(stop_.name));
        step();
        return value("a value");
      case After::value_in_object:
        if (next() != ',') return missing("',' or '}' after the value");
        step();
        return name("a name in quotes");
      case After::value_in_list:
        if (next() != ',') return missing("',' or ']' after the value");
        step();
        return value("a value");
    }
    return here("this is not JSON");
  }

 private:
  [[nodiscard]] bool done() const { return at_ >= text_.size(); }
  [[nodiscard]] char next() const { return done() ? '\0' : text_[at_]; }
  void step() { at_ = skip_space(text_, at_ + 1, comments_); }

  [[nodiscard]] std::string found() const {
    if (done()) return "the end of the text";
    const unsigned char c = static_cast<unsigned char>(text_[at_]);
    if (c < 0x20 || c == 0x7f || c >= 0x80) {
      static constexpr char digits[] = "0123456789abcdef";
      return std::string("the byte 0x") + digits[c >> 4] + digits[c & 15];
    }
    return std::string("'") + static_cast<char>(c) + "'";
  }

  [[nodiscard]] Fault here(std::string message, std::size_t length = 1) const {
    return {at_, length, std::move(message)};
  }

  // Something other than `wanted` is here. Something that never ends is reported at its start.
  [[nodiscard]] Fault missing(const std::string& wanted, const std::string& advice = {}) const {
    if (comments_ && text_.substr(at_, 2) == "/*") return here("this comment has no end; expected \"*/\"");
    if (!stop_.open) return here("expected " + wanted + ", found " + found() + advice);
    const char bracket = text_[*stop_.open];
    const char closing = bracket == '{' ? '}' : ']';
    if (done()) {
      if (const std::optional<Misfit> misfit = misfitting_bracket())
        return {misfit->open, 1,
                std::string("this '") + text_[misfit->open] +
                    "' is not closed where its line's indentation says: the '" + text_[misfit->close] + "' of line " +
                    std::to_string(place_in(text_, misfit->close).line) +
                    " closes it, and at the end of the text one is missing"};
      return {
          *stop_.open, 1,
          std::string("this '") + bracket + "' is never closed: expected " + wanted + ", found the end of the text"};
    }
    std::string message = "expected " + wanted + ", found " + found() + advice;
    if ((next() == '}' || next() == ']') && next() != closing) {
      const TextPlace open = place_in(text_, *stop_.open);
      message += std::string("; the '") + bracket + "' of line " + std::to_string(open.line) + ", column " +
                 std::to_string(open.column) + " is not closed";
    }
    return here(std::move(message));
  }

  // Where a bracket is missing, a later one closes the wrong one: it begins a line with less indentation than the line
  // of the bracket that it closes.
  struct Misfit {
    std::size_t open, close;
  };
  [[nodiscard]] std::optional<Misfit> misfitting_bracket() const {
    const auto indentation = [&](std::size_t at) {
      const std::size_t line = at == 0 ? std::string_view::npos : text_.rfind('\n', at - 1);
      const std::size_t from = line == std::string_view::npos ? 0 : line + 1;
      return text_.find_first_not_of(" \t", from) - from;
    };
    std::vector<std::size_t> open;
    for (std::size_t at = skip_space(text_, 0, comments_); at < text_.size();) {
      const char c = text_[at];
      if (c == '{' || c == '[') open.push_back(at);
      if ((c == '}' || c == ']') && !open.empty()) {
        const std::size_t line = text_.rfind('\n', at);
        const bool begins_line = line != std::string_view::npos && text_.find_first_not_of(" \t", line + 1) == at;
        if (begins_line && indentation(at) < indentation(open.back())) return Misfit{open.back(), at};
        open.pop_back();
      }
      const bool bracket = c == '{' || c == '[' || c == '}' || c == ']';
      const std::size_t after = bracket ? at + 1 : value_end(text_, at, comments_);
      at = skip_space(text_, std::max(after, at + 1), comments_);
    }
    return {};
  }

  [[nodiscard]] Fault name(const std::string& wanted) {
    if (next() == '"') return quoted();
    const std::size_t end = word_end(text_, at_);
    const std::string_view word = text_.substr(at_, end - at_);
    const bool bare = !word.empty() && text_.substr(skip_space(text_, end, comments_), 1) == ":" && word.size() <= 40;
    return missing(wanted, bare ? "; write " + in_quotes(word) : std::string());
  }

  [[nodiscard]] Fault value(const std::string& wanted) {
    const char c = next();
    if (c == '"') return quoted();
    if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.') return number();
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) return word();
    if (c == '\'') return here("expected " + wanted + ", found '''; texts must be in double quotes");
    return missing(wanted);
  }

  [[nodiscard]] Fault word() const {
    const std::size_t end = word_end(text_, at_);
    const std::string_view word = text_.substr(at_, end - at_);
    std::string small(word.substr(0, 10));
    for (char& c : small)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    const char* meant = small == "true"                      ? "true"
                        : small == "false"                   ? "false"
                        : small == "null" || small == "none" ? "null"
                                                             : nullptr;
    return here("expected a value, found " + std::string(word.substr(0, 40)) +
                    (meant ? std::string("; write ") + meant : "; texts must be in quotes"),
                word.size());
  }

  [[nodiscard]] Fault number() {
    const char first = next();
    const auto digits = [&] {
      const std::size_t from = at_;
      while (next() >= '0' && next() <= '9') ++at_;
      return at_ > from;
    };
    if (first == '+') return here("a number has no '+' before it");
    if (first == '.') return here("a number needs a digit before '.'");
    if (first == '-') ++at_;
    if (next() == '0') {
      ++at_;
      if (next() >= '0' && next() <= '9') return here("a number does not start with 0 before other digits");
    } else if (!digits()) {
      return here("expected a digit after '-', found " + found());
    }
    if (next() == '.') {
      ++at_;
      if (!digits()) return here("expected a digit after '.', found " + found());
    }
    if (next() == 'e' || next() == 'E') {
      ++at_;
      if (next() == '+' || next() == '-') ++at_;
      if (!digits()) return here("expected a digit of the exponent, found " + found());
    }
    return here("this is not a number");
  }

  [[nodiscard]] Fault quoted() {
    const std::size_t from = at_++;
    while (true) {
      if (done()) return {from, 1, "this text has no end; expected '\"'"};
      const char c = text_[at_];
      if (c == '"') break;
      if (c == '\n') return {from, 1, "this text has no end on its line; expected '\"'"};
      if (static_cast<unsigned char>(c) < 0x20)
        return here("control characters are written with '\\'; found " + found());
      if (c == '\\') {
        if (const std::optional<Fault> wrong = escape()) return *wrong;
        continue;
      }
      const std::size_t length = character_length(text_, at_);
      if (length == 0) return here("this text is not UTF-8: found " + found());
      at_ += length;
    }
    at_ = from;
    return here("this text cannot be read");
  }

  [[nodiscard]] std::optional<Fault> escape() {
    ++at_;
    if (next() != 'u') {
      if (done() || std::string_view("\"\\/bfnrt").find(next()) == std::string_view::npos)
        return here("there is no such escape; found " + found() + " after '\\'");
      ++at_;
      return {};
    }
    ++at_;
    unsigned code = 0;
    if (const auto wrong = four_hex_digits(code)) return wrong;
    if (code >= 0xdc00 && code <= 0xdfff) return here("the second half of a \\u pair stands alone");
    if (code < 0xd800 || code > 0xdbff) return {};
    if (text_.substr(at_, 2) != "\\u") return here("expected the second half of a \\u pair, found " + found());
    at_ += 2;
    if (const auto wrong = four_hex_digits(code)) return wrong;
    if (code < 0xdc00 || code > 0xdfff) return here("expected the second half of a \\u pair");
    return {};
  }

  [[nodiscard]] std::optional<Fault> four_hex_digits(unsigned& code) {
    code = 0;
    for (int i = 0; i < 4; ++i, ++at_) {
      const char c = next();
      const int digit = c >= '0' && c <= '9'   ? c - '0'
                        : c >= 'a' && c <= 'f' ? c - 'a' + 10
                        : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                               : -1;
      if (digit < 0) return here("expected four hexadecimal digits after \\u, found " + found());
      code = code * 16 + static_cast<unsigned>(digit);
    }
    return {};
  }

  std::string_view text_;
  const Stop& stop_;
  std::size_t at_;
  bool comments_;
};

}  // namespace

Fault explained(std::string_view text, const Stop& stop, bool comments) {
  return Explainer(text, stop, comments).fault();
}

}  // namespace tweenfall::json
