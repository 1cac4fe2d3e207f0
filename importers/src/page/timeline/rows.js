// The rows of the timeline: those of graphs, then one per node, with one lane per track and its children below it unless it
// is folded; or, while searching, all rows whose names contain the text.

// Fixed nodes without children come last.
const standsThere = node => node.fixed && !node.children.length;
const rootNodes = nodes.filter(node => node.parent < 0).sort((a, b) => standsThere(a) - standsThere(b));
const rowHeight = row => (row.lane || (row.part && !row.part.states) ? 18 : 23);

const rowLabel = row => (row.graph ? (row.part ? row.part.name : row.graph.name)
  : row.lane ? row.lane.property : row.node.name) || "(no name)";
const rowName = row => (row.graph ? graphRowName(row) : row.lane ? `${row.node.name}.${row.lane.property}` : row.node.name);
// The indent of a row, px; smaller on a narrow page, where names need the room.
const indentOf = row => 4 + (innerWidth > 520 ? 11 : 4) * Math.min(6, row.depth + (row.lane ? 1 : 0));

function visibleRows() {
  const rows = [], wanted = state.find.trim().toLowerCase();
  let top = 0;
  const add = row => {
    rows.push({...row, top});
    top += rowHeight(row);
  };
  const open = (node, depth) => {
    const folds = node.lanes.length + node.children.length > 0, folded = !wanted && state.folded.has(node);
    add({node, lane: null, depth, folds, folded});
    if (!folded) for (const lane of node.lanes) add({node, lane, depth});
    return !folded;
  };
  if (wanted) {
    for (const node of nodes) if (node.name.toLowerCase().includes(wanted)) open(node, 0);
    return {rows, height: top};
  }
  for (const {graph, part} of graphRows) add({node: null, lane: null, graph, part, depth: part ? 1 : 0});
  // Without recursion: chains of nodes may be thousands long.
  const waiting = rootNodes.map(node => [node, 0]).reverse();
  while (waiting.length) {
    const [node, depth] = waiting.pop();
    if (open(node, depth)) for (let i = node.children.length - 1; i >= 0; --i) waiting.push([node.children[i], depth + 1]);
  }
  return {rows, height: top};
}

function toggleFold(node, all = false) {
  const folded = new Set(state.folded), fold = !folded.has(node);
  const family = new Set([node]);
  if (all) for (const other of nodes) if (other.parent >= 0 && family.has(nodes[other.parent])) family.add(other);
  for (const each of family) if (fold) folded.add(each); else folded.delete(each);
  change({folded});
}
function toggleAllFolds() {
  change({folded: state.folded.size ? new Set() : new Set(nodes.filter(node => node.lanes.length + node.children.length > 0))});
}
// Unfolds the ancestors that hide a node.
function unfoldTo(node) {
  const folded = new Set(state.folded);
  for (let n = nodes[node.parent]; n; n = nodes[n.parent]) folded.delete(n);
  if (folded.size !== state.folded.size) change({folded});
}
