#include "actors/soft/chains.h"

#include <array>
#include <utility>

namespace tweenfall::soft {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

class Links {
 public:
  explicit Links(const SoftBody& body) : made_(*body.made), of_(body.positions.size(), {none, none}) {
    for (std::uint32_t i = 0; i < made_.edges.size() && sound_; ++i) {
      if (body.torn[i] != 0) continue;
      note(made_.edges[i].a, i);
      note(made_.edges[i].b, i);
    }
    seen_.assign(made_.edges.size(), 0);
  }
  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] std::size_t nodes() const { return of_.size(); }
  [[nodiscard]] bool ends_at(std::uint32_t node) const { return of_[node][0] != none && of_[node][1] == none; }
  /// An edge that is in no chain yet; none if all are.
  [[nodiscard]] std::uint32_t left_at(std::uint32_t node) const {
    for (const std::uint32_t edge : of_[node])
      if (edge != none && seen_[edge] == 0) return edge;
    return none;
  }
  /// The chain of all remaining edges, starting at a node.
  [[nodiscard]] Chain from(std::uint32_t node) {
    Chain chain;
    chain.nodes.push_back(node);
    for (std::uint32_t edge = left_at(node); edge != none; edge = left_at(node)) {
      seen_[edge] = 1;
      node = made_.edges[edge].a == node ? made_.edges[edge].b : made_.edges[edge].a;
      chain.edges.push_back(edge);
      chain.nodes.push_back(node);
    }
    return chain;
  }

 private:
  void note(std::uint32_t node, std::uint32_t edge) {
    std::array<std::uint32_t, 2>& its = of_[node];
    if (its[0] == none)
      its[0] = edge;
    else if (its[1] == none)
      its[1] = edge;
    else
      sound_ = false;
  }

  const SoftSettings& made_;
  std::vector<std::array<std::uint32_t, 2>> of_;  ///< edges by node
  std::vector<char> seen_;
  bool sound_ = true;
};

}  // namespace

std::vector<Chain> chains_of(const SoftBody& body) {
  Links links(body);
  std::vector<Chain> chains;
  if (!links.sound()) return chains;
  for (std::uint32_t node = 0; node < links.nodes(); ++node)
    if (links.ends_at(node) && links.left_at(node) != none) chains.push_back(links.from(node));
  // Only rings are left.
  for (std::uint32_t node = 0; node < links.nodes(); ++node) {
    if (links.left_at(node) == none) continue;
    Chain ring = links.from(node), last;
    last.edges = {ring.edges.back()};
    last.nodes = {ring.nodes[ring.nodes.size() - 2], ring.nodes.back()};
    ring.edges.pop_back();
    ring.nodes.pop_back();
    chains.push_back(std::move(ring));
    chains.push_back(std::move(last));
  }
  return chains;
}

const std::vector<Chain>& KeptChains::of(const SoftBody& body) {
  if (made_ != body.made || torn_ != body.torn) {
    chains_ = chains_of(body);
    made_ = body.made;
    torn_ = body.torn;
  }
  return chains_;
}

void solve_three_diagonals(std::vector<double>& diagonal, const std::vector<double>& beside,
                           std::vector<double>& values) {
  const std::size_t count = values.size();
  const auto over = [&diagonal](double value, std::size_t i) { return diagonal[i] > 0 ? value / diagonal[i] : 0; };
  for (std::size_t i = 1; i < count; ++i) {
    const double part = over(beside[i], i - 1);
    diagonal[i] -= part * beside[i];
    values[i] -= part * values[i - 1];
  }
  for (std::size_t i = count; i-- > 0;)
    values[i] = over(i + 1 < count ? values[i] - beside[i + 1] * values[i + 1] : values[i], i);
}

}  // namespace tweenfall::soft
