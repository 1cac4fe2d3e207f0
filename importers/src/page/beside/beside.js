// Two pages side by side with one clock. Changes of the time, of playing and of the view in one are made in the other.

const {before, after} = JSON.parse(document.getElementById("pages").textContent);
const frames = Array.from(document.querySelectorAll("iframe"));
frames.forEach((frame, i) => { frame.srcdoc = before[i] + after; });

// The settings that both pages share. A chosen node is shared if both pages have it.
const shared = ["playing", "speed", "loop", "snap", "byOwner", "trail", "skeleton", "colliders", "joints", "contacts", "islands",
  "boxes", "sleepers", "follow", "local"];

// While one page takes over a change from the other, it does not send the change back.
let passing = false;
function pass(action) {
  if (passing) return;
  passing = true;
  try { action(); } finally { passing = false; }
}

function follow(other, changed, page) {
  const values = {};
  for (const name of shared) if (name in changed) values[name] = changed[name];
  if (Object.keys(values).length) other.set(values);
  if ("time" in changed) other.seek(page.time);
  if ("chosen" in changed && (page.chosen === null || other.nodes.includes(page.chosen))) other.choose(page.chosen);
}

function join(pages) {
  const last = page => page.times[page.times.length - 1];
  // The longer recording has the clock.
  const [first, second] = last(pages[1]) > last(pages[0]) ? [pages[1], pages[0]] : pages;
  second.set({led: true});
  second.seek(first.time);
  for (const [page, other] of [[first, second], [second, first]]) {
    page.onChange(changed => pass(() => follow(other, changed, page)));
    page.onLook(look => pass(() => { other.look = look; }));
  }
  if (first.nodes.includes(second.chosen)) first.choose(second.chosen);
  second.look = first.look;
  // #t=0.8&node=ball opens both at that time, with that node chosen in each page that has it.
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
