// Puts the page together, and lets programs drive it through `window.tweenfall`.

let drawQueued = false;
function requestDraw() {
  if (drawQueued) return;
  drawQueued = true;
  requestAnimationFrame(() => {
    drawQueued = false;
    drawScene();
    drawOverlay();
    curves.draw();
  });
}

// Dots and lines show the nodes if nothing else does.
state.skeleton = cast.links.length + cast.bones.size > 0 && recording.instances.length === 0;
// Without bodies that can change owner, the owners' colors say nothing.
state.byOwner = nodes.some(node => node.hasBody && !node.fixed);

const timeline = new Timeline(), curves = new Curves(), actions = actionList(timeline);

store.onChange(changed => {
  keepTimeInSight();
  updateScene();
  follow();
  timeline.update(changed);
  updateReadout();
  updateControls();
  requestDraw();
});
curvesBox.addEventListener("scroll", requestDraw);

function layOut() {
  readColors();
  applyColors();
  const emptied = fitView();
  if (framedWhole) frameAll();
  updateScene();
  // Layout happens after the animation frame callbacks: the page is painted before the next of these runs.
  if (emptied) drawScene();
  timeline.draw();
  updateReadout();
  requestDraw();
}

// The node most likely of interest: one that changes owner, else one that moves, else one with keys.
function firstChoice() {
  const handed = recording.handoffs.length ? nodes[recording.handoffs[0].node] : null;
  return handed || nodes.find(node => node.hasBody && !node.fixed && node.shown) || nodes.find(node => node.moves && node.shown) ||
    nodes.find(node => node.lanes.length) || nodes.find(node => !node.fixed) || nodes[0] || null;
}

showLegend();
showLimits();
fillHelp(actions);
wireKeys(actions);
wireControls();
layOut();
new ResizeObserver(layOut).observe(document.body);
new ResizeObserver(layOut).observe(view);
new ResizeObserver(requestDraw).observe(curvesBox);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", layOut);

// #t=0.8&node=ball opens the page at that time with that node chosen.
const asked = new URLSearchParams(location.hash.slice(1));
change({chosen: recording.named.get(asked.get("node")) || firstChoice()});
if (asked.has("t") && Number.isFinite(Number(asked.get("t")))) seek(Number(asked.get("t")));
updateReadout();
updateControls();
requestAnimationFrame(tick);

const known = name => {
  const node = recording.named.get(name);
  if (!node) throw new Error(`there is no node "${name}"`);
  return node;
};

const graphPart = (graph, parts, name) => recording.graphs.find(each => each.name === graph)[parts].find(each => each.name === name);

