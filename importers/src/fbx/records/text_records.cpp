#include "fbx/records/records.h"

#include <charconv>
#include <limits>

namespace tweenfall::fbx {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool ends_word(char c) {
  return is_blank(c) || c == ',' || c == '{' || c == '}' || c == ':' || c == ';' || c == '"';
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

class TextReader {
 public:
  explicit TextReader(const Source& source) : source_(source), bytes_(source.bytes()) {}

  File read() {
    File file;
    file.root.name = "file";
    read_list(file.root, 0);
    const Record* header = file.root.find("FBXHeaderExtension");
    const Record* version = header ? header->find("FBXVersion") : nullptr;
    if (!version) source_.fail(0, "is not an FBX file: it has no FBXHeaderExtension with an FBXVersion");
    file.version = version->whole(0, 0);
    return file;
  }

 private:
  void skip_blank() {
    while (at_ < bytes_.size()) {
      if (is_blank(bytes_[at_]))
        ++at_;
      else if (bytes_[at_] == ';')
        at_ = std::min(bytes_.find('\n', at_), bytes_.size());
      else
        return;
    }
  }

  /// The next character that is not blank, or 0 at the end.
  char next() {
    skip_blank();
    return at_ < bytes_.size() ? bytes_[at_] : '\0';
  }

  std::string_view word() {
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !ends_word(bytes_[at_])) ++at_;
    return bytes_.substr(begin, at_ - begin);
  }

  /// Records up to a closing brace, or at the top to the end of the file.
  void read_list(Record& into, std::size_t depth) {
    if (depth > deepest) source_.fail(at_, "records lie more than 64 deep within each other");
    while (true) {
      const char c = next();
      if (c == '\0' && at_ >= bytes_.size()) {
        if (depth > 0) source_.fail(into.at, "the brace of \"" + into.name + "\" is not closed");
        return;
      }
      if (c == '}') {
        if (depth == 0) source_.fail(at_, "a brace is closed that was not opened");
        ++at_;
        return;
      }
      into.children.push_back(read_record(depth));
    }
  }

  Record read_record(std::size_t depth) {
    Record record;
    record.at = at_;
    record.name = std::string(word());
    if (record.name.empty() || next() != ':') source_.fail(record.at, "expected the name of a record and a colon");
    ++at_;
    read_values(record);
    if (next() == '{') {
      ++at_;
      read_list(record, depth + 1);
    }
    return record;
  }

  void read_values(Record& record) {
    // Some records begin with a comma.
    if (next() == ',') ++at_;
    if (record.name == "a") {
      record.values.emplace_back(read_numbers());
      return;
    }
    while (true) {
      const char c = next();
      if (c == '{' || c == '}' || c == '\0') return;
      const std::size_t begin = at_;
      if (c == '"') {
        record.values.emplace_back(quoted());
      } else {
        const std::string_view given = word();
        // Without a comma before it, a word followed by a colon is the name of the next record.
        if (next() == ':') {
          at_ = begin;
          return;
        }
        if (given.empty()) source_.fail(begin, "expected a value");
        // The count of an array is redundant.
        if (given[0] != '*') record.values.push_back(value_of(given));
      }
      if (next() != ',') return;
      ++at_;
    }
  }

  std::string quoted() {
    const std::size_t begin = at_;
    const std::size_t end = bytes_.find('"', at_ + 1);
    if (end == std::string_view::npos) source_.fail(begin, "the quotation mark is not closed");
    std::string text(bytes_.substr(begin + 1, end - begin - 1));
    at_ = end + 1;
    replace_all(text, "&quot;", "\"");
    replace_all(text, "&cr;", "\r");
    replace_all(text, "&lf;", "\n");
    return text;
  }

  static Value value_of(std::string_view given) {
    std::int64_t whole = 0;
    double real = 0;
    const char* end = given.data() + given.size();
    if (const auto read = std::from_chars(given.data(), end, whole); read.ec == std::errc() && read.ptr == end)
      return whole;
    if (real_of(given, real)) return real;
    return std::string(given);
  }

  static bool real_of(std::string_view given, double& real) {
    if (given.starts_with('+')) given.remove_prefix(1);
    const char* end = given.data() + given.size();
    const auto read = std::from_chars(given.data(), end, real);
    if (read.ptr == end && read.ec == std::errc()) return true;
    if (read.ptr == end && read.ec == std::errc::result_out_of_range) {
      // Too small or too large for a double.
      real = given.find("e-") != std::string_view::npos || given.find("E-") != std::string_view::npos
                 ? 0.0
                 : std::numeric_limits<double>::infinity();
      return true;
    }
    // "1.#IND" and the like, printed by some programs for NaN.
    if (read.ptr != given.data() && *read.ptr == '#') {
      real = std::numeric_limits<double>::quiet_NaN();
      return true;
    }
    return false;
  }

  /// The numbers of an array: integers if all of them are.
  Value read_numbers() {
    Integers integers;
    Reals reals;
    bool whole = true;
    while (true) {
      const char c = next();
      if (c == '}' || c == '\0') break;
      const std::size_t begin = at_;
      const std::string_view given = word();
      const Value value = given.empty() ? Value(std::string()) : value_of(given);
      if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        if (whole)
          integers.push_back(*integer);
        else
          reals.push_back(static_cast<double>(*integer));
      } else if (const auto* real = std::get_if<double>(&value)) {
        if (whole) {
          reals.assign(integers.begin(), integers.end());
          integers = {};
          whole = false;
        }
        reals.push_back(*real);
      } else if (given.size() == 1 && whole) {
        // Booleans written as letters.
        integers.push_back(given[0]);
      } else {
        source_.fail(begin, "expected a number, found \"" + std::string(given.substr(0, 40)) + "\"");
      }
      if (next() == ',') ++at_;
    }
    return whole ? Value(std::move(integers)) : Value(std::move(reals));
  }

  const Source& source_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace

File read_text_records(const Source& source) {
  return TextReader(source).read();
}

}  // namespace tweenfall::fbx
