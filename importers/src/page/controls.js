// Buttons, boxes, keys, the numbers of the chosen node, and choosing in the view.

const element = id => document.getElementById(id);

function showLegend() {
  if (!nodes.some(node => node.hasBody && !node.fixed)) return;
  const words = ["keyed", "driven", "free", "fixed"].filter(word => word === "fixed"
    ? nodes.some(node => node.fixed && !node.shape.plane)
    : word !== "driven" || nodes.some(node => node.runs.some(run => run[1] === "driven")));
  element("legend").replaceChildren(...words.map(word => {
    const item = document.createElement("li"), patch = document.createElement("i");
    patch.style.background = `var(--${word})`;
    item.append(patch, word);
    return item;
  }));
}

function updateReadout() {
  const box = element("readout"), node = state.chosen;
  element("clock").innerHTML = `<b>${times[state.frame].toFixed(3)}</b> <span>s of ${endTime.toFixed(3)}, ` +
    `frame ${state.frame}</span>`;
  if (!node) { box.innerHTML = "<h2><span>nothing chosen</span></h2>"; return; }
  const place = positionOf(node, state.frame), twist = twistOf(node, state.frame);
  const owner = node.fixed ? "fixed" : ownerOf(node, state.frame);
  const line = (name, values, unit) => `<dt>${name}</dt>` + values.map(value => `<dd>${number(value)}</dd>`).join("") +
    `<dd class="unit">${unit}</dd>`;
  box.innerHTML = `<h2><span></span><span class="owner ${owner}" style="background: var(--${owner})">${owner}</span></h2><dl>` +
    line("position", place, "m") + line("velocity", twist.slice(0, 3), "m/s") + line("angular", twist.slice(3), "rad/s") +
    `<dt>speed</dt><dd>${number(Math.hypot(...twist.slice(0, 3)))}</dd><dd></dd><dd></dd><dd class="unit">m/s</dd></dl>`;
  box.querySelector("h2 span").textContent = node.name;
}

function updateControls() {
  element("play-icon").setAttribute("d", state.playing ? "M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z" : "M4 2.5v11L13 8z");
  element("play").setAttribute("aria-label", state.playing ? "Pause" : "Play");
  for (const [id, name] of [["by-owner", "byOwner"], ["trail", "trail"], ["skeleton", "skeleton"],
    ["colliders", "colliders"], ["loop", "loop"]]) element(id).checked = state[name];
  element("speed").value = String(state.speed);
}

const toggle = name => change({[name]: !state[name]});
const frameAll = () => orbit.frame(extent.corners);

function wireControls() {
  element("play").addEventListener("click", () => (state.playing ? pause() : play()));
  element("to-start").addEventListener("click", () => toFrame(0));
  element("to-end").addEventListener("click", () => { pause(); toFrame(frameCount - 1); });
  element("back").addEventListener("click", event => step(event.shiftKey ? -10 : -1));
  element("forward").addEventListener("click", event => step(event.shiftKey ? 10 : 1));
  element("speed").addEventListener("change", event => change({speed: Number(event.target.value)}));
  for (const [id, name] of [["by-owner", "byOwner"], ["trail", "trail"], ["skeleton", "skeleton"],
    ["colliders", "colliders"], ["loop", "loop"]])
    element(id).addEventListener("change", event => change({[name]: event.target.checked}));
  element("frame-all").addEventListener("click", frameAll);
  element("find").addEventListener("input", event => filterRows(event.target.value));
  view.addEventListener("click", event => {
    if (orbit.travelled > 5) return;
    const box = view.getBoundingClientRect();
    const node = nodeAtPoint(event.clientX - box.left, event.clientY - box.top);
    if (node) change({chosen: node});
  });
  document.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(text|search)$/.test(event.target.type || "")) return;
    if (event.target.tagName === "SELECT") return;
    const actions = {
      " ": () => (state.playing ? pause() : play()), ArrowLeft: () => step(event.shiftKey ? -10 : -1),
      ArrowRight: () => step(event.shiftKey ? 10 : 1), Home: () => toFrame(0),
      End: () => { pause(); toFrame(frameCount - 1); }, f: frameAll, l: () => toggle("loop"),
      c: () => toggle("byOwner"), t: () => toggle("trail"), b: () => toggle("skeleton"), x: () => toggle("colliders"),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    if (event.key === " " && event.target.blur) event.target.blur();
    actions[event.key]();
  });
}
