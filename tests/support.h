#pragma once

// Helpers that tests of all modules share: the folders of external numbers, approximate equality, seeded random.

#include <tweenfall/curves/values.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace tweenfall::test {

namespace detail {
inline std::filesystem::path folder(const char* variable, const char* fallback) {
  const char* given = std::getenv(variable);
  return given && *given ? std::filesystem::path(given) : std::filesystem::path(TWEENFALL_SOURCE_DIR) / fallback;
}
}  // namespace detail

/// Numbers made by other programs: TWEENFALL_VECTORS, or ../shared/vectors.
inline std::filesystem::path vectors_folder() {
  return detail::folder("TWEENFALL_VECTORS", "../shared/vectors");
}
/// Real models with oracle poses: TWEENFALL_MODELS, or ../shared/models.
inline std::filesystem::path models_folder() {
  return detail::folder("TWEENFALL_MODELS", "../shared/models");
}
/// The few cases of each family that travel with the project.
inline std::filesystem::path data_folder() {
  return std::filesystem::path(TWEENFALL_SOURCE_DIR) / "tests/data";
}

inline nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  REQUIRE_MESSAGE(stream.good(), "cannot read " << file.string());
  return nlohmann::json::parse(stream);
}

/// All files of a vector family: "NAME.json" and "NAME_*.json" in tests/data and in the vectors folder.
/// Says loudly when the vectors folder is absent.
inline std::vector<nlohmann::json> vector_family(const std::string& name) {
  std::vector<nlohmann::json> files;
  for (const auto& folder : {data_folder() / "vectors", vectors_folder()}) {
    if (!std::filesystem::is_directory(folder)) {
      MESSAGE("SKIPPED: vectors of family " << name << ", no folder " << folder.string());
      continue;
    }
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".json") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    for (const auto& path : found) {
      auto content = read_json(path);
      if (content.is_object() && content.value("family", "") == name) files.push_back(std::move(content));
    }
  }
  CHECK_MESSAGE(!files.empty(), "no file of vector family " << name << " anywhere");
  return files;
}

/// Equal within `tolerance` of the larger of 1 and the expected magnitude.
inline bool near(double actual, double expected, double tolerance) {
  return std::abs(actual - expected) <= tolerance * std::max(1.0, std::abs(expected));
}

template <class A, class B>
bool near(const Eigen::MatrixBase<A>& actual, const Eigen::MatrixBase<B>& expected, double tolerance) {
  return (actual - expected).cwiseAbs().maxCoeff() <= tolerance * std::max(1.0, expected.cwiseAbs().maxCoeff());
}

/// Equal as rotations: up to sign.
inline bool near(const Quat& actual, const Quat& expected, double tolerance) {
  return std::min((actual.coeffs() - expected.coeffs()).cwiseAbs().maxCoeff(),
                  (actual.coeffs() + expected.coeffs()).cwiseAbs().maxCoeff()) <= tolerance;
}

/// The same numbers on every machine: splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  ///< in [0, 1)
  double between(double low, double high) { return low + (high - low) * unit(); }
  Vec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  Quat rotation() {
    // Braces, for the arguments of a call in parentheses are taken in an order of the compiler's choice.
    Quat q{between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
    if (q.norm() < 0.1) return rotation();
    q.normalize();
    return q;
  }

 private:
  std::uint64_t state_;
};

}  // namespace tweenfall::test
