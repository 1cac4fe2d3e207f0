#include "document/report/problems.h"

#include <algorithm>
#include <map>
#include <utility>

namespace tweenfall {

namespace {

std::string all_texts(const std::vector<Problem>& problems) {
  std::string out;
  for (const Problem& problem : problems) {
    if (!out.empty()) out += '\n';
    out += problem.text();
  }
  return out;
}

std::size_t characters(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

std::string Problem::text() const {
  std::string out = file;
  if (line > 0) out += ":" + std::to_string(line) + ":" + std::to_string(column);
  out += ": error: " + message;
  if (!pointer.empty()) out += " (at " + pointer + ")";
  if (line == 0 || excerpt.empty()) return out;

  const std::string number = std::to_string(line);
  out += "\n " + number + " | " + excerpt + "\n " + std::string(number.size(), ' ') + " | ";
  // Tabs stay tabs, so that the caret stands below its place however wide they are shown.
  std::size_t before = column - std::min(column, excerpt_column);
  for (const char c : excerpt) {
    if (before == 0) break;
    if ((static_cast<unsigned char>(c) & 0xc0) == 0x80) continue;
    out += c == '\t' ? '\t' : ' ';
    --before;
  }
  return out + std::string(before, ' ') + "^";
}

DocumentError::DocumentError(std::vector<Problem> problems)
    : std::runtime_error(all_texts(problems)), problems_(std::move(problems)) {}

namespace document {

namespace {

constexpr std::size_t most_listed = 10000;
constexpr std::size_t longest_excerpt = 160;  // bytes

std::string pointer_part(std::string_view name) {
  std::string out = "/";
  for (const char c : name) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else
      out += c;
  }
  return out;
}

// Pointers of the values (or member names) that stand at the wanted offsets.
void find_pointers(const JsonValue& value, const std::string& pointer, std::map<std::size_t, std::string>& wanted) {
  const auto within = wanted.lower_bound(value.offset);
  if (within == wanted.end() || within->first > value.offset + value.length) return;
  if (within->first == value.offset) within->second = pointer;
  // A place within a text is the text's.
  if (value.is(JsonValue::Kind::text))
    for (auto inside = within; inside != wanted.end() && inside->first < value.offset + value.length; ++inside)
      inside->second = pointer;
  for (std::size_t i = 0; i < value.items.size(); ++i)
    find_pointers(value.items[i], pointer + "/" + std::to_string(i), wanted);
  for (const JsonMember& member : value.members) {
    const std::string below = pointer + pointer_part(member.name);
    if (const auto named = wanted.find(member.name_offset); named != wanted.end()) named->second = below;
    find_pointers(member.value, below, wanted);
  }
}

void excerpt_around(std::string_view text, std::size_t line_start, std::size_t offset, Problem& problem) {
  const std::size_t line_end = std::min(text.find_first_of("\r\n", line_start), text.size());
  std::size_t from = line_start, to = line_end;
  const auto inside = [&](std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80;
  };
  if (to - from > longest_excerpt) {
    from = std::max(line_start, offset - std::min(offset, longest_excerpt / 2));
    while (from > line_start && inside(from)) --from;
    to = std::min(line_end, from + longest_excerpt);
    while (to < line_end && inside(to)) ++to;
  }
  problem.excerpt_column = characters(text.substr(line_start, from - line_start)) + 1;
  for (const char c : text.substr(from, to - from))
    problem.excerpt += (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f ? ' ' : c;
}

}  // namespace

void Problems::add(const JsonValue& at, std::string message) {
  add(JsonFault{at.offset, at.length, std::move(message)});
}

void Problems::add_name(const JsonMember& at, std::string message) {
  add(JsonFault{at.name_offset, at.name_length, std::move(message)});
}

void Problems::add_foreign(std::vector<Problem> problems) {
  for (Problem& problem : problems) foreign_.push_back(std::move(problem));
}

std::vector<Problem> Problems::located(const std::string& file, std::string_view text, const JsonValue& root) const {
  std::vector<const JsonFault*> ordered;
  for (const JsonFault& fault : faults_) ordered.push_back(&fault);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const JsonFault* a, const JsonFault* b) { return a->offset < b->offset; });
  const std::size_t count = std::min(ordered.size(), most_listed);
  std::map<std::size_t, std::string> pointers;
  for (std::size_t i = 0; i < count; ++i) pointers.emplace(ordered[i]->offset, "");
  find_pointers(root, "", pointers);

  std::vector<Problem> out;
  std::size_t line = 1, line_start = text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0, counted = line_start;
  std::size_t column_from = line_start, column = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const JsonFault& fault = *ordered[i];
    const std::size_t offset = std::min(fault.offset, text.size());
    for (; counted < offset; ++counted) {
      if (text[counted] != '\n') continue;
      ++line;
      line_start = column_from = counted + 1;
      column = 1;
    }
    if (offset > column_from) {
      column += characters(text.substr(column_from, offset - column_from));
      column_from = offset;
    }
    Problem problem;
    problem.file = file;
    problem.line = line;
    problem.column = column;
    problem.pointer = pointers[fault.offset];
    problem.message = fault.message;
    problem.length = fault.length;
    excerpt_around(text, line_start, offset, problem);
    out.push_back(std::move(problem));
  }
  if (ordered.size() > count)
    out.push_back(file_problem(file, std::to_string(ordered.size() - count) + " more problems are not listed"));
  out.insert(out.end(), foreign_.begin(), foreign_.end());
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
