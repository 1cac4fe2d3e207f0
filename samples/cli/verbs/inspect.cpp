// tweenfall inspect: what is in a document or a model, in tables.

#include "files/stage_file.h"
#include "motion/clip_sampling.h"
#include "motion/track_survey.h"
#include "report/counted.h"
#include "report/table.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tweenfall::cli {

namespace {

std::string loop_text(const Loop& loop) {
  constexpr const char* modes[] = {"once", "repeat", "repeat-offset", "pingpong"};
  std::string text = modes[static_cast<int>(loop.mode)];
  if (loop.mode != LoopMode::once && loop.count > 0) text += " x " + brief_text(loop.count);
  return text;
}

std::string times_text(const std::vector<double>& times) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < times.size() && i < most; ++i) text += (i > 0 ? ", " : "at ") + brief_text(times[i]);
  if (times.size() > most) text += " and " + std::to_string(times.size() - most) + " more";
  return text;
}

std::string shape_text(const Shape& shape) {
  struct Words {
    std::string operator()(const Sphere& sphere) const { return "sphere, radius " + brief_text(sphere.radius); }
    std::string operator()(const Box& box) const { return "box, half " + brief_text(box.half_extents); }
    std::string operator()(const Capsule& capsule) const {
      return "capsule, radius " + brief_text(capsule.radius) + ", half height " + brief_text(capsule.half_height);
    }
    std::string operator()(const Cylinder& cylinder) const {
      return "cylinder, radius " + brief_text(cylinder.radius) + ", half height " + brief_text(cylinder.half_height);
    }
    std::string operator()(const Cone& cone) const {
      return "cone, radius " + brief_text(cone.radius) + ", half height " + brief_text(cone.half_height);
    }
    std::string operator()(const TaperedCapsule& capsule) const {
      return "tapered capsule, radii " + brief_text(capsule.bottom_radius) + " and " + brief_text(capsule.top_radius) +
             ", half height " + brief_text(capsule.half_height);
    }
    std::string operator()(const Compound& compound) const {
      return "compound, " + std::to_string(compound.parts().size()) + " parts";
    }
    std::string operator()(const TriangleMesh& mesh) const {
      return "mesh, " + std::to_string(mesh.triangles().size() / 3) + " triangles";
    }
    std::string operator()(const HeightField& field) const {
      return "height field, " + std::to_string(field.columns()) + " by " + std::to_string(field.rows());
    }
    std::string operator()(const Plane& plane) const { return "plane, normal " + brief_text(plane.normal); }
    std::string operator()(const Hull& hull) const {
      return "hull, " + std::to_string(hull.convex.vertices().size()) + " vertices, " +
             std::to_string(hull.convex.faces().size()) + " faces";
    }
  };
  return std::visit(Words{}, shape.solid);
}

/// The scale that the rest poses of a node and its ancestors give to lengths along its own axes.
Vec3 scale_at_rest(const StageDescription& stage, std::size_t node) {
  Mat3 frame = Mat3::Identity();
  for (; node != no_node; node = stage.nodes[node].parent) {
    const Pose& rest = stage.nodes[node].rest;
    frame = rest.rotation.toRotationMatrix() * rest.scale.asDiagonal() * frame;
  }
  return frame.colwise().norm();
}

std::string scale_text(const Vec3& scale) {
  if ((scale - Vec3(1, 1, 1)).cwiseAbs().maxCoeff() < 1e-12) return "";
  const bool is_even = scale.maxCoeff() - scale.minCoeff() < 1e-12 * scale.maxCoeff();
  return ", times " + (is_even ? brief_text(scale.x()) : brief_text(scale));
}

std::string nodes_table(const StageDescription& stage) {
  Table table(counted(stage.nodes.size(), "node"), {"name", "parent", "position, m", "shown"});
  for (std::size_t i = 0; i < stage.nodes.size(); ++i) {
    const NodeDescription& node = stage.nodes[i];
    std::string shown = node.body ? "body" : "";
    for (const MeshInstance& instance : stage.mesh_instances) {
      if (instance.node != i) continue;
      const Mesh& mesh = stage.meshes[instance.mesh];
      shown += (shown.empty() ? "" : ", ") + std::string(instance.skin == no_node ? "" : "skinned ") + "mesh, " +
               counted(mesh.triangles.size() / 3, "triangle");
      if (!mesh.morphs.empty()) shown += ", " + counted(mesh.morphs.size(), "morph");
    }
    table.row({node.name, node.parent == no_node ? "" : stage.nodes[node.parent].name, brief_text(node.rest.position),
               shown});
  }
  return table.text(styled_output());
}

