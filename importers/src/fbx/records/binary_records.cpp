#include "fbx/records/packed_array.h"
#include "fbx/records/records.h"

#include <bit>
#include <cstring>
#include <type_traits>

namespace tweenfall::fbx {

namespace {

constexpr std::string_view magic("Kaydara FBX Binary  \0", 21);
constexpr std::size_t header_bytes = 27;

template <class T>
T plain(const char* from, std::endian order) {
  char bytes[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = from[order == std::endian::native ? i : sizeof(T) - 1 - i];
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

class BinaryReader {
 public:
  explicit BinaryReader(const Source& source) : source_(source), bytes_(source.bytes()) {}

  File read() {
    if (bytes_.size() < header_bytes) source_.fail(bytes_.size(), "the file ends within its header");
    if (bytes_[22] == 1) order_ = std::endian::big;
    File file;
    at_ = 23;
    file.version = number<std::uint32_t>();
    wide_ = file.version >= 7500;
    file.root.name = "file";
    read_list(file.root.children, bytes_.size(), 0);
    return file;
  }

 private:
  template <class T>
  T number() {
    return plain<T>(take(sizeof(T)).data(), order_);
  }

  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - at_)
      source_.fail(
          at_, "needs " + std::to_string(count) + " bytes where " + std::to_string(bytes_.size() - at_) + " are left");
    const std::string_view part = bytes_.substr(at_, count);
    at_ += count;
    return part;
  }

  std::size_t header_number() { return wide_ ? number<std::uint64_t>() : number<std::uint32_t>(); }

  /// Records up to one that is all zero, or to `end`.
  void read_list(std::vector<Record>& into, std::size_t end, std::size_t depth) {
    const std::size_t header = wide_ ? 25 : 13;
    while (end - at_ >= header) {
      const std::size_t begin = at_;
      const std::size_t record_end = header_number(), values = header_number(), value_bytes = header_number();
      const std::string_view name = take(number<std::uint8_t>());
      if (record_end == 0) return;
      if (record_end < at_ || record_end > end)
        source_.fail(begin, "a record says that it ends at byte " + std::to_string(record_end) +
                                ", outside of what holds it, which ends at " + std::to_string(end));
      if (value_bytes > record_end - at_)
        source_.fail(begin, "the values of a record, " + std::to_string(value_bytes) + " bytes, do not fit into it");
      if (depth >= deepest) source_.fail(begin, "records lie more than 64 deep within each other");
      Record record{std::string(name), begin, {}, {}};
      const std::size_t values_end = at_ + value_bytes;
      for (std::size_t i = 0; i < values; ++i) record.values.push_back(read_value(values_end));
      at_ = values_end;
      read_list(record.children, record_end, depth + 1);
      at_ = record_end;
      into.push_back(std::move(record));
    }
  }

  Value read_value(std::size_t end) {
    const std::size_t begin = at_;
    if (at_ >= end) source_.fail(at_, "a record has fewer values than it says");
    Value value;
    switch (const char type = take(1)[0]) {
      case 'C':
      case 'B':
      case 'Z':
        value = std::int64_t{number<std::uint8_t>()};
        break;
      case 'Y':
        value = std::int64_t{number<std::int16_t>()};
        break;
      case 'I':
        value = std::int64_t{number<std::int32_t>()};
        break;
      case 'L':
        value = number<std::int64_t>();
        break;
      case 'F':
        value = static_cast<double>(number<float>());
        break;
      case 'D':
        value = number<double>();
        break;
      case 'S':
      case 'R':
        value = std::string(take(number<std::uint32_t>()));
        break;
      case 'b':
      case 'c':
        value = array<std::uint8_t, Integers>(begin);
        break;
      case 'i':
        value = array<std::int32_t, Integers>(begin);
        break;
      case 'l':
        value = array<std::int64_t, Integers>(begin);
        break;
      case 'f':
        value = array<float, Reals>(begin);
        break;
      case 'd':
        value = array<double, Reals>(begin);
        break;
      default:
        source_.fail(begin, "a value is of an unknown type, " + std::to_string(static_cast<unsigned char>(type)));
    }
    if (at_ > end) source_.fail(begin, "a value does not fit into its record");
    return value;
  }

  template <class T, class List>
  List array(std::size_t begin) {
    PackedArray stored;
    stored.at = begin;
    stored.count = number<std::uint32_t>();
    stored.size = sizeof(T);
    const auto encoding = number<std::uint32_t>();
    const auto length = number<std::uint32_t>();
    if (encoding > 1) source_.fail(begin, "an array is packed in an unknown way, " + std::to_string(encoding));
    stored.packed = encoding == 1;
    stored.stored = take(stored.packed ? length : std::size_t{stored.count} * sizeof(T));
    const std::string bytes = unpacked(stored, source_);
    List list(stored.count);
    for (std::size_t i = 0; i < stored.count; ++i)
      list[i] = static_cast<typename List::value_type>(plain<T>(bytes.data() + i * sizeof(T), order_));
    return list;
  }

  const Source& source_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool wide_ = false;
  std::endian order_ = std::endian::little;
};

}  // namespace

bool is_binary(std::string_view bytes) noexcept {
  return bytes.starts_with(magic);
}

File read_binary_records(const Source& source) {
  return BinaryReader(source).read();
}

File read_records(const Source& source) {
  return source.text() ? read_text_records(source) : read_binary_records(source);
}

}  // namespace tweenfall::fbx
