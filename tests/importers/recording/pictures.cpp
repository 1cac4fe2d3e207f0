#include <tweenfall/importers/document.h>
#include <tweenfall/importers/model.h>
#include <tweenfall/importers/recording_file.h>

#include "page/example_stage.h"
#include "support.h"

#include <sstream>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// The attribute's value in the first element after `from`.
std::string attribute(const std::string& text, std::size_t from, const std::string& name) {
  const std::size_t at = text.find(" " + name + "=\"", from) + name.size() + 3;
  return text.substr(at, text.find('"', at) - at);
}

std::vector<double> list(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ';');) numbers.push_back(std::stod(part));
  return numbers;
}

/// A ball that is thrown along a parabola, 2 s.
struct Throw {
  StageDescription stage;
  Recording recording;
  Throw() {
    NodeDescription node{.name = "ball"};
    node.body = BodyDescription{};
    node.body->shape.solid = Sphere{0.1};
    stage.nodes.push_back(node);
    NodeRecord record{.name = "ball"};
    for (int frame = 0; frame <= 120; ++frame) {
      const double t = frame / 60.0;
      recording.times.push_back(t);
      record.world.push_back(placed({t, 10 * t - 4.905 * t * t, 0}, Quat(1, 0, 0, 0), {}));
      record.twist.push_back({Vec3(1, 10 - 9.81 * t, 0), Vec3(0, 0, 0)});
      record.owner.push_back(Owner::free);
    }
    recording.nodes.push_back(record);
  }
};

/// A pyramid of 2 m by 2 m by 3 m that slides 4 m along x in a second.
struct Pyramid {
  StageDescription stage;
  Recording recording;
  Pyramid() {
    NodeDescription node{.name = "pyramid"};
    node.body = BodyDescription{};
    node.body->shape.solid =
        Hull{ConvexHull(std::vector<Vec3>{{1, 0, 1}, {-1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {0, 3, 0}})};
    stage.nodes.push_back(node);
    NodeRecord record{.name = "pyramid"};
    for (int frame = 0; frame <= 10; ++frame) {
      recording.times.push_back(frame / 10.0);
      record.world.push_back(placed({0.4 * frame, 0, 0}, Quat(1, 0, 0, 0), {Vec3(4, 0, 0), Vec3(0, 0, 0)}));
      record.twist.push_back({Vec3(4, 0, 0), Vec3(0, 0, 0)});
      record.owner.push_back(Owner::free);
    }
    recording.nodes.push_back(record);
  }
};

}  // namespace

TEST_CASE("the moving picture's keyframes follow a parabola within the error it states") {
  const Throw thrown;
  const std::string svg = recording_svg(thrown.recording, thrown.stage);
  const std::size_t circle = svg.find("<circle");
  REQUIRE(circle != std::string::npos);
  const std::size_t cx = svg.find("attributeName=\"cx\"", circle), cy = svg.find("attributeName=\"cy\"", circle);
  const std::vector<double> shares = list(attribute(svg, cx, "keyTimes"));
  const std::vector<double> x = list(attribute(svg, cx, "values")), y = list(attribute(svg, cy, "values"));
  const double length = std::stod(attribute(svg, cx, "dur"));
  REQUIRE(shares.size() == x.size());
  REQUIRE(shares.size() == y.size());
  REQUIRE(shares.size() > 5);
  CHECK(shares.front() == 0);
  CHECK(shares.back() == 1);
  // The horizontal speed is one meter per second, which gives the scale.
  const double scale = (x[x.size() - 2] - x.front()) / 2;
  REQUIRE(scale > 10);
  std::size_t key = 0;
  for (int frame = 0; frame <= 120; ++frame) {
    const double t = frame / 60.0;
    while (key + 2 < shares.size() && shares[key + 1] * length < t) ++key;
    const double u = std::clamp((t / length - shares[key]) / (shares[key + 1] - shares[key]), 0.0, 1.0);
    const double height = y.front() - (y[key] + u * (y[key + 1] - y[key]));
    // 0.4 px as stated, 0.05 px of rounding at either end, and of the scale.
    CHECK(std::abs(height - scale * (10 * t - 4.905 * t * t)) < 0.4 + 0.3);
  }
}

