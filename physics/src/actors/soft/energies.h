#pragma once

#include <vector>

#include "actors/soft/chain_factor.h"
#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

/// The elastic energy of everything of finite stiffness, at the nodes' present positions, J.
[[nodiscard]] double elastic_energy(const SoftBody& body);
[[nodiscard]] double volume_energy(const SoftBody& body);  ///< the part of it from volumes

/// The elastic energy of a soft body at x + h v, plus the loss by damping; its derivative by v; and its
/// second derivative, made definite.
class Energies {
 public:
  Energies(const SoftBody& body, double h) : body_(body), made_(*body.made), h_(h) {}

  /// J; the other functions refer to the velocities of the last call of `at`.
  [[nodiscard]] double at(const std::vector<Vec3>& x, const std::vector<Vec3>& v);
  void add_gradient(std::vector<Vec3>& gradient) const;
  void add_product(const std::vector<Vec3>& change, std::vector<Vec3>& out) const;
  void add_blocks(std::vector<Mat3>& blocks) const;  ///< only those on the diagonal
  void add_all_blocks(ChainFactor& matrix) const;

 private:
  struct Edge {
    std::uint32_t a, b;
    Vec3 normal;         ///< from b to a
    double pull;         ///< N
    double along;        ///< stiffness, N/m
    double across;       ///< against turning it, N/m; >= 0
    Vec3 damped_normal;  ///< at the start
    double damped;       ///< damping times speed, N
    double damping;      ///< N s/m
  };
  struct Bend {
    const SoftBend* bend;
    Vec3 off;
  };
  /// A part whose energy is stiffness / 2 times the square of one number.
  struct Amount {
    double stiffness, off;
    std::vector<std::pair<std::uint32_t, Vec3>> gradients;
  };

  [[nodiscard]] Mat3 block_of(const Edge& edge) const;
  void take_edges(const std::vector<Vec3>& x, const std::vector<Vec3>& v);
  void take_amounts();

  const SoftBody& body_;
  const SoftSettings& made_;
  double h_;
  std::vector<Vec3> p_;
  std::vector<Edge> edges_;
  std::vector<Bend> bends_;
  std::vector<Amount> amounts_;
};

}  // namespace tweenfall::soft
