#include "recording/meshes/dressed.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <string>
#include <utility>

namespace tweenfall::recordings {

namespace {

constexpr std::size_t around = 8;                // corners of a tube
constexpr std::size_t most_targets = 400;        // of a mesh
constexpr std::size_t most_vectors = 1'500'000;  // of all its targets

struct SoftSurface {
  std::vector<Vec3> positions, normals;
};

/// One soft body, frame by frame.
class SoftSkin {
 public:
  SoftSkin(const SoftRecord& record, const SoftDescription& described) : record_(record), soft_(described.soft) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edges;
    for (std::size_t i = 0; i < soft_.edges.size(); ++i)
      edges.emplace(std::minmax(soft_.edges[i].a, soft_.edges[i].b), i);
    corner_of_.assign(soft_.positions.size(), none);
    for (const auto& triangle : soft_.triangles) add_triangle(triangle, edges);
  }

  [[nodiscard]] std::vector<std::uint32_t> triangles() const {
    if (!soft_.triangles.empty()) return triangles_;
    std::vector<std::uint32_t> tube;
    for (std::uint32_t edge = 0; edge < soft_.edges.size(); ++edge)
      for (std::uint32_t k = 0; k < around; ++k) {
        const auto size = static_cast<std::uint32_t>(around);
        const std::uint32_t first = 2 * edge * size, next = (k + 1) % size;
        tube.insert(tube.end(), {first + k, first + next, first + size + k});
        tube.insert(tube.end(), {first + size + k, first + next, first + size + next});
      }
    return tube;
  }

  [[nodiscard]] SoftSurface at(std::size_t frame) const {
    return soft_.triangles.empty() ? tube_at(frame) : surface_at(frame);
  }

 private:
  static constexpr auto none = static_cast<std::uint32_t>(-1);

  /// Triangles that will tear have corners of their own.
  void add_triangle(const std::array<std::uint32_t, 3>& triangle,
                    const std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>& edges) {
    std::size_t torn_at = record_.positions.size();
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto edge = edges.find(std::minmax(triangle[k], triangle[(k + 1) % 3])); edge != edges.end())
        torn_at = std::min(torn_at, record_.torn_at[edge->second]);
    const bool tears = torn_at < record_.positions.size();
    for (const std::uint32_t node : triangle) {
      if (tears || corner_of_[node] == none) {
        const auto corner = static_cast<std::uint32_t>(node_of_.size());
        node_of_.push_back(node);
        if (!tears) corner_of_[node] = corner;
        triangles_.push_back(corner);
      } else {
        triangles_.push_back(corner_of_[node]);
      }
    }
    torn_at_.push_back(torn_at);
  }

  [[nodiscard]] SoftSurface surface_at(std::size_t frame) const {
    const std::vector<Vec3>& nodes = record_.positions[frame];
    std::vector<Vec3> normal_of(nodes.size(), Vec3(0, 0, 0));
    for (std::size_t i = 0; i < torn_at_.size(); ++i) {
      if (frame >= torn_at_[i]) continue;
      const auto& [a, b, c] = soft_.triangles[i];
      const Vec3 normal = (nodes[b] - nodes[a]).cross(nodes[c] - nodes[a]);
      for (const std::uint32_t node : {a, b, c}) normal_of[node] += normal;
    }
    SoftSurface surface;
    for (const std::uint32_t node : node_of_) {
      surface.positions.push_back(nodes[node]);
      surface.normals.push_back(unit(normal_of[node], Vec3(0, 1, 0)));
    }
    for (std::size_t i = 0; i < torn_at_.size(); ++i) {
      if (frame < torn_at_[i]) continue;
      const std::size_t first = 3 * i;
      const Vec3 middle = surface.positions[triangles_[first]];
      for (std::size_t k = 0; k < 3; ++k) surface.positions[triangles_[first + k]] = middle;
    }
    return surface;
  }

