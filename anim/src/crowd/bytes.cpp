#include <tweenfall/anim/crowd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "crowd/compiled_clip.h"

// The contents are preceded by "tweenfall crowd\n", the version, the size of the contents, and their checksum. All
// numbers are little-endian, each in its own width.

namespace tweenfall {

namespace crowd {
namespace {

constexpr std::string_view signature = "tweenfall crowd\n";
/// Raised whenever the contents change, so that older bytes are refused and not misread.
constexpr std::uint32_t format_version = 2;
constexpr std::size_t header_size = signature.size() + 4 + 8 + 8;
constexpr std::uint32_t largest_stride = 64;
constexpr std::uint32_t most_joints = 1U << 30;
/// Later than any clip, but small enough that differences are finite; s.
constexpr double latest_knot = 1e100;

/// FNV-1a by words of eight bytes, with the finalizer of splitmix64.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0xcbf29ce484222325U ^ bytes.size();
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = 0; k < std::min<std::size_t>(8, bytes.size() - i); ++k)
      word |= static_cast<std::uint64_t>(bytes[i + k]) << (8 * k);
    sum = (sum ^ word) * 0x100000001b3U;
    sum ^= sum >> 29;
  }
  sum = (sum ^ (sum >> 30)) * 0xbf58476d1ce4e5b9U;
  sum = (sum ^ (sum >> 27)) * 0x94d049bb133111ebU;
  return sum ^ (sum >> 31);
}

template <std::size_t size>
using Unsigned = std::conditional_t<
    size == 1, std::uint8_t,
    std::conditional_t<size == 2, std::uint16_t, std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

class Writer {
 public:
  template <class T>
  void number(T value) {
    const auto word = std::bit_cast<Unsigned<sizeof(T)>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes.push_back(static_cast<std::byte>(word >> (8 * i) & 0xff));
  }
  void count(std::size_t value) { number(static_cast<std::uint32_t>(value)); }

  std::vector<std::byte> bytes;
};

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument("these bytes are not a compiled clip: " + why);
}

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  [[nodiscard]] T number() {
    require(left() >= sizeof(T), "it ends too early");
    Unsigned<sizeof(T)> word = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      word = static_cast<Unsigned<sizeof(T)>>(word | static_cast<Unsigned<sizeof(T)>>(bytes_[place_ + i]) << (8 * i));
    place_ += sizeof(T);
    return std::bit_cast<T>(word);
  }
  [[nodiscard]] double finite() {
    const auto value = number<double>();
    require(std::isfinite(value), "a number is not finite");
    return value;
  }
  /// The number of items that follow, each of which takes `least` bytes or more.
  [[nodiscard]] std::size_t count(std::size_t least) {
    const auto many = number<std::uint32_t>();
    require(many <= left() / least, "it claims more than fits in the remaining bytes");
    return many;
  }
  /// @param many known from the bytes before; memory is allocated only after checking that they are there
  template <class T, class Allocator>
  void all(std::vector<T, Allocator>& values, std::uint64_t many) {
    require(many <= left() / sizeof(T), "it claims more than fits in the remaining bytes");
    values.resize(static_cast<std::size_t>(many));
    for (T& value : values) value = number<T>();
  }
  void require(bool holds, const char* what) const {
    if (!holds) refuse(std::string(what) + ", at byte " + std::to_string(place_) + " of its contents");
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - place_; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t place_ = 0;
};

void write(Writer& to, const CompiledClip& clip) {
  to.number(clip.joints);
  to.number(clip.duration);
  to.number(static_cast<std::uint8_t>(clip.loop.mode));
  to.number(clip.loop.count);
  for (const double error : {clip.errors.first, clip.errors.later, clip.errors.growth}) to.number(error);
  to.count(clip.timelines.size());
  for (const Timeline& timeline : clip.timelines) {
    to.count(timeline.knots.size());
    for (const double knot : timeline.knots) to.number(knot);
  }
  to.count(clip.runs.size());
  for (const Run& run : clip.runs) {
    to.number(run.form.timeline);
    to.number(static_cast<std::uint8_t>(run.form.cubic ? 1 : 0));
    to.number(static_cast<std::uint8_t>(run.form.base));
    to.number(static_cast<std::uint8_t>(run.form.fine));
    to.number(run.form.stride);
    to.number(run.count);
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
      to.number(clip.channels[i].group);
      to.number(static_cast<std::uint8_t>(clip.channels[i].kind));
    }
  }
  for (const float value : clip.numbers) to.number(value);
  for (const std::int32_t word : clip.words) to.number(word);
  to.count(clip.climbs.size());
  for (const Climb& climb : clip.climbs) {
    to.number(climb.joint);
    for (const double part : climb.gain) to.number(part);
    for (const double part : climb.turn) to.number(part);
  }
}

void read_timeline(Reader& from, Timeline& timeline) {
  const std::size_t knots = from.count(sizeof(double));
  from.require(knots >= 2, "a timeline has fewer than two knots");
  from.all(timeline.knots, knots);
  for (const double knot : timeline.knots)
    from.require(std::abs(knot) <= latest_knot, "the time of a knot is out of range");
  from.require(std::ranges::is_sorted(timeline.knots), "the knots of a timeline are not in order of time");
  timeline.index();
}

