// What the user has set: values by name, and listeners that are told of changes.

class Store {
  constructor(values) {
    this.values = values;
    this.listeners = [];
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  change(values) {
    let any = false;
    for (const name in values)
      if (!Object.is(this.values[name], values[name])) { this.values[name] = values[name]; any = true; }
    if (any) for (const listener of this.listeners) listener(values);
  }
}

const recording = new Recording(JSON.parse(document.getElementById("data").textContent));
const {nodes, times} = recording;

// `led`: another page's clock moves the time; `from` and `until`: the times that the timeline and the curves show;
// `folded`: nodes whose lanes and children are hidden; `labels`: width of the column of names, px; null: as its names
// need, within bounds; Infinity: as the longest needs.
const store = new Store({time: recording.startTime, playing: false, led: false, speed: 1, loop: true, snap: true, chosen: null, byOwner: true,
  trail: true, skeleton: false, colliders: false, joints: false, contacts: false, islands: false, boxes: false, sleepers: false, follow: false, local: false, help: false, find: "", folded: new Set(), labels: null,
  from: recording.startTime, until: recording.endTime});
const state = store.values;
const change = values => store.change(values);

// The position of the present time among the frames.
let lastCursor = null;
function cursorNow() {
  if (!lastCursor || lastCursor.time !== state.time) lastCursor = cursorAt(recording, state.time);
  return lastCursor;
}
