#pragma once

/// Walks through a world's state down to its numbers.

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "saving/fields.h"

namespace tweenfall::saving {

using state::ContactMemories;
using state::IgnoredPairs;

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsVariant : std::false_type {};
template <class... T>
struct IsVariant<std::variant<T...>> : std::true_type {};

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t count>
struct IsArray<std::array<T, count>> : std::true_type {};

/// Passes every number to `tool.number(...)`, and what does not consist of fields to `tool.list`, `tool.choice`,
/// `tool.hull` and the like, in a fixed order.
template <class Tool>
class Walk {
 public:
  explicit Walk(Tool& tool) : tool_(tool) {}

  template <class... T>
  void operator()(T&... values) const {
    (one(values), ...);
  }
  /// Places in lists, with the greatest number for none: the same bytes on every platform.
  template <class... T>
  void places(T&... values) const {
    (place(values), ...);
  }
  /// Numbers that are nearly always 0: if all of them are, a hash leaves them out.
  template <class... T>
  void rarely(T&... numbers) const {
    if (tool_.skips_zeros && ((numbers == T{}) && ...)) return;
    (one(numbers), ...);
  }

 private:
  template <class T>
  void place(T& value) const {
    constexpr auto none = static_cast<std::size_t>(-1);
    std::uint64_t word = value == none ? ~std::uint64_t{0} : std::uint64_t{value};
    tool_.number(word);
    if constexpr (!std::is_const_v<T>) value = word >= std::uint64_t{none} ? none : static_cast<std::size_t>(word);
  }
  template <class T>
  void one(T& value) const {
    using Value = std::remove_const_t<T>;
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
      tool_.number(value);
    } else if constexpr (std::is_same_v<Value, Vec3> || std::is_same_v<Value, Mat3>) {
      for (int i = 0; i < static_cast<int>(value.size()); ++i) tool_.number(value.data()[i]);
    } else if constexpr (std::is_same_v<Value, Quat>) {
      for (int i = 0; i < 4; ++i) tool_.number(value.coeffs().data()[i]);
    } else if constexpr (IsVector<Value>::value || std::is_same_v<Value, ContactMemories> ||
                         std::is_same_v<Value, IgnoredPairs>) {
      tool_.list(value);
    } else if constexpr (IsArray<Value>::value) {
      for (auto& element : value) one(element);
    } else if constexpr (IsOptional<Value>::value) {
      bool has = value.has_value();
      tool_.number(has);
      if constexpr (!std::is_const_v<T>) {
        if (has) value.emplace();
        if (!has) value.reset();
      }
      if (has) one(*value);
    } else if constexpr (std::is_same_v<Value, std::shared_ptr<const Makeup>> ||
                         std::is_same_v<Value, std::shared_ptr<const SoftSettings>>) {
      if constexpr (std::is_const_v<T>) {
        one(*value);
      } else {
        const auto read = std::make_shared<std::remove_const_t<typename Value::element_type>>();
        one(*read);
        value = read;
      }
    } else if constexpr (std::is_same_v<Value, state::Boxed<Extra>>) {
      bool has = value.has_value();
      tool_.number(has);
      if constexpr (std::is_const_v<T>) {
        if (has) one(value.value());
      } else {
        if (has) one(value.own());
        if (!has) value.reset();
      }
    } else if constexpr (IsVariant<Value>::value) {
      tool_.choice(value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      tool_.text(value);
    } else if constexpr (std::is_same_v<Value, Color>) {
      for (int i = 0; i < 4; ++i) tool_.number(value.rgba.data()[i]);
    } else if constexpr (std::is_same_v<Value, std::monostate>) {
    } else if constexpr (std::is_same_v<Value, Compound>) {
      tool_.compound(value);
    } else if constexpr (std::is_same_v<Value, ConvexHull>) {
      tool_.hull(value);
    } else if constexpr (std::is_same_v<Value, TriangleMesh>) {
      tool_.mesh(value);
    } else if constexpr (std::is_same_v<Value, HeightField>) {
      tool_.heights(value);
    } else if constexpr (std::is_same_v<Value, Field>) {
      tool_.field(value);
    } else if constexpr (InParts<Value>) {
      if constexpr (std::is_const_v<T>) {
        const auto parts = parts_of(value);
        one(parts);
      } else {
        decltype(parts_of(value)) parts;
        one(parts);
        value = made_of(parts);
      }
    } else {
      each_field(value, *this);
    }
  }

  Tool& tool_;
};

template <class Tool, class T>
void walk(Tool& tool, T& value) {
  Walk<Tool>{tool}(value);
}

/// What all tools have in common that only read the state.
template <class Tool>
class Teller {
 public:
  static constexpr bool skips_zeros = false;
  template <class T>
  void list(const std::vector<T>& values) {
    tool().number(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) walk(tool(), value);
  }
  void list(const ContactMemories& memories) {
    std::uint64_t count = 0;
    const auto is_there = [&](std::uint32_t place) { return !memories[place].is(ContactMemory::gone); };
    for (const std::uint32_t place : memories.sorted()) count += is_there(place) ? 1 : 0;
    tool().number(count);
    for (const std::uint32_t place : memories.sorted()) {
      if (!is_there(place)) continue;
      const WholeContact whole = memories.whole(place);
      walk(tool(), whole);
    }
  }
  void list(const IgnoredPairs& pairs) { list(pairs.all()); }
  void compound(const Compound& compound) {
    tool().number(static_cast<std::uint64_t>(compound.parts().size()));
    for (const Shape& part : compound.parts()) walk(tool(), part);
  }
  template <class... T>
  void choice(const std::variant<T...>& value) {
    tool().number(static_cast<std::uint8_t>(value.index()));
    std::visit([this](const auto& chosen) { walk(tool(), chosen); }, value);
  }

 private:
  Tool& tool() { return static_cast<Tool&>(*this); }
};

}  // namespace tweenfall::saving
