// The dope sheet: the ruler, the playhead, and the visible rows, made from a pool of elements.

const ruler = document.querySelector("#ruler .strip");
const rowsBox = document.getElementById("rows");
const rowsFill = document.getElementById("rows-fill");
const playhead = document.getElementById("playhead");

class Timeline {
  constructor() {
    this.pool = [];
    this.list = visibleRows();
    rowsBox.addEventListener("scroll", () => this.place());
    wireLabels();
    wireAxis(ruler, {hover: x => rulerTip(x, ruler.clientWidth), snaps: () => allEventTimes().concat(
      state.chosen ? keyTimesOf(state.chosen) : [])});
  }

  element() {
    const element = document.createElement("div"), label = document.createElement("button");
    const fold = document.createElement("span"), dot = document.createElement("i"), name = document.createElement("span");
    const canvas = document.createElement("canvas"), held = {element, label, fold, dot, name, canvas, row: null};
    label.className = "label";
    fold.className = "fold";
    name.className = "name";
    canvas.className = "strip";
    label.append(fold, dot, name);
    element.append(label, canvas);
    rowsFill.append(element);
    label.addEventListener("click", () => held.row.node && change({chosen: held.row.node}));
    fold.addEventListener("click", event => {
      if (!held.row.folds) return;
      event.stopPropagation();
      toggleFold(held.row.node, event.shiftKey);
    });
    wireAxis(canvas, {pans: true, hover: x => stripTip(held.row, x, canvas.clientWidth),
      snaps: () => (held.row.graph ? graphSnaps(held.row) : held.row.lane ? Array.from(held.row.lane.times) : keyTimesOf(held.row.node))});
    return held;
  }

  // Gives each visible row an element, and draws it.
  place() {
    const {rows, height} = this.list, above = rowsBox.scrollTop - 200, below = rowsBox.scrollTop + rowsBox.clientHeight + 200;
    rowsFill.style.height = height + "px";
    let first = Math.max(0, lastNotAbove(rows.length, i => rows[i].top, above)), count = 0;
    for (; first + count < rows.length && rows[first + count].top < below; ++count) {
      if (count >= this.pool.length) this.pool.push(this.element());
      this.fill(this.pool[count], rows[first + count]);
    }
    for (const held of this.pool.splice(count)) held.element.remove();
  }

  fill(held, row) {
    const {element, label, fold, dot, name, canvas} = held;
    held.row = row;
    if (row.graph) return this.fillGraph(held, row);
    element.className = "row" + (row.lane ? " lane" : "") + (row.node === state.chosen ? " chosen" : "");
    element.style.transform = `translateY(${row.top}px)`;
    label.style.paddingLeft = indentOf(row) + "px";
    label.title = rowName(row);
    fold.textContent = row.folds ? row.folded ? "\u25b8" : "\u25be" : "";
    dot.hidden = !!row.lane;
    dot.style.background = row.node.hasBody ? colors[recording.shownOwner(row.node, state.time)] : "";
    name.textContent = shownName(row, rowLabel(row));
    drawStrip(canvas, row);
  }

  fillGraph(held, row) {
    const {element, label, fold, dot, canvas} = held;
    element.className = "row graph" + (row.part && !row.part.states ? " lane" : "");
    element.style.transform = `translateY(${row.top}px)`;
    label.style.paddingLeft = indentOf(row) + "px";
    label.title = rowName(row);
    fold.textContent = "";
    dot.hidden = true;
    this.nameGraph(held);
    drawStrip(canvas, row);
  }

  nameGraph({name, row}) {
    name.textContent = shownName(row, row.part ? `${row.part.name}: ${graphNow(row)}` : row.graph.name);
  }

  // Builds the rows again, after folding or searching.
  rebuild() {
    this.list = visibleRows();
    if (fitLabels(this.list.rows)) this.draw();
    else this.place();
  }

  drawPlayhead() {
    const box = ruler.getBoundingClientRect(), left = document.getElementById("timeline").getBoundingClientRect().left;
    const x = xOfTime(state.time, box.width);
    playhead.hidden = x < -1 || x > box.width + 1;
    playhead.style.transform = `translateX(${box.left - left + x - 0.75}px)`;
  }

  showChosen() {
    const row = state.chosen && this.list.rows.find(candidate => candidate.node === state.chosen);
    if (!row) return;
    // Scrolls so far that its lanes are visible, too, as far as there is room.
    const own = this.list.rows.filter(candidate => candidate.node === row.node).pop();
    const bottom = own.top + rowHeight(own);
    if (bottom > rowsBox.scrollTop + rowsBox.clientHeight) rowsBox.scrollTop = bottom - rowsBox.clientHeight;
    if (row.top < rowsBox.scrollTop) rowsBox.scrollTop = row.top;
  }

  update(changed) {
    if ("find" in changed || "folded" in changed) this.rebuild();
    if ("labels" in changed) this.draw();
    if ("chosen" in changed && state.chosen) {
      unfoldTo(state.chosen);
      this.showChosen();
    }
    if ("from" in changed || "chosen" in changed) this.place();
    if ("from" in changed) drawRuler(ruler);
    if ("time" in changed)
      for (const held of this.pool) if (held.row.graph) this.nameGraph(held);
    if ("time" in changed)
      for (const {row, dot} of this.pool) if (row.node && row.node.hasBody) dot.style.background = colors[recording.shownOwner(row.node, state.time)];
    this.drawPlayhead();
  }

  draw() {
    fitLabels(this.list.rows);
    drawRuler(ruler);
    this.place();
    this.drawPlayhead();
  }
}

// Chooses the neighbor of the chosen node in the list.
function chooseNext(timeline, direction) {
  const list = timeline.list.rows.filter(row => row.node && !row.lane), at = list.findIndex(row => row.node === state.chosen);
  if (list.length) change({chosen: list[Math.min(list.length - 1, Math.max(0, at < 0 ? 0 : at + direction))].node});
}

// Chooses the first node that the search finds, or the next one if the chosen node is among the results.
function chooseFound() {
  const found = state.find.trim() ? visibleRows().rows.filter(row => !row.lane).map(row => row.node) : [];
  const exact = found.filter(node => node.name.toLowerCase() === state.find.trim().toLowerCase());
  const at = found.indexOf(state.chosen);
  if (found.length) change({chosen: at < 0 ? exact[0] || found[0] : found[(at + 1) % found.length]});
  return found.length;
}
