#include <tweenfall/anim/crowd_skin.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "crowd/compiled_clip.h"
#include "crowd/skin_kernels.h"

namespace tweenfall {

namespace crowd {
namespace {

constexpr std::size_t influences_of_row = 4;
/// The matrices are addressed by byte offsets of 32 bits.
constexpr std::size_t palette_limit = 0xffffffff / sizeof(CrowdMatrix);

void refuse_skin(const std::string& problems) {
  if (!problems.empty()) throw std::invalid_argument("a mesh cannot be skinned in a crowd:" + problems);
}

std::string wrong_influences(const Mesh& mesh, std::size_t joints) {
  std::string problems;
  for (std::size_t vertex = 0; vertex < mesh.influences.size(); ++vertex)
    for (const Influence& influence : mesh.influences[vertex]) {
      if (influence.joint >= joints)
        problems += "\n  vertex " + std::to_string(vertex) + " follows joint " + std::to_string(influence.joint) +
                    " of " + std::to_string(joints);
      if (!std::isfinite(influence.weight))
        problems += "\n  a weight of vertex " + std::to_string(vertex) + " is not finite";
    }
  return problems;
}

std::string wrong_vectors(const std::vector<Vec3>& vectors, const char* what) {
  std::string problems;
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if (!std::isfinite(vectors[i].squaredNorm()))
      problems += "\n  the " + std::string(what) + " of vertex " + std::to_string(i) + " is not finite";
  return problems;
}

/// One row of four influences; unused places of the last row have the weight 0.
CrowdMesh::Influence4 row_of(std::span<const Influence> influences, std::size_t begin) {
  CrowdMesh::Influence4 row{};
  for (std::size_t i = 0; i < influences_of_row && begin + i < influences.size(); ++i) {
    row.offset[i] = influences[begin + i].joint * static_cast<std::uint32_t>(sizeof(CrowdMatrix));
    row.weight[i] = static_cast<float>(influences[begin + i].weight);
  }
  return row;
}

}  // namespace
}  // namespace crowd

CrowdSkin::CrowdSkin(const Skin& skin) {
  std::string problems;
  if (skin.joints.size() != skin.inverse_binds.size())
    problems += "\n  there are " + std::to_string(skin.joints.size()) + " joints and " +
                std::to_string(skin.inverse_binds.size()) + " inverse binds";
  joints_.reserve(skin.joints.size());
  for (const std::size_t joint : skin.joints) joints_.push_back(static_cast<std::uint32_t>(joint));
  inverse_binds_.reserve(skin.inverse_binds.size());
  for (std::size_t i = 0; i < skin.inverse_binds.size(); ++i) {
    const Skin::InverseBind& bind = skin.inverse_binds[i];
    if (!std::isfinite(bind.linear.squaredNorm() + bind.translation.squaredNorm()))
      problems += "\n  inverse bind " + std::to_string(i) + " is not finite";
    CrowdMatrix& matrix = inverse_binds_.emplace_back();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) matrix.row[r][c] = static_cast<float>(bind.linear(r, c));
      matrix.row[r][3] = static_cast<float>(bind.translation[r]);
    }
  }
  crowd::refuse_skin(problems);
}

void CrowdSkin::palette(std::span<const CrowdMatrix> world, std::span<CrowdMatrix> palette) const noexcept {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const CrowdMatrix &above = world[joints_[i]], &bind = inverse_binds_[i];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c)
        palette[i].row[r][c] = (above.row[r][0] * bind.row[0][c] + above.row[r][1] * bind.row[1][c]) +
                               (above.row[r][2] * bind.row[2][c] + (c == 3 ? above.row[r][3] : 0.0F));
  }
}

