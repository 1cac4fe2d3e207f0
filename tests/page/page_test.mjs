// What the page shows, checked against the recording as JSON: page_test.mjs FOLDER with example.html and example.json.

import {readFileSync, writeFileSync} from "node:fs";
import {join, resolve} from "node:path";
import {pathToFileURL} from "node:url";
import {findBrowser, Page} from "./browser.mjs";
import {check, equal, near, summary} from "./checks.mjs";
import {frameModels} from "./model_tests.mjs";
import {showsActors} from "./actor_tests.mjs";
import {showHostile, showLarge} from "./hostile_tests.mjs";
import {easesCoverNoCurve, fitsAllWidths, isNeverEmpty, namesFit} from "./layout_tests.mjs";
import {showsTwoBesideEachOther} from "./beside_tests.mjs";
import {showsJoints, showsSteps} from "./overlay_tests.mjs";
import {pressesEveryKey} from "./help_tests.mjs";
import {framesTheLinked, holdsUntilTheEnd, leapsWhereTheScriptDoes, saysEasesOnce, tellsNamesApart} from "./shown_tests.mjs";
import {drivesTheTimeline} from "./timeline_tests.mjs";

const browser = findBrowser();
if (!browser) {
  console.error("SKIPPED: the page: no Chromium is installed (Debian: chromium)");
  process.exit(77);
}
const folder = resolve(process.argv[2]);
const recording = JSON.parse(readFileSync(join(folder, "example.json"), "utf8"));
const fine = JSON.parse(readFileSync(join(folder, "example_fine.json"), "utf8"));
const address = pathToFileURL(join(folder, "example.html")).href;

// Column-major matrix of a position and a rotation x, y, z, w.
function matrixOf([px, py, pz], [x, y, z, w]) {
  return [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
    2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0, px, py, pz, 1];
}

const hueOf = ([r, g, b]) => {
  const most = Math.max(r, g, b), range = most - Math.min(r, g, b);
  if (!range) return NaN;
  const sixth = most === r ? (g - b) / range : most === g ? 2 + (b - r) / range : 4 + (r - g) / range;
  return (sixth * 60 + 360) % 360;
};
const hueDistance = (a, b) => Math.min(Math.abs(a - b), 360 - Math.abs(a - b));
const rgbOf = css => [1, 3, 5].map(at => parseInt(css.slice(at, at + 2), 16));

const moves = ["bob", "crate", "roller"];

async function showsTheRecording(page) {
  near(await page.evaluate("tweenfall.times"), recording.times, "the page has the recording's times", 0);
  for (const frame of [0, 24, 46, 72, 102, 150, 180]) {
    const time = recording.times[frame];
    await page.evaluate(`tweenfall.seek(${time})`);
    equal(await page.evaluate("tweenfall.frame"), frame, `seek(${time}) shows that frame`);
    for (const [name, node] of Object.entries(recording.nodes)) {
      const expected = matrixOf(node.position[frame], node.rotation[frame]);
      near(await page.evaluate(`tweenfall.worldMatrixOf(${JSON.stringify(name)})`), expected, `${name} is where it was recorded at ${time} s`);
      const drawn = await page.evaluate(`tweenfall.drawnMatrixOf(${JSON.stringify(name)})`);
      if (drawn) near(drawn, expected, `${name} is drawn where it was recorded at ${time} s`);
      near(await page.evaluate(`tweenfall.twistOf(${JSON.stringify(name)})`),
        [...node.velocity[frame], ...node.angular_velocity[frame]], `${name} moves as recorded at ${time} s`);
      equal(await page.evaluate(`tweenfall.ownerOf(${JSON.stringify(name)})`), node.owner[frame],
        `owner of ${name} at ${time} s`);
    }
  }
}

