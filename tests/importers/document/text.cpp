#include "importers/document/document_files.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/quaternion_cubic.h>

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("what was written, read and written again is the same text, and means the same") {
  for (const std::filesystem::path& file : documents_in("good")) {
    CAPTURE(file.string());
    const Document first = Document::read(file);
    const std::string written = first.text();
    const Document second = Document::parse(written, "again.json", file.parent_path());
    CHECK(second.text() == written);
    CHECK(second.stage().nodes.size() == first.stage().nodes.size());
    REQUIRE(second.stage().clips.size() == first.stage().clips.size());
    CHECK(second.stage().rules.size() == first.stage().rules.size());
    for (std::size_t i = 0; i < first.stage().clips.size(); ++i) {
      const Clip &a = first.stage().clips[i], &b = second.stage().clips[i];
      CHECK(a.duration == b.duration);
      REQUIRE(a.tracks.size() == b.tracks.size());
      for (std::size_t k = 0; k < a.tracks.size(); ++k) {
        CHECK(a.tracks[k].name() == b.tracks[k].name());
        if (const auto* curve = std::get_if<Curve<Quat>>(&a.tracks[k].curve))
          CHECK(curve->value(0.37).coeffs() == std::get<Curve<Quat>>(b.tracks[k].curve).value(0.37).coeffs());
        if (const auto* curve = std::get_if<Curve<Vec3>>(&a.tracks[k].curve))
          CHECK(curve->value(0.37) == std::get<Curve<Vec3>>(b.tracks[k].curve).value(0.37));
      }
    }
  }
}

TEST_CASE("writing leaves defaults out, keeps names that are free, and says a thing one way") {
  const Document document = parsed(R"({
    // gone
    "world": {"step": "1/240", "gravity": [0, -9.81, 0]}, "tweenfall": 1, "x-mine": [1, {"a": null}],
    "clips": {"a": {"tracks": {"b.c": {"after": "hold", "keys": [{"ease": "linear", "v": 1, "t": 0}, [0.1, 2, "smooth-clamped"]]}}, "events": []}}
  })");
  CHECK(document.text() == R"({
  "tweenfall": 1,
  "clips": {
    "a": {
      "tracks": {
        "b.c": [
          [0, 1, "linear"],
          [0.1, 2]
        ]
      }
    }
  },
  "x-mine": [1, {"a": null}]
}
)");
}

TEST_CASE("numbers are written so that they read back to the same bits") {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const double number = (random.unit() - 0.5) * std::pow(10.0, random.between(-300, 300));
    char text[64];
    std::snprintf(text, sizeof text, "%.17g", number);
    const Document document =
        parsed(std::string(R"({"tweenfall": 1, "clips": {"a": {"tracks": {"b.c": [[0, )") + text + "]]}}}}");
    const Document again = parsed(document.text());
    CHECK(std::get<Curve<double>>(again.stage().clips.at(0).tracks.at(0).curve).value(0) == number);
  }
}

