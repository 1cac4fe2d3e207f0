// Recordings that hardly fit a page: it opens, and says what it cannot show.

import {statSync} from "node:fs";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {check, equal, near} from "./checks.mjs";

const notes = page => page.evaluate("document.getElementById('limits').hidden ? '' : document.getElementById('limits').innerText");

const cases = {
  async beyond_float(page) {
    const said = await notes(page);
    check(said.includes('"far"') && said.includes('"wide"') && !said.includes('"near"'), `what is beyond floats is named: ${said}`);
    await page.evaluate("tweenfall.choose('far')");
    await page.evaluate("tweenfall.seek(0.3); tweenfall.choose('near'); tweenfall.frameChosen()");
    const place = await page.evaluate("tweenfall.screenPositionOf('near')");
    check(place && place.x > 0 && place.x < 1280, "what fits is in the view");
  },
  async many_nodes(page) {
    equal(await page.evaluate("tweenfall.nodes.length"), 20000, "all nodes are there");
    check(await page.evaluate("document.querySelectorAll('#rows .row').length") < 100, "rows out of sight are not made");
    const took = await page.evaluate("(() => {const from = performance.now(); tweenfall.choose('node 19999'); return performance.now() - from})()");
    check(took < 2000, `choosing among 20,000 nodes takes ${took} ms`);
    check(await page.evaluate("[...document.querySelectorAll('#rows .row.chosen')].length") === 1, "the chosen row scrolls into sight");
  },
  async large_numbers(page) {
    const cells = "[...document.querySelectorAll('#readout dd')].filter(cell => cell.textContent)";
    for (const width of [1280, 640]) {
      await page.resize(width, 800);
      await page.drawn();
      const cut = await page.evaluate(`${cells}.filter(cell => cell.scrollWidth > cell.clientWidth).map(cell => cell.textContent)`);
      check(cut.length === 0, `no number is cut off at ${width}: ${cut}`);
    }
    equal((await page.evaluate(`${cells}.slice(0, 3).map(cell => cell.textContent)`)).join(" "), "-4.024 307.1 -1235", "in a narrow column four digits are told");
    await page.resize(1280, 800);
  },
  async one_frame(page) {
    check((await notes(page)).includes("one frame"), "one frame is said to be one");
    for (const key of [" ", "ArrowRight", "End", "Home", "f", "+", ".", "]"]) await page.key(key);
    near([await page.evaluate("tweenfall.time")], [2.5], "time stays where it is", 0);
  },
  async no_nodes(page) {
    check((await notes(page)).includes("no nodes"), "no nodes is said");
    for (const key of [" ", "ArrowDown", "a", "f", "g", "x", "e", "E", "."]) await page.key(key);
  },
  async markup(page) {
    equal(await page.evaluate("typeof window.hurt"), "undefined", "no name runs as a script");
    equal(await page.evaluate("document.images.length"), 0, "no name becomes markup");
    const name = await page.evaluate("tweenfall.nodes[0]");
    check(name.startsWith("</script>") && name.includes("{{data}}"), "names are kept as they are");
    await page.evaluate("tweenfall.choose(tweenfall.nodes[1])");
    const [wide, label] = await page.evaluate("(({offsetWidth, textContent}) => [offsetWidth, textContent])(document.querySelector('#rows .chosen .name'))");
    check(wide < 250 && label.length < 100 && label.includes("\u2026"), `a long name is shown without its middle: ${wide} px, ${label}`);
    equal(await page.evaluate("document.querySelector('#rows .chosen .label').title.length"), 5000, "its title has all of it");
    check(await page.evaluate("document.documentElement.scrollWidth") <= 1280, "a long name makes nothing wider");
  },
  async long(page, file) {
    const size = statSync(file).size;
    check(size < 40e6, `a long recording is thinned: ${size} bytes`);
    check((await notes(page)).includes("Thinned"), "thinning is said");
    // The motion is sin t: smooth between the frames that are left.
    for (const time of [0.31, 100.7, 333.333, 599.9]) {
      await page.evaluate(`tweenfall.seek(${time})`);
      near([(await page.evaluate("tweenfall.worldMatrixOf('ball 7')"))[13]], [Math.sin(time)], `what is left moves smoothly at ${time} s`, 1e-4);
    }
  },
  async small(page) {
    const points = await page.evaluate("tweenfall.drawnPoints().map(point => tweenfall.placeInView(point))");
    const x = points.map(point => point[0]);
    check(Math.max(...x) - Math.min(...x) > 300, "what is a millimeter wide fills the view");
  },
};

// The large ones: where software draws, they are shown without the scene.
const large = ["many_nodes", "long"];

export const showLarge = (page, folder) => show(page, folder, large);
export const showHostile = (page, folder) => show(page, folder, Object.keys(cases).filter(name => !large.includes(name)));

async function show(page, folder, names) {
  for (const name of names) {
    const file = join(folder, name + ".html");
    const started = Date.now();
    await page.visit(pathToFileURL(file).href);
    check(Date.now() - started < 60000, `${name}: the page opens within a minute: ${Date.now() - started} ms`);
    check(await page.evaluate("!!window.tweenfall && tweenfall.ready"), `${name}: the page opens`);
    check(!/NaN|Infinity|undefined/.test(await page.evaluate("document.body.innerText")), `${name}: no such word is shown`);
    await cases[name](page, file);
    await page.drawn();
    check(page.problems.length === 0, `${name}: the page reports no errors: ${page.problems}`);
  }
}
