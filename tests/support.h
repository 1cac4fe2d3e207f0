#pragma once

// Helpers that tests of all modules share: the folders of external numbers, approximate equality, seeded random.

#include "random.h"

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

// Compiled once, in support.cpp: compiled with every test that uses it, it took a tenth of the tests' compile time.
extern template class nlohmann::basic_json<>;

namespace tweenfall::test {

using std::numbers::pi;

/// Numbers made by other programs: TWEENFALL_VECTORS, or ../shared/vectors.
std::filesystem::path vectors_folder();
/// Real models with oracle poses: TWEENFALL_MODELS, or ../shared/models.
std::filesystem::path models_folder();
/// Scenes of rigid bodies: TWEENFALL_SCENES, or ../shared/scenes.
std::filesystem::path scenes_folder();
/// The few cases of each family that are part of the project.
std::filesystem::path data_folder();

std::string text_of(const std::filesystem::path& file);
nlohmann::json read_json(const std::filesystem::path& file);
/// How often `what` occurs in `text`.
std::size_t count(const std::string& text, const std::string& what);

/// All files of a vector family: "NAME.json" and "NAME_*.json" in tests/data and in the vectors folder.
/// Reports loudly when the vectors folder is absent.
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

}  // namespace tweenfall::test