Form read_form(Reader& from, const CompiledClip& clip) {
  Form form;
  form.timeline = from.number<std::uint32_t>();
  const auto cubic = from.number<std::uint8_t>(), base = from.number<std::uint8_t>(),
             fine = from.number<std::uint8_t>();
  from.require(cubic <= 1 && base <= static_cast<std::uint8_t>(Packing::wide) &&
                   fine <= static_cast<std::uint8_t>(Packing::exact),
               "there is no such form");
  form.cubic = cubic != 0;
  form.base = static_cast<Packing>(base);
  form.fine = static_cast<Packing>(fine);
  form.stride = from.number<std::uint32_t>();
  if (form.is_constant()) {
    from.require(form.timeline == Form::no_timeline && !form.cubic, "a constant channel has no timeline");
  } else {
    from.require(form.timeline < clip.timelines.size(), "there is no such timeline");
  }
  if (form.base == Packing::none) {
    from.require(form.stride == 0, "there is no base for this stride");
  } else {
    from.require(std::has_single_bit(form.stride) && form.stride <= largest_stride, "there is no such stride");
    from.require(form.fine == Packing::none || form.fine == Packing::narrow, "there is no such form");
  }
  return form;
}

void read_run(Reader& from, CompiledClip& clip, std::vector<bool>& seen, std::uint64_t& numbers) {
  Run run{.form = read_form(from, clip), .first = static_cast<std::uint32_t>(clip.channels.size())};
  run.count = static_cast<std::uint32_t>(from.count(5));
  from.require(run.count > 0, "a run has no channels");
  for (std::uint32_t i = 0; i < run.count; ++i) {
    Channel channel{.group = from.number<std::uint32_t>()};
    const auto kind = from.number<std::uint8_t>();
    from.require(channel.group < seen.size() / 3 && kind <= 2, "there is no such channel");
    channel.kind = static_cast<Kind>(kind);
    const std::size_t place = std::size_t{3} * channel.group + kind;
    from.require(!seen[place], "a channel occurs twice");
    seen[place] = true;
    from.require(numbers <= 0xffffffffU, "it claims more than fits in the remaining bytes");
    channel.numbers = static_cast<std::uint32_t>(numbers);
    numbers += run.form.slots(components(channel.kind)) * run.form.numbers_per_slot() * lane_count;
    clip.channels.push_back(channel);
  }
  clip.runs.push_back(run);
}

/// The largest value that a component of a packing can have.
double largest_field(Packing packing, std::size_t component_count, std::size_t component) {
  const Field field = field_of(packing, component_count, component);
  return std::ldexp(1.0, field.at_top() ? 31 : field.at + field.bits);
}

/// Bound on the values of a channel, or on its tangents, over all its components.
double largest_of(const CompiledClip& clip, const Run& run, const Channel& channel, bool tangents) {
  const std::size_t count = components(channel.kind), each = run.form.numbers_per_slot();
  double largest = 0;
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const float* number =
          clip.numbers.data() + channel.numbers + ((tangents ? count : 0) + c) * each * lane_count + lane;
      double sum = std::abs(*number);
      for (const Packing packing : {run.form.base, run.form.fine})
        if (packing != Packing::none) sum += std::abs(*(number += lane_count)) * largest_field(packing, count, c);
      largest = std::max(largest, sum);
    }
  return largest;
}
/// The same for a channel stored as floats. @param column where it begins in a row
double largest_exact(const CompiledClip& clip, const Run& run, std::size_t column, std::size_t width) {
  double largest = 0;
  for (std::size_t knot = 0; knot < clip.timelines[run.form.timeline].knots.size(); ++knot)
    for (std::size_t i = 0; i < width; ++i) {
      const float value = std::bit_cast<float>(clip.words[run.fine_begin + knot * run.fine_row + column + i]);
      if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
      largest = std::max<double>(largest, std::abs(value));
    }
  return largest;
}

/// Checks that no numbers in the bytes can lead to a value or a rate that float cannot hold.
void require_bounded(const Reader& from, const CompiledClip& clip) {
  for (const float value : clip.numbers) from.require(std::isfinite(value), "a number is not finite");
  for (const Run& run : clip.runs) {
    double slowest = 1, quickest = 1;
    if (run.form.timeline != Form::no_timeline) {
      const std::vector<double>& knots = clip.timelines[run.form.timeline].knots;
      for (std::size_t i = 1; i < knots.size(); ++i) {
        const double length = knots[i] - knots[i - 1];
        slowest = std::max(slowest, length);
        if (length > 0) quickest = std::max(quickest, std::min(1 / length, steepest));
      }
    }
    const bool exact = run.form.fine == Packing::exact;
    std::size_t column = 0;
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
      const Channel& channel = clip.channels[i];
      const std::size_t width = lane_count * run.form.lines(run.form.fine, components(channel.kind));
      double value, tangent = 0;
      if (exact) {
        value = largest_exact(clip, run, column, width);
        if (run.form.cubic) tangent = value;
      } else {
        value = largest_of(clip, run, channel, false);
        if (run.form.cubic) tangent = largest_of(clip, run, channel, true);
      }
      column += width;
      const double far = value + tangent * slowest, fast = value * quickest + tangent;
      // Rotations are squared, and multiplied by their rates.
      const bool fits = channel.kind != Kind::rotation || (far <= 1e15 && far * fast <= 1e36);
      from.require(far <= 1e36 && fast <= 1e36 && fits, "a number is too large");
    }
  }
}

