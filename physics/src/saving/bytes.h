#pragma once

/// A world's state as bytes: little-endian, every number in its own width, in the order of `each_field`.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "saving/walk.h"

namespace tweenfall::saving {

/// The unsigned integer in which a number is written.
template <class T>
using Word = std::conditional_t<sizeof(T) == 1, std::uint8_t,
                                std::conditional_t<sizeof(T) == 2, std::uint16_t,
                                                   std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

template <class T>
[[nodiscard]] Word<T> word_of(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return std::bit_cast<Word<T>>(value);
  else
    return static_cast<Word<T>>(value);
}

/// The number of an enumeration's last value, up to which bytes are checked; -1: whoever reads checks them.
template <class Enumeration>
inline constexpr int last_of = -1;

class ByteWriter : public Teller<ByteWriter> {
 public:
  template <class T>
  void number(const T& value) {
    const Word<T> word = word_of(value);
    for (std::size_t i = 0; i < sizeof(word); ++i) bytes.push_back(static_cast<std::byte>(word >> (8 * i) & 0xff));
  }
  void text(const std::string& text) {
    number(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) number(c);
  }
  /// A shared hull is only written the first time; afterwards its number. Likewise meshes and height fields.
  void hull(const ConvexHull& hull);
  void mesh(const TriangleMesh& mesh);
  void heights(const HeightField& field);
  /// @throws std::invalid_argument
  [[noreturn]] void field(const Field&);

  std::vector<std::byte> bytes;

 private:
  /// Whether it has been written before; then its number is written.
  bool known(std::unordered_map<const void*, std::uint32_t>& all, const void* data);

  std::unordered_map<const void*, std::uint32_t> hulls_, meshes_, fields_;
};

/// All functions throw std::invalid_argument when the bytes are too few or their contents are impossible.
class ByteReader {
 public:
  static constexpr bool skips_zeros = false;
  /// @param kind  of what was saved, for messages
  ByteReader(std::span<const std::byte> bytes, const char* kind) : bytes_(bytes), kind_(kind) {}

  template <class T>
  void number(T& value) {
    Word<T> word = 0;
    require(bytes_.size() - place_ >= sizeof(word), "it ends too early");
    for (std::size_t i = 0; i < sizeof(word); ++i)
      word = static_cast<Word<T>>(word | static_cast<Word<T>>(bytes_[place_ + i]) << (8 * i));
    if constexpr (std::is_same_v<T, bool>) require(word <= 1, "this should be 0 or 1");
    if constexpr (std::is_enum_v<T>)
      if constexpr (last_of<T> >= 0) require(word <= static_cast<Word<T>>(last_of<T>), "there is no such value");
    place_ += sizeof(word);
    if constexpr (std::is_floating_point_v<T>)
      value = std::bit_cast<T>(word);
    else
      value = static_cast<T>(word);
  }
  template <class T>
  void list(std::vector<T>& values) {
    values.clear();
    // One by one: a wrong count meets the end of the bytes before it takes much memory.
    for (std::uint64_t left = count(); left > 0; --left) walk(*this, values.emplace_back());
  }
  void list(ContactMemories& memories) {
    std::vector<WholeContact> all;
    list(all);
    memories = ContactMemories(all);
  }
  void list(IgnoredPairs& pairs) {
    std::vector<IgnoredPairs::Entry> all;
    list(all);
    pairs = IgnoredPairs(std::move(all));
  }
  void text(std::string& text) {
    text.clear();
    for (std::uint64_t left = count(); left > 0; --left) number((text += char{}).back());
  }
  template <class... T>
  void choice(std::variant<T...>& value) {
    std::uint8_t index = 0;
    number(index);
    std::size_t kind = 0;
    bool found = false;
    const auto try_kind = [&](auto make) {
      if (kind++ != index) return;
      found = true;
      make();
    };
    (try_kind([&] { read_as<T>(value); }), ...);
    require(found, "there is no such kind");
  }
  [[noreturn]] void field(Field&);

  /// @throws std::invalid_argument saying where in the bytes that is
  void require(bool holds, const char* what) const;
  [[nodiscard]] std::size_t place() const { return place_; }
  [[nodiscard]] bool at_end() const { return place_ == bytes_.size(); }

 private:
  /// Of elements that take at least one byte each.
  std::uint64_t count();
  template <class T, class Variant>
  void read_as(Variant& value) {
    if constexpr (std::is_same_v<T, Hull>)
      value = read_hull();
    else if constexpr (std::is_same_v<T, Compound>)
      value = read_compound();
    else if constexpr (std::is_same_v<T, TriangleMesh>)
      value = read_mesh();
    else if constexpr (std::is_same_v<T, HeightField>)
      value = read_heights();
    else
      walk(*this, value.template emplace<T>());
  }
  [[nodiscard]] Hull read_hull();
  [[nodiscard]] Compound read_compound();
  [[nodiscard]] TriangleMesh read_mesh();
  [[nodiscard]] HeightField read_heights();

  std::span<const std::byte> bytes_;
  const char* kind_;
  std::size_t place_ = 0;
  std::vector<ConvexHull> hulls_;
  std::vector<TriangleMesh> meshes_;
  std::vector<HeightField> fields_;
  bool in_compound_ = false;
};

}  // namespace tweenfall::saving
