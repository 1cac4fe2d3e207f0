#pragma once

#include <vector>

#include "actors/soft/chain_factor.h"
#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

/// The elastic energy of all that is of finite stiffness, as the nodes are, J.
[[nodiscard]] double elastic_energy(const SoftBody& body);
[[nodiscard]] double volume_energy(const SoftBody& body);  ///< its part of that

/// The elastic energy of what a soft body is made of, at x + h v, with what damping takes; its derivative by v; and its
/// second derivative, made definite.
class Energies {
 public:
  Energies(const SoftBody& body, double h) : body_(body), made_(*body.made), h_(h) {}

  /// J; the other functions are about the velocities that `at` was last asked for.
  [[nodiscard]] double at(const std::vector<Vec3>& x, const std::vector<Vec3>& v);
  void add_gradient(std::vector<Vec3>& gradient) const;
  void add_product(const std::vector<Vec3>& change, std::vector<Vec3>& out) const;
  void add_blocks(std::vector<Mat3>& blocks) const;  ///< those on the diagonal alone
  void add_all_blocks(ChainFactor& matrix) const;

 private:
  struct Edge {
    std::uint32_t a, b;
    Vec3 normal;         ///< from b to a
    double pull;         ///< N
    double along;        ///< stiffness, N/m
    double across;       ///< of turning it, N/m; >= 0
    Vec3 damped_normal;  ///< at the start
    double damped;       ///< damping times speed, N
    double damping;      ///< N s/m
  };
  struct Bend {
    const SoftBend* bend;
    Vec3 off;
  };
  /// Something whose energy is stiffness / 2 times the square of one number.
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