// Between the frames, checked against the same motion recorded four times as often: cubics through positions and
// velocities are of fourth order (a pendulum of 0.5 Hz: w^4 h^4 / 384 = 2e-8), nearest frames were off by v h / 2 = 25
// mm. If a body bounces between two frames without a contact event, nothing says when: those intervals are left out.
async function movesBetweenFrames(page) {
  const bounces = node => (frame, k) => Math.abs(node.velocity[k][1] - node.velocity[k - 1][1]) > 0.06 && frame;
  let compared = 0;
  const all = await page.evaluate(`${JSON.stringify(fine.times)}.map(time => (tweenfall.seek(time),
    Object.fromEntries(tweenfall.nodes.map(name => [name, tweenfall.worldMatrixOf(name)]))))`);
  for (const [name, node] of Object.entries(fine.nodes)) {
    const corner = bounces(node);
    let worst = 0, worstTime = 0;
    const places = all.map(list => list[name]);
    for (let k = 1; k < fine.times.length; ++k) {
      const first = 4 * Math.floor(k / 4), last = Math.min(first + 4, fine.times.length - 1);
      // A motion split by a contact event is straight on both sides of it, without the fall within the frame.
      let broken = fine.times[k] > 71 / 60 + 1e-9 && fine.times[k] < 1.2;
      for (let i = first + 1; i <= last; ++i) if (corner(true, i)) broken = true;
      if (broken) continue;
      const expected = matrixOf(node.position[k], node.rotation[k]);
      const off = Math.max(...expected.map((value, i) => Math.abs(value - places[k][i])));
      ++compared;
      if (off > worst) { worst = off; worstTime = fine.times[k]; }
    }
    check(worst < 2e-4, `${name} moves on the cubics between frames: off by ${worst} at ${worstTime} s`);
  }
  check(compared > 0.85 * 8 * fine.times.length, `most instants are compared: ${compared}`);
  // The hand-off at 1.6 s lies on a frame; that of 0.75 s too. Owners change exactly there.
  await page.evaluate("tweenfall.seek(0.7499)");
  equal(await page.evaluate("tweenfall.ownerOf('bob')"), "keyed", "just before the hand-off the script holds the bob");
  await page.evaluate("tweenfall.seek(0.7501)");
  equal(await page.evaluate("tweenfall.ownerOf('bob')"), "free", "just after it the bob is free");
  near([await page.evaluate("tweenfall.time")], [0.7501], "time is not rounded to frames", 1e-12);
}

async function bendsTheMesh(page) {
  // The last row of the strip depends on the third joint alone, 0.5 m above it.
  await page.evaluate(`tweenfall.seek(${recording.times[24]})`);
  const frame = 24, joint = recording.nodes["reed/2"];
  const m = matrixOf(joint.position[frame], joint.rotation[frame]);
  const expected = [-0.14, 0.14].flatMap(x => [0, 1, 2].map(i => m[i] * x + m[4 + i] * 0.5 + m[12 + i]));
  near((await page.evaluate("tweenfall.verticesOf(0)")).slice(-6), expected, "the skinned strip's end follows its joint");
}

async function paintsOwners(page) {
  await page.evaluate("tweenfall.choose('floor')");
  for (const time of [0.3, 1.3, 2]) {
    await page.evaluate(`tweenfall.seek(${time})`);
    await page.drawn();
    const picture = await page.picture();
    for (const name of moves) {
      const place = await page.evaluate(`tweenfall.screenPositionOf("${name}")`);
      const owner = recording.nodes[name].owner[await page.evaluate("tweenfall.frame")];
      const pixel = picture.at(place.x, place.y), wanted = rgbOf(await page.evaluate(`tweenfall.colorOf("${owner}")`));
      check(hueDistance(hueOf(pixel), hueOf(wanted)) < 14,
        `${name} is painted as ${owner} at ${time} s: pixel ${pixel}, owner's color ${wanted}`);
    }
  }
  // With their own colors the bodies, which have none, are gray.
  await page.evaluate("tweenfall.set({byOwner: false})");
  await page.drawn();
  const picture = await page.picture(), place = await page.evaluate("tweenfall.screenPositionOf('roller')");
  const pixel = picture.at(place.x, place.y);
  check(Math.max(...pixel) - Math.min(...pixel) < 12, `without owners' colors the roller is gray: ${pixel}`);
  await page.evaluate("tweenfall.set({byOwner: true})");
}