void read_climbs(Reader& from, CompiledClip& clip) {
  const std::size_t climbs = from.count(4 + 6 * 8);
  clip.climbs.resize(climbs);
  for (Climb& climb : clip.climbs) {
    climb.joint = from.number<std::uint32_t>();
    from.require(climb.joint < clip.joints, "there is no such joint");
    for (double& part : climb.gain) part = from.finite();
    for (double& part : climb.turn) part = from.finite();
    for (const double part : climb.gain) from.require(std::abs(part) <= 1e20, "a number is too large");
    for (const double part : climb.turn) from.require(std::abs(part) <= 1e5, "a number is too large");
  }
}

void read(Reader& from, CompiledClip& clip) {
  clip.joints = from.number<std::uint32_t>();
  from.require(clip.joints <= most_joints, "it claims more than fits in the remaining bytes");
  clip.duration = from.finite();
  const auto mode = from.number<std::uint8_t>();
  from.require(mode <= static_cast<std::uint8_t>(LoopMode::pingpong), "there is no such loop");
  clip.loop.mode = static_cast<LoopMode>(mode);
  clip.loop.count = from.finite();
  from.require(clip.duration >= 0 && clip.loop.count >= 0, "a number must not be negative");
  for (double* const error : {&clip.errors.first, &clip.errors.later, &clip.errors.growth}) {
    *error = from.finite();
    from.require(*error >= 0, "a number must not be negative");
  }
  const std::size_t timelines = from.count(4);
  for (std::size_t i = 0; i < timelines; ++i) read_timeline(from, clip.timelines.emplace_back());

  const std::size_t channels = 3 * crowd_groups(clip.joints), runs = from.count(15 + 5);
  from.require(channels <= from.left() / 5, "it claims more than fits in the remaining bytes");
  std::vector<bool> seen(channels);
  std::uint64_t numbers = 0;
  for (std::size_t i = 0; i < runs; ++i) read_run(from, clip, seen, numbers);
  from.require(clip.channels.size() == channels, "some joints have no values");
  from.all(clip.numbers, numbers);
  from.all(clip.words, lay_out(clip));
  require_bounded(from, clip);
  read_climbs(from, clip);
  from.require(from.left() == 0, "it should end");
}

}  // namespace
}  // namespace crowd

std::vector<std::byte> CrowdClip::to_bytes() const {
  crowd::Writer contents;
  crowd::write(contents, *compiled_);
  crowd::Writer all;
  all.bytes.reserve(crowd::header_size + contents.bytes.size());
  for (const char c : crowd::signature) all.number(c);
  all.number(crowd::format_version);
  all.number(static_cast<std::uint64_t>(contents.bytes.size()));
  all.number(crowd::checksum(contents.bytes));
  all.bytes.insert(all.bytes.end(), contents.bytes.begin(), contents.bytes.end());
  return std::move(all.bytes);
}

std::size_t CrowdClip::byte_count() const noexcept {
  const crowd::CompiledClip& clip = *compiled_;
  std::size_t bytes = crowd::header_size + 4 + 8 + 1 + 8 + 24 + 4 + 4 + 4;
  for (const crowd::Timeline& timeline : clip.timelines) bytes += 4 + 8 * timeline.knots.size();
  return bytes + 15 * clip.runs.size() + 5 * clip.channels.size() + 4 * (clip.numbers.size() + clip.words.size()) +
         52 * clip.climbs.size();
}

CrowdClip CrowdClip::from_bytes(std::span<const std::byte> bytes) {
  using namespace crowd;
  if (bytes.size() < header_size)
    refuse("there are " + std::to_string(bytes.size()) + " of them, fewer than a header has");
  for (std::size_t i = 0; i < signature.size(); ++i)
    if (static_cast<char>(bytes[i]) != signature[i]) refuse("they do not begin with \"tweenfall crowd\"");
  Reader header(bytes.subspan(signature.size(), header_size - signature.size()));
  const auto version = header.number<std::uint32_t>();
  if (version != format_version)
    refuse("they are of version " + std::to_string(version) + ", and only version " + std::to_string(format_version) +
           " can be read");
  const auto size = header.number<std::uint64_t>(), sum = header.number<std::uint64_t>();
  const std::span<const std::byte> contents = bytes.subspan(header_size);
  if (contents.size() != size)
    refuse("there should be " + std::to_string(size) + " of them after the header, and there are " +
           std::to_string(contents.size()));
  if (checksum(contents) != sum) refuse("they are damaged: their checksum differs");
  Reader reader(contents);
  auto clip = std::make_shared<CompiledClip>();
  read(reader, *clip);
  return CrowdClip(clip);
}

}  // namespace tweenfall
