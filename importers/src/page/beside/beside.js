// Two pages side by side with one clock: what is done to one, time, playing and looking, is done to the other.

const {before, after} = JSON.parse(document.getElementById("pages").textContent);
const frames = Array.from(document.querySelectorAll("iframe"));
frames.forEach((frame, i) => { frame.srcdoc = before[i] + after; });

// What is looked at in one way in both; of a choice, nodes that both have.
const shared = ["playing", "speed", "loop", "snap", "byOwner", "trail", "skeleton", "colliders", "joints", "contacts", "islands",
  "boxes", "sleepers", "follow", "local"];

// While one page takes over what the other did, it does not answer.
let passing = false;
function pass(action) {
  if (passing) return;
  passing = true;
  try { action(); } finally { passing = false; }
}

function follow(other, changed, page) {
  const values = {};
  for (const name of shared) if (name in changed) values[name] = changed[name];
  // The loop of a clock that is longer is not stopped where the shorter one ends.
  if (Object.keys(values).length) other.set(values);
  if ("time" in changed) other.seek(page.time);
  if ("chosen" in changed && (page.chosen === null || other.nodes.includes(page.chosen))) other.choose(page.chosen);
}

function join(pages) {
  const last = page => page.times[page.times.length - 1];
  // The one that lasts longer has the clock.
  const [first, second] = last(pages[1]) > last(pages[0]) ? [pages[1], pages[0]] : pages;
  second.set({led: true});
  second.seek(first.time);
  for (const [page, other] of [[first, second], [second, first]]) {
    page.onChange(changed => pass(() => follow(other, changed, page)));
    page.onLook(look => pass(() => { other.look = look; }));
  }
  if (first.nodes.includes(second.chosen)) first.choose(second.chosen);
  second.look = first.look;
  // #t=0.8&node=ball opens both at that time, with that node chosen where there is one.
  const asked = new URLSearchParams(location.hash.slice(1)), node = asked.get("node");
  for (const page of pages) if (page.nodes.includes(node)) page.choose(node);
  if (asked.has("t") && Number.isFinite(Number(asked.get("t")))) first.seek(Number(asked.get("t")));
  window.beside = {ready: true, pages, first, second};
}

(function wait() {
  const pages = frames.map(frame => frame.contentWindow && frame.contentWindow.tweenfall);
  if (pages.every(page => page && page.ready)) join(pages);
  else setTimeout(wait, 20);
})();