async function stepsAndPlays(page) {
  await page.evaluate("tweenfall.seek(1)");
  const start = await page.evaluate("tweenfall.frame");
  await page.evaluate("tweenfall.step(-1)");
  equal(await page.evaluate("tweenfall.frame"), start - 1, "step(-1) goes back one frame");
  await page.key("ArrowRight");
  await page.key("ArrowRight");
  equal(await page.evaluate("tweenfall.frame"), start + 1, "the right arrow goes forward one frame");
  await page.evaluate("tweenfall.seek(1.004)");
  await page.evaluate("tweenfall.step(1)");
  near([await page.evaluate("tweenfall.time")], [recording.times[start + 1]], "from between two frames a step goes to the later one", 1e-12);
  await page.evaluate("tweenfall.seek(1.02)");
  await page.evaluate("tweenfall.step(-1)");
  near([await page.evaluate("tweenfall.time")], [recording.times[start + 1]], "and back to the earlier one", 1e-12);
  await page.evaluate("document.getElementById('back').click()");
  equal(await page.evaluate("tweenfall.frame"), start, "the button goes back one frame");
  await page.key("End");
  equal(await page.evaluate("tweenfall.frame"), recording.times.length - 1, "End goes to the last frame");
  await page.evaluate("tweenfall.step(1)");
  equal(await page.evaluate("tweenfall.frame"), recording.times.length - 1, "there is nothing after the last frame");
  await page.key("Home");
  equal(await page.evaluate("tweenfall.frame"), 0, "Home goes to the first frame");
  await page.key(" ");
  equal(await page.evaluate("tweenfall.playing"), true, "space plays");
  check(await page.until("tweenfall.frame > 0"), "playing moves time on");
  await page.key(" ");
  equal(await page.evaluate("tweenfall.playing"), false, "space pauses");
}

async function scrubs(page) {
  const box = await page.evaluate("(({left, top, width, height}) => ({left, top, width, height}))" +
    "(document.querySelector('#ruler .strip').getBoundingClientRect())");
  const xOf = time => box.left + 10 + time / 3 * (box.width - 20), y = box.top + box.height / 2;
  await page.drag(xOf(0.5), y, xOf(2.25), y);
  near([await page.evaluate("tweenfall.time")], [2.25], "dragging along the timeline moves time there", 0.01);
  const curves = await page.evaluate("(({left, top, width, height}) => ({left, top, width, height}))" +
    "(document.getElementById('curves').getBoundingClientRect())");
  await page.click(curves.left + 46 + (curves.width - 56) / 2, curves.top + curves.height / 2);
  near([await page.evaluate("tweenfall.time")], [1.5], "a click into the curves moves time there", 0.01);
}

async function showsKeys(page) {
  const lanes = await page.evaluate("tweenfall.lanes");
  equal(await page.evaluate("document.querySelectorAll('#rows .lane:not(.graph)').length"), 4, "one lane for each animated track");
  const crate = lanes.find(lane => lane.name === "crate.position");
  equal(crate.values[1], "(0, 0.85, -0.8)", "a key says its value");
  equal(crate.eases.join(), "linear,linear,linear,linear,end", "keys say how the curve goes on");
  const keysOf = name => lanes.find(lane => lane.name === name)?.keys ?? [];
  // The clip of 1.5 s plays twice; its last key is the next play's first.
  near(keysOf("crate.position"), [0, 0.5, 1.5, 2, 3], "keys of a loop stand at each time around", 0);
  near(keysOf("reed/1.rotation"), [0, 0.375, 1.125, 1.5, 1.875, 2.625, 3], "keys of a rotation", 0);
  equal(keysOf("pivot.rotation").length, 0, "a formula has no keys");
  equal(await page.evaluate("tweenfall.handoffs.length"), recording.handoffs.length, "hand-offs on the timeline");
}

