#pragma once

/// A node of a hierarchy, given by its name or by its number.

#include <tweenfall/anim/hierarchy.h>

#include <concepts>
#include <optional>
#include <string>
#include <string_view>

namespace tweenfall {

class NodeRef {
 public:
  NodeRef(std::string_view name) : name_(name) {}
  NodeRef(const std::string& name) : name_(name) {}
  NodeRef(const char* name) : name_(name) {}
  template <std::integral Number>
  NodeRef(Number index) : index_(static_cast<std::size_t>(index)), by_number_(true) {}

  /// Its number; empty when the hierarchy has no such node.
  [[nodiscard]] std::optional<std::size_t> in(const Hierarchy& nodes) const;

  /// Its name or number, for messages.
  [[nodiscard]] std::string text() const;

 private:
  std::string name_;
  std::size_t index_ = no_node;
  bool by_number_ = false;
};

}  // namespace tweenfall
