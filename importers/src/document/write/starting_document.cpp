#include <tweenfall/importers/document.h>

namespace tweenfall {

std::string starting_document() {
  return R"({
  // A ball that a clip throws and physics catches. Lines like this one are for people; a reader passes over them.
  "tweenfall": 1,
  "name": "a start",

  // Times are seconds, or frames such as "12f" of these.
  "fps": 24,

  // What there is: where it stands (meters), and what it is made of. Without "mass", density 1000 kg/m^3 counts.
  "nodes": {
    "floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}},
    "ball": {
      "position": [-1, 1, 0],
      "color": "#ffd27a",
      "body": {"shape": {"sphere": {"radius": 0.25}}, "mass": 1, "restitution": 0.4, "rolling_friction": 0.1}
    }
  },

  // How it moves: keys are [time, value] or [time, value, ease], the ease being how the curve leaves the key.
  // Angles are degrees. In place of keys a track can have a function: {"spring": ...}, {"spline": ...}, {"path": ...},
  // {"expression": "2*t^2"}, ...
  "clips": {
    "swing up": {
      "tracks": {
        "ball.position": [[0, [-1, 1, 0]], ["12f", [-0.8, 0.6, 0], "smooth"], [1, [-0.2, 1.2, 0]]],
        "ball.rotation": {"axis": "z", "keys": [[0, 0, "linear"], [1, -360]]}
      },
      "events": [[0.9, "let go"]]
    }
  },

  // How the world moves it: gravity in m/s^2, and the length of a step.
  "world": {"gravity": [0, -9.81, 0], "step": "1/240"},

  // Who moves it when: the clip until its event, then physics with the clip's own velocity, and once it has lain still
  // for half a second the clip again, from its start.
  "handoff": [
    {"body": "ball", "when": {"marker": "let go"}, "to": "free"},
    {"body": "ball", "when": {"asleep": 0.5}, "to": "keyed", "path": {"clip": "swing up", "time": "restart"}, "settle": {"quintic": 0.6}}
  ]
}
)";
}

}  // namespace tweenfall
