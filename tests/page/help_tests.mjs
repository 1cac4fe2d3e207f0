// Every key of the help sheet, pressed: its effect shows in the page's state. A key without a line here fails.

import {check} from "./checks.mjs";

const flips = name => [`tweenfall.state.${name}`, (before, after) => before === !after];
const moves = sense => ["tweenfall.time", (before, after) => Math.sign(after - before) === sense];

// By what the sheet shows: [what to look at, what must hold of it before and after, how to begin, what to press].
const effects = {
  space: flips("playing"), "\u2190": [...moves(-1), "", "ArrowLeft"], "\u2192": [...moves(1), "", "ArrowRight"],
  Home: ["tweenfall.time", (_, after) => after === 0], End: ["tweenfall.time", (_, after) => after === 3],
  ",": moves(-1), ".": moves(1), "[": moves(-1), "]": moves(1), l: flips("loop"),
  a: ["tweenfall.look.distance", (before, after) => after !== before, "tweenfall.look = {...tweenfall.look, distance: 1}"],
  f: ["tweenfall.look.distance", (before, after) => after < before, "tweenfall.frameAll()"],
  g: flips("follow"), c: flips("byOwner"), t: flips("trail"), b: flips("skeleton"), x: flips("colliders"), j: flips("joints"),
  k: flips("contacts"), i: flips("islands"), w: flips("boxes"), z: flips("sleepers"),
  "\u2191": ["tweenfall.chosen", (before, after) => after && after !== before, "tweenfall.choose('roller')", "ArrowUp"],
  "\u2193": ["tweenfall.chosen", (before, after) => after && after !== before, "", "ArrowDown"],
  esc: ["tweenfall.chosen", (before, after) => before === "crate" && after === null, "", "Escape"],
  "/": ["document.activeElement.id", (_, after) => after === "find"],
  "+": ["tweenfall.shownTime[1] - tweenfall.shownTime[0]", (before, after) => after < before],
  "\u2212": ["tweenfall.shownTime[1] - tweenfall.shownTime[0]", (before, after) => after > before, "tweenfall.zoomTime(0.5)", "-"],
  0: ["tweenfall.shownTime[1] - tweenfall.shownTime[0]", (before, after) => before < 3 && after === 3, "tweenfall.zoomTime(0.5)"],
  e: ["tweenfall.rows.length", (before, after) => after < before], E: ["tweenfall.rows.length", (before, after) => after < before],
  s: flips("snap"), o: flips("local"), "?": flips("help"),
};
const shift = {ArrowLeft: -10, ArrowRight: 10};

export async function pressesEveryKey(page) {
  const shown = await page.evaluate("[...document.querySelectorAll('#help-lists dt')].map(key => key.textContent)");
  check(shown.length > 25, `the sheet tells of ${shown.length} keys`);
  for (const name of shown) {
    const effect = effects[name];
    check(!!effect, `the key "${name}" of the sheet has an effect that is looked at`);
    if (!effect) continue;
    const [look, holds, begin = "", key = name === "space" ? " " : name] = effect;
    await page.evaluate(`document.activeElement.blur(); tweenfall.pause(); tweenfall.showAllTime(); tweenfall.set({help: false});
      tweenfall.choose('crate'); tweenfall.seek(1.1); ${begin}`);
    const before = await page.evaluate(look);
    await page.key(key);
    const after = await page.evaluate(look);
    check(holds(before, after), `"${name}": ${look} was ${before} and is ${after}`);
    if (shift[key]) {
      await page.evaluate("tweenfall.seek(1.1)");
      const frame = await page.evaluate("tweenfall.frame");
      await page.key(key, 8);
      check(await page.evaluate("tweenfall.frame") - frame === shift[key], `"${name}" with shift goes ten frames`);
    }
    // The same key switches back.
    if (look.startsWith("tweenfall.state.")) {
      await page.key(key);
      check(await page.evaluate(look) === before, `"${name}" pressed again takes it back`);
    }
    if (name === "e" || name === "E") await page.key(key);
    if (name === "/") await page.key("Escape");
  }
  await page.evaluate("document.activeElement.blur(); tweenfall.pause(); tweenfall.showAllTime(); tweenfall.frameAll(); tweenfall.seek(0)");
}
