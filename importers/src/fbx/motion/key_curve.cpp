#include "fbx/motion/key_curve.h"

#include "fbx/motion/key_slopes.h"

#include <tweenfall/curves/keys.h>

#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace tweenfall::fbx {

namespace {

/// The four numbers of a key as floats, and the bits of the third. From version 7.2 on text files state the bits.
void set_data(const Record* list, bool bits, std::size_t set, FileKey& key) {
  if (!list) return;
  const Record* inside = list->find("a");
  const std::vector<Value>& values = (inside ? inside : list)->values;
  if (values.empty()) return;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t at = 4 * set + i;
    std::uint32_t packed = 0;
    if (const auto* integers = std::get_if<Integers>(&values[0])) {
      if (at >= integers->size()) return;
      packed = bits ? static_cast<std::uint32_t>((*integers)[at])
                    : std::bit_cast<std::uint32_t>(static_cast<float>((*integers)[at]));
    } else if (const auto* reals = std::get_if<Reals>(&values[0])) {
      if (at >= reals->size()) return;
      packed = std::bit_cast<std::uint32_t>(static_cast<float>((*reals)[at]));
    }
    key.data[i] = std::bit_cast<float>(packed);
    if (i == 2) key.packed_weights = packed;
  }
}

class CurveReader {
 public:
  CurveReader(const Object& curve, const Objects& objects, models::ModelProblems& problems)
      : record_(*curve.record), objects_(objects), problems_(problems) {}

  std::vector<FileKey> keys() {
    const Integers times = record_.integers("KeyTime");
    const Reals values = record_.reals("KeyValueFloat");
    if (times.size() != values.size())
      fail("has " + std::to_string(times.size()) + " times for " + std::to_string(values.size()) + " values");
    std::vector<FileKey> all(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      all[i].time = static_cast<double>(times[i]) / objects_.ticks();
      all[i].value = values[i];
      if (!std::isfinite(values[i])) fail("the value of key " + std::to_string(i) + " is not finite");
    }
    set_attributes(all);
    return in_order(all);
  }

  OutsideRule<double> outside(const char* name) const {
    OutsideRule<double> result;
    const Record* rule = record_.find(name);
    const Record* type = rule ? rule->find("Type") : nullptr;
    if (!type) return result;
    const std::string_view word = type->text(0);
    switch (word.empty() ? type->whole(0, 'C') : word[0]) {
      case 'K':
        result.rule = Outside::linear;
        break;
      case 'R':
        result.rule = Outside::repeat;
        break;
      case 'M':
        result.rule = Outside::pingpong;
        break;
      case 'A':
        result.rule = Outside::repeat_offset;
        break;
      default:
        return result;
    }
    const Record* plays = rule->find("Repetition");
    const std::int64_t count = plays ? plays->whole(0, -1) : -1;
    if (result.rule == Outside::linear || count < 0) return result;
    if (count == 0) return {};
    result.plays = static_cast<double>(count);
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    objects_.source().fail(record_.at, "an animation curve " + what);
  }

  /// Flags and slopes are stored once for each run of keys that share them.
  void set_attributes(std::vector<FileKey>& keys) const {
    const Integers flags = record_.integers("KeyAttrFlags"), counts = record_.integers("KeyAttrRefCount");
    const Record* data = record_.find("KeyAttrDataFloat");
    const bool bits = objects_.source().text() && objects_.version() >= 7200;
    if (flags.size() != counts.size())
      fail("has " + std::to_string(flags.size()) + " kinds of keys for " + std::to_string(counts.size()) + " counts");
    std::size_t at = 0;
    for (std::size_t set = 0; set < flags.size(); ++set) {
      FileKey like;
      like.flags = static_cast<std::uint32_t>(flags[set]);
      set_data(data, bits, set, like);
      for (const float number : {like.data[0], like.data[1]})
        if (!std::isfinite(number)) fail("has a slope that is not finite");
      for (std::int64_t i = 0; i < counts[set] && at < keys.size(); ++i, ++at) {
        like.time = keys[at].time;
        like.value = keys[at].value;
        keys[at] = like;
      }
    }
    if (at < keys.size() && !flags.empty())
      fail("says the kinds of only " + std::to_string(at) + " of its " + std::to_string(keys.size()) + " keys");
  }

  /// Of keys at the same time the last is kept, and keys that go back in time are left out.
  std::vector<FileKey> in_order(const std::vector<FileKey>& keys) const {
    std::vector<FileKey> kept;
    for (const FileKey& key : keys) {
      if (!kept.empty() && key.time == kept.back().time)
        kept.back() = key;
      else if (kept.empty() || key.time > kept.back().time)
        kept.push_back(key);
    }
    if (kept.size() < keys.size())
      problems_.repair(
          objects_.source().place(record_.at),
          "an animation curve has keys out of order; " + std::to_string(keys.size() - kept.size()) + " were left out");
    return kept;
  }

  const Record& record_;
  const Objects& objects_;
  models::ModelProblems& problems_;
};

Tangent<double> tangent(double rate, double weight) {
  return {.kind = TangentKind::given, .rate = rate, .weight = weight};
}

Curve<double> joined(const std::vector<FileKey>& keys, double scale, double tick) {
  const std::vector<KeySlopes> slopes = key_slopes(keys);
  const Ease hold = Ease::hold(), straight = Ease::linear();
  std::vector<Key<double>> all;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const FileKey& key = keys[i];
    const bool last = i + 1 == keys.size();
    Key<double> made{.time = key.time, .value = key.value * scale};
    if (i > 0 && (keys[i - 1].flags & key_cubic) && !(keys[i - 1].flags & key_constant))
      made.in = tangent(slopes[i].in * scale, slopes[i].in_weight);
    if (key.flags & key_constant)
      made.ease = hold;
    else if (!(key.flags & key_cubic))
      made.ease = straight;
    else if (!last)
      made.out = tangent(slopes[i].out * scale, slopes[i].out_weight);
    all.push_back(std::move(made));
    // The next key's value applies from the clock's next tick on; at its own time a key has its own value.
    if (!last && (key.flags & key_constant) && (key.flags & key_constant_next) && keys[i + 1].time > key.time + tick)
      all.push_back({.time = key.time + tick, .value = keys[i + 1].value * scale, .ease = hold});
  }
  const Curve<double> curve = keyed_curve<double>(std::span<const Key<double>>(all));
  if (keys.size() < 2 || !(keys[keys.size() - 2].flags & key_constant)) return curve;
  // The last key's value applies at its own time, where the curve ends.
  std::vector<Span<double>> spans = curve.spans();
  spans.back().end = keys.back().value * scale;
  return Curve<double>(std::span<const Span<double>>(spans));
}

}  // namespace

std::optional<Curve<double>> key_curve(const Object& curve, const Objects& objects, double scale,
                                       models::ModelProblems& problems) {
  CurveReader reader(curve, objects, problems);
  const std::vector<FileKey> keys = reader.keys();
  if (keys.empty()) return std::nullopt;
  try {
    const Curve<double> made = joined(keys, scale, 1 / objects.ticks());
    if (keys.size() < 2) return made;
    return made.with_outside(reader.outside("Pre-Extrapolation"), reader.outside("Post-Extrapolation"));
  } catch (const std::invalid_argument& error) {
    objects.source().fail(curve.record->at, std::string("an animation curve: ") + error.what());
  }
}

}  // namespace tweenfall::fbx
