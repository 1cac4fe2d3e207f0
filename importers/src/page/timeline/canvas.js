// Drawing on sharp canvases in the page's own colors.

// A context in CSS pixels, cleared; null while the canvas has no size.
function prepared(canvas) {
  const width = canvas.clientWidth, height = canvas.clientHeight, ratio = window.devicePixelRatio || 1;
  if (!width || !height) return null;
  const wide = Math.round(width * ratio), high = Math.round(height * ratio);
  if (canvas.width !== wide || canvas.height !== high) { canvas.width = wide; canvas.height = high; }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.width = width;
  context.height = height;
  return context;
}

let colors = {};
function readColors() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["paper", "panel", "line", "ink", "quiet", "sky", "ground", "grid", "accent", "keyed", "driven",
    "free", "fixed", "x", "y", "z", "w", "key", "event"]) colors[name] = style.getPropertyValue("--" + name).trim();
}
readColors();

const font = (size, weight = 400) => `${weight} ${size}px system-ui, "Segoe UI", "DejaVu Sans", sans-serif`;

function line(context, x0, y0, x1, y1, color, width = 1) {
  context.strokeStyle = color;
  context.lineWidth = width;
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

// Round steps that divide `span` into about `count` parts.
function niceStep(span, count) {
  const rough = span / Math.max(1, count), power = Math.pow(10, Math.floor(Math.log10(rough)));
  for (const factor of [1, 2, 5, 10]) if (factor * power >= rough * 0.999) return factor * power;
  return 10 * power;
}
const decimalsOf = step => Math.max(0, -Math.floor(Math.log10(step) + 1e-9));

const tip = document.getElementById("tip");
function showTip(event, text) {
  tip.hidden = !text;
  if (!text) return;
  tip.textContent = text;
  const box = tip.getBoundingClientRect();
  tip.style.left = Math.max(4, Math.min(innerWidth - box.width - 6, event.clientX + 12)) + "px";
  tip.style.top = Math.max(4, event.clientY - box.height - 10) + "px";
}

// `text` cut with an ellipsis to at most `width` px.
function fitted(context, text, width) {
  if (text.length > 400) text = text.slice(0, 400);
  if (context.measureText(text).width <= width) return text;
  let low = 0, high = text.length;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (context.measureText(text.slice(0, middle) + "\u2026").width <= width) low = middle; else high = middle - 1;
  }
  return text.slice(0, low) + "\u2026";
}

// A name at most `width` px wide. Names differ at their ends, so the middle is cut, or, if there is little room, the
// beginning.
function fittedName(context, name, width) {
  if (name.length <= 400 && context.measureText(name).width <= width) return name;
  const cut = count => name.slice(0, count < 16 ? 0 : Math.ceil(count / 3)) + "\u2026" +
    name.slice(name.length - (count < 16 ? count : Math.floor(2 * count / 3)));
  let low = 0, high = Math.min(name.length - 1, 400);
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (context.measureText(cut(middle)).width <= width) low = middle; else high = middle - 1;
  }
  return cut(low);
}