CrowdMesh::CrowdMesh(const Mesh& mesh, std::size_t joints)
    : vertices_(mesh.positions.size()), has_normals_(!mesh.normals.empty()) {
  std::string problems;
  if (mesh.influences.size() != vertices_)
    problems += "\n  it has " + std::to_string(vertices_) + " vertices, and influences of " +
                std::to_string(mesh.influences.size());
  if (has_normals_ && mesh.normals.size() != vertices_)
    problems +=
        "\n  it has " + std::to_string(vertices_) + " vertices, and normals of " + std::to_string(mesh.normals.size());
  if (vertices_ > 0 && joints == 0) problems += "\n  there are no joints";
  if (joints > crowd::palette_limit)
    problems += "\n  there are " + std::to_string(joints) + " joints; at most " + std::to_string(crowd::palette_limit) +
                " can be told apart";
  problems += crowd::wrong_influences(mesh, joints) + crowd::wrong_vectors(mesh.positions, "position") +
              crowd::wrong_vectors(mesh.normals, "normal");
  crowd::refuse_skin(problems);

  const std::size_t lanes = crowd::lane_count, block_count = (vertices_ + lanes - 1) / lanes;
  blocks_.resize(block_count, Block{});
  influences_.resize(block_count * lanes, Influence4{});
  for (std::size_t vertex = 0; vertex < vertices_; ++vertex) {
    auto& numbers = blocks_[vertex / lanes].numbers;
    for (int c = 0; c < 3; ++c) {
      numbers[c][vertex % lanes] = static_cast<float>(mesh.positions[vertex][c]);
      if (has_normals_) numbers[3 + c][vertex % lanes] = static_cast<float>(mesh.normals[vertex][c]);
    }
    influences_[vertex] = crowd::row_of(mesh.influences[vertex], 0);
  }
  if (mesh.influences.most() <= crowd::influences_of_row) return;
  more_.reserve(influences_.size() + 1);
  for (std::size_t vertex = 0; vertex < influences_.size(); ++vertex) {
    more_.push_back(static_cast<std::uint32_t>(more_influences_.size()));
    if (vertex >= vertices_) continue;
    const std::span<const Influence> all = mesh.influences[vertex];
    for (std::size_t i = crowd::influences_of_row; i < all.size(); i += crowd::influences_of_row)
      more_influences_.push_back(crowd::row_of(all, i));
  }
  more_.push_back(static_cast<std::uint32_t>(more_influences_.size()));
}

void CrowdMesh::skin(std::span<const CrowdMatrix> palette, std::span<CrowdPoint> positions,
                     std::span<CrowdPoint> normals) const noexcept {
  skin_with(crowd::fastest_skin_kernels(), palette, positions, normals);
}

void CrowdMesh::skin_with(const crowd::SkinKernels& kernels, std::span<const CrowdMatrix> palette,
                          std::span<CrowdPoint> positions, std::span<CrowdPoint> normals) const noexcept {
  for (std::size_t part = 0; part < parts(); ++part) skin_part_with(kernels, part, palette, positions, normals);
}

void CrowdMesh::skin_part(std::size_t part, std::span<const CrowdMatrix> palette, std::span<CrowdPoint> positions,
                          std::span<CrowdPoint> normals) const noexcept {
  skin_part_with(crowd::fastest_skin_kernels(), part, palette, positions, normals);
}

void CrowdMesh::skin_part_with(const crowd::SkinKernels& kernels, std::size_t part,
                               std::span<const CrowdMatrix> palette, std::span<CrowdPoint> positions,
                               std::span<CrowdPoint> normals) const noexcept {
  const std::size_t first = part * part_size;
  const bool with_normals = has_normals_ && !normals.empty();
  kernels.skin({.blocks = blocks_.data() + first / crowd::lane_count,
                .influences = influences_.data() + first,
                .more = more_.empty() ? nullptr : more_.data() + first,
                .more_influences = more_influences_.data(),
                .palette = palette.data(),
                .positions = positions.data() + first,
                .normals = with_normals ? normals.data() + first : nullptr,
                .vertices = std::min(part_size, vertices_ - first)});
}

}  // namespace tweenfall
