// Joints are where they were recorded, drawn when they are switched on, and gone once they ended.

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
