// The timeline of the example: zooming, panning, folding, finding, keys, snapping, the help sheet.

import {check, equal, near} from "./checks.mjs";

const boxOf = (page, selector) => page.evaluate(`(({left, top, width, height}) => ({left, top, width, height}))` +
  `(document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect())`);
const timeNow = page => page.evaluate("tweenfall.time");

async function zoomsAndPans(page) {
  await page.evaluate("tweenfall.choose('bob')");
  await page.drawn();
  const ruler = await boxOf(page, "#ruler .strip"), strip = await boxOf(page, "#rows .chosen .strip");
  const x = ruler.left + 10 + (ruler.width - 20) / 3, y = ruler.top + ruler.height / 2;
  await page.wheel(x, y, -300);
  const [from, until] = await page.evaluate("tweenfall.shownTime");
  check(until - from < 2.6 && until - from > 1, `the wheel zooms in: ${from} to ${until}`);
  near([(1 - from) / (until - from)], [1 / 3], "the instant under the pointer stays there", 1e-3);
  await page.drag(strip.left + 400, strip.top + 8, strip.left + 300, strip.top + 8);
  const moved = await page.evaluate("tweenfall.shownTime");
  near([moved[0] - from], [100 / (strip.width - 20) * (until - from)], "a drag along a row pans by as much", 1e-3);
  near([moved[1] - moved[0]], [until - from], "panning keeps the zoom", 1e-9);
  await page.click(x, y);
  near([await timeNow(page)], [moved[0] + (until - from) / 3], "a click goes to its instant also when zoomed in", 0.02);
  await page.wheel(x, y, 3000);
  for (let i = 0; i < 10; ++i) await page.wheel(x, y, 300);
  equal(JSON.stringify(await page.evaluate("tweenfall.shownTime")), "[0,3]", "zooming out ends at the whole recording");
  for (let i = 0; i < 60; ++i) await page.evaluate("tweenfall.zoomTime(0.5, 1)");
  const [near0, near1] = await page.evaluate("tweenfall.shownTime");
  check(near1 > near0 && near0 <= 1 && near1 >= 1, `zooming in ends at some stretch: ${near0} to ${near1}`);
  await page.key("0");
  equal(JSON.stringify(await page.evaluate("tweenfall.shownTime")), "[0,3]", "0 shows all time");
}

async function folds(page) {
  const rows = () => page.evaluate("tweenfall.rows");
  const before = await rows();
  check(before.includes("bob") && before.includes("pivot.rotation"), "children and tracks have rows");
  await page.evaluate("[...document.querySelectorAll('#rows .row')].find(row => row.innerText.includes('pivot')).querySelector('.fold').click()");
  const after = await rows();
  check(after.includes("pivot") && !after.includes("bob") && !after.includes("pivot.rotation"), `folding hides what is below: ${after}`);
  await page.evaluate("tweenfall.choose('floor')");
  await page.evaluate("tweenfall.choose('bob')");
  check((await rows()).includes("bob"), "choosing what is folded away opens it");
  await page.key("E");
  check((await rows()).length < before.length, "E folds all");
  await page.key("E");
  equal((await rows()).join(), before.join(), "and opens all");
}

async function finds(page) {
  await page.evaluate("tweenfall.choose('floor')");
  await page.key("/");
  await page.type("reed");
  check((await page.evaluate("tweenfall.rows")).every(row => row.startsWith("reed/")), "the list holds what is found");
  await page.key("Enter");
  equal(await page.evaluate("tweenfall.chosen"), "reed/0", "enter chooses the first that is found");
  await page.key("Enter");
  equal(await page.evaluate("tweenfall.chosen"), "reed/1", "enter again, the next");
  await page.key("Escape");
  equal(await page.evaluate("tweenfall.rows.length > 4 && document.activeElement.id !== 'find'"), true, "escape ends the search");
  await page.evaluate("tweenfall.choose('reed/2')");
  await page.key("ArrowUp");
  equal(await page.evaluate("tweenfall.chosen"), "reed/1", "the up arrow chooses the node above");
}

async function jumpsToKeys(page) {
  await page.evaluate("tweenfall.choose('crate'); tweenfall.seek(0.3)");
  const times = [];
  for (const key of [".", ".", ".", ",", "[", "]", "]"]) {
    await page.key(key);
    times.push(await timeNow(page));
  }
  // Keys at 0, 0.5, 1.5, ..., hand-offs at 1 and 1.6; events at 0.75, 1.2 and the hand-offs.
  near(times, [0.5, 1, 1.5, 1, 0.75, 1, 1.2], "keys go to the next and the previous key and event", 1e-9);
}

async function snaps(page) {
  const strip = await page.evaluate("(({left, top, width, height}) => ({left, top, width, height}))([...document.querySelectorAll('#rows .lane')]" +
    ".find(row => row.innerText.includes('position')).querySelector('.strip').getBoundingClientRect())");
  const x = strip.left + 10 + (strip.width - 20) * 0.5 / 3 + 4, y = strip.top + 8;
  await page.click(x, y);
  near([await timeNow(page)], [0.5], "near a key, scrubbing snaps to it", 1e-12);
  await page.key("s");
  await page.click(x, y);
  check(Math.abs(await timeNow(page) - 0.5) > 0.005, "without snapping it does not");
  await page.key("s");
}