// A ball on a circle of 2 m, about a point that draws it.
TEST_CASE("an orbit is drawn round, upright and level") {
  for (const Vec3& along : {Vec3(0, 2, 0), Vec3(0, 0, 2)}) {
    StageDescription stage;
    stage.world.gravity = Vec3(0, 0, 0);
    stage.nodes.push_back(
        {.name = "planet",
         .rest = {.position = Vec3(2, 0, 0)},
         .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0, .twist = {along, Vec3(0, 0, 0)}}});
    stage.forces.push_back({.force = Attractor{.acceleration = 8}});
    Stage run(stage);
    const std::string svg = recording_svg(record(run, 6.4, 60), stage);
    const std::size_t circle = svg.find("<circle");
    REQUIRE(circle != std::string::npos);
    const auto way = [&](const char* axis) {
      const std::size_t at = svg.find(axis, circle);
      REQUIRE(at != std::string::npos);
      const std::vector<double> values = list(attribute(svg, at, "values"));
      return *std::max_element(values.begin(), values.end()) - *std::min_element(values.begin(), values.end());
    };
    CHECK(way("attributeName=\"cx\"") > 100);
    CHECK(way("attributeName=\"cx\"") == doctest::Approx(way("attributeName=\"cy\"")).epsilon(0.02));
  }
}

TEST_CASE("a moving picture joins nothing across a jump: what jumps stays until then, and its trail is broken") {
  const Document document = Document::parse(R"({"tweenfall": 1,
      "nodes": {"ball": {"body": {"shape": {"sphere": {"radius": 0.1}}}},
                "cart": {}, "post": {"parent": "cart", "body": {"shape": {"box": {"size": [0.2, 1, 0.2]}}}}},
      "clips": {"c": {"tracks": {
        "ball.position": [[0, [0, 2, 0], "linear"], [0.5, [1, 2, 0], "hold"], [1.01, [3, 3, 0], "linear"], [2, [4, 3, 0]]],
        "cart.position": [[0, [0, 0, 0], "hold"], [1.01, [2, 0, 0], "linear"], [2, [3, 0, 0]]]}}},
      "play": [{"clip": "c"}]})",
                                            "jumps.json", {});
  Stage run(document.stage());
  const std::string svg = recording_svg(record(run, 2, 30), document.stage());
  for (const char* trail : {"stroke-width=\"1.5\""}) {
    std::size_t at = 0;
    for (int i = 0; i < 2; ++i) {
      at = svg.find(trail, at) + 1;
      REQUIRE(at != std::string::npos + 1);
      const std::string path = attribute(svg, at, "d");
      CHECK(std::count(path.begin(), path.end(), 'M') == 2);
    }
  }
  const std::size_t circle = svg.find("<circle"), x_of = svg.find("attributeName=\"cx\"", circle);
  REQUIRE(x_of != std::string::npos);
  const std::vector<double> shares = list(attribute(svg, x_of, "keyTimes")), x = list(attribute(svg, x_of, "values"));
  const double length = std::stod(attribute(svg, x_of, "dur"));
  REQUIRE(shares.size() == x.size());
  int jumps = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    CHECK(shares[i] >= shares[i - 1]);
    if (shares[i] > shares[i - 1]) continue;
    ++jumps;
    CHECK(shares[i] * length == doctest::Approx(1.01).epsilon(1e-4));
    CHECK(x[i] - x[i - 1] == doctest::Approx(2 * (x[i - 1] - x.front())).epsilon(0.02));
  }
  CHECK(jumps == 1);
}

TEST_CASE("a moving picture in which nothing can be seen says so, and one with a ground alone does not") {
  StageDescription stage;
  stage.nodes.push_back({.name = "nowhere"});
  Stage empty(stage);
  CHECK(count(recording_svg(record(empty, 1, 10), stage), "nothing here has a shape or a mesh") == 1);
  BodyDescription ground;
  ground.shape = {Plane{}};
  ground.fixed = true;
  stage.nodes[0].body = ground;
  Stage grounded(stage);
  CHECK(count(recording_svg(record(grounded, 1, 10), stage), "nothing here has a shape or a mesh") == 0);
}

