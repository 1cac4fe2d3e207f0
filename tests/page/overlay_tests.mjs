// What is drawn over the picture when it is switched on. Joints: where they were recorded, and gone once they ended. What
// the steps worked with: contacts where bodies touch, islands in colors of their own, sleepers that fade, boxes that
// contain their bodies.

import {readFileSync} from "node:fs";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {check, equal, near} from "./checks.mjs";

const paintedPoints = `(() => {
  const canvas = document.getElementById("overlay"), data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  let count = 0;
  for (let i = 3; i < data.length; i += 4) if (data[i]) ++count;
  return count;
})()`;
const drawn = page => page.evaluate(`new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(${paintedPoints}))))`);

export async function showsJoints(page, folder) {
  const recording = JSON.parse(readFileSync(join(folder, "jointed.json"), "utf8"));
  await page.visit(pathToFileURL(join(folder, "jointed.html")).href);
  for (const frame of [0, 6, 12, 21]) {
    await page.evaluate(`tweenfall.seek(${recording.times[frame]})`);
    const pin = await page.evaluate("tweenfall.jointOf('pin')");
    near(pin.a, [0, 1, 0], "the hinge's end in the world stays", 1e-6);
    near(pin.b, [0, 1, 0], "the door's end of it stays there", 1e-3);
    near(pin.axis, [0, 1, 0], "and so does its axis", 1e-6);
    const rope = await page.evaluate("tweenfall.jointOf('rope')"), held = recording.joints.rope.force[frame] !== null;
    equal(rope !== null, held, `at ${recording.times[frame]} s the rope holds as long as it was recorded to`);
    if (held) near(rope.b, recording.nodes.lamp.position[frame], "the rope ends at the lamp", 1e-3);
  }
  await page.evaluate("tweenfall.seek(0.1)");
  const before = await drawn(page);
  await page.key("j");
  const after = await drawn(page);
  check(after > before + 50, `joints are drawn once they are switched on: ${before} painted points before, ${after} after`);
  equal(await page.evaluate("document.getElementById('joints-option').offsetParent !== null"), true, "there is a box for them");
}

export async function showsSteps(page, folder) {
  await page.visit(pathToFileURL(join(folder, "stacked.html")).href);
  await page.evaluate("tweenfall.choose(null)");
  await page.evaluate("tweenfall.seek(0.1)");
  const contacts = await page.evaluate("tweenfall.contacts()");
  equal(contacts.length, 12, "three boxes that lie on something have four points each");
  check(contacts.every(({normal}) => Math.abs(Math.abs(normal[1]) - 1) < 1e-6), "their normals stand upright");
  check(contacts.every(({impulse}) => impulse > 0), "and all press");
  equal(await page.evaluate("tweenfall.islandOf('upper')"), await page.evaluate("tweenfall.islandOf('lower')"), "a stack is one island");
  check(await page.evaluate("tweenfall.islandOf('alone')") !== await page.evaluate("tweenfall.islandOf('lower')"), "what stands alone is another");
  equal(await page.evaluate("tweenfall.islandOf('floor')"), null, "what never moves is in none");
  for (const name of ["lower", "upper", "alone"]) {
    const box = await page.evaluate(`tweenfall.boxOf('${name}')`), matrix = await page.evaluate(`tweenfall.worldMatrixOf('${name}')`);
    check([0, 1, 2].every(i => box[i] <= matrix[12 + i] - 0.19 && box[3 + i] >= matrix[12 + i] + 0.19), `the box of ${name} holds it`);
  }
  const before = await drawn(page);
  await page.key("k");
  check(await drawn(page) > before + 50, "contacts are drawn once they are switched on");
  await page.key("k");
  const own = await page.evaluate("tweenfall.drawnColorOf('lower')");
  await page.key("i");
  const [lower, upper, alone] = await page.evaluate("['lower', 'upper', 'alone'].map(tweenfall.drawnColorOf)");
  equal(String(lower), String(upper), "an island has one color");
  check(Math.hypot(...lower.map((value, i) => value - alone[i])) > 0.1, "and another one another");
  await page.key("i");
  equal(String(await page.evaluate("tweenfall.drawnColorOf('lower')")), String(own), "switched off, owners are colored again");
  equal(await page.evaluate("tweenfall.asleep('lower')"), false, "it is awake at first");
  await page.evaluate("tweenfall.seek(1.9)");
  equal(await page.evaluate("tweenfall.asleep('lower')"), true, "and sleeps in the end");
  await page.key("z");
  check(Math.hypot(...(await page.evaluate("tweenfall.drawnColorOf('lower')")).map((value, i) => value - own[i])) > 0.05, "sleepers fade");
  await page.key("z");
  await page.key("w");
  equal(await page.evaluate("document.getElementById('boxes').checked"), true, "W shows the boxes");
  await page.key("w");
  near(await page.evaluate("['lower', 'alone', 'upper'].map(tweenfall.drawnAlphaOf)"), [1, 0.25, 0],
    "bodies are seen through by the last part of their colors, and with none of it not at all", 1e-3);
}
