#pragma once

// Collects the faults of a chain while it is read, to report them all at once.

#include <tweenfall/anim/node_ref.h>

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall::chains {

class Problems {
 public:
  /// @param what the thing checked, such as "two-bone chain"
  explicit Problems(std::string what) : what_(std::move(what)) {}

  void add(const std::string& problem);
  /// Adds the problem unless it `holds`. @returns holds
  bool require(bool holds, const std::string& problem);
  /// The node; if there is none, `no_node`, and a problem with the nearest name is added. @param role  such as "start"
  [[nodiscard]] std::size_t node(const Hierarchy& nodes, const NodeRef& told, const std::string& role);
  void require_finite(const Vec3& v, const std::string& name);
  void require_in(double number, double low, double high, const std::string& name);

  /// The nodes in order, each below the one before. @returns for each its number or `no_node`
  [[nodiscard]] std::vector<std::size_t> chain(const Hierarchy& nodes, std::span<const NodeRef> told);
  /// Adds the problems that `make` throws, each prefixed by `whose`.
  template <class Make>
  void include(const Make& make, const std::string& whose) {
    try {
      make();
    } catch (const std::invalid_argument& fault) {
      add_all(fault.what(), whose);
    }
  }

  [[nodiscard]] bool none() const noexcept { return text_.empty(); }
  /// @throws std::invalid_argument listing them, when there are any.
  void report() const;

 private:
  void add_all(const std::string& lines, const std::string& whose);

  std::string what_, text_;
};

/// A node as shown to people: by its name, if it has one.
[[nodiscard]] std::string called(const Hierarchy& nodes, const NodeRef& told);

/// Bound on lengths and positions: beyond it, squares and results computed from them would overflow.
inline constexpr double largest = 1e15;

/// Whether `node` is below `above`, at any depth, and not the same.
[[nodiscard]] bool is_below(const Hierarchy& nodes, std::size_t node, std::size_t above);

}  // namespace tweenfall::chains
