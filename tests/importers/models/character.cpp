// The sample character as a clone has it: what the stored file holds, and that its motions keep their promises.

#include "support.h"

#include <tweenfall/anim/mesh.h>
#include <tweenfall/importers/model.h>

#if __has_include(<character.h>)
#include <character.h>
#endif

#include <iterator>
#include <set>

using namespace tweenfall;
using tweenfall::test::near;

namespace {

std::filesystem::path stored_file() {
  return std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/character.glb";
}

const Model& stored() {
  static const Model model = load_model(stored_file());
  return model;
}

const Clip& clip_named(const std::string& name) {
  for (const Clip& clip : stored().clips)
    if (clip.name == name) return clip;
  FAIL("no clip " << name << " in " << stored_file().string());
  throw std::logic_error("unreachable");
}

std::size_t node_named(const std::string& name) {
  for (std::size_t i = 0; i < stored().nodes.size(); ++i)
    if (stored().nodes[i].name == name) return i;
  FAIL("no node " << name);
  return no_node;
}

/// Every node in the world, with `clip` at `time` over the rest pose; null: only the rest pose.
std::vector<WorldMotion> world_at(const Clip* clip, double time) {
  static const Hierarchy hierarchy(stored().nodes);
  std::vector<Motion> local;
  for (const Node& node : stored().nodes) local.push_back({node.rest, {}, Vec3::Zero()});
  if (clip)
    for (const Track& track : clip->tracks) {
      Motion& motion = local[node_named(track.node)];
      if (track.property == "position") motion.pose.position = std::get<Curve<Vec3>>(track.curve).value(time);
      if (track.property == "rotation") motion.pose.rotation = std::get<Curve<Quat>>(track.curve).value(time);
    }
  std::vector<WorldMotion> world(local.size());
  hierarchy.world_motions(local, world);
  return world;
}

std::vector<Vec3> skinned(const Clip* clip, double time) {
  const MeshInstance& instance = stored().instances.at(0);
  const Mesh& mesh = stored().meshes.at(instance.mesh);
  const std::vector<WorldMotion> world = world_at(clip, time);
  std::vector<Vec3> points(mesh.positions.size());
  deform(mesh, {}, &stored().skins.at(instance.skin), instance.node, world, points);
  return points;
}

double lowest(const std::vector<Vec3>& points) {
  return std::min_element(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); })
      ->y();
}

Vec3 place_of(const std::vector<WorldMotion>& world, const std::string& node) {
  return world[node_named(node)].motion.pose.position;
}

/// A stretch in which a point stays on the floor: how long it lasts, and how far the point strays over it.
struct FootContact {
  double duration = 0, drift = 0;
};

/// @param heights  of the point while it stands, m; it touches when within `tolerance` of that
std::vector<FootContact> foot_contacts(const std::vector<Vec3>& way, double step, double standing_height,
                                       double tolerance) {
  std::vector<FootContact> found;
  std::size_t first = 0;
  bool touching = false;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const bool touches = std::abs(way[i].y() - standing_height) <= tolerance;
    if (touches && !touching) {
      found.push_back({});
      first = i;
    }
    touching = touches;
    if (!touching) continue;
    found.back().duration = step * static_cast<double>(i - first);
    for (std::size_t j = first; j < i; ++j) {
      const Vec3 apart = way[i] - way[j];
      found.back().drift = std::max(found.back().drift, std::hypot(apart.x(), apart.z()));
    }
  }
  return found;
}

}  // namespace

TEST_CASE("the stored character loads unrepaired, with one skin of 21 joints and its four clips") {
  CHECK(stored().repairs.empty());
  CHECK(stored().meshes.size() == 1);
  REQUIRE(stored().skins.size() == 1);
  REQUIRE(stored().instances.size() == 1);
  CHECK(stored().instances[0].skin == 0);
  CHECK(stored().skins[0].joints.size() == 21);
  std::set<std::string> clips, joints;
  for (const Clip& clip : stored().clips) clips.insert(clip.name);
  CHECK(clips == std::set<std::string>{"Walk", "WalkForward", "Wave", "GetUp"});
  for (const std::size_t joint : stored().skins[0].joints) joints.insert(stored().nodes[joint].name);
  for (const char* name :
       {"Hips",          "Spine",        "Chest",     "Neck",       "Head",      "LeftShoulder", "LeftUpperArm",
        "LeftForearm",   "LeftHand",     "LeftThigh", "LeftShin",   "LeftFoot",  "LeftToes",     "RightShoulder",
        "RightUpperArm", "RightForearm", "RightHand", "RightThigh", "RightShin", "RightFoot",    "RightToes"})
    CHECK_MESSAGE(joints.count(name) == 1, name);
}

