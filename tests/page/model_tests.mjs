// Every model is framed: throughout its recording, what is drawn lies inside the view with a margin and fills a fair part.

import {readdirSync} from "node:fs";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {check} from "./checks.mjs";

// The least rectangle around all that is drawn over the recording, in CSS pixels of the view, and the view's size.
const drawnRectangle = page => page.evaluate(`(() => {
  const view = document.getElementById("view"), out = [1e9, 1e9, -1e9, -1e9], times = tweenfall.times;
  let count = 0, behind = 0;
  for (let i = 0; i <= 24; ++i) {
    tweenfall.seek(times[0] + (times[times.length - 1] - times[0]) * i / 24);
    for (const point of tweenfall.drawnPoints()) {
      const place = tweenfall.placeInView(point);
      ++count;
      if (!place) { ++behind; continue; }
      out[0] = Math.min(out[0], place[0]); out[1] = Math.min(out[1], place[1]);
      out[2] = Math.max(out[2], place[0]); out[3] = Math.max(out[3], place[1]);
    }
  }
  return {box: out, count, behind, width: view.clientWidth, height: view.clientHeight};
})()`);

async function framesThePage(page, name) {
  const {box: [left, top, right, bottom], count, behind, width, height} = await drawnRectangle(page);
  check(count > 0 && behind === 0, `${name}: all of it is before the camera: ${behind} of ${count} points are not`);
  check(left >= 0.02 * width && top >= 0.02 * height && right <= 0.98 * width && bottom <= 0.98 * height,
    `${name} is inside the view of ${width} by ${height}: ${[left, top, right, bottom].map(Math.round)}`);
  check(right - left > 0.45 * width || bottom - top > 0.45 * height,
    `${name} fills a fair part of the view of ${width} by ${height}: ${Math.round(right - left)} by ${Math.round(bottom - top)}`);
}

// The same in the moving picture: all figures, at ten instants, within the picture's window.
async function framesThePicture(page, name) {
  const {box: [left, top, right, bottom], window: [x, y, width, height], count} = await page.evaluate(`(() => {
    const svg = document.documentElement, rect = svg.querySelector("#view rect"), out = [1e9, 1e9, -1e9, -1e9];
    const ends = [...svg.querySelectorAll("animate")].map(e => parseFloat(e.getAttribute("dur")));
    const length = Math.max(0, ...ends), figures = [...svg.querySelectorAll("g[clip-path] > g")];
    svg.pauseAnimations();
    for (let i = 0; i <= 10; ++i) {
      svg.setCurrentTime(length * i / 10.001);
      for (const figure of figures) {
        const box = figure.getBBox();
        out[0] = Math.min(out[0], box.x); out[1] = Math.min(out[1], box.y);
        out[2] = Math.max(out[2], box.x + box.width); out[3] = Math.max(out[3], box.y + box.height);
      }
    }
    return {box: out, count: figures.length, window: ["x", "y", "width", "height"].map(a => parseFloat(rect.getAttribute(a)))};
  })()`);
  check(count > 0, `${name}: the picture draws something`);
  check(left > x && top > y && right < x + width && bottom < y + height,
    `${name} is inside the picture ${[x, y, width, height]}: ${[left, top, right, bottom].map(Math.round)}`);
  check(right - left > 0.5 * width || bottom - top > 0.5 * height,
    `${name} fills a fair part of the picture ${[width, height].map(Math.round)}: ${Math.round(right - left)} by ${Math.round(bottom - top)}`);
}

export async function frameModels(page, folder) {
  const files = readdirSync(folder);
  check(files.length >= 2, "there are models to look at");
  for (const file of files) {
    await page.visit(pathToFileURL(join(folder, file)).href);
    await page.drawn();
    if (file.endsWith(".html")) await framesThePage(page, file);
    else await framesThePicture(page, file);
    check(page.problems.length === 0, `${file} reports no errors: ${page.problems}`);
  }
}
