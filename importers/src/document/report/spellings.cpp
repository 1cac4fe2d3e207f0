#include "document/report/spellings.h"

#include <tweenfall/curves/number_text.h>

#include "document/report/foreign_words.h"
#include "document/report/units.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

// Longer values are not quoted, so that a message stays on one line.
constexpr std::size_t longest_said = 120;

std::string said(const std::string& text) {
  return text.size() > longest_said ? std::string() : "; say " + text;
}

struct WithUnit {
  double number = 0;
  std::string_view unit;
};

// "500ms" as 500 and "ms"
std::optional<WithUnit> with_unit(std::string_view text) {
  WithUnit read;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), read.number);
  if (fault != std::errc() || !std::isfinite(read.number)) return {};
  read.unit = text.substr(static_cast<std::size_t>(end - text.data()));
  while (!read.unit.empty() && read.unit.front() == ' ') read.unit.remove_prefix(1);
  constexpr std::size_t longest_unit = 16;
  const bool plain = read.unit.size() <= longest_unit && std::all_of(read.unit.begin(), read.unit.end(), [](char c) {
                       return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' ||
                              c == '/' || c == '^' || c == '*' || static_cast<unsigned char>(c) >= 0x80;
                     });
  const bool begins = read.unit.empty() || read.unit.starts_with("1/") || !(read.unit[0] >= '0' && read.unit[0] <= '9');
  return plain && begins ? std::optional(read) : std::nullopt;
}

// The number in our unit; none where that is not sure.
std::optional<double> in_unit(std::string_view unit, const WithUnit& read) {
  if (read.unit.empty()) return read.number;
  const std::optional<double> factor = factor_to(unit, read.unit);
  if (!factor || !std::isfinite(read.number * *factor)) return {};
  return read.number * *factor;
}

// As exactly as a few digits can; what comes from a factor such as that of radians is rounded.
std::string in_digits(double number) {
  constexpr std::size_t few = 10;
  const std::string exact = number_text(number);
  return exact.size() > few ? brief_text(number) : exact;
}

bool all_numbers(const json::Value& list) {
  return std::all_of(list.items().begin(), list.items().end(),
                     [](const json::Value& item) { return item.is(Kind::number); });
}

json::Value first_of(const json::Value& object, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const json::Value value = object.find(name)) return value;
  return {};
}

}  // namespace

std::string number_meant(std::string_view text, std::string_view unit) {
  const std::optional<WithUnit> read = with_unit(text);
  if (!read) return {};
  // Keys of angles, whose form does not say so, are in degrees as all angles are.
  const bool of_angle = unit.empty() && factor_to("degrees", read->unit) == 1;
  if (const std::optional<double> number = in_unit(of_angle ? "degrees" : unit, *read)) return said(in_digits(*number));
  return unit.empty() ? std::string() : "; it is a number, in " + std::string(unit);
}

std::string member_said(std::string_view name, const json::Value& value) {
  return said("{" + json::in_quotes(name) + ": " + json::on_one_line(value) + "}");
}

std::string vector_meant(const json::Value& value) {
  std::string list;
  for (const std::string_view name : {"x", "y", "z", "w"}) {
    const json::Value part = value.find(name);
    if (!part) break;
    if (!part.is(Kind::number)) return {};
    list += (list.empty() ? "" : ", ") + json::on_one_line(part);
  }
  return list.empty() ? list : said("[" + list + "]");
}

std::string time_meant(std::string_view text, bool share_of_duration) {
  const std::string small = small_letters(text.substr(0, longest_said));
  if (share_of_duration && small == "from") return said("\"0%\"");
  if (share_of_duration && small == "to") return said("\"100%\"");
  const std::optional<WithUnit> read = with_unit(small);
  if (!read) return {};
  const std::optional<double> seconds = in_unit("s", *read);
  return seconds ? said(in_digits(*seconds)) : std::string();
}

std::string step_meant(std::string_view text) {
  const std::optional<WithUnit> read = with_unit(text.substr(0, longest_said));
  if (!read) return {};
  const std::string unit = small_letters(read->unit);
  const bool times = unit == "hz" || unit == "fps";
  if (times && read->number >= 1 && read->number <= 999999999 && read->number == std::floor(read->number))
    return said("\"1/" + number_text(read->number) + "\"");
  const std::optional<WithUnit> parts = text.starts_with("1/") ? with_unit(text.substr(2, longest_said)) : std::nullopt;
  if (parts && parts->number >= 1 && in_unit("s", *parts) == parts->number)
    return said("\"1/" + number_text(parts->number) + "\"");
  return text.starts_with("1/") ? std::string() : number_meant(text, "s");
}

std::string list_of_equal(const json::Value& value) {
  if (!value.is(Kind::number)) return {};
  const std::string number = json::on_one_line(value);
  return said("[" + number + ", " + number + ", " + number + "]");
}

std::string gravity_meant(const json::Value& value) {
  if (value.is(Kind::text)) {
    const std::optional<WithUnit> read = with_unit(value.text());
    const std::optional<double> down = read ? in_unit("m/s^2", *read) : std::nullopt;
    return down ? said("[0, " + in_digits(-std::abs(*down)) + ", 0]") : std::string();
  }
  return value.is(Kind::number) ? said("[0, " + number_text(-std::abs(value.number())) + ", 0]") : vector_meant(value);
}

