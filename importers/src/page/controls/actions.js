// What the keys do: one list, from which the keyboard handler and the help sheet are made.

const toggle = name => change({[name]: !state[name]});

// [keys, words, action, name shown for the key]; keys as `event.key` has them.
const actionList = timeline => [
  ["Time", [
    [[" "], "play or pause", () => (state.playing ? pause() : play()), "space"],
    [["ArrowLeft"], "one frame back; with shift ten", event => step(event.shiftKey ? -10 : -1), "\u2190"],
    [["ArrowRight"], "one frame forward; with shift ten", event => step(event.shiftKey ? 10 : 1), "\u2192"],
    [["Home"], "to the start", () => toFrame(0)],
    [["End"], "to the end", () => { pause(); toFrame(recording.frameCount - 1); }],
    [[","], "to the previous key", () => toNext(allKeyTimes(), -1)],
    [["."], "to the next key", () => toNext(allKeyTimes(), 1)],
    [["["], "to the previous event or hand-off", () => toNext(allEventTimes(), -1)],
    [["]"], "to the next event or hand-off", () => toNext(allEventTimes(), 1)],
    [["l"], "play again from the start, or stop at the end", () => toggle("loop")],
  ]],
  ["View", [
    [["a"], "show everything", frameAll],
    [["f"], "show the chosen node", frameChosen],
    [["g"], "follow the chosen node", () => toggle("follow")],
    [["c"], "color bodies by owner, or in their own colors", () => toggle("byOwner")],
    [["t"], "path of the chosen node", () => toggle("trail")],
    [["b"], "lines between nodes", () => toggle("skeleton")],
    [["x"], "shapes that collide", () => toggle("colliders")],
    [["j"], "joints: ends, axes and limits", () => toggle("joints")],
    [["k"], "contacts: points and normals", () => toggle("contacts")],
    [["i"], "islands: one color for bodies solved together", () => toggle("islands")],
    [["w"], "boxes of the search for pairs (broad phase)", () => toggle("boxes")],
    [["z"], "sleeping bodies faded", () => toggle("sleepers")],
  ]],
  ["Nodes and timeline", [
    [["ArrowUp"], "choose the node above", () => chooseNext(timeline, -1), "\u2191"],
    [["ArrowDown"], "choose the node below", () => chooseNext(timeline, 1), "\u2193"],
    [["Escape"], "choose nothing; close this sheet", () => (state.help ? change({help: false}) : change({chosen: null})), "esc"],
    [["/"], "find a node; enter chooses it", () => element("find").focus()],
    [["+", "="], "zoom in on the timeline (or wheel)", () => zoomTime(1 / 1.5), "+"],
    [["-"], "zoom out of the timeline (or wheel)", () => zoomTime(1.5), "\u2212"],
    [["0"], "all time in the timeline", showAllTime],
    [["e"], "fold the chosen node", () => state.chosen && toggleFold(state.chosen)],
    [["E"], "fold or unfold all", toggleAllFolds],
    [["s"], "snap to keys and events; hold alt to not snap", () => toggle("snap")],
    [["o"], "curves in the parent's axes or the world's", () => toggle("local")],
    [["?"], "this sheet", () => toggle("help")],
  ]],
];

function fillHelp(list) {
  element("help-lists").replaceChildren(...list.map(([title, entries]) => {
    const part = document.createElement("section"), table = document.createElement("dl");
    for (const [keys, words, , shown] of entries) table.append(cell("dt", shown || keys[0]), cell("dd", words));
    part.append(cell("h3", title), table);
    return part;
  }));
}

function wireKeys(list) {
  const actions = new Map(list.flatMap(([, entries]) => entries.flatMap(([keys, , action]) => keys.map(key => [key, action]))));
  document.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(text|search)$/.test(event.target.type || "")) return;
    if (event.target.tagName === "SELECT") return;
    const action = actions.get(event.key);
    if (!action) return;
    event.preventDefault();
    if (event.key === " " && event.target.blur) event.target.blur();
    action(event);
  });
}
