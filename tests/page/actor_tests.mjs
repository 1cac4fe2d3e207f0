// Particles and wheels are where they were recorded; states in between are drawn, and none of it is black.

import {readFileSync} from "node:fs";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {check, equal, near} from "./checks.mjs";

async function opens(page, folder, name) {
  await page.visit(pathToFileURL(join(folder, name + ".html")).href);
  return JSON.parse(readFileSync(join(folder, name + ".json"), "utf8"));
}

export async function showsActors(page, folder) {
  const fountain = await opens(page, folder, "fountain"), water = fountain.particles.water;
  for (const frame of [0, 10, fountain.times.length - 1]) {
    await page.evaluate(`tweenfall.seek(${fountain.times[frame]})`);
    near(await page.evaluate("tweenfall.particlesOf('water')"), water.positions[frame].flat(),
      `particles are where they were recorded at ${fountain.times[frame]} s`);
  }
  // Between two frames each moves on by its own velocity.
  const frame = fountain.times.length - 3, later = 0.01;
  await page.evaluate(`tweenfall.seek(${fountain.times[frame] + later})`);
  near(await page.evaluate("tweenfall.particlesOf('water')"),
    water.positions[frame].flatMap((place, i) => place.map((value, axis) => value + later * water.velocities[frame][i][axis])),
    "particles go on between frames", 1e-5);

  const car = await opens(page, folder, "car"), wheel = car.vehicles.car["front left"];
  for (const frame of [0, 7, car.times.length - 1]) {
    await page.evaluate(`tweenfall.seek(${car.times[frame]})`);
    near((await page.evaluate("tweenfall.worldMatrixOf('car/front left')")).slice(12, 15), wheel.position[frame],
      `a wheel is where it was recorded at ${car.times[frame]} s`);
  }
  equal(await page.evaluate("tweenfall.nodes.filter(name => name.startsWith('car/')).length"), 4, "each wheel is a node");

  await opens(page, folder, "cloth");
  await page.evaluate("tweenfall.seek(0.4)");
  await page.drawn();
  const picture = await page.picture(), box = await page.evaluate("(({left, top, width, height}) => ({left, top, width, height}))" +
    "(document.getElementById('view').getBoundingClientRect())");
  for (const [x, y] of [[0.05, 0.1], [0.95, 0.1], [0.05, 0.9], [0.95, 0.9]]) {
    const pixel = picture.at(box.left + x * box.width, box.top + y * box.height);
    check(Math.min(...pixel) > 100, `ground and sky around a cloth are light: ${pixel}`);
  }
  const corner = await page.evaluate("tweenfall.verticesOf(0).slice(0, 3)");
  near(corner, [-0.5, 1, -0.5], "the cloth's corner is pinned", 1e-4);
}