TEST_CASE("the character's skin is closed, wound outwards, smooth, and pulled by weights that sum to 1") {
  const Mesh& mesh = stored().meshes.at(0);
  CHECK(mesh.positions.size() >= 1500);
  CHECK(mesh.positions.size() <= 4000);
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  REQUIRE(mesh.influences.size() == mesh.positions.size());

  std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::size_t against = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const std::uint32_t a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
    edges.insert({{a, b}, {b, c}, {c, a}});
    const Vec3 face = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    if (face.dot(mesh.normals[a] + mesh.normals[b] + mesh.normals[c]) <= 0) ++against;
  }
  CHECK(against == 0);
  std::size_t open = 0;
  for (const auto& [a, b] : edges)
    if (edges.count({a, b}) != 1 || edges.count({b, a}) != 1) ++open;
  CHECK(open == 0);

  std::size_t shared = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    double sum = 0;
    for (const Influence& influence : mesh.influences[i]) sum += influence.weight;
    CHECK(near(sum, 1, 1e-6));
    CHECK(near(mesh.normals[i].norm(), 1, 1e-6));
    if (mesh.influences[i].size() > 1 && mesh.influences[i][1].weight > 0.05) ++shared;
  }
  CHECK(shared > mesh.positions.size() / 10);
}

TEST_CASE("the character stands at the origin, feet on the floor, looking along +Z with its left at +X") {
  const std::vector<Vec3> points = skinned(nullptr, 0);
  double top = 0;
  for (const Vec3& point : points) top = std::max(top, point.y());
  CHECK(std::abs(lowest(points)) < 1e-3);
  CHECK(top > 1.6);
  CHECK(top < 1.8);
  const auto world = world_at(nullptr, 0);
  CHECK(place_of(world, "LeftHand").x() > 0.2);
  CHECK(place_of(world, "RightHand").x() < -0.2);
  CHECK(place_of(world, "LeftToes").z() > place_of(world, "LeftFoot").z() + 0.08);
  CHECK(std::abs(place_of(world, "Hips").x()) < 1e-6);
}

TEST_CASE("the character's rotations are stored as cubics of the four parts, with slopes") {
  std::size_t tracks = 0;
  for (const Clip& clip : stored().clips)
    for (const Track& track : clip.tracks) {
      if (track.property != "rotation") continue;
      ++tracks;
      for (const RotationSpan& span : std::get<Curve<Quat>>(track.curve).spans()) {
        CHECK(span.form == RotationSpan::Form::normalized);
        CHECK(span.degree == 3);
      }
    }
  CHECK(tracks > 50);
}

TEST_CASE("the walk closes: its last pose and rates are its first") {
  const Clip& walk = clip_named("Walk");
  CHECK(walk.duration == doctest::Approx(1.1).epsilon(0.1));
  for (const Track& track : walk.tracks) {
    INFO(track.name());
    if (track.property == "position") {
      const auto& curve = std::get<Curve<Vec3>>(track.curve);
      const Sample<Vec3> last = curve.sample(curve.end(), Side::in), first = curve.sample(0);
      CHECK(near(last.value, first.value, 1e-6));
      CHECK(near(last.rate, first.rate, 1e-5));
    } else {
      const auto& curve = std::get<Curve<Quat>>(track.curve);
      const Sample<Quat> last = curve.sample(curve.end(), Side::in), first = curve.sample(0);
      CHECK(near(last.value, first.value, 1e-6));
      CHECK(near(last.rate, first.rate, 1e-5));
    }
  }
}

TEST_CASE("a foot that stands does not slide while the character walks forward") {
  const Clip& walk = clip_named("WalkForward");
  const double step = 1.0 / 240;
  const std::vector<Vec3> rest = skinned(nullptr, 0);
  for (const std::string side : {"Left", "Right"}) {
    INFO(side);
    std::vector<Vec3> ball;
    for (double time = 0; time <= walk.duration; time += step)
      ball.push_back(place_of(world_at(&walk, time), side + "Toes"));
    // The ball of the foot carries from when the foot lies flat until the toes leave, about half of each cycle.
    const double height = place_of(world_at(nullptr, 0), side + "Toes").y();
    std::size_t stances = 0;
    for (const FootContact& contact : foot_contacts(ball, step, height, 0.002)) {
      if (contact.duration < 0.3) continue;
      ++stances;
      CHECK(contact.drift < 0.01);
    }
    CHECK(stances >= 4);
  }
  const Vec3 way = place_of(world_at(&walk, walk.duration), "Hips") - place_of(world_at(&walk, 0), "Hips");
  CHECK(way.z() / walk.duration == doctest::Approx(1.2).epsilon(0.02));
  CHECK(std::abs(way.x()) < 1e-5);
}