async function chooses(page) {
  await page.evaluate("tweenfall.seek(1.3)");
  for (const name of moves) {
    const place = await page.evaluate(`tweenfall.screenPositionOf("${name}")`);
    await page.click(place.x, place.y);
    equal(await page.evaluate("tweenfall.chosen"), name, "a click in the view chooses the body there");
    equal(await page.evaluate("document.querySelector('#readout h2 span').textContent"), name, "numbers of the chosen");
  }
  await page.evaluate("[...document.querySelectorAll('#rows .label')].find(row => row.title === 'bob').click()");
  equal(await page.evaluate("tweenfall.chosen"), "bob", "a click in the list chooses");
  const [positions, velocities] = await page.evaluate("tweenfall.curvesOf('bob')");
  const node = recording.nodes.bob;
  for (const axis of [0, 1, 2]) {
    near(positions[axis], node.position.map(place => place[axis]), "the curves show the recorded positions");
    near(velocities[axis], node.velocity.map(rate => rate[axis]), "the curves show the recorded velocities");
  }
  // The capsule rolls at 0.5 m/s on 0.15 m, through whole turns: its angles continue, and never jump by a half turn.
  const roller = await page.evaluate("tweenfall.curvesOf('roller')"), names = await page.evaluate("tweenfall.panelsOf('roller').map(panel => panel.name)");
  const angles = roller[names.indexOf("rotation")];
  for (const series of angles)
    for (let k = 1; k < series.length; ++k)
      if (Math.abs(series[k] - series[k - 1]) > 20) { check(false, `angles go on without a jump: ${series[k - 1]} to ${series[k]}`); break; }
  const turned = Math.max(...angles.map(series => Math.abs(series[series.length - 1] - series[0])));
  near([turned], [0.5 * 3 / 0.15 * 180 / Math.PI], "the curves show how far it rolled, in degrees", 1e-4);
  const place = () => page.evaluate("tweenfall.screenPositionOf('bob')");
  const before = await place(), view = {x: 300, y: 400};
  await page.drag(view.x, view.y, view.x + 120, view.y);
  const after = await place();
  check(Math.hypot(after.x - before.x, after.y - before.y) > 10, "a drag in the view turns it");
  await page.key("a");
  await page.evaluate("tweenfall.seek(0)");
  // The floor below, right in front.
  const box = await page.evaluate("(({left, top, width, height}) => ({left, top, width, height}))(document.getElementById('view').getBoundingClientRect())");
  await page.click(box.left + 0.5 * box.width, box.top + box.height - 8);
  equal(await page.evaluate("tweenfall.chosen"), null, "a click on the ground chooses nothing");
}

async function run(title, options, test) {
  const started = Date.now(), page = await Page.open(browser, address, options);
  try {
    await test(page);
    check(page.problems.length === 0, `${title}: the page reports no errors: ${page.problems}`);
    check(page.requests.every(url => url === address), `${title}: the page asks for nothing else: ${page.requests}`);
  } catch (problem) {
    check(false, `${title}: ${problem.stack}`);
    writeFileSync(join(folder, "failed.png"), await page.screenshot().catch(() => ""));
  }
  await page.close();
  console.log(`${title}: ${((Date.now() - started) / 1000).toFixed(1)} s`);
}

await run("with WebGL", {scale: 0.5}, async page => {
  check(await page.evaluate("tweenfall.ready"), "the page is ready once it is loaded");
  check(await page.evaluate("tweenfall.webgl"), "the browser draws WebGL");
  for (const test of [showsTheRecording, movesBetweenFrames, bendsTheMesh, paintsOwners, stepsAndPlays, scrubs, showsKeys, chooses,
    isNeverEmpty]) await test(page);
});

// What needs no pictures of the scene: where software draws them, they take nearly all of the time.
await run("without WebGL", {flags: ["--disable-3d-apis", "--disable-gpu"]}, async page => {
  equal(await page.evaluate("tweenfall.webgl"), false, "the page knows that there is no WebGL");
  equal(await page.evaluate("document.getElementById('no-webgl').hidden"), false, "it says so");
  await page.key("End");
  equal(await page.evaluate("tweenfall.frame"), recording.times.length - 1, "the timeline works without WebGL");
  await scrubs(page);
  await page.evaluate(`tweenfall.seek(${recording.times[90]})`);
  near(await page.evaluate("tweenfall.worldMatrixOf('bob')"),
    matrixOf(recording.nodes.bob.position[90], recording.nodes.bob.rotation[90]), "places are known without WebGL");
  await page.key("Home");
  await drivesTheTimeline(page);
  await pressesEveryKey(page);
  for (const test of [fitsAllWidths, namesFit, easesCoverNoCurve]) await test(page);
  for (const test of [holdsUntilTheEnd, leapsWhereTheScriptDoes, saysEasesOnce, framesTheLinked, tellsNamesApart]) await test(page, folder);
  await frameModels(page, join(folder, "models"));
  await showLarge(page, join(folder, "hostile"));
  await page.visit(address);
});

await run("hostile recordings", {scale: 0.5}, async page => {
  await showHostile(page, join(folder, "hostile"));
  await showsJoints(page, folder);
  await showsSteps(page, folder);
  await showsActors(page, folder);
  await showsTwoBesideEachOther(page, folder);
  await page.visit(address);
});

process.exit(summary());
