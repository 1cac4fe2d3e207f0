// Nothing overlaps and nothing is cut off, from a desk's screen to a phone's, by the rectangles of the elements.

import {check} from "./checks.mjs";

const parts = ["header", "#view", "#readout", "#curves", "#transport", "#timeline"];
const controls = "header h1, header #legend, header button, #transport button, #clock, #transport label, #transport select, #find";

const rectangles = (page, selector) => page.evaluate(`[...document.querySelectorAll(${JSON.stringify(selector)})]
  .filter(e => e.offsetParent !== null).map(e => {
    const b = e.getBoundingClientRect();
    return {name: e.id || e.textContent.trim() || e.tagName, box: [b.left, b.top, b.right, b.bottom],
      over: e.tagName === "H1" || e.tagName === "SELECT" || e.tagName === "INPUT" ? 0 : e.scrollWidth - e.clientWidth,
      holds: [...e.querySelectorAll("*")].map(inner => inner.id || inner.textContent.trim() || inner.tagName)};
  })`);

const apart = (a, b) => a.box[2] <= b.box[0] + 0.5 || b.box[2] <= a.box[0] + 0.5 || a.box[3] <= b.box[1] + 0.5 || b.box[3] <= a.box[1] + 0.5;

function checkRectangles(list, width, height) {
  for (const {name, box: [left, top, right, bottom], over} of list) {
    check(left >= -0.5 && top >= -0.5 && right <= width + 0.5 && bottom <= height + 0.5,
      `"${name}" is inside ${width} by ${height}: ${[left, top, right, bottom]}`);
    check(over <= 1, `"${name}" is not cut off at ${width}: ${over} px too long`);
  }
  list.forEach((a, i) => list.slice(i + 1).forEach(b => {
    if (!a.holds.includes(b.name) && !b.holds.includes(a.name))
      check(apart(a, b), `"${a.name}" and "${b.name}" do not overlap at ${width} by ${height}: ${a.box} and ${b.box}`);
  }));
}

async function fitsTheWindow(page, width, height) {
  await page.resize(width, height);
  const shown = await rectangles(page, parts.join(", "));
  check(shown.length === parts.length, `all parts are shown at ${width} by ${height}`);
  for (const {name, box: [left, top, right, bottom]} of shown)
    check(right - left > 150 && bottom - top > (name === "header" || name === "transport" ? 20 : 28), `"${name}" has room at ${width} by ${height}`);
  checkRectangles(shown, width, height);
  checkRectangles(await rectangles(page, controls), width, height);
  // What does not fit beside the rest is behind a button.
  const toggles = await rectangles(page, "#options label");
  if (!toggles.length) {
    await page.evaluate("document.getElementById('show-options').click()");
    const opened = await rectangles(page, "#options label");
    check(opened.length === 5, `the button shows what can be shown at ${width} by ${height}: ${opened.length}`);
    checkRectangles(opened, width, height);
    await page.evaluate("document.getElementById('show-options').click()");
  } else {
    checkRectangles(toggles.concat(await rectangles(page, "header h1, #legend, header button")), width, height);
  }
  // The playhead is below the times on the ruler, which are 11 pixels high from the second on.
  const [[, top], [, ruler]] = await page.evaluate(`["playhead", "ruler"].map(id => document.getElementById(id).getBoundingClientRect()).map(box => [box.left, box.top])`);
  check(top >= ruler + 13, `the playhead covers no time at ${width} by ${height}: ${top - ruler}`);
  // Rows and their names.
  const rows = await rectangles(page, "#rows .row .label");
  check(rows.length > 3, `the timeline has rows at ${width} by ${height}`);
  for (const {box: [left, , right]} of rows) check(left >= 0 && right <= 0.45 * width, `names leave room for time at ${width}: ${right}`);
}