TEST_CASE("no bone changes its length in any clip") {
  const auto rest = world_at(nullptr, 0);
  for (const Clip& clip : stored().clips)
    for (double time = 0; time <= clip.duration; time += 0.1) {
      const auto world = world_at(&clip, time);
      for (const std::size_t joint : stored().skins.at(0).joints) {
        const std::size_t parent = stored().nodes[joint].parent;
        if (stored().nodes[joint].name == "Hips") continue;
        const double length = (world[joint].motion.pose.position - world[parent].motion.pose.position).norm();
        const double at_rest = (rest[joint].motion.pose.position - rest[parent].motion.pose.position).norm();
        CHECK(near(length, at_rest, 1e-6));
      }
    }
}

TEST_CASE("nothing of the character sinks more than 2 cm into the floor in any clip") {
  for (const Clip& clip : stored().clips) {
    double depth = 0, at = 0;
    for (double time = 0; time <= clip.duration; time += 1.0 / 40) {
      const double low = lowest(skinned(&clip, time));
      if (low < depth) {
        depth = low;
        at = time;
      }
      CHECK_MESSAGE(low < 0.02, clip.name << " floats at " << time << " s");
    }
    CHECK_MESSAGE(depth >= -0.02, clip.name << " at " << at << " s: " << depth << " m");
  }
}

TEST_CASE("getting up starts on the back and ends in the standing pose, at rest") {
  const Clip& clip = clip_named("GetUp");
  CHECK(place_of(world_at(&clip, 0), "Head").y() < 0.3);
  CHECK(place_of(world_at(&clip, 0), "Hips").y() < 0.3);
  const auto end = world_at(&clip, clip.duration), rest = world_at(nullptr, 0);
  for (const std::size_t joint : stored().skins.at(0).joints) {
    INFO(stored().nodes[joint].name);
    CHECK(near(end[joint].motion.pose.position, rest[joint].motion.pose.position, 1e-5));
    CHECK(near(end[joint].motion.pose.rotation, rest[joint].motion.pose.rotation, 1e-5));
  }
  for (const Track& track : clip.tracks)
    if (track.property == "rotation") {
      const auto& curve = std::get<Curve<Quat>>(track.curve);
      CHECK(curve.rate(curve.end(), Side::in).norm() < 0.02);
    }
}

TEST_CASE("the wave lifts the right hand over the head, swings it out three times, and leaves the legs alone") {
  const Clip& clip = clip_named("Wave");
  for (const Track& track : clip.tracks) {
    INFO(track.name());
    for (const char* part : {"Hips", "Thigh", "Shin", "Foot", "Toes", "LeftHand", "LeftForearm"})
      CHECK(track.node.find(part) == std::string::npos);
  }
  std::size_t peaks = 0;
  double top = 0, before = 0, now = 0;
  for (double time = 0; time <= clip.duration; time += 1.0 / 120) {
    const auto world = world_at(&clip, time);
    const Vec3 hand = place_of(world, "RightHand");
    top = std::max(top, hand.y() - place_of(world, "Head").y());
    // Sideways from the elbow, so that the arm's own up and down does not count.
    const double out = place_of(world, "RightForearm").x() - hand.x();
    if (hand.y() > 1.5 && now > 0.1 && now > before && now > out) ++peaks;
    before = now;
    now = out;
  }
  CHECK(top > 0.05);
  CHECK(peaks == 3);
}

TEST_CASE("the program under samples makes the stored character again, bit for bit") {
#if __has_include(<character.h>)
  const auto again = std::filesystem::temp_directory_path() / "tweenfall_character_again.glb";
  save_glb(character::make_character(), again);
  const auto bytes = [](const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::string made = bytes(again), kept = bytes(stored_file());
  std::filesystem::remove(again);
  CHECK(made.size() > 100000);
  CHECK_MESSAGE(made == kept, "run `make_character samples/documents/character.glb` and commit the result");
#else
  MESSAGE("SKIPPED: the samples are not built, so the character is not made again");
#endif
}
