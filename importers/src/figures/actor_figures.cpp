#include "figures/actor_figures.h"

#include <algorithm>
#include <map>
#include <utility>

namespace tweenfall::figures {

namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;
using Line = std::vector<std::uint32_t>;

constexpr std::size_t most_nodes = 220;   // drawn of one soft body
constexpr std::size_t longest_line = 24;  // nodes drawn of a line
constexpr double straight_on = 0.5;       // cosine of the greatest turn at which a line continues

/// The edges of a surface, those of its hem first, without diagonals of cells: edges that are the longest in each of
/// their triangles. Without a surface, all edges.
std::vector<std::size_t> drawn_edges(const SoftSettings& soft, std::size_t& hem) {
  constexpr double sharp = 0.7;  // cosine of the angle by which a surface turns at an edge that counts as a hem
  struct Side {
    int triangles = 0;
    bool longest = true;
    bool is_hem = true;
    Vec3 normal{0, 0, 0};
  };
  std::map<Ends, Side> sides;
  const auto length = [&](std::uint32_t a, std::uint32_t b) { return (soft.positions[a] - soft.positions[b]).norm(); };
  for (const auto& triangle : soft.triangles) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, length(triangle[k], triangle[(k + 1) % 3]));
    const Vec3& corner = soft.positions[triangle[0]];
    const Vec3 normal = (soft.positions[triangle[1]] - corner).cross(soft.positions[triangle[2]] - corner).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      Side& side = sides[std::minmax(triangle[k], triangle[(k + 1) % 3])];
      if (side.triangles++ == 0)
        side.normal = normal;
      else
        side.is_hem = normal.dot(side.normal) < sharp;
      side.longest = side.longest && length(triangle[k], triangle[(k + 1) % 3]) > (1 - 1e-6) * most;
    }
  }
  std::vector<std::size_t> of_hem, others;
  for (std::size_t i = 0; i < soft.edges.size(); ++i) {
    const auto found = sides.find(std::minmax(soft.edges[i].a, soft.edges[i].b));
    if (soft.triangles.empty()) {
      others.push_back(i);
    } else if (found != sides.end()) {
      if (found->second.is_hem)
        of_hem.push_back(i);
      else if (!found->second.longest)
        others.push_back(i);
    }
  }
  hem = of_hem.size();
  of_hem.insert(of_hem.end(), others.begin(), others.end());
  return of_hem;
}

/// Edges joined to lines that continue as straight as possible; first those of the first `hem` edges.
std::vector<Line> lines_of(const SoftSettings& soft, const std::vector<std::size_t>& edges, std::size_t hem,
                           std::size_t& hem_lines) {
  std::vector<std::vector<std::size_t>> at(soft.positions.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const std::uint32_t end : {soft.edges[edges[i]].a, soft.edges[edges[i]].b}) at[end].push_back(i);
  std::vector<bool> used(edges.size(), false);
  const auto go_on = [&](Line& line, bool of_hem) {
    for (;;) {
      const Vec3& last = soft.positions[line.back()];
      const Vec3 way = (last - soft.positions[line[line.size() - 2]]).normalized();
      double best = straight_on;
      std::size_t next = edges.size();
      std::uint32_t node = 0;
      for (const std::size_t i : at[line.back()]) {
        if (used[i] || (i < hem) != of_hem) continue;
        const SoftEdge& edge = soft.edges[edges[i]];
        const std::uint32_t other = edge.a == line.back() ? edge.b : edge.a;
        const double straight = way.dot((soft.positions[other] - last).normalized());
        if (!(straight > best)) continue;
        best = straight;
        next = i;
        node = other;
      }
      if (next == edges.size()) return;
      used[next] = true;
      line.push_back(node);
    }
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i == hem) hem_lines = lines.size();
    if (used[i]) continue;
    used[i] = true;
    Line line{soft.edges[edges[i]].a, soft.edges[edges[i]].b};
    go_on(line, i < hem);
    std::ranges::reverse(line);
    go_on(line, i < hem);
    lines.push_back(std::move(line));
  }
  if (hem >= edges.size()) hem_lines = lines.size();
  return lines;
}

/// All lines of the hem, and every few of the others: with about `most` nodes together.
std::vector<Line> some_of(std::vector<Line> lines, std::size_t hem_lines, std::size_t most) {
  std::size_t of_hem = 0, of_others = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) (i < hem_lines ? of_hem : of_others) += lines[i].size();
  const std::size_t room = most > of_hem ? most - of_hem : 1;
  const std::size_t apart = std::max<std::size_t>(1, (of_others + room - 1) / room);
  std::vector<Line> shown;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (i < hem_lines || (i - hem_lines) % apart == apart / 2) shown.push_back(std::move(lines[i]));
  return shown;
}

