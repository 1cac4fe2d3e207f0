#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <type_traits>

#include "saving/walk.h"
#include "saving/word_hash.h"

namespace tweenfall::saving {

/// Mixes all numbers that it gets into one.
class StateHash : public Teller<StateHash> {
 public:
  static constexpr bool skips_zeros = true;
  template <class T>
  void number(const T& value) {
    if constexpr (std::is_same_v<T, double>)
      hash_.add(std::bit_cast<std::uint64_t>(value));
    else
      hash_.add(static_cast<std::uint64_t>(value));
  }
  void text(const std::string& text) {
    number(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) number(c);
  }
  void hull(const ConvexHull& hull) {
    for (const Vec3& vertex : hull.vertices()) walk(*this, vertex);
    for (const ConvexHull::Face& face : hull.faces())
      for (const std::uint32_t corner : hull.corners(face)) number(corner);
  }
  void mesh(const TriangleMesh& mesh) {
    for (const Vec3& vertex : mesh.vertices()) walk(*this, vertex);
    for (const std::uint32_t corner : mesh.triangles()) number(corner);
  }
  void heights(const HeightField& field) {
    number(static_cast<std::uint64_t>(field.columns()));
    number(field.spacing_x());
    number(field.spacing_z());
    for (const double height : field.heights()) number(height);
  }
  void field(const Field&) {}
  [[nodiscard]] std::uint64_t value() const { return hash_.value(); }

 private:
  WordHash hash_;
};

}  // namespace tweenfall::saving
