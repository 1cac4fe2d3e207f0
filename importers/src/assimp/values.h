#pragma once

// Converts assimp's value types to ours. Templates, so that assimp's headers stay in the sources that read scenes.

#include <tweenfall/curves/values.h>
#include <tweenfall/importers/shown_text.h>

#include <string>

namespace tweenfall::assimp {

template <class AssimpVector>
Vec3 vector_of(const AssimpVector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

template <class AssimpQuaternion>
Quat quaternion_of(const AssimpQuaternion& q) {
  return Quat(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z));
}

template <class AssimpMatrix>
Mat3 linear_of(const AssimpMatrix& m) {
  Mat3 out;
  for (unsigned row = 0; row < 3; ++row)
    for (unsigned column = 0; column < 3; ++column)
      out(static_cast<int>(row), static_cast<int>(column)) = static_cast<double>(m[row][column]);
  return out;
}

template <class AssimpMatrix>
Vec3 translation_of(const AssimpMatrix& m) {
  return {static_cast<double>(m.a4), static_cast<double>(m.b4), static_cast<double>(m.c4)};
}

template <class AssimpString>
std::string text_of(const AssimpString& text) {
  return utf8_or_latin1(text.C_Str());
}

}  // namespace tweenfall::assimp