TEST_CASE("the moving picture is small, the same each time, and shows all that moves and changes hands") {
  const Recording recording = example_recording();
  const std::string svg = recording_svg(recording, example_stage());
  CHECK(svg.size() < 60000);
  CHECK(svg == recording_svg(recording, example_stage()));
  for (const char* name : {"bob", "crate", "roller"})
    CHECK(count(svg, "<title>" + std::string(name) + "</title>") == 1);
  CHECK(count(svg, "<script") == 0);
  CHECK(count(svg, "http") == 1);                   // the name space alone
  CHECK(count(svg, "calcMode=\"discrete\"") == 4);  // fill and stroke of the two that change hands
}

TEST_CASE("a picture of many tumbling boxes stays under 300 kB") {
  StageDescription stage;
  Recording recording;
  for (int frame = 0; frame <= 600; ++frame) recording.times.push_back(frame / 60.0);
  Random random(7);
  for (int box = 0; box < 60; ++box) {
    NodeDescription node{.name = "box" + std::to_string(box)};
    node.body = BodyDescription{};
    node.body->shape.solid = Box{};
    stage.nodes.push_back(node);
    NodeRecord record{.name = node.name};
    const Vec3 axis = random.vector(1).normalized(), from = random.vector(5);
    const double rate = random.between(2, 8);
    for (const double time : recording.times) {
      record.world.push_back(placed(from, turned(rate * time, axis), {}));
      record.twist.emplace_back();
      record.owner.push_back(Owner::free);
    }
    recording.nodes.push_back(std::move(record));
  }
  CHECK(recording_svg(recording, stage).size() < 300000);
}

TEST_CASE("a page is one file that holds its data and asks for nothing") {
  std::string html;
  try {
    html = recording_html(example_recording(), example_stage());
  } catch (const std::runtime_error& problem) {
    // Built without three.js: then the page says so.
    CHECK(std::string(problem.what()).find("libjs-three") != std::string::npos);
    MESSAGE("SKIPPED: the page, this build has no three.js inside");
    return;
  }
  CHECK(html == recording_html(example_recording(), example_stage()));
  CHECK(count(html, " src=") == 0);
  CHECK(count(html, "<link") == 0);
  CHECK(count(html, "</script>") == 3);
  CHECK(html.find("{{") == std::string::npos);
  const std::size_t start = html.find("id=\"data\">") + 10;
  const nlohmann::json data = nlohmann::json::parse(html.substr(start, html.find("</script>", start) - start));
  CHECK(data["nodes"].size() == 8);
  CHECK(data["lanes"].size() == 4);
  CHECK(data["nodes"][3]["owner"] == nlohmann::json::parse(R"([[0, "keyed"], [60, "driven"], [96, "free"]])"));
  CHECK(data["nodes"][0]["matrices"].get<std::string>().size() == 64);  // a node at rest has one matrix: 48 bytes
}

TEST_CASE("keys of a page have the eases that the document says, and a word of ours where it says tangents") {
  const Document document = Document::parse(R"json({"tweenfall": 1, "nodes": {"a": {}, "b": {}, "c": {}, "d": {}},
    "clips": {"all": {"duration": 4, "tracks": {
      "a.position": [[0, [0, 0, 0], "smooth"], [1, [1, 0, 0], "quad-in-out"], [2, [2, 0, 0], "quad-in-out"],
                     [3, [3, 0, 0]], [4, [4, 0, 0], "bounce-out"]],
      "b.position": {"keys": [{"t": 0, "v": [0, 0, 0], "out": [1, 0, 0]}, {"t": "50%", "v": [1, 0, 0], "ease": "ease-in"},
                              {"t": 4, "v": [2, 0, 0]}]},
      "c.rotation": [[0, {"angle": 0, "axis": "z"}, "tcb(0,0,0)"], [4, {"angle": 720, "axis": "z"}]],
      "d.position": {"spline": {"points": [[0, 0, 0], [1, 0, 0], [2, 1, 0]], "times": [0, 1, 4]}}}}}})json",
                                            "eases.json", ".");
  const StageDescription& stage = document.stage();
  std::string html;
  try {
    Stage run(stage);
    html = recording_html(record(run, 4, 30), stage);
  } catch (const std::runtime_error&) {
    MESSAGE("SKIPPED: the page, this build has no three.js inside");
    return;
  }
  const std::size_t start = html.find("id=\"data\">") + 10;
  const nlohmann::json data = nlohmann::json::parse(html.substr(start, html.find("</script>", start) - start));
  const auto eases = [&data](std::size_t lane) {
    std::vector<std::string> words;
    for (const nlohmann::json& key : data["lanes"][lane]["keys"]) words.push_back(key["ease"].get<std::string>());
    return words;
  };
  using Words = std::vector<std::string>;
  CHECK(eases(0) == Words{"smooth", "quad-in-out", "quad-in-out", "smooth-clamped", "end"});
  CHECK(eases(1) == Words{"cubic", "ease-in", "end"});
  CHECK(eases(2) == Words{"tcb(0,0,0)", "end"});
  CHECK(eases(3) == Words{"spline", "spline", "end"});
}

