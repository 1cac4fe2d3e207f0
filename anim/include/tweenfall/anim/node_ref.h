#pragma once

/// A node of a hierarchy, told by its name or by its number.

#include <tweenfall/anim/hierarchy.h>

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace tweenfall {

class NodeRef {
 public:
  NodeRef(std::string_view name) : told_(std::string(name)) {}
  NodeRef(const std::string& name) : told_(name) {}
  NodeRef(const char* name) : told_(std::string(name)) {}
  template <std::integral Number>
  NodeRef(Number index) : told_(static_cast<std::size_t>(index)) {}

  /// Its number; nothing when the hierarchy has no such node.
  [[nodiscard]] std::optional<std::size_t> in(const Hierarchy& nodes) const;

  /// Its name or number, for messages.
  [[nodiscard]] std::string text() const;

 private:
  std::variant<std::string, std::size_t> told_;
};

}  // namespace tweenfall
