// The column of names beside the timeline: as wide as its names need, within bounds, or as it was dragged.

const divider = document.getElementById("divider");
const leastLabels = 110, leastStrip = 90;          // px
const mostLabels = 290, mostShareOfLabels = 0.42;  // px and of the timeline, unless it is dragged wider

// The width that a row needs besides its name's: for the fold sign, the dot and the gaps.
const besideName = row => indentOf(row) + (row.node && !row.lane ? 46 : 34);

const nameWidths = new Map();
const measuring = document.createElement("canvas").getContext("2d");
function nameWidth(text, small) {
  const key = (small ? "s" : "l") + text;
  if (!nameWidths.has(key)) {
    measuring.font = small ? font(11) : font(13, 650);
    // Names far longer than any screen need not be measured in full.
    nameWidths.set(key, measuring.measureText(text.slice(0, 400)).width);
  }
  return nameWidths.get(key);
}
// The longest text that the row of a machine (a state) or a parameter (a number) shows after its name.
const longestNow = row => (row.part ? row.part.states ? ["", ...row.part.states].reduce((a, b) => (b.length > a.length ? b : a)) : "-000.000" : "");
const labelWidth = row => besideName(row) +
  nameWidth(rowLabel(row) + (row.part ? ": " + longestNow(row) : ""), !!row.lane || (row.part && !row.part.states));

// A row's name, cut to the width of the column.
function shownName(row, text) {
  const small = !!row.lane || (row.part && !row.part.states), room = columnWidth - besideName(row);
  if (nameWidth(text, small) <= room) return text;
  measuring.font = small ? font(11) : font(13, 650);
  return fittedName(measuring, text, room);
}

// Sets the column to its right width; returns whether the width changed.
let columnWidth = 200;  // px
function fitLabels(rows) {
  const box = document.getElementById("timeline"), most = Math.max(leastLabels, box.clientWidth - leastStrip);
  let wide = state.labels;
  if (wide === null) {
    const longest = rows.reduce((widest, row) => Math.max(widest, labelWidth(row)), leastLabels);
    wide = Math.min(longest, mostLabels, Math.max(leastLabels, mostShareOfLabels * box.clientWidth));
  } else if (wide === Infinity) {
    wide = rows.reduce((widest, row) => Math.max(widest, labelWidth(row)), leastLabels);
  }
  columnWidth = Math.ceil(Math.min(most, Math.max(60, wide)));
  const text = columnWidth + "px";
  if (box.style.getPropertyValue("--label") === text) return false;
  box.style.setProperty("--label", text);
  return true;
}

// Dragging makes the column wider or narrower; a double click fits its longest name, and another undoes that.
function wireLabels() {
  divider.addEventListener("pointerdown", event => {
    event.preventDefault();
    divider.setPointerCapture(event.pointerId);
  });
  divider.addEventListener("pointermove", event => {
    if (!event.buttons) return;
    change({labels: Math.max(60, event.clientX - document.getElementById("timeline").getBoundingClientRect().left)});
  });
  divider.addEventListener("dblclick", () => change({labels: state.labels === Infinity ? null : Infinity}));
}