std::vector<Line> shown_lines(const SoftSettings& soft) {
  std::size_t hem = 0, hem_lines = 0;
  const std::vector<std::size_t> edges = drawn_edges(soft, hem);
  std::vector<Line> lines = lines_of(soft, edges, hem, hem_lines);
  for (Line& line : lines) {
    const std::size_t pieces = line.size() - 1, apart = (pieces + longest_line - 1) / longest_line;
    if (apart <= 1) continue;
    Line fewer;
    for (std::size_t i = 0; i < pieces; i += apart) fewer.push_back(line[i]);
    fewer.push_back(line.back());
    line = std::move(fewer);
  }
  return some_of(std::move(lines), hem_lines, most_nodes);
}

/// For bodies that tear: the same lines, but each edge is one of its own, which shrinks to a point when it tears.
Figure tearing_figure(const SoftRecord& record, const SoftSettings& soft, Facing facing) {
  Figure figure;
  std::size_t hem = 0, hem_lines = 0;
  const std::vector<std::size_t> edges = drawn_edges(soft, hem);
  std::map<Ends, std::size_t> between;
  for (const std::size_t edge : edges) between.emplace(std::minmax(soft.edges[edge].a, soft.edges[edge].b), edge);
  std::vector<std::size_t> shown;
  for (const Line& line : some_of(lines_of(soft, edges, hem, hem_lines), hem_lines, most_nodes))
    for (std::size_t i = 1; i < line.size(); ++i) shown.push_back(between.at(std::minmax(line[i - 1], line[i])));
  for (std::size_t i = 0; i < shown.size(); ++i) figure.starts.push_back(2 * i);
  for (std::size_t frame = 0; frame < record.positions.size(); ++frame) {
    std::vector<Vec2>& points = figure.points.emplace_back();
    for (const std::size_t edge : shown) {
      const auto& nodes = record.positions[frame];
      const bool torn = frame >= record.torn_at[edge];
      points.push_back(flattened(nodes[soft.edges[edge].a], facing));
      points.push_back(flattened(nodes[torn ? soft.edges[edge].a : soft.edges[edge].b], facing));
    }
  }
  return figure;
}

}  // namespace

void add_soft_figures(std::vector<Figure>& list, const Recording& recording, const StageDescription& stage,
                      Facing facing) {
  if (recording.softs.size() != stage.softs.size()) return;
  for (std::size_t i = 0; i < recording.softs.size(); ++i) {
    const SoftRecord& record = recording.softs[i];
    const SoftSettings& soft = stage.softs[i].soft;
    if (record.positions.size() != recording.times.size() || soft.edges.empty()) continue;
    const bool tears =
        std::ranges::any_of(record.torn_at, [&](std::size_t frame) { return frame < recording.times.size(); });
    Figure figure;
    if (tears) {
      figure = tearing_figure(record, soft, facing);
    } else {
      const std::vector<Line> lines = shown_lines(soft);
      std::size_t count = 0;
      for (const Line& line : lines) {
        figure.starts.push_back(count);
        count += line.size();
      }
      for (const std::vector<Vec3>& nodes : record.positions) {
        std::vector<Vec2>& points = figure.points.emplace_back();
        for (const Line& line : lines)
          for (const std::uint32_t node : line) points.push_back(flattened(nodes[node], facing));
      }
    }
    figure.kind = Figure::Kind::lines;
    figure.radius = soft.triangles.empty() ? soft.radius : 0;
    figure.name = record.name;
    figure.color = stage.softs[i].color;
    list.push_back(std::move(figure));
  }
}

void add_wheel_figures(std::vector<Figure>& list, const Recording& recording, const StageDescription& stage,
                       Facing facing) {
  for (const VehicleRecord& vehicle : recording.vehicles) {
    const auto described = std::ranges::find(stage.vehicles, vehicle.name, &VehicleDescription::name);
    if (described == stage.vehicles.end() || vehicle.chassis >= recording.nodes.size() ||
        vehicle.frame.size() != recording.times.size())
      continue;
    for (std::size_t i = 0; i < vehicle.wheels.size() && i < described->wheels.size(); ++i) {
      Figure figure;
      figure.kind = Figure::Kind::ball;
      figure.node = vehicle.chassis;
      figure.name = vehicle.name + "/" + vehicle.wheels[i];
      const double radius = described->wheels[i].wheel.radius;
      figure.radius = radius;
      // From above one sees its tread.
      if (facing == Facing::above) {
        figure.kind = Figure::Kind::stick;
        figure.radius = 0.3 * radius;
      }
      for (const std::vector<StageWheel>& wheels : vehicle.frame) {
        const Pose& pose = wheels.at(i).pose;
        if (facing == Facing::above) {
          const Vec3 ahead =
              (radius - figure.radius) * (pose.rotation * Vec3(0, 0, 1)).cross(Vec3(0, 1, 0)).stableNormalized();
          figure.points.push_back({flattened(pose.position - ahead, facing), flattened(pose.position + ahead, facing)});
          continue;
        }
        figure.points.push_back(
            {flattened(pose.position, facing), flattened(pose.position + pose.rotation * Vec3(radius, 0, 0), facing)});
      }
      list.push_back(std::move(figure));
    }
  }
}

}  // namespace tweenfall::figures