TEST_CASE("the schema refuses every fault of shape and accepts all that loads") {
  if (std::system("python3 -c 'import jsonschema' >/dev/null 2>&1") != 0) {
    MESSAGE("SKIPPED: the schema against the corpus, no python3-jsonschema");
    return;
  }
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() /
                          ("tweenfall_schema_" + std::to_string(std::hash<std::string>{}(fs::current_path().string())));
  fs::remove_all(folder);
  for (const char* verdict : {"good", "bad"}) fs::create_directories(folder / verdict);
  std::ofstream(folder / "schema.json") << document_schema();
  // Comments are the reader's; a schema sees what is left without them.
  const auto put = [&](const std::string& verdict, const std::string& name, const std::string& text) {
    const nlohmann::json plain = nlohmann::json::parse(text, nullptr, false, true);
    if (!plain.is_discarded()) std::ofstream(folder / verdict / name) << plain.dump();
  };
  for (const fs::path& file : documents_in("good")) put("good", file.filename().string(), text_of(file));
  put("good", "start.json", starting_document());
  for (const fs::path& file : documents_in("bad/shape")) put("bad", file.filename().string(), text_of(file));
  // The faults of these are beyond shapes: order, cycles, references.
  for (const fs::path& file : documents_in("bad/meaning"))
    put("good", "meaning_" + file.filename().string(), text_of(file));
  // Documents changed at random that still load.
  Random random(11);
  const nlohmann::json seed =
      nlohmann::json::parse(text_of(data_folder() / "documents/good/everything.json"), nullptr, true, true);
  const nlohmann::json flat = seed.flatten();
  std::vector<std::string> places;
  for (const auto& [pointer, value] : flat.items()) places.push_back(pointer);
  const nlohmann::json values[] = {0,
                                   -1,
                                   0.5,
                                   true,
                                   "linear",
                                   "x",
                                   "50%",
                                   "#fff",
                                   nullptr,
                                   nlohmann::json::array(),
                                   nlohmann::json::object(),
                                   nlohmann::json::array({1, 2, 3})};
  int loaded = 0;
  for (int i = 0; i < 400; ++i) {
    nlohmann::json changed = seed;
    changed[nlohmann::json::json_pointer(places[random.bits() % places.size()])] =
        values[random.bits() % std::size(values)];
    if (!faults_of(changed.dump(), "changed.json", data_folder() / "documents/good").empty()) continue;
    put("good", "changed_" + std::to_string(i) + ".json", changed.dump());
    ++loaded;
  }
  CHECK(loaded > 10);
  std::ofstream(folder / "check.py") << R"(import json, pathlib, sys
import jsonschema
here = pathlib.Path(sys.argv[1])
schema = json.loads((here / "schema.json").read_text())
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
wrong = []
for verdict in ("good", "bad"):
    for file in sorted((here / verdict).iterdir()):
        faults = list(validator.iter_errors(json.loads(file.read_text())))
        if bool(faults) == (verdict == "good"):
            wrong.append(f"{verdict} {file.name}: {faults[0].message[:200] if faults else 'accepted'}")
(here / "wrong.txt").write_text("\n".join(wrong))
)";
  REQUIRE(std::system(("python3 " + (folder / "check.py").string() + " " + folder.string()).c_str()) == 0);
  CHECK(text_of(folder / "wrong.txt") == "");
  fs::remove_all(folder);
}

TEST_CASE("a formula of a model becomes as many keys as it needs, however long it lasts") {
  Model model;
  model.nodes = {{.name = "long"}, {.name = "still"}, {.name = "wave"}};
  const auto steady = [](double time, Side) {
    return Sample<Vec3>{Vec3(time, 2 * time, 0), Vec3(1, 2, 0), Vec3::Zero()};
  };
  const auto wave = [](double time, Side) {
    return Sample<Vec3>{Vec3(0, std::sin(time), 0), Vec3(0, std::cos(time), 0), Vec3(0, -std::sin(time), 0)};
  };
  Clip clip{.name = "move", .duration = 2};
  clip.tracks.push_back({"long", "position", Curve<Vec3>(steady, std::vector<double>{0, 0.8, 4e5})});
  clip.tracks.push_back({"still", "position", Curve<Vec3>(steady, 0, 1e300)});
  clip.tracks.push_back({"wave", "position", Curve<Vec3>(wave, std::vector<double>{0, 1, 3})});
  model.clips.push_back(clip);
  const Document document = Document::from_model(model);
  CHECK(document.text().size() < 1'000'000);
  const auto& tracks = document.stage().clips.at(0).tracks;
  for (const Track& track : tracks) {
    if (track.node == "still") continue;
    const auto& curve = std::get<Curve<Vec3>>(track.curve);
    for (double time = 0; time <= 3; time += 0.07) {
      const auto expected = track.node == "wave" ? wave(time, Side::out) : steady(time, Side::out);
      CHECK(near(curve.value(time), expected.value, 1e-6));
      CHECK(near(curve.rate(time), expected.rate, 1e-4));
    }
  }
}

