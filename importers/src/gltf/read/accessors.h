#pragma once

// Accessors: typed lists of numbers in the buffers, decoded and checked.

#include "gltf/read/container.h"

#include <initializer_list>
#include <optional>

namespace tweenfall::gltf {

/// The kind of numbers expected from an accessor.
enum class Wanted {
  reals,    ///< floats, or integers with "normalized"
  any,      ///< the same, or plain integers
  indices,  ///< unsigned integers
  spare,    ///< reals that are left out, with a repair, where one is not finite
};

struct Decoded {
  std::size_t count = 0;  ///< elements
  std::size_t parts = 1;  ///< numbers in each
  std::vector<double> numbers;

  [[nodiscard]] const double* at(std::size_t element) const { return numbers.data() + element * parts; }
};

class Accessors {
 public:
  Accessors(const Container& container, models::ModelProblems& problems);

  [[nodiscard]] std::size_t size() const { return count_; }

  /// The accessor's numbers, all finite; empty after a problem.
  /// @param user place of the reference to it
  /// @param types  the allowed ones of "SCALAR", "VEC2", "VEC3", "VEC4", "MAT4"
  [[nodiscard]] std::optional<Decoded> read(std::size_t accessor, const std::string& user,
                                            std::initializer_list<const char*> types, Wanted wanted);

 private:
  struct Source;
  std::optional<Source> source(const Fields& fields, const char* offset_name, std::size_t count,
                               std::size_t element_size) const;
  bool afford(const Fields& accessor, std::size_t numbers);
  bool decode_sparse(const Fields& accessor, int component, bool normalized, Decoded& decoded);

  const Container& container_;
  models::ModelProblems& problems_;
  Fields root_;
  std::size_t count_;
  std::size_t budget_;  ///< numbers that may still be decoded
};

}  // namespace tweenfall::gltf
