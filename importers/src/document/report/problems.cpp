#include "document/report/problems.h"

#include <tweenfall/importers/shown_text.h>

#include "json/text_place.h"

#include <algorithm>
#include <utility>

namespace tweenfall {

namespace document {

namespace {

std::string all_texts(const std::vector<Problem>& problems) {
  std::string out;
  for (const Problem& problem : problems) {
    if (!out.empty()) out += '\n';
    out += problem.text();
  }
  return out;
}

}  // namespace

}  // namespace document

std::string Problem::text() const {
  std::string out = utf8_text(file);
  if (line > 0) out += ":" + std::to_string(line) + ":" + std::to_string(column);
  out += (severity == Severity::note ? ": note: " : ": error: ") + utf8_text(message);
  if (!pointer.empty()) out += " (at " + utf8_text(pointer) + ")";
  if (line == 0 || excerpt.empty()) return out;

  const std::string number = std::to_string(line);
  out += "\n " + number + " | " + excerpt + "\n " + std::string(number.size(), ' ') + " | ";
  // Tabs stay tabs, so that the caret is below its place however wide tabs are shown.
  std::size_t before = column - std::min(column, excerpt_column);
  for (const char c : excerpt) {
    if (before == 0) break;
    if ((static_cast<unsigned char>(c) & 0xc0) == 0x80) continue;
    out += c == '\t' ? '\t' : ' ';
    --before;
  }
  return out + std::string(before, ' ') + "^";
}

DocumentError::DocumentError(std::vector<Problem> problems, std::vector<Problem> notes)
    : std::runtime_error(document::all_texts(problems)), problems_(std::move(problems)), notes_(std::move(notes)) {}

namespace document {

namespace {

constexpr std::size_t longest_excerpt = 160;  // bytes

// Finds the line and column of a problem, starting from the problem before it.
class Walk {
 public:
  explicit Walk(std::string_view text)
      : text_(text), line_start_(text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0), at_(line_start_) {}

  void to(std::size_t offset, Problem& problem) {
    for (std::size_t end = line_end(); end < offset && end < text_.size(); end = line_end()) {
      ++line_;
      line_start_ = at_ = end + 1;
      column_ = 1;
      line_end_ = 0;
    }
    if (offset > at_) {
      column_ += json::characters_in(utf8_text(text_.substr(at_, offset - at_)));
      at_ = offset;
    }
    problem.line = line_;
    problem.column = column_;
    excerpt(problem);
  }

 private:
  std::size_t line_end() {
    if (line_end_ <= line_start_) line_end_ = std::min(text_.find('\n', line_start_), text_.size());
    return line_end_;
  }

  // Sets the excerpt: the line or, if it is very long, the part around the place.
  void excerpt(Problem& problem) {
    const std::size_t end = line_end();
    std::size_t from = line_start_, to = end > from && text_[end - 1] == '\r' ? end - 1 : end;
    const auto inside = [&](std::size_t i) {
      return i < text_.size() && (static_cast<unsigned char>(text_[i]) & 0xc0) == 0x80;
    };
    if (to - from > longest_excerpt) {
      from = std::max(line_start_, at_ - std::min(at_, longest_excerpt / 2));
      while (from > line_start_ && inside(from)) --from;
      to = std::min(to, from + longest_excerpt);
      while (to < end && inside(to)) ++to;
    }
    // Bytes that are not UTF-8 are shown as the characters as which they are counted.
    const std::string before = utf8_text(text_.substr(from, at_ - std::min(at_, from)));
    const std::string after = utf8_text(text_.substr(std::max(at_, from), to - std::min(to, std::max(at_, from))));
    problem.excerpt_column = column_ - json::characters_in(before);
    for (const char c : before + after)
      problem.excerpt += (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f ? ' ' : c;
  }

  std::string_view text_;
  std::size_t line_ = 1, line_start_, line_end_ = 0;
  std::size_t at_, column_ = 1;
};

}  // namespace

void Problems::add(const json::Value& at, std::string message) {
  errors_.entries.push_back({{at.offset(), 0, std::move(message)}, at});
}

void Problems::add_name(const json::Member& at, std::string message) {
  add(json::Fault{at.name_offset(), at.name_length(), std::move(message)});
}

void Problems::add_name_beside(const json::Member& at, std::string message, const json::Member& other) {
  errors_.entries.push_back({{at.name_offset(), at.name_length(), std::move(message)}, {}, other.name_offset()});
}

void Problems::keep(std::size_t count) {
  errors_.entries.resize(std::min(errors_.entries.size(), count - std::min(count, errors_.foreign.size())));
}

void Problems::note(const json::Value& at, std::string message) {
  notes_.entries.push_back({{at.offset(), 0, std::move(message)}, at});
}

void Problems::note_name(const json::Member& at, std::string message) {
  notes_.entries.push_back({{at.name_offset(), at.name_length(), std::move(message)}, {}});
}

void Problems::add_foreign(const std::vector<Problem>& problems) {
  for (const Problem& problem : problems)
    (problem.severity == Severity::note ? notes_ : errors_).foreign.push_back(problem);
}

std::vector<std::size_t> Problems::places() const {
  std::vector<std::size_t> out;
  out.reserve(errors_.entries.size());
  for (const Entry& entry : errors_.entries) out.push_back(entry.fault.offset);
  std::ranges::sort(out);
  return out;
}

std::vector<Problem> Problems::located(Severity severity, const std::string& file, const json::Tree& tree) const {
  const Told& told = severity == Severity::note ? notes_ : errors_;
  std::vector<const Entry*> ordered;
  ordered.reserve(told.entries.size());
  for (const Entry& entry : told.entries) ordered.push_back(&entry);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Entry* a, const Entry* b) { return a->fault.offset < b->fault.offset; });
  const std::size_t count = std::min(ordered.size(), most_listed);

  std::vector<Problem> out;
  out.reserve(count + told.foreign.size() + 1);
  Walk walk(tree.text());
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [fault, value, other] = *ordered[i];
    Problem problem;
    problem.severity = severity;
    problem.file = file;
    walk.to(std::min(fault.offset, tree.text().size()), problem);
    problem.pointer = tree.pointer_to(fault.offset);
    problem.message = fault.message;
    if (other) {
      const json::TextPlace place = json::place_in(tree.text(), *other);
      problem.message +=
          "; the first stands at line " + std::to_string(place.line) + ", column " + std::to_string(place.column);
    }
    problem.length = value ? value.length() : fault.length;
    out.push_back(std::move(problem));
  }
  if (ordered.size() > count) {
    out.push_back(file_problem(file, std::to_string(ordered.size() - count) +
                                         (severity == Severity::note ? " more notes" : " more problems") +
                                         " are not listed"));
    out.back().severity = severity;
    out.back().count = ordered.size() - count;
  }
  out.insert(out.end(), told.foreign.begin(), told.foreign.end());
  return out;
}

Problem file_problem(std::string file, std::string message) {
  Problem problem;
  problem.file = std::move(file);
  problem.message = std::move(message);
  return problem;
}

}  // namespace document
}  // namespace tweenfall
