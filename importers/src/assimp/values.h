#pragma once

// assimp's value types as ours.

#include <tweenfall/curves/values.h>

#include <assimp/types.h>

#include <string>

namespace tweenfall {

inline Vec3 vector_of(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Quat quaternion_of(const aiQuaternion& q) {
  return Quat(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z));
}

inline Mat3 linear_of(const aiMatrix4x4& m) {
  Mat3 out;
  for (unsigned row = 0; row < 3; ++row)
    for (unsigned column = 0; column < 3; ++column)
      out(static_cast<int>(row), static_cast<int>(column)) = static_cast<double>(m[row][column]);
  return out;
}

inline Vec3 translation_of(const aiMatrix4x4& m) {
  return {static_cast<double>(m.a4), static_cast<double>(m.b4), static_cast<double>(m.c4)};
}

inline std::string text_of(const aiString& text) {
  return std::string(text.C_Str());
}

}  // namespace tweenfall
