#pragma once

// Helpers that tests of all modules share: the folders of external numbers, approximate equality, seeded random.

#include <tweenfall/curves/values.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace tweenfall::test {

inline constexpr double pi = std::numbers::pi;

/// Numbers made by other programs: TWEENFALL_VECTORS, or ../shared/vectors.
std::filesystem::path vectors_folder();
/// Real models with oracle poses: TWEENFALL_MODELS, or ../shared/models.
std::filesystem::path models_folder();
/// Scenes of rigid bodies: TWEENFALL_SCENES, or ../shared/scenes.
std::filesystem::path scenes_folder();
/// The few cases of each family that travel with the project.
std::filesystem::path data_folder();

std::string text_of(const std::filesystem::path& file);
nlohmann::json read_json(const std::filesystem::path& file);
/// How often `what` is in `text`.
std::size_t count(const std::string& text, const std::string& what);

/// All files of a vector family: "NAME.json" and "NAME_*.json" in tests/data and in the vectors folder.
/// Says loudly when the vectors folder is absent.
std::vector<nlohmann::json> vector_family(const std::string& name);

/// Three numbers.
Vec3 vec(const nlohmann::json& list);
/// Four numbers from place `at`, the scalar last.
Quat quat(const nlohmann::json& list, std::size_t at = 0);

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
