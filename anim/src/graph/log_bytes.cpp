#include "graph/log_bytes.h"

#include "graph/digest.h"
#include "graph/swing_course.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace tweenfall::graphs {

namespace {

constexpr std::uint64_t kind_of_file = 0x3248504152474654;  // "TFGRAPH2", the first letter in the lowest byte

class Writer {
 public:
  void number(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) bytes_.push_back(static_cast<std::byte>(number >> shift & 0xff));
  }
  void number(double number_) { number(std::bit_cast<std::uint64_t>(number_)); }
  void text(std::string_view text) {
    number(std::uint64_t{text.size()});
    for (const char letter : text) bytes_.push_back(static_cast<std::byte>(letter));
  }
  void part(std::span<const std::byte> part) {
    number(std::uint64_t{part.size()});
    bytes_.insert(bytes_.end(), part.begin(), part.end());
  }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint64_t number() {
    const std::span<const std::byte> part = next(8);
    std::uint64_t out = 0;
    for (std::size_t i = 0; i < 8; ++i) out |= std::to_integer<std::uint64_t>(part[i]) << (8 * i);
    return out;
  }
  double real() {
    const double out = std::bit_cast<double>(number());
    if (!std::isfinite(out)) refuse("a number in them is not finite");
    return out;
  }
  std::string text() {
    std::string out;
    for (const std::byte letter : next(number())) out += static_cast<char>(letter);
    return out;
  }
  std::span<const std::byte> part() { return next(number()); }
  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size(); }
  [[noreturn]] static void refuse(const std::string& why) {
    throw std::invalid_argument("these bytes are not a saved graph: " + why);
  }

 private:
  std::span<const std::byte> next(std::uint64_t size) {
    if (size > bytes_.size()) refuse("they end too early");
    const std::span<const std::byte> part = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return part;
  }
  std::span<const std::byte> bytes_;
};

std::uint64_t checksum(std::span<const std::byte> bytes) noexcept {
  Digest digest;
  for (const std::byte byte : bytes) digest.byte(std::to_integer<std::uint8_t>(byte));
  return digest.value();
}

// For each course the mark that has come the furthest, so that nothing is computed again.
void write_swings(const SwingMemory& memory, double time, Writer& out) {
  std::vector<const SwingCourse*> courses;
  for (const SwingCourse& course : memory.courses)
    if (course.start >= 0 && furthest_mark(course, time, time)) courses.push_back(&course);
  std::ranges::sort(courses, {}, &SwingCourse::start);
  out.number(std::uint64_t{courses.size()});
  for (const SwingCourse* course : courses) {
    const SwingMark& mark = *furthest_mark(*course, time, time);
    out.number(course->start);
    out.number(mark.instant);
    out.number(mark.time);
    out.number(std::uint64_t{mark.state.index()});
    out.part(std::visit([](const auto& state) { return state.bytes(); }, mark.state));
  }
}

void read_swings(SwingMemory& memory, double time, Reader& reader) {
  const std::uint64_t count = reader.number();
  if (count > memory.courses.size()) Reader::refuse("they have more springs than the graph");
  for (std::uint64_t i = 0; i < count; ++i) {
    SwingCourse& course = memory.courses[i];
    course.start = reader.real();
    SwingMark& mark = course.latest.front();
    mark.instant = reader.real();
    mark.time = reader.real();
    if (!(course.start >= 0 && course.start <= mark.instant && mark.instant <= mark.time && mark.time <= time))
      Reader::refuse("its springs are not in order of time");
    course.oldest = 1;
    const std::uint64_t kind = reader.number();
    if (kind == 0)
      mark.state = NodeSpringState::from_bytes(reader.part());
    else if (kind == 1)
      mark.state = JiggleState::from_bytes(reader.part());
    else
      mark.state = ReachState::from_bytes(reader.part());
  }
}

}  // namespace

std::vector<std::byte> bytes_of(const Log& log, const GraphDescription& description, double time) {
  Writer out;
  out.number(kind_of_file);
  out.number(fingerprint(description));
  out.number(time);
  for (const Record<Setting>& settings : log.settings) {
    std::uint64_t own = 0;
    for (const Setting& each : settings) own += each.origin == Origin::outside;
    out.number(own);
    for (const Setting& each : settings) {
      if (each.origin != Origin::outside) continue;
      out.number(each.time);
      out.number(each.value);
    }
  }
  std::uint64_t own = 0;
  for (const Sending& each : log.sent) own += each.origin == Origin::outside;
  out.number(own);
  for (const Sending& each : log.sent) {
    if (each.origin != Origin::outside) continue;
    out.number(each.time);
    out.text(each.event);
  }
  for (const SwingMemory& memory : log.swings) write_swings(memory, time, out);
  std::vector<std::byte> bytes = out.take();
  Writer end;
  end.number(checksum(bytes));
  for (const std::byte byte : end.take()) bytes.push_back(byte);
  return bytes;
}

SavedLog log_of(std::span<const std::byte> bytes, const GraphDescription& description, const LogSizes& sizes) {
  if (bytes.size() < 32) Reader::refuse("they end too early");
  Reader reader(bytes.first(bytes.size() - 8));
  if (reader.number() != kind_of_file) Reader::refuse("they do not begin like a saved graph");
  if (Reader(bytes.last(8)).number() != checksum(bytes.first(bytes.size() - 8)))
    Reader::refuse("their checksum differs");
  if (reader.number() != fingerprint(description)) Reader::refuse("they are of another graph");
  SavedLog saved{fresh_log(description, sizes), reader.real()};
  if (saved.time < 0) Reader::refuse("its time is before 0 s");
  const auto time_after = [&](double last) {
    const double read = reader.real();
    if (read < last || read > saved.time) Reader::refuse("the inputs are not in order of time");
    return read;
  };
  for (std::size_t p = 0; p < description.parameters.size(); ++p) {
    const std::uint64_t count = reader.number();
    if (count > 0 && description.parameters[p].curve) Reader::refuse("a parameter that has keys was set");
    double at = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      at = time_after(at);
      const double value = reader.real();
      if (std::abs(value) > largest_parameter) Reader::refuse("a parameter was set beyond 1e15");
      set(saved.log, description, p, at, value, Origin::outside);
    }
  }
  const std::uint64_t count = reader.number();
  double at = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    at = time_after(at);
    send(saved.log, at, reader.text(), Origin::outside);
  }
  for (SwingMemory& memory : saved.log.swings) read_swings(memory, saved.time, reader);
  if (reader.left() > 0) Reader::refuse("something follows their end");
  return saved;
}

std::uint64_t hash_of(const Log& log, double time) noexcept {
  Digest digest;
  digest.number(time);
  for (const Record<Setting>& settings : log.settings)
    for (const Setting& each : settings) {
      if (each.time > time) break;
      digest.number(each.time);
      digest.number(each.value);
    }
  for (const Sending& each : log.sent) {
    if (each.time > time) break;
    digest.number(each.time);
    digest.text(each.event);
  }
  for (const Record<Passage>& passages : log.passages)
    for (const Passage& each : passages) {
      if (each.time > time) break;
      digest.number(each.time);
      digest.number(std::uint64_t{each.state});
      digest.number(std::uint64_t{each.transition});
      digest.number(each.trace);
    }
  return digest.value();
}

}  // namespace tweenfall::graphs