TEST_CASE("a name cannot break out of the page") {
  Recording recording = example_recording(10);
  recording.name = "</script><script>alert(1)</script>";
  recording.nodes[2].name = "</script><b>";
  std::string html;
  try {
    html = recording_html(recording, example_stage());
  } catch (const std::runtime_error&) {
    MESSAGE("SKIPPED: the page, this build has no three.js inside");
    return;
  }
  CHECK(count(html, "</script>") == 3);
  CHECK(html.find("<script>alert") == std::string::npos);
  CHECK(html.find("&lt;/script&gt;&lt;script&gt;alert(1)") != std::string::npos);
}

TEST_CASE("a hull is drawn as its outline and its sharp edges") {
  const Pyramid slid;
  const std::string svg = recording_svg(slid.recording, slid.stage);
  const std::size_t title = svg.find("<title>pyramid</title>");
  REQUIRE(title != std::string::npos);
  const std::size_t start = svg.find(" d=\"", title) + 4;
  const std::string path = svg.substr(start, svg.find('"', start) - start);
  const std::size_t closed = path.find('Z');
  REQUIRE(closed != std::string::npos);
  CHECK(count(path.substr(0, closed), "L") == 23);
  CHECK(count(path.substr(closed), "M") == 8);
  // The outline from the side is the triangle: as wide as two thirds of its height.
  double left = 1e9, right = -1e9, low = -1e9, high = 1e9;
  std::string numbers = path.substr(0, closed);
  for (char& c : numbers)
    if (c == 'M' || c == 'L') c = ' ';
  std::istringstream stream(numbers);
  for (double x = 0, y = 0; stream >> x >> y;) {
    left = std::min(left, x);
    right = std::max(right, x);
    high = std::min(high, y);
    low = std::max(low, y);
  }
  CHECK(near((right - left) / (low - high), 2.0 / 3, 0.02));
}

TEST_CASE("a hull's faces are in the model that a recording makes, flat and as large as they are") {
  const Pyramid slid;
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "tweenfall_pyramid.glb";
  save_recording(slid.recording, slid.stage, file);
  const Model model = load_model(file);
  std::filesystem::remove(file);
  REQUIRE(model.meshes.size() == 1);
  const Mesh& mesh = model.meshes[0];
  CHECK(mesh.triangles.size() == 3 * 6);
  CHECK(mesh.positions.size() == 4 + 4 * 3);
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3& a = mesh.positions[mesh.triangles[i]];
    const Vec3 out = (mesh.positions[mesh.triangles[i + 1]] - a).cross(mesh.positions[mesh.triangles[i + 2]] - a);
    area += 0.5 * out.norm();
    CHECK(near(mesh.normals[mesh.triangles[i]], Vec3(out / out.norm()), 1e-6));
  }
  CHECK(near(area, 4 + 4 * std::sqrt(10.0), 1e-6));
}

TEST_CASE("a page holds a hull's vertices and faces") {
  const Pyramid slid;
  std::string html;
  try {
    html = recording_html(slid.recording, slid.stage);
  } catch (const std::runtime_error&) {
    MESSAGE("SKIPPED: the page, this build has no three.js inside");
    return;
  }
  const std::size_t start = html.find("id=\"data\">") + 10;
  const nlohmann::json data = nlohmann::json::parse(html.substr(start, html.find("</script>", start) - start));
  const nlohmann::json hull = data["nodes"][0]["shape"]["hull"];
  CHECK(hull["vertices"].size() == 5);
  CHECK(hull["vertices"][4] == nlohmann::json::parse("[0, 3, 0]"));
  CHECK(hull["faces"].size() == 5);
}