window.tweenfall = {
  ready: true,
  webgl: !!renderer,
  times: Array.from(times),
  nodes: nodes.map(node => node.name),
  lanes: recording.lanes.map(lane => ({name: `${lane.node.name}.${lane.property}`, keys: Array.from(lane.times),
    values: Array.from(lane.keyOf, i => lane.keys[i].value), eases: Array.from(lane.keyOf, i => lane.keys[i].ease)})),
  handoffs: recording.handoffs.map(handoff => ({...handoff, node: nodes[handoff.node].name})),
  limits: recording.limits(),
  get frame() { return recording.frameNear(state.time); },
  get time() { return state.time; },
  get playing() { return state.playing; },
  get chosen() { return state.chosen ? state.chosen.name : null; },
  get shownTime() { return [state.from, state.until]; },
  get rows() { return timeline.list.rows.map(row => (row.graph ? graphRowName(row) : row.lane ? `${row.node.name}.${row.lane.property}` : row.node.name)); },
  // At the present time: the weights of a machine's states, and the value of a parameter.
  graphs: recording.graphs.map(graph => graph.name),
  stateOf: (graph, machine) => machineStateAt(graphPart(graph, "machines", machine), state.time),
  weightsOf: (graph, machine) => {
    const part = graphPart(graph, "machines", machine), weights = stateWeightsAt(part, state.time);
    return Object.fromEntries(part.states.map((name, i) => [name, weights[i]]));
  },
  parameterOf: (graph, name) => parameterAt(graphPart(graph, "parameters", name), state.time),
  passagesOf: (graph, machine) => graphPart(graph, "machines", machine).passages,
  get state() { return {...state, chosen: state.chosen ? state.chosen.name : null}; },
  get look() { return orbit.look; },
  set look(look) { orbit.look = look; framedWhole = false; },
  onChange: listener => store.onChange(listener),
  onLook: listener => { orbit.looked = listener; },
  seek, play, pause, step, frameAll, frameChosen, zoomTime, panTime, showAllTime,
  choose: name => change({chosen: name === null ? null : known(name)}),
  fold: name => toggleFold(known(name)),
  set: values => change(values),
  // In the world, column-major, at the present time.
  worldMatrixOf: name => Array.from(matrixAt(recording, known(name), cursorNow(), new Float64Array(16))),
  // The matrix of the 3-D object that is drawn, brought back from the scene to the world.
  drawnMatrixOf: name => {
    const group = cast.groups.get(known(name));
    return group && new THREE.Matrix4().getInverse(cast.root.matrixWorld).multiply(group.matrixWorld).toArray();
  },
  twistOf: name => twistAt(recording, known(name), cursorNow()),
  ownerOf: name => recording.ownerAt(known(name), state.time),
  colorOf: owner => colors[owner],
  // In CSS pixels of the page; null when behind the camera.
  screenPositionOf: name => {
    const place = toView(centerOf(known(name), cursorNow())), box = view.getBoundingClientRect();
    return place && {x: box.left + place[0], y: box.top + place[1]};
  },
  // World positions of the vertices of mesh instance `index`, as drawn.
  verticesOf: index => Array.from(cast.deformed[index].geometry.attributes.position.array),
  // World positions of the particles named `name`, as drawn.
  particlesOf: name => {
    const found = cast.particles.find(each => each.name === name);
    return found && Array.from(found.places.array.subarray(0, 3 * found.shown));
  },
  // Vertices of the meshes drawn now, without the ground, and the positions of the nodes if only bones are drawn.
  drawnPoints: () => {
    const points = [], back = new THREE.Matrix4().getInverse(cast.root.matrixWorld), point = new THREE.Vector3();
    cast.root.traverseVisible(object => {
      if (!object.isMesh || (object.userData.node && object.userData.node.shape.plane)) return;
      const place = object.geometry.attributes.position, stride = Math.max(1, Math.floor(place.count / 3000));
      for (let i = 0; i < place.count; i += stride)
        points.push(point.fromBufferAttribute(place, i).applyMatrix4(object.matrixWorld).applyMatrix4(back).toArray());
    });
    if (!recording.instances.length && state.skeleton)
      for (const node of cast.bones) points.push(placeAt(recording, node, cursorNow()).position);
    return points;
  },
  // The box [low x, y, z, high x, y, z] around all that is drawn over the recording, and where a point of the world is
  // in the view, in CSS pixels from its corner.
  boundsOf: () => cast.bounds.box(),
  placeInView: toView,
  // The outlines of the collision shape of node `name`, in the world: [x, y, z, ...].
  colliderOf: name => {
    if (!cast.wires) cast.addWires();
    updateScene();
    const held = cast.wires.find(({node}) => node === known(name)), points = [];
    if (!held) return points;
    const back = new THREE.Matrix4().getInverse(cast.root.matrixWorld).multiply(held.wire.matrixWorld);
    const place = held.wire.geometry.attributes.position, point = new THREE.Vector3();
    for (let i = 0; i < place.count; ++i) points.push(...point.fromBufferAttribute(place, i).applyMatrix4(back).toArray());
    return points;
  },
  // The ends of joint `name` in the world, [x, y, z] each, and its axis; null once it is gone.
  jointOf: name => {
    const joint = recording.joints.find(each => each.name === name);
    if (!joint || !holdsAt(joint, state.time)) return null;
    const [a, b] = endsOf(joint, cursorNow());
    return {a: a.origin, b: b.origin, axis: a.axes.slice(0, 3)};
  },
  // What the last physics step used; null if the page does not have it. A box is [low x, y, z, high x, y, z].
  contacts: () => recording.details && contactsNow(),
  islandOf: name => { const detail = detailOf(known(name)), island = detail ? runAt(detail.island, detailFrame()) : -1;
    return island < 0 ? null : nodes[island].name; },
  asleep: name => isAsleep(known(name)),
  boxOf: name => { const detail = detailOf(known(name)); return detail && boxAt(detail, detailFrame()); },
  drawnColorOf: name => colorAt(known(name)),
  // How opaque the solid of a node is drawn; 0 if it is not drawn.
  drawnAlphaOf: name => {
    const {mesh} = cast.solids.find(({node}) => node === known(name));
    return mesh.visible ? mesh.material.opacity : 0;
  },
  // The values that the curves show in a panel at the present time.
  valuesOf: (name, panel) => gatheredAt(gather(known(name)), state.time)[panel],
  // The values that the curves show at all frames, panel by panel: position [x, y, z], velocity, rotation, angular velocity, ...
  curvesOf: name => gather(known(name)).panels.map(panel => panel.series.map(values => Array.from(values))),
  panelsOf: name => gather(known(name)).panels.map(({name: panel, unit, names}) => ({name: panel, unit, names})),
};