// A canvas that gets another size is emptied, and what is shown next comes before the next animation frame: here there
// is none. The sky and the ground are light.
export async function isNeverEmpty(page) {
  await page.evaluate("window.next = window.requestAnimationFrame; window.held = []; " +
    "window.requestAnimationFrame = frame => held.push(frame); document.getElementById('view').style.marginRight = '90px'");
  await page.evaluate("new Promise(done => next.call(window, () => next.call(window, () => done(1))))");
  const picture = await page.picture();
  const [left, top, right, bottom] = (await rectangles(page, "#view"))[0].box;
  for (const [x, y] of [[0.1, 0.1], [0.9, 0.1], [0.1, 0.9], [0.9, 0.9]]) {
    const pixel = picture.at(left + x * (right - left), top + y * (bottom - top));
    check(Math.min(...pixel) > 100, `the view is drawn as soon as it has another size: ${pixel}`);
  }
  await page.evaluate("window.requestAnimationFrame = next; document.getElementById('view').style.marginRight = ''; " +
    "held.forEach(frame => next.call(window, frame))");
}

export async function fitsAllWidths(page) {
  for (const [width, height] of [[390, 844], [390, 640], [640, 480], [640, 900], [800, 600], [1024, 700], [1280, 800], [2200, 1300]])
    await fitsTheWindow(page, width, height);
  await page.resize(1280, 800);
}

// The names of eases are below the curves, at any size. Drawing is intercepted where it happens.
export async function easesCoverNoCurve(page) {
  await page.evaluate(`(() => {
    const own = CanvasRenderingContext2D.prototype, words = new Set(tweenfall.lanes.flatMap(lane => lane.eases));
    window.caught = {eases: [], curves: []};
    window.released = () => { Object.assign(own, {fillText, lineTo}); };
    const {fillText, lineTo} = own;
    const inCurves = context => context.canvas.parentElement && context.canvas.parentElement.id === "curves";
    const at = (context, y) => context.canvas.offsetTop + y;
    own.fillText = function (text, x, y) {
      if (inCurves(this) && words.has(text)) caught.eases.push(at(this, y));
      return fillText.call(this, text, x, y);
    };
    own.lineTo = function (x, y) {
      if (inCurves(this) && this.lineWidth > 1.55 && this.lineWidth < 1.65) caught.curves.push(at(this, y));
      return lineTo.call(this, x, y);
    };
  })()`);
  await page.evaluate("tweenfall.choose('floor'); tweenfall.choose('crate'); tweenfall.showAllTime()");
  for (const width of [1280, 640, 390]) {
    await page.resize(width, 800);
    await page.evaluate("caught.eases = []; caught.curves = []; tweenfall.seek(tweenfall.time === 1 ? 1.25 : 1)");
    await page.drawn();
    const {eases, curves} = await page.evaluate("caught");
    check(eases.length >= 1 && curves.length > 100, `eases and curves are drawn at ${width}: ${eases.length} and ${curves.length}`);
    const near = eases.map(ease => Math.min(...curves.map(y => Math.abs(y - ease))));
    check(Math.min(...near) > 6, `no ease covers a curve at ${width}: ${Math.min(...near)} px`);
  }
  await page.evaluate("released()");
  await page.resize(1280, 800);
}

// The column of names is as wide as they need, can be dragged, and shows the longest on a double click.
export async function namesFit(page) {
  const cut = () => page.evaluate("[...document.querySelectorAll('#rows .name')].filter(name => name.scrollWidth > name.clientWidth || name.textContent.includes('\\u2026')).map(name => name.textContent)");
  const column = () => page.evaluate("document.querySelector('#rows .label').getBoundingClientRect().right");
  for (const width of [1280, 640, 390]) {
    await page.resize(width, 800);
    check((await cut()).length === 0, `names are not cut at ${width}: ${await cut()}`);
  }
  const y = await page.evaluate("document.getElementById('timeline').getBoundingClientRect().top + 60");
  await page.drag(await column(), y, 90, y);
  await page.drawn();
  check(Math.abs(await column() - 90) < 2, `the column of names is dragged: ${await column()}`);
  check((await cut()).length > 0, "what is dragged too narrow cuts names");
  await page.evaluate("document.getElementById('divider').dispatchEvent(new MouseEvent('dblclick'))");
  await page.drawn();
  check((await cut()).length === 0, `a double click shows the longest name: ${await cut()}`);
  await page.evaluate("tweenfall.set({labels: null})");
  await page.resize(1280, 800);
}