TEST_CASE("a document of a model moves as the model does") {
  Model model;
  model.name = "made";
  model.nodes = {{.name = "root"}, {.name = "x-arm", .parent = 0}, {.name = "", .parent = 1}};
  model.nodes[1].rest.position = Vec3(0, 1, 0);
  model.nodes[1].rest.scale = Vec3(1, 2, 3);
  Random random(5);
  Clip clip;
  clip.name = "move";
  clip.duration = 2;
  std::vector<Key<Vec3>> cubic, stepped;
  std::vector<Key<Quat>> turns;
  std::vector<double> times;
  std::vector<Vec4> in, values, out;
  for (int i = 0; i < 4; ++i) {
    const double time = 0.5 * i + 0.1;
    times.push_back(time);
    cubic.push_back({.time = time,
                     .value = random.vector(2),
                     .in = Tangent<Vec3>{Tangent<Vec3>::Kind::given, random.vector(3)},
                     .out = Tangent<Vec3>{Tangent<Vec3>::Kind::given, random.vector(3)}});
    stepped.push_back({.time = time, .value = random.vector(2), .ease = i == 1 ? Ease::linear() : Ease::hold()});
    turns.push_back({.time = time, .value = random.rotation(), .ease = Ease::linear()});
    values.push_back(random.rotation().coeffs());
    in.push_back(Vec4(random.unit(), random.unit(), random.unit(), random.unit()));
    out.push_back(Vec4(random.unit(), random.unit(), random.unit(), random.unit()));
  }
  clip.tracks.push_back({"root", "position", keyed_curve<Vec3>(cubic)});
  clip.tracks.push_back({"root", "scale", keyed_curve<Vec3>(stepped)});
  clip.tracks.push_back({"root", "rotation", keyed_curve<Quat>(turns)});
  clip.tracks.push_back({"x-arm", "rotation", gltf_cubic_rotation(times, in, values, out)});
  model.clips.push_back(clip);

  const Document document = Document::from_model(model);
  const StageDescription& stage = document.stage();
  REQUIRE(stage.nodes.size() == 3);
  CHECK(stage.nodes[2].parent == 1);
  CHECK(stage.nodes[1].rest.scale == Vec3(1, 2, 3));
  REQUIRE(stage.clips.size() == 1);
  REQUIRE(stage.clips[0].tracks.size() == 4);
  CHECK(stage.clips[0].duration == 2);
  const auto& tracks = stage.clips[0].tracks;
  for (double time = 0; time <= 1.7; time += 0.01) {
    CAPTURE(time);
    for (const int i : {0, 1}) {
      const auto& expected = std::get<Curve<Vec3>>(clip.tracks[i].curve);
      const auto& actual = std::get<Curve<Vec3>>(tracks[i].curve);
      CHECK(near(actual.value(time), expected.value(time), 1e-12));
      CHECK(near(actual.rate(time), expected.rate(time), 1e-10));
    }
    CHECK(near(std::get<Curve<Quat>>(tracks[2].curve).value(time),
               std::get<Curve<Quat>>(clip.tracks[2].curve).value(time), 1e-12));
    // Kept in pieces, each checked in its middle.
    CHECK(near(std::get<Curve<Quat>>(tracks[3].curve).value(time),
               std::get<Curve<Quat>>(clip.tracks[3].curve).value(time), 1e-6));
  }
  CHECK(Document::parse(document.text(), "again.json", {}).text() == document.text());
}

TEST_CASE("a document that was moved from is what it was") {
  Document document =
      Document::parse(R"({"tweenfall": 1, "clips": {"a": {"tracks": {"x.y": [[0, 1], [1, 2]]}}}})", "a", "");
  const Document taken = std::move(document);
  CHECK(document.text() == taken.text());
  CHECK(document.stage().clips.size() == 1);
}