async function helps(page) {
  await page.key("?");
  const words = await page.evaluate("document.getElementById('help').hidden ? '' : document.getElementById('help').innerText");
  for (const told of ["next key", "next event", "chosen node", "space", "fold"]) check(words.includes(told), `the help sheet tells of "${told}"`);
  const box = await boxOf(page, "#help");
  check(box.top >= 0 && box.left >= 0 && box.height <= 800, "the help sheet fits");
  await page.key("Escape");
  equal(await page.evaluate("document.getElementById('help').hidden"), true, "escape closes it");
}

async function framesAndFollows(page) {
  const place = () => page.evaluate("tweenfall.screenPositionOf('roller')");
  const view = await boxOf(page, "#view");
  await page.evaluate("tweenfall.choose('roller'); tweenfall.seek(0)");
  await page.key("f");
  const middle = await place();
  const [left, top, right, bottom] = await page.evaluate(`(() => {
    const points = tweenfall.colliderOf("roller"), x = [], y = [];
    for (let i = 0; i < points.length; i += 3) {
      const place = tweenfall.placeInView(points.slice(i, i + 3));
      x.push(place[0]);
      y.push(place[1]);
    }
    return [Math.min(...x), Math.min(...y), Math.max(...x), Math.max(...y)];
  })()`);
  check(left > 0 && top > 0 && right < view.width && bottom < view.height, `f brings the chosen node into the view: ${[left, top, right, bottom]}`);
  check(bottom - top > 0.4 * view.height || right - left > 0.6 * view.width, `f comes near: ${right - left} by ${bottom - top} px`);
  await page.evaluate("tweenfall.seek(2)");
  const gone = await place();
  check(Math.hypot(gone.x - middle.x, gone.y - middle.y) > 60, "without following the node leaves");
  await page.evaluate("tweenfall.seek(0)");
  await page.key("g");
  await page.evaluate("tweenfall.seek(2)");
  const held = await place();
  check(Math.hypot(held.x - middle.x, held.y - middle.y) < 2, "following keeps the node in its place");
  await page.key("g");
  await page.key("a");
}

// The outlines of colliders: the crate of 0.5 m, the capsule of radius 0.15 m and half height 0.3 m.
async function showsColliders(page) {
  await page.evaluate("tweenfall.seek(0)");
  const reach = async name => {
    const points = await page.evaluate(`tweenfall.colliderOf(${JSON.stringify(name)})`), low = [9e9, 9e9, 9e9], high = [-9e9, -9e9, -9e9];
    points.forEach((value, i) => { low[i % 3] = Math.min(low[i % 3], value); high[i % 3] = Math.max(high[i % 3], value); });
    return high.map((value, i) => value - low[i]);
  };
  near(await reach("crate"), [0.5, 0.5, 0.5], "the crate's collider has its size", 1e-5);
  near(await reach("roller"), [0.9, 0.3, 0.3], "the capsule's collider lies along x", 2e-3);
  near(await reach("bob"), [0.4, 0.4, 0.4], "the ball's collider is round", 2e-3);
  equal((await reach("floor"))[0] < 0, true, "a plane has no outline");
}

// The machine passes at 1 s and fades for 0.5 s; the parameter is twice the time.
async function showsGraphs(page) {
  const rows = await page.evaluate("tweenfall.rows");
  equal(rows.slice(0, 3).join(), "figure,figure.legs,figure.speed", "a graph, its machines and its parameters have rows");
  const at = async time => {
    await page.evaluate(`tweenfall.seek(${time})`);
    return page.evaluate("[tweenfall.stateOf('figure', 'legs'), tweenfall.weightsOf('figure', 'legs').walk, tweenfall.parameterOf('figure', 'speed')]");
  };
  const expected = [[0.9, "stand", 0, 1.8], [1.25, "walk", 0.5, 2.5], [2, "walk", 1, 4]];
  for (const [time, state, weight, value] of expected) {
    const [found, share, number] = await at(time);
    equal(found, state, `the state at ${time} s`);
    near([share, number], [weight, value], `its weight and the parameter at ${time} s`, 1e-5);
    const label = await page.evaluate("[...document.querySelectorAll('#rows .row.graph .name')].map(name => name.textContent).join()");
    equal(label, `figure,legs: ${state},speed: ${value.toFixed(3)}`, `the labels at ${time} s`);
  }
  await page.evaluate("document.getElementById('rows').scrollTop = 0");
  await page.drawn();
  const strip = await boxOf(page, "#rows .row.graph:nth-child(2) .strip");
  await page.click(strip.left + 10 + (strip.width - 20) / 3 + 3, strip.top + 8);
  check(await page.until("tweenfall.time === 1"), "scrubbing snaps to where a machine passed");
}

export async function drivesTheTimeline(page) {
  for (const test of [showsGraphs, zoomsAndPans, folds, finds, jumpsToKeys, snaps, helps, framesAndFollows, showsColliders]) await test(page);
}
