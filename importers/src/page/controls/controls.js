// Buttons, boxes, the field to find a node, and choosing in the view.

const switches = [["by-owner", "byOwner"], ["trail", "trail"], ["skeleton", "skeleton"], ["colliders", "colliders"], ["joints", "joints"],
  ["contacts", "contacts"], ["islands", "islands"], ["boxes", "boxes"], ["sleepers", "sleepers"],
  ["follow", "follow"], ["loop", "loop"], ["snap", "snap"], ["local", "local"]];

function updateControls() {
  element("play-icon").setAttribute("d", state.playing ? "M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z" : "M4 2.5v11L13 8z");
  element("play").setAttribute("aria-label", state.playing ? "Pause" : "Play");
  for (const [id, name] of switches) element(id).checked = state[name];
  element("speed").value = String(state.speed);
  element("help").hidden = !state.help;
}

function wireFind() {
  const find = element("find");
  find.addEventListener("input", () => change({find: find.value}));
  find.addEventListener("keydown", event => {
    if (event.key === "Enter") find.classList.toggle("none", !chooseFound() && !!find.value.trim());
    else find.classList.remove("none");
    if (event.key !== "Escape") return;
    find.value = "";
    change({find: ""});
    find.blur();
  });
}

function wireView() {
  for (const name of ["pointerdown", "wheel"]) view.addEventListener(name, () => { framedWhole = false; }, {passive: true});
  view.addEventListener("click", event => {
    if (orbit.travelled > 5) return;
    const box = view.getBoundingClientRect();
    change({chosen: nodeAtPoint(event.clientX - box.left, event.clientY - box.top)});
  });
}

function wireControls() {
  const on = (id, action) => element(id).addEventListener("click", action);
  on("play", () => (state.playing ? pause() : play()));
  on("to-start", () => toFrame(0));
  on("to-end", () => { pause(); toFrame(recording.frameCount - 1); });
  on("back", event => step(event.shiftKey ? -10 : -1));
  on("forward", event => step(event.shiftKey ? 10 : 1));
  on("frame-all", frameAll);
  on("show-help", () => toggle("help"));
  on("close-help", () => change({help: false}));
  on("close-limits", () => { element("limits").hidden = true; });
  on("show-options", () => element("options").classList.toggle("open"));
  element("speed").addEventListener("change", event => change({speed: Number(event.target.value)}));
  for (const [id, name] of switches) element(id).addEventListener("change", event => change({[name]: event.target.checked}));
  element("joints-option").hidden = recording.joints.length === 0;
  element("steps-options").hidden = !recording.details;
  wireFind();
  wireView();
}