std::string names_text(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string play_text(const Play& play, const Clip& clip) {
  std::string text = (play.name.empty() ? "from " : play.name + " from ") + brief_text(play.at) + " s";
  if (!play.speed.is_constant())
    text += " at a speed that has keys";
  else if (play.speed.at(0) != 1)
    text += " at " + brief_text(play.speed.at(0)) + " x";
  if (play.from != 0 || play.to)
    text += ", " + brief_text(play.from) + " s to " + brief_text(play.to.value_or(clip.duration)) + " s of it";
  if (play.offset != 0) text += ", " + brief_text(play.offset) + " s ahead";
  if (play.reverse) text += ", in reverse";
  if (play.loop) text += ", " + loop_text(*play.loop);
  if (!play.weight.knots().empty())
    text += ", weight by keys";
  else if (play.weight.value(0) != 1)
    text += ", weight " + brief_text(play.weight.value(0));
  if (play.fade_in.seconds > 0) text += ", fades in " + brief_text(play.fade_in.seconds) + " s";
  if (play.fade_out.seconds > 0) text += ", fades out " + brief_text(play.fade_out.seconds) + " s";
  if (play.fill != Fill{}) text += ", fill " + std::string(fill_words[static_cast<std::size_t>(play.fill)]);
  if (!play.mask.empty()) text += ", on " + names_text(play.mask);
  return text;
}

std::string clips_table(const StageDescription& stage) {
  Table table(counted(stage.clips.size(), "clip"),
              {"name", ">duration, s", "loop", ">tracks", ">keys", ">events", "plays"});
  for (std::size_t i = 0; i < stage.clips.size(); ++i) {
    const Clip& clip = stage.clips[i];
    std::size_t keys = 0;
    for (const Track& track : clip.tracks) keys += survey(track, clip).keys;
    std::string plays;
    for (const Play& play : stage.plays)
      if (play.clip == i) plays += (plays.empty() ? "" : "; ") + play_text(play, clip);
    table.row({clip.name, brief_text(clip.duration), loop_text(clip.loop), std::to_string(clip.tracks.size()),
               std::to_string(keys), std::to_string(clip.events.size()), plays});
  }
  return table.text(styled_output());
}

std::string tracks_table(const Clip& clip) {
  Table table("tracks of " + clip.name, {"track", "kind", ">keys", ">from, s", ">to, s", ">top speed, 1/s", ">at, s",
                                         "value jumps", "slope jumps"});
  for (const Track& track : clip.tracks) {
    const TrackSurvey found = survey(track, clip);
    const bool is_formula = found.keys == 0;
    const bool is_step = track.curve.index() >= 7;
    table.row({track.name(), kind_of(track.curve), is_formula ? "formula" : std::to_string(found.keys),
               is_formula ? "" : brief_text(found.from), is_formula ? "" : brief_text(found.to),
               is_step ? "" : brief_text(found.top_speed), is_step ? "" : brief_text(found.top_speed_at),
               times_text(found.value_jumps), times_text(found.slope_jumps)});
  }
  return table.text(styled_output());
}

std::string events_table(const Clip& clip) {
  Table table("events of " + clip.name, {">time, s", ">to, s", "name", "data"});
  for (const ClipEvent& event : clip.events)
    table.row({brief_text(event.from), event.is_interval() ? brief_text(event.to) : "", event.name, event.data});
  return table.empty() ? "" : table.text(styled_output());
}

/// A body that no file gives an owner starts keyed if a playing clip moves it or an ancestor.
std::string owner_text(const NodeDescription& node, bool animated) {
  if (node.body->fixed) return "static";
  if (!node.body->drive) return animated ? "keyed" : "free";
  const Drive& drive = *node.body->drive;
  constexpr const char* frames[] = {"", ", as its parent is", ", as its anchor is"};
  if (drive.owner() == Owner::driven)
    return "driven, " + brief_text(drive.hz) + " Hz" + frames[static_cast<int>(drive.frame)];
  return drive.owner() == Owner::keyed ? "keyed" : "free";
}

std::string bodies_table(const StageDescription& stage, const std::string& file) {
  Table table("", {"body", "shape", ">mass, kg", ">friction", ">restitution", "starts"});
  const Stage made = make_stage(stage, file);
  for (std::size_t i = 0; i < stage.nodes.size(); ++i) {
    const NodeDescription& node = stage.nodes[i];
    if (!node.body) continue;
    const Vec3 scale = scale_at_rest(stage, i);
    const double mass =
        node.body->mass_properties
            ? node.body->mass_properties->mass
            : node.body->mass.value_or(node.body->density * volume(node.body->shape.solid) * scale.prod());
    table.row({node.name, shape_text(node.body->shape) + scale_text(scale), node.body->fixed ? "" : brief_text(mass),
               brief_text(node.body->friction), brief_text(node.body->restitution),
               owner_text(node, made.owner(i) == Owner::keyed)});
  }
  if (table.empty()) return "";
  return "bodies; gravity " + brief_text(stage.world.gravity) + " m/s^2, " + brief_text(1 / stage.step) +
         " steps per second, " + counted(stage.rules.size(), "hand-off rule") + "\n" + table.text(styled_output());
}

std::string joints_table(const StageDescription& stage) {
  constexpr const char* kinds[] = {"ball",        "hinge", "slider", "fixed", "distance", "universal",
                                   "swing_twist", "wheel", "pulley", "gear",  "spring"};
  static_assert(std::variant_size_v<JointKind> == std::size(kinds));
  Table table(counted(stage.joints.size(), "joint"), {"name", "kind", "between", ">breaks at, N", ">or N m"});
  const auto load = [](double most) { return std::isinf(most) ? std::string() : brief_text(most); };
  for (const JointDescription& joint : stage.joints)
    table.row({joint.name, kinds[joint.kind.index()],
               (joint.a == no_node ? "the world" : stage.nodes[joint.a].name) + ", " + stage.nodes[joint.b].name,
               load(joint.break_force), load(joint.break_torque)});
  return table.empty() ? "" : table.text(styled_output());
}

std::string softs_table(const StageDescription& stage) {
  Table table(counted(stage.softs.size(), "soft body", "soft bodies"),
              {"name", "solver", ">nodes", ">edges", ">triangles", ">mass, kg", ">pins"});
  for (const SoftDescription& described : stage.softs) {
    const SoftSettings& soft = described.soft;
    double mass = 0;
    for (const double one : soft.masses) mass += one;
    table.row({described.name, soft.solver == SoftSolver::springs ? "springs" : "positions",
               std::to_string(soft.positions.size()), std::to_string(soft.edges.size()),
               std::to_string(soft.triangles.size()), brief_text(mass), std::to_string(described.pins.size())});
  }
  return table.empty() ? "" : table.text(styled_output());
}

std::string vehicles_table(const StageDescription& stage) {
  Table table(counted(stage.vehicles.size(), "vehicle"), {"name", "wheel", "mount, m", ">radius, m", ">stiffness, N/m",
                                                          ">grip", ">torque, N m", ">brake, N m", ">lock, deg"});
  for (const VehicleDescription& vehicle : stage.vehicles)
    for (const WheelDescription& each : vehicle.wheels) {
      const WheelSettings& wheel = each.wheel;
      table.row({vehicle.name, each.name,
                 brief_text(wheel.mount.x()) + ", " + brief_text(wheel.mount.y()) + ", " + brief_text(wheel.mount.z()),
                 brief_text(wheel.radius), brief_text(wheel.stiffness), brief_text(wheel.grip), brief_text(each.torque),
                 brief_text(each.brake), brief_text(each.lock * 180 / std::numbers::pi)});
    }
  return table.empty() ? "" : table.text(styled_output());
}

std::string particles_table(const StageDescription& stage) {
  Table table(counted(stage.particles.size(), "kind of particles", "kinds of particles"),
              {"name", "from", ">most per second", ">speed, m/s", ">life, s", ">radius, m", ">forces"});
  for (const ParticlesDescription& particles : stage.particles)
    for (const EmitterDescription& emitter : particles.emitters) {
      const auto most = [](const Curve<double>& curve) {
        const bool endless = !std::isfinite(curve.start()) || !std::isfinite(curve.end());
        const double from = endless ? 0 : curve.start(), to = endless ? 10 : curve.end();
        return brief_text(to > from ? range(curve, from, to).high : curve.value(from));
      };
      table.row({particles.name, emitter.node == no_node ? "the world" : stage.nodes[emitter.node].name,
                 most(emitter.rate), most(emitter.speed), brief_text(particles.settings.life),
                 brief_text(particles.settings.radius), std::to_string(particles.forces.size())});
    }
  return table.empty() ? "" : table.text(styled_output());
}

/// Systems of formulas; a clip contains what follows from each.
std::string systems_table(const std::vector<ExpressionSystem>& systems) {
  Table table(counted(systems.size(), "system"),
              {"name", "variable", ">starts as", ">rate then", ">step, s", ">lasts, s", "keeps"});
  for (const ExpressionSystem& system : systems)
    for (std::size_t i = 0; i < system.variables.size(); ++i) {
      const bool first = i == 0;
      table.row({first ? system.name : "", system.variables[i], brief_text(system.start[i]),
                 brief_text(value_at(system.rates[i], 0, system.start)), first ? brief_text(system.step) : "",
                 first ? brief_text(system.duration) : "",
                 first && system.energy ? brief_text(value_at(*system.energy, 0, system.start)) : ""});
    }
  return table.empty() ? "" : table.text(styled_output());
}

std::string poses_table(const GraphDescription& graph) {
  Table table("poses of the graph " + graph.name, {"name", "is", "of"});
  for (const GraphPose& pose : graph.poses) {
    std::string of;
    for (const GraphOperand& operand : operands_of(pose.operation))
      of += (of.empty() ? "" : "; ") + (operand.clip ? "" : operand.role + ": ") + operand.pose;
    const bool shows = graph.output.empty() ? &pose == &graph.poses.back() : pose.name == graph.output;
    table.row({pose.name + (shows ? " (shows)" : ""), words_of(pose.operation), of});
  }
  return table.text(styled_output());
}

/// Of layers that reach only some nodes.
std::string masks_table(const GraphDescription& graph) {
  Table table("masks of the graph " + graph.name, {"layers", "layer", "nodes", ">share"});
  for (const GraphPose& pose : graph.poses)
    if (const auto* layers = std::get_if<LayersPose>(&pose.operation))
      for (const LayersPose::Layer& layer : layers->layers)
        for (const MaskPart& part : layer.mask)
          table.row({pose.name, layer.pose, part.joints + (part.below ? " and below" : ""), brief_text(part.weight)});
  return table.empty() ? "" : table.text(styled_output());
}

std::string setting_text(const std::string& name, const std::optional<double>& value) {
  return value ? "sets " + name + " to " + brief_text(*value) : "sends " + name;
}

std::string reactions_table(const GraphDescription& graph) {
  Table table("what the graph " + graph.name + " does on events", {"event", "does"});
  for (const GraphReaction& reaction : graph.reactions)
    table.row({reaction.event, setting_text(reaction.name, reaction.value)});
  return table.empty() ? "" : table.text(styled_output());
}

std::string inputs_table(const GraphDescription& graph) {
  Table table("inputs of the graph " + graph.name, {">time, s", "does"});
  for (const GraphInput& input : graph.inputs)
    table.row({brief_text(input.time), setting_text(input.name, input.value)});
  return table.empty() ? "" : table.text(styled_output());
}

std::string parameters_table(const GraphDescription& graph) {
  Table table("parameters of the graph " + graph.name, {"name", ">starts as", ">half-life, s", "comes from"});
  for (const GraphParameter& parameter : graph.parameters) {
    const auto inputs = std::ranges::count(graph.inputs, parameter.name, &GraphInput::name);
    const std::string from = parameter.curve ? "keys or a track"
                             : inputs > 0    ? counted(static_cast<std::size_t>(inputs), "input")
                                             : "outside";
    table.row({parameter.name, parameter.curve ? "" : brief_text(parameter.start),
               parameter.half_life > 0 ? brief_text(parameter.half_life) : "", from});
  }
  return table.empty() ? "" : table.text(styled_output());
}

std::string transitions_table(const GraphPose& pose, const MachinePose& machine) {
  Table table("machine " + pose.name + ": starts with " + machine.start, {"from", "to", "when", "how"});
  for (const GraphTransition& transition : machine.transitions) {
    std::string from;
    for (const std::string& state : transition.from) from += (from.empty() ? "" : ", ") + state;
    table.row({from.empty() ? "any" : from, transition.to, words_of(transition.when), words_of(transition.change)});
  }
  return table.text(styled_output());
}

std::string graph_tables(const StageDescription& stage) {
  std::string out;
  for (const GraphDescription& graph : stage.graphs) {
    out += parameters_table(graph) + inputs_table(graph) + reactions_table(graph) + poses_table(graph) +
           masks_table(graph);
    for (const GraphPose& pose : graph.poses)
      if (const auto* machine = std::get_if<MachinePose>(&pose.operation)) out += transitions_table(pose, *machine);
  }
  return out;
}

int inspect_file(const std::string& file) {
  const StageFile read = read_stage_file(file);
  const StageDescription& stage = read.stage;
  std::string out = nodes_table(stage) + clips_table(stage);
  if (read.document) out += systems_table(read.document->systems());
  for (const Clip& clip : stage.clips) out += tracks_table(clip) + events_table(clip);
  out += graph_tables(stage) + bodies_table(stage, file) + joints_table(stage) + softs_table(stage) +
         vehicles_table(stage) + particles_table(stage);
  print(out);
  return 0;
}

Run declare_inspect(Arguments& arguments) {
  auto file = std::make_shared<std::string>();
  arguments.file("FILE", *file, "a document or a model; - is a document on standard input");
  return [file] { return inspect_file(*file); };
}

}  // namespace

const Verb inspect_verb{"inspect", "tables of nodes, clips, tracks, speeds, jumps and bodies, of documents and models",
                        "tweenfall inspect Fox.glb", declare_inspect};

}  // namespace tweenfall::cli
