// Puts the page together, and lets a program drive it through `window.tweenfall`.

let drawQueued = false;
function requestDraw() {
  if (drawQueued) return;
  drawQueued = true;
  requestAnimationFrame(() => {
    drawQueued = false;
    drawScene();
    drawOverlay();
    drawCurves();
  });
}

onChange(changed => {
  updateScene();
  updateTimeline(changed);
  updateReadout();
  updateControls();
  requestDraw();
});

function layOut() {
  readColors();
  applyColors();
  fitView();
  updateScene();
  drawTimeline();
  requestDraw();
}

// The node that most likely interests: one that changes hands, else one that moves.
function firstChoice() {
  const handed = shownHandoffs.length ? nodes[shownHandoffs[0].node] : null;
  return handed || nodes.find(node => node.hasBody && !node.fixed) || nodes.find(node => node.matrices.length > 12) ||
    nodes[0] || null;
}

showLegend();
addRows();
wireControls();
scrubCurves();
scrubbing(ruler, rulerTip);
layOut();
orbit.yaw = 0.42;
orbit.pitch = 0.24;
frameAll();
new ResizeObserver(layOut).observe(document.body);
new ResizeObserver(layOut).observe(view);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", layOut);

// #t=0.8&node=ball opens the page at that time with that node chosen.
const asked = new URLSearchParams(location.hash.slice(1));
change({chosen: nodeNamed.get(asked.get("node")) || firstChoice()});
if (asked.has("t") && Number.isFinite(Number(asked.get("t")))) seek(Number(asked.get("t")));
updateReadout();
updateControls();
requestAnimationFrame(tick);

const known = name => {
  const node = nodeNamed.get(name);
  if (!node) throw new Error(`there is no node "${name}"`);
  return node;
};

window.tweenfall = {
  ready: true,
  webgl: !!renderer,
  times: Array.from(times),
  nodes: nodes.map(node => node.name),
  lanes: lanes.map(lane => ({name: `${lane.node.name}.${lane.property}`, keys: Array.from(lane.times)})),
  handoffs: shownHandoffs.map(handoff => ({...handoff, node: nodes[handoff.node].name})),
  get frame() { return state.frame; },
  get time() { return times[state.frame]; },
  get playing() { return state.playing; },
  get chosen() { return state.chosen ? state.chosen.name : null; },
  seek, play, pause, step,
  choose: name => change({chosen: known(name)}),
  set: values => change(values),
  // As the 3-D object that is drawn has it, column-major.
  worldMatrixOf: name => Array.from(groups[known(name).index].matrixWorld.elements),
  twistOf: name => twistOf(known(name), state.frame),
  ownerOf: name => ownerOf(known(name), state.frame),
  colorOf: owner => colors[owner],
  // In CSS pixels of the page; null when behind the camera.
  screenPositionOf: name => {
    const place = toView(centerOf(known(name), state.frame)), box = view.getBoundingClientRect();
    return place && {x: box.left + place[0], y: box.top + place[1]};
  },
  // World positions of the vertices of mesh instance `index`, as drawn.
  verticesOf: index => Array.from(deformed[index].geometry.attributes.position.array),
  // What the curves show: {position: [x, y, z], velocity: [x, y, z], speed: [..]} of all frames.
  curvesOf: name => gather(known(name)).panels.map(panel => panel.series.map(values => Array.from(values))),
};
