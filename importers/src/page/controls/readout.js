// The clock, the numbers of the chosen node, the legend, and what the page cannot show.

const element = id => document.getElementById(id);

function showLegend() {
  if (!nodes.some(node => node.hasBody && !node.fixed)) return;
  const words = ["keyed", "driven", "free", "fixed"].filter(word => word === "fixed"
    ? nodes.some(node => node.fixed && !node.shape.plane)
    : nodes.some(node => node.hasBody && !node.fixed && node.runs.some(run => run[1] === word)));
  element("legend").replaceChildren(...words.map(word => {
    const item = document.createElement("li"), patch = document.createElement("i");
    patch.style.background = `var(--${word})`;
    item.append(patch, word);
    return item;
  }));
}

function showLimits() {
  const said = recording.limits();
  element("limits").hidden = !said.length;
  element("limits-text").textContent = said.join(" ");
}

const cell = (name, text, kind = "") => {
  const made = document.createElement(name);
  made.textContent = text;
  if (kind) made.className = kind;
  return made;
};

// A narrow page shows four digits of a number, and all of them when pointed at.
const digitsOf = (value, digits) => innerWidth > 860 ? digits
  : Math.max(0, Math.min(digits, 3 - Math.floor(Math.log10(Math.max(1, Math.abs(value))))));
const numberCell = (value, digits) => {
  const made = cell("dd", number(value, digitsOf(value, digits)));
  made.title = number(value, digits);
  return made;
};

function updateReadout() {
  const box = element("readout"), node = state.chosen, clock = element("clock");
  clock.replaceChildren(cell("b", number(state.time)), cell("span", ` s of ${number(recording.endTime)}`, "of"),
    cell("span", `, frame ${recording.frameNear(state.time)}`, "frame"));
  const head = document.createElement("h2");
  if (!node) { head.append(cell("span", "nothing chosen")); box.replaceChildren(head); return; }
  const owner = node.fixed ? "fixed" : recording.ownerAt(node, state.time), name = cell("span", "");
  measuring.font = font(14, 650);
  name.textContent = fittedName(measuring, node.name || "(no name)", box.clientWidth - 26 - (node.hasBody ? 80 : 0));
  name.title = node.name;
  head.append(name);
  if (node.hasBody) {
    head.append(cell("span", owner, "owner " + owner));
    head.lastChild.style.background = `var(--${owner})`;
  }
  const list = document.createElement("dl"), row = (title, values, unit, digits = 3) => list.append(cell("dt", title),
    ...[0, 1, 2].map(i => i < values.length ? numberCell(values[i], digits) : cell("dd", "")), cell("dd", unit, "unit"));
  if (node.shown) {
    const numbers = gatheredAt(gather(node), state.time);
    row("position", numbers.position, "m");
    row("rotation", numbers.rotation, "\u00b0", 2);
    row("velocity", numbers.velocity, "m/s");
    row("angular", numbers.angular, "rad/s");
    row("speed", [Math.hypot(...numbers.velocity)], "m/s");
  }
  box.replaceChildren(head, list);
}