  [[nodiscard]] SoftSurface tube_at(std::size_t frame) const {
    const std::vector<Vec3>& nodes = record_.positions[frame];
    std::vector<Vec3> along(nodes.size(), Vec3(0, 0, 0)), side(nodes.size(), Vec3(0, 0, 0));
    for (const SoftEdge& edge : soft_.edges)
      for (const std::uint32_t end : {edge.a, edge.b}) along[end] += unit(nodes[edge.b] - nodes[edge.a], Vec3(0, 0, 0));
    SoftSurface surface;
    for (std::size_t i = 0; i < soft_.edges.size(); ++i) {
      const SoftEdge& edge = soft_.edges[i];
      const bool torn = frame >= record_.torn_at[i];
      for (const std::uint32_t end : {edge.a, edge.b}) {
        const Vec3 axis = unit(along[end], Vec3(0, 1, 0));
        // Carried over from the edge before, so that the tube does not twist.
        const Vec3 from = side[edge.a] == Vec3::Zero() ? least_axis(axis) : side[edge.a];
        side[end] = unit(from - axis * axis.dot(from), unit(least_axis(axis).cross(axis), Vec3(1, 0, 0)));
        const Vec3 other = axis.cross(side[end]);
        for (std::size_t k = 0; k < around; ++k) {
          const double angle = 2 * std::numbers::pi * static_cast<double>(k) / around;
          const Vec3 out = elementary::cos(angle) * side[end] + elementary::sin(angle) * other;
          surface.positions.push_back(torn ? nodes[edge.a] : Vec3(nodes[end] + soft_.radius * out));
          surface.normals.push_back(out);
        }
      }
    }
    return surface;
  }

  static Vec3 unit(const Vec3& vector, const Vec3& otherwise) {
    const double length = vector.norm();
    return length > 1e-30 ? Vec3(vector / length) : otherwise;
  }
  static Vec3 least_axis(const Vec3& axis) {
    int least = 0;
    axis.cwiseAbs().minCoeff(&least);
    return Vec3::Unit(least);
  }

  const SoftRecord& record_;
  const SoftSettings& soft_;
  std::vector<std::uint32_t> corner_of_, node_of_, triangles_;
  std::vector<std::size_t> torn_at_;  ///< by triangle
};

/// The frames that have a target, and the first: all or, if there are too many, evenly spaced ones including the last.
std::vector<std::size_t> frames_shown(std::size_t frames, std::size_t vertices) {
  const std::size_t room =
      std::clamp<std::size_t>(most_vectors / std::max<std::size_t>(2 * vertices, 1), 2, most_targets);
  std::vector<std::size_t> shown;
  if (frames <= room + 1) {
    for (std::size_t i = 0; i < frames; ++i) shown.push_back(i);
    return shown;
  }
  for (std::size_t i = 0; i <= room; ++i) shown.push_back(i * (frames - 1) / room);
  return shown;
}

void dress(Dressed& out, const SoftRecord& record, const SoftDescription& described) {
  const SoftSkin skin(record, described);
  Mesh mesh;
  mesh.name = described.name;
  mesh.base_color = described.color.value_or(Color{Vec4(0.45, 0.3, 0.16, 1)});
  mesh.triangles = skin.triangles();
  const SoftSurface first = skin.at(0);
  mesh.positions = first.positions;
  mesh.normals = first.normals;
  const std::vector<std::size_t> shown = frames_shown(record.positions.size(), first.positions.size());
  for (std::size_t k = 1; k < shown.size(); ++k) {
    SoftSurface surface = skin.at(shown[k]);
    for (std::size_t i = 0; i < surface.positions.size(); ++i) {
      surface.positions[i] -= first.positions[i];
      surface.normals[i] -= first.normals[i];
    }
    mesh.morphs.push_back({std::to_string(shown[k]), std::move(surface.positions), std::move(surface.normals)});
  }
  mesh.rest_weights.assign(mesh.morphs.size(), 0);

  const std::vector<double>& times = out.recording.times;
  NodeRecord node;
  for (std::size_t frame = 0, k = 0; frame < times.size(); ++frame) {
    while (k + 1 < shown.size() && shown[k + 1] <= frame) ++k;
    std::vector<double> weights(mesh.morphs.size(), 0);
    const double part =
        k + 1 < shown.size() ? (times[frame] - times[shown[k]]) / (times[shown[k + 1]] - times[shown[k]]) : 0;
    if (k > 0) weights[k - 1] = 1 - part;
    if (k + 1 < shown.size()) weights[k] = part;
    if (!weights.empty()) node.weights.push_back(std::move(weights));
  }
  out.add(std::move(node), described.name, std::move(mesh));
}

}  // namespace

void add_soft_meshes(Dressed& out) {
  const std::vector<SoftRecord> softs = out.recording.softs;
  const std::vector<SoftDescription> described = out.stage.softs;
  for (std::size_t i = 0; i < softs.size(); ++i)
    if (softs[i].positions.size() == out.recording.times.size() && !softs[i].positions[0].empty())
      dress(out, softs[i], described[i]);
}

}  // namespace tweenfall::recordings
