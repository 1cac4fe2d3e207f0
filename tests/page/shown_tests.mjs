// What small documents show: held values that change between two frames, bare nodes, long names, eases named once.

import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {check, equal, near} from "./checks.mjs";

const opens = (page, folder, name) => page.visit(pathToFileURL(join(folder, name + ".html")).href);
const boxOf = (page, selector) => page.evaluate(`(({left, top, right, bottom}) => ({left, top, right, bottom}))` +
  `(document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect())`);

// Recorded 30 times per second: 0.51 s and 1.19 s lie between frames. A held value holds until its very end, also for
// what hangs on it.
export async function holdsUntilTheEnd(page, folder) {
  await opens(page, folder, "held");
  const at = async time => {
    await page.evaluate(`tweenfall.seek(${time})`);
    return page.evaluate(`["lamp", "shade"].map(name => tweenfall.worldMatrixOf(name)).flatMap(m => [m[12], m[13], m[0]])
      .concat(tweenfall.valuesOf("lamp", "color")[0])`);
  };
  for (const [time, expected] of [[0.2, [0, 0, 1, 0, 1, 1, 1]], [0.509, [0, 0, 1, 0, 1, 1, 1]], [0.511, [1, 0, 2, 1, 2, 2, 1]],
    [1.189, [1, 0, 2, 1, 2, 2, 1]], [1.191, [3, 0, 4, 3, 4, 4, 0]], [1.9, [3, 0, 4, 3, 4, 4, 0]]])
    near(await at(time), expected, `places, sizes and color at ${time} s`, 1e-5);
  // The marks of keys are on what they hold.
  near(await at(0.51), [1, 0, 2, 1, 2, 2, 1], "a key has its own value", 1e-5);
}

// At its own instant, between two frames: in the steps of an ease, at a value that arrives, at the seam of a loop and
// where the weight of a play leaps.
export async function leapsWhereTheScriptDoes(page, folder) {
  await opens(page, folder, "leaps");
  const nodes = ["stairs", "round", "given", "fading"], thirds = [1.37 / 3, 2.74 / 3];
  const step = time => time < thirds[0] ? 0 : time < thirds[1] ? 1 : time < 1.37 ? 2 : 3;
  const wanted = time => [step(time), time % 0.77, time < 0.51 ? time : 5 + (time - 0.51), time < 0.51 ? 0.25 : 1];
  for (const leap of [0.51, thirds[0], thirds[1], 0.77, 1.37, 1.54])
    for (const time of [leap - 0.02, leap - 1e-3, leap + 1e-3, leap + 0.02]) {
      await page.evaluate(`tweenfall.seek(${time})`);
      const shown = await page.evaluate(`${JSON.stringify(nodes)}.map(name => tweenfall.worldMatrixOf(name)[12])`);
      near(shown, wanted(time), `places at ${time} s`, 1e-5);
      if (time < 1.37 || time > 1.38) {
        const [red] = await page.evaluate(`tweenfall.valuesOf("stairs", "color")`);
        check((step(time) === 0) === (red < 0.01) && (step(time) === 3) === (red > 0.99), `the color at ${time} s is not between two: ${red}`);
      }
    }
}

// One word for a row of keys that leave alike; none where there is no room for it.
export async function saysEasesOnce(page, folder) {
  await opens(page, folder, "held");
  await page.evaluate(`(() => {
    const own = CanvasRenderingContext2D.prototype, {fillText} = own;
    window.words = [];
    own.fillText = function (text, x, y) {
      if (this.canvas.parentElement && this.canvas.parentElement.id === "curves") words.push(text);
      return fillText.call(this, text, x, y);
    };
    tweenfall.choose("shade"); tweenfall.choose("lamp");
  })()`);
  await page.drawn();
  const words = await page.evaluate("words");
  // Of position: hold twice in a row, then linear; of scale: hold three times; of color: step-next once, then hold.
  const count = word => words.filter(each => each === word).length;
  check(count("step-next") > 0 && count("hold") === 3 * count("step-next"),
    `a word stands once for keys in a row: ${["hold", "step-next"].map(count)}`);
  check(!words.some(word => /^(hol|ho|li|lin|ste)/.test(word) && word.includes("\u2026")), "no word is cut");
}

// What only stands there, such as a camera, is not what the view frames.
export async function framesTheLinked(page, folder) {
  await opens(page, folder, "lone");
  equal(await page.evaluate("tweenfall.state.skeleton"), true, "bare nodes are shown where nothing else is");
  const view = await boxOf(page, "#view");
  const [hip, knee] = await page.evaluate("['hip', 'knee'].map(tweenfall.screenPositionOf)");
  check(Math.hypot(hip.x - knee.x, hip.y - knee.y) > 0.25 * (view.bottom - view.top),
    `what is linked fills the view: ${Math.hypot(hip.x - knee.x, hip.y - knee.y)} of ${view.bottom - view.top} px`);
}

export async function tellsNamesApart(page, folder) {
  await opens(page, folder, "names");
  equal(await page.evaluate("tweenfall.lanes.length"), 300, "300 tracks are there");
  for (const width of [1280, 640, 390]) {
    await page.resize(width, 800);
    const names = await page.evaluate("[...document.querySelectorAll('#rows .row:not(.lane) .name')].map(name => name.textContent)");
    check(names.length > 5 && new Set(names).size === names.length, `long names can be told apart at ${width}: ${names.slice(0, 2)}`);
    check(names.every(name => name.includes("\u2026") && /\d$/.test(name)), `they keep their ends at ${width}`);
    if (width > 390) check(names.every(name => name.startsWith("the ")), `and their beginnings at ${width}`);
    const cut = await page.evaluate("[...document.querySelectorAll('#rows .name')].filter(name => name.scrollWidth > name.clientWidth).length");
    equal(cut, 0, `and fit as they are shown at ${width}`);
  }
  await page.evaluate("tweenfall.choose(tweenfall.nodes[7])");
  for (const width of [1280, 640, 390]) {
    await page.resize(width, 800);
    await page.evaluate("tweenfall.seek(tweenfall.time === 1 ? 0.5 : 1)");
    const [title, over] = await page.evaluate("(name => [name.textContent, name.scrollWidth - name.clientWidth])(document.querySelector('#readout h2 span'))");
    check(title.endsWith("number 7") && over <= 0, `the chosen one is told by its end at ${width}: ${title}, ${over} px too long`);
  }
  await page.resize(1280, 800);
}
