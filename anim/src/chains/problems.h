#pragma once

// Collects the faults of a chain while it is read, to report them all at once.

#include <tweenfall/anim/node_ref.h>

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall::chains {

/// Where in what a chain is made of, by the words of documents, the outermost first: {"joints", "2"}.
using Member = std::vector<std::string>;

struct Problem {
  Member member;  ///< empty: all of it
  std::string text;
};

/// All problems of a chain, as one text and each at its member.
class Unfit : public std::invalid_argument {
 public:
  explicit Unfit(std::vector<Problem> problems);
  /// As one text below a heading, indented.
  Unfit(const std::string& heading, std::vector<Problem> problems);
  [[nodiscard]] std::span<const Problem> problems() const noexcept { return *problems_; }

 private:
  std::shared_ptr<const std::vector<Problem>> problems_;  // copying what is thrown must not throw
};

class Problems {
 public:
  /// @param what the thing checked, such as "two-bone chain"
  explicit Problems(std::string what) : what_(std::move(what)) {}

  /// What is added next is wrong at this member.
  Problems& at(Member member) {
    member_ = std::move(member);
    return *this;
  }
  void add(const std::string& problem);
  /// Adds the problem unless it `holds`. @returns holds
  bool require(bool holds, const std::string& problem);
  /// The node; if there is none, `no_node`, and a problem with the nearest name is added. @param role  such as "start"
  [[nodiscard]] std::size_t node(const Hierarchy& nodes, const NodeRef& told, const std::string& role);
  void require_finite(const Vec3& v, const std::string& name);
  void require_in(double number, double low, double high, const std::string& name);

  /// The nodes in order, each below the one before, which are its "joints". @returns of each its number or `no_node`
  [[nodiscard]] std::vector<std::size_t> chain(const Hierarchy& nodes, std::span<const NodeRef> told);
  /// The problems of a part that `make` throws, each behind `whose`, at a member of this one.
  template <class Make>
  void include(const Make& make, const std::string& whose) {
    try {
      make();
    } catch (const Unfit& part) {
      add_all(part.problems(), whose);
    }
  }

  [[nodiscard]] bool none() const noexcept { return problems_.empty(); }
  /// @throws Unfit listing them, when there are any.
  void report() const;

 private:
  void add_all(std::span<const Problem> problems, const std::string& whose);

  std::string what_;
  Member member_;
  std::vector<Problem> problems_;
};

/// A node as shown to people: by its name, if it has one.
[[nodiscard]] std::string called(const Hierarchy& nodes, const NodeRef& told);

/// Bound on lengths and positions: beyond it, squares and results computed from them would overflow.
inline constexpr double largest = 1e15;

/// Whether `node` is below `above`, at any depth, and not the same.
[[nodiscard]] bool is_below(const Hierarchy& nodes, std::size_t node, std::size_t above);

}  // namespace tweenfall::chains
