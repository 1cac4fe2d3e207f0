// Two recordings side by side: one clock, one view, and what is done to one is done to the other.

import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {check, equal, near} from "./checks.mjs";

export async function showsTwoBesideEachOther(page, folder) {
  await page.visit(pathToFileURL(join(folder, "beside.html")).href);
  check(await page.until("window.beside && beside.ready"), "both pages come up");
  const times = () => page.evaluate("beside.pages.map(each => each.time)");
  const [left, right] = ["beside.pages[0]", "beside.pages[1]"];
  equal(await page.evaluate("document.querySelectorAll('iframe')[0].title"), "the other <one>", "each has its title");
  equal(await page.evaluate("beside.first === beside.pages[1]"), true, "the longer one has the clock");
  await page.evaluate(`${left}.seek(0.7)`);
  near(await times(), [0.7, 0.7], "a time sought in one is shown in both", 0);
  // Free fall, to what floats hold.
  near([(await page.evaluate(`${left}.worldMatrixOf('bob')`))[13]], [3 - 0.5 * 9.81 * 0.49], "the left one falls", 1e-4);
  await page.evaluate(`${right}.seek(2.5)`);
  near(await times(), [1.5, 2.5], "the shorter one waits at its end, and holds the longer one by nothing", 0);
  await page.evaluate(`${right}.seek(0.2)`);
  await page.evaluate(`${left}.play()`);
  check(await page.until(`${right}.time > 0.3`), "play pressed in one plays both");
  equal(await page.evaluate(`${right}.playing && ${left}.playing`), true, "both say so");
  const [a, b] = await times();
  near([a], [b], "by one clock", 0);
  await page.evaluate(`${left}.pause()`);
  equal(await page.evaluate(`${right}.playing`), false, "and pause, pressed in one, halts both");
  await page.evaluate(`${right}.choose('bob')`);
  equal(await page.evaluate(`${left}.chosen`), "bob", "a node that both have is chosen in both");
  await page.evaluate(`${right}.choose('crate')`);
  equal(await page.evaluate(`${left}.chosen`), "bob", "one that only one has, in that one");
  await page.evaluate(`${left}.look = {...${left}.look, yaw: 1.25}`);
  near([await page.evaluate(`${right}.look.yaw`)], [1.25], "both look from one side", 0);
  near(await page.evaluate(`${right}.look.target`), await page.evaluate(`${left}.look.target`), "at one place", 1e-9);
  await page.evaluate(`${left}.set({trail: false})`);
  equal(await page.evaluate(`${right}.state.trail`), false, "what is shown, too");
  await page.visit("about:blank");
  await page.visit(pathToFileURL(join(folder, "beside.html")).href + "#t=0.6&node=crate");
  check(await page.until("window.beside && beside.ready"), "with an instant in the address both pages come up");
  near(await times(), [0.6, 0.6], "at that instant", 0);
  equal(await page.evaluate(`${right}.chosen`), "crate", "with that node chosen where there is one");
  equal(page.problems.length, 0, `the pages report no errors: ${page.problems}`);
  check(page.requests.filter(url => !url.startsWith("about:")).length === 1, `and ask for nothing: ${page.requests}`);
}