std::string loop_meant(const json::Value& value) {
  if (value.is(Kind::boolean)) return value.boolean() ? said("\"repeat\"") : "; leave it out";
  if (!value.is(Kind::number)) return {};
  if (!(value.number() > 0)) return said("\"repeat\"");
  return said("{\"mode\": \"repeat\", \"count\": " + json::on_one_line(value) + "}");
}

std::string angles_meant(const json::Value& value) {
  if (!value.is(Kind::object) || value.members().empty()) return {};
  std::string angles;
  std::size_t known = 0;
  for (const std::string_view name : {"x", "y", "z", "w"}) {
    const json::Value part = value.find(name);
    if (part && !part.is(Kind::number)) return {};
    if (!part && name == "w") break;
    angles += (angles.empty() ? "" : ", ") + (part ? json::on_one_line(part) : std::string("0"));
    known += part ? 1 : 0;
  }
  if (known != value.members().size()) return {};
  return "a rotation must say how it is given" +
         said("{\"" + std::string(value.find("w") ? "quat" : "euler") + "\": [" + angles + "]}");
}

std::string rotation_meant(const json::Value& value, std::string_view kind) {
  if (value.is(Kind::text) && kind != "quat") {
    const std::optional<WithUnit> read = with_unit(value.text());
    if (const std::optional<double> angle = read ? in_unit("degrees", *read) : std::nullopt)
      return said("{\"axis\": \"z\", \"angle\": " + in_digits(*angle) + "}");
  }
  if (value.is(Kind::number) && kind != "quat")
    return said("{\"axis\": \"z\", \"angle\": " + json::on_one_line(value) + "}");
  if (!value.is(Kind::list) || !all_numbers(value)) return {};
  const std::string_view spelling = value.items().size() == 3 ? "euler" : value.items().size() == 4 ? "quat" : "";
  if (spelling.empty() || (kind != spelling && kind != "euler")) return {};
  return said("{" + json::in_quotes(spelling) + ": " + json::on_one_line(value) + "}");
}

std::string comparison_meant(const json::Value& value) {
  const std::string_view text = value.is(Kind::text) ? value.text() : std::string_view();
  const std::size_t from = text.find_first_of("<>="), to = text.find_first_not_of("<>=", from);
  if (from == std::string_view::npos || to == std::string_view::npos) return {};
  const std::string_view name = text.substr(0, text.find_last_not_of(' ', from == 0 ? 0 : from - 1) + 1);
  const std::optional<WithUnit> number = with_unit(text.substr(std::min(text.find_first_not_of(' ', to), text.size())));
  if (from == 0 || name.empty() || !number || !number->unit.empty()) return {};
  const char* const how = text[from] == '>' ? "above" : text[from] == '<' ? "below" : "equals";
  return said("{\"parameter\": " + json::in_quotes(name) + ", " + json::in_quotes(how) + ": " +
              number_text(number->number) + "}");
}

std::string key_meant(const json::Value& value) {
  if (!value.is(Kind::list) || value.items().size() < 4 || !all_numbers(value)) return {};
  std::string rest;
  for (std::size_t i = 1; i < value.items().size(); ++i)
    rest += (rest.empty() ? "" : ", ") + json::on_one_line(value.items()[i]);
  return said("[" + json::on_one_line(value.items().front()) + ", [" + rest + "]]");
}

std::string event_meant(const json::Value& value) {
  const json::Value name = first_of(value, {"name", "event", "marker", "label"}),
                    time = first_of(value, {"at", "time", "t"});
  if (!name || !time || value.find("from") || value.find("to")) return {};
  return "an event at one time is a list" + said("[" + json::on_one_line(time) + ", " + json::on_one_line(name) + "]");
}

std::string member_meant(const json::Value& value) {
  if (!value.is(Kind::list)) return {};
  const json::Value first = value.items().empty() ? json::Value() : value.items().front();
  const json::Value name = first ? first_of(first, {"name", "id"}) : json::Value();
  return said("{" + (name && name.is(Kind::text) ? json::on_one_line(name) : std::string("\"NAME\"")) +
              ": ...}, each by its name");
}

std::string kind_meant(const json::Value& value, const std::vector<std::string>& kinds,
                       const std::vector<std::string>& beside) {
  const json::Value word = value.is(Kind::text) ? value : first_of(value, {"type", "kind"});
  if (!word || !word.is(Kind::text)) return {};
  const std::string kind = small_letters(word.text());
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) return {};
  std::string rest, others;
  for (const json::Member& member : value.members()) {
    if (member.value == word) continue;
    const bool is_beside = std::find(beside.begin(), beside.end(), member.name) != beside.end();
    const std::string written = json::in_quotes(member.name) + ": " + json::on_one_line(member.value);
    if (is_beside)
      others += ", " + written;
    else
      rest += (rest.empty() ? "" : ", ") + written;
  }
  return said("{" + json::in_quotes(kind) + ": {" + (value.is(Kind::text) ? "..." : rest) + "}" + others + "}");
}

}  // namespace tweenfall::document
