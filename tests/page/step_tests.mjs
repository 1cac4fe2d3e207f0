// What the steps worked with: contacts are drawn where bodies touch, islands have colors of their own, sleepers fade, and
// boxes hold their bodies.

import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {check, equal} from "./checks.mjs";

const paintedPoints = `(() => {
  const canvas = document.getElementById("overlay"), data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  let count = 0;
  for (let i = 3; i < data.length; i += 4) if (data[i]) ++count;
  return count;
})()`;
const drawn = page => page.evaluate(`new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(${paintedPoints}))))`);

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
}
