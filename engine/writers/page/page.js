// page.js: the legend, the search, the controls and what ties them to the map and the panel.

const $ = (id) => document.getElementById(id);
const root = document.documentElement;
window.addEventListener("error", (event) => {
  root.dataset.error = event.message;
});

const data = new MapData(JSON.parse($("map-data").textContent));
/** What is chosen; -1 and null mean nothing. */
const state = {
  mode: "winner", // or "margin", or "p" with probabilityOf
  probabilityOf: null,
  dots: "indicates",
  hidden: new Set(), // environments, -1 = unknown
  layers: { segments: true, landmarks: true, names: true },
  hover: -1,
  segment: -1,
  landmark: -1,
  rival: null,
  classOf: null, // the highlighted class
};
const canvas = $("map");
let painter = null;
const view = new View(canvas, data.bounds, (moving) => {
  if (painter) painter.request(moving);
  drawScale();
});
painter = new Painter(canvas, $("over"), data, view, state);
const panel = new Panel($("panel-body"), data, painter, {
  compare: (k) => {
    state.rival = k;
    panel.showSegment(state.segment, k);
    const pressed = $("panel-body").querySelector(".bar[aria-pressed=true]");
    if (pressed) pressed.focus();
  },
  highlight: (f) => highlight(state.classOf === f ? null : f),
  landmark: (l) => selectLandmark(l, true),
  segment: (i) => selectSegment(i, true),
});

// ---- head ---------------------------------------------------------------------------------
function fillHead() {
  const { raw } = data, [x0, y0, x1, y1] = data.bounds;
  const length = (m) => (m >= 1000 ? `${(m / 1000).toPrecision(3)}\u00a0km` : `${+m.toPrecision(3)}\u00a0m`);
  const brief = [
    `${many(raw.count, "landmark")}, ${many(data.S, "segment")}`,
    `${length(x1 - x0)} × ${length(y1 - y0)}`,
    [raw.facts.Profile && `profile ${raw.facts.Profile}`,
      raw.facts["Ontology hash"] && `ontology ${raw.facts["Ontology hash"].slice(0, 8)}`].filter(Boolean).join(", "),
  ].filter(Boolean);
  $("counts").append(...brief.map((text) => el("span", { text })));
  const rows = Object.entries(raw.facts).filter(([, value]) => value);
  for (const [name, value] of rows) $("facts").append(el("dt", { text: name }), el("dd", { text: value, class: /hash/.test(name) ? "code" : null }));
  const settings = Object.entries(raw.config).filter(([, value]) => value !== null && value !== "");
  if (settings.length) {
    $("facts").append(el("dt", { text: "Settings" }), el("dd", { class: "code", text: settings.map(([k, v]) => `${k} = ${v}`).join("\n") }));
  }
  $("attribution").textContent = raw.attribution;
  $("north-text").textContent = raw.geographic ? "N" : "y";
}

// ---- notices ------------------------------------------------------------------------------
function fillNotices() {
  const { unknown, outside, duplicates, notes } = data.raw.report, body = $("notices-body");
  const add = (text) => body.append(el("p", { text }));
  if (unknown.length) {
    const total = unknown.reduce((sum, [, n]) => sum + n, 0);
    const title = `${many(unknown.length, "class or tag", "classes or tags")} not in the ontology (${many(total, "landmark")})`;
    body.append(el("details", {}, el("summary", { text: title }),
      el("ul", { class: "unknown-list" }, ...unknown.slice(0, 500).map(([name, n]) => el("li", {}, el("span", { text: name }), el("span", { class: "n", text: number(n) }))))));
  }
  if (outside) add(`${many(outside, "landmark")} outside the area.`);
  if (duplicates) add(`${many(duplicates, "landmark")} given more than once.`);
  for (const note of notes) add(note);
  if (!data.raw.landmarks) add(`${many(data.raw.count, "landmark")} are too many to draw; the segments rest on all of them.`);
  $("notices").hidden = !body.children.length;
}

// ---- legend -------------------------------------------------------------------------------
function fillLegend() {
  const total = data.area.reduce((a, b) => a + b, 0) || 1;
  const share = new Map();
  data.label.forEach((k, i) => share.set(k, (share.get(k) || 0) + data.area[i] / total));
  const keys = data.envs.map((_, k) => k).sort((a, b) => (share.get(b) || 0) - (share.get(a) || 0));
  if (share.has(-1) || !data.S) keys.push(-1);
  for (const k of keys) {
    const part = share.get(k) || 0, env = data.envs[k];
    const box = el("input", { type: "checkbox", checked: true });
    box.addEventListener("change", () => {
      if (box.checked) state.hidden.delete(k);
      else state.hidden.add(k);
      painter.recolour();
      painter.request();
    });
    $("legend").append(el("li", { class: part ? null : "absent", title: env ? env.definition : "No evidence, or nobody has looked" },
      el("label", {}, box, panel.swatch(k), el("span", { class: "name", text: env ? env.label : "Unknown" }), el("span", { class: "n", text: part ? percent(part) : "–" }))));
    if (part) $("shares").append(el("span", { class: env ? null : "unknown", colour: env && env.colour, width: part * 100 }));
  }
  $("mode").append(el("option", { value: "winner", text: "likeliest environment" }), el("option", { value: "margin", text: "certainty" }),
    el("optgroup", { label: "probability of" }, ...data.envs.map((env, k) => el("option", { value: k, text: env.label }))));
}

function setMode(value) {
  state.mode = value === "winner" || value === "margin" ? value : "p";
  state.probabilityOf = state.mode === "p" ? +value : null;
  painter.recolour();
  painter.request();
  drawRamp();
}

function drawRamp() {
  const ctx = $("ramp-bar").getContext("2d"), winner = state.mode === "winner";
  for (let x = 0; x < 200; x++) {
    const t = Math.floor((x / 200) * 10) / 9;
    ctx.fillStyle = winner ? css(mix(painter.paper, painter.ink, 0.12 + 0.5 * t)) : painter.ramp(t);
    ctx.fillRect(x, 0, 1, 8);
  }
  $("ramp-text").textContent = winner ? "The paler, the less certain." : state.mode === "margin"
    ? "Lead of the likeliest over the next: 0 to 1." : `Probability of ${data.envs[state.probabilityOf].label}: 0 to 1.`;
}

// ---- classes ------------------------------------------------------------------------------
function fillClasses(all = false) {
  const shown = all ? data.classes : data.classes.slice(0, 10), list = $("classes");
  $("classes-section").hidden = !data.classes.length;
  $("classes-unit").textContent = `${data.classes.length === 1 ? "1 class" : `${data.classes.length} classes`}`;
  list.replaceChildren(...shown.map((f) => el("li", {}, el("button", {
    type: "button", "aria-pressed": state.classOf === f, click: () => highlight(state.classOf === f ? null : f),
  }, el("span", { class: "dot", colour: painter.dotColour(f) }), el("span", { class: "name", text: data.features[f].label }), el("span", { class: "n", text: number(data.classCount[f]) })))));
  if (shown.length < data.classes.length) {
    list.append(el("li", {}, el("button", { type: "button", class: "more", click: () => fillClasses(true), text: `${data.classes.length - shown.length} more` })));
  }
  fillClasses.all = all;
}

function highlight(f) {
  state.classOf = f;
  $("highlight").hidden = f === null;
  if (f !== null) {
    $("highlight-text").textContent = `${number(data.classCount[f])} ${data.classCount[f] === 1 ? running(data.features[f].label) : data.features[f].plural}`;
    if (!state.layers.landmarks) $("layer-landmarks").click();
  }
  fillClasses(fillClasses.all);
  painter.request();
}

// ---- selection ----------------------------------------------------------------------------
/** How much of the map the open panel covers. */
function covered() {
  if ($("panel").hidden) return {};
  const box = $("panel").getBoundingClientRect(), map = canvas.getBoundingClientRect();
  return box.width > map.width * 0.9 ? { bottom: Math.max(0, map.bottom - box.top) } : { right: Math.max(0, map.right - box.left) };
}

function openPanel(label) {
  $("panel").hidden = false;
  $("panel-body").scrollTop = 0;
  $("hint").hidden = true;
  document.body.classList.add("explaining");
  document.body.classList.remove("tools-open");
  $("drawer").setAttribute("aria-expanded", "false");
  $("status").textContent = label;
  painter.requestChosen();
}

function selectSegment(i, show = false) {
  [state.segment, state.landmark, state.rival] = [i, -1, null];
  panel.showSegment(i, null);
  const k = data.label[i];
  openPanel(k < 0 ? `Segment ${data.id[i]}: unknown` : `Segment ${data.id[i]}: ${data.envs[k].label}, ${percent(data.p(i, k))}`);
  root.dataset.segment = data.id[i];
  setHash(`#segment=${encodeURIComponent(data.id[i])}`);
  if (show) {
    const b = data.box.subarray(4 * i, 4 * i + 4), w = 4 * (b[2] - b[0]), h = 4 * (b[3] - b[1]);
    view.showBox([b[0] - w, b[1] - h, b[2] + w, b[3] + h], covered());
  }
}

function selectLandmark(l, show = false) {
  [state.segment, state.landmark] = [-1, l];
  panel.showLandmark(l);
  openPanel(`${data.features[data.feature[l]].label} ${data.landmarkId[l]}`);
  delete root.dataset.segment;
  if (!state.layers.landmarks) $("layer-landmarks").click();
  if (show) {
    const reach = 150 / Math.max(view.k, view.fitted * 4);
    view.showBox([data.lx[l] - reach, data.ly[l] - reach, data.lx[l] + reach, data.ly[l] + reach], covered());
  }
}

function closePanel() {
  if ($("panel").hidden) return;
  const inside = $("panel").contains(document.activeElement);
  $("panel").hidden = true;
  [state.segment, state.landmark] = [-1, -1];
  document.body.classList.remove("explaining");
  delete root.dataset.segment;
  setHash("");
  if (inside) canvas.focus();
  painter.requestChosen();
}

function setHash(hash) {
  try {
    history.replaceState(null, "", hash || location.pathname + location.search);
  } catch {
    // Some viewers forbid it; the map works without.
  }
}

function followHash() {
  const match = /^#segment=(.*)$/.exec(location.hash);
  if (!match) return;
  let id = match[1];
  try {
    id = decodeURIComponent(id);
  } catch {
    // Not encoded: take it as it is.
  }
  const i = data.byId.get(id);
  if (i !== undefined) selectSegment(i, true);
  else $("status").textContent = `There is no segment ${id}.`;
}

// ---- pointer ------------------------------------------------------------------------------
const visibleLandmark = (l) => state.classOf === null || data.feature[l] === state.classOf;

function under(px, py) {
  const [x, y] = view.place(px, py), reach = Math.max(painter.radius + 2, 5) / view.k;
  const l = state.layers.landmarks && painter.radius >= 1.5 ? data.landmarkAt(x, y, reach, visibleLandmark) : -1;
  return { x, y, landmark: l, segment: state.layers.segments ? data.segmentAt(x, y) : -1 };
}

function hover(px, py) {
  const { x, y, landmark, segment } = under(px, py), tip = $("tip");
  const place = data.degrees(x, y);
  $("readout").textContent = place ? degreesText(place) : metresText(x, y, data.raw.unit);
  if (segment !== state.hover) {
    state.hover = segment;
    painter.requestChosen();
  }
  canvas.classList.toggle("over", landmark >= 0 || segment >= 0);
  tip.hidden = landmark < 0 && segment < 0;
  if (tip.hidden) return;
  const lines = [];
  if (landmark >= 0) {
    const f = data.feature[landmark];
    lines.push(el("p", { class: "tip-title" }, el("span", { class: "dot", colour: painter.dotColour(f) }), data.features[f].label),
      el("p", { class: "tip-more", text: `${data.landmarkId[landmark]} · confidence ${percent(data.confidence[landmark])}` }));
  } else {
    const k = data.label[segment], inside = many(data.count[segment], "landmark");
    const title = k < 0 ? "Unknown" : `${data.envs[k].label} ${percent(data.p(segment, k))}`;
    const next = k < 0 ? -1 : data.order(segment).find((j) => j !== k) ?? -1;
    lines.push(el("p", { class: "tip-title" }, panel.swatch(k), title),
      el("p", { class: "tip-more", text: next >= 0 && data.p(segment, next) >= 0.005 ? `then ${data.envs[next].label} ${percent(data.p(segment, next))} · ${inside}` : inside }));
  }
  tip.replaceChildren(...lines);
  const w = tip.offsetWidth, h = tip.offsetHeight;
  tip.style.left = `${px + 16 + w > view.width ? px - w - 12 : px + 16}px`;
  tip.style.top = `${py + 18 + h > view.height ? py - h - 10 : py + 18}px`;
}

function leave() {
  $("tip").hidden = true;
  $("readout").textContent = "";
  if (state.hover >= 0) {
    state.hover = -1;
    painter.requestChosen();
  }
}

function choose(px, py) {
  const { landmark, segment } = under(px, py);
  if (landmark >= 0) selectLandmark(landmark);
  else if (segment >= 0) selectSegment(segment);
  else closePanel();
}

// ---- scale bar ----------------------------------------------------------------------------
/** A round length that is at most 120 pixels long: [pixels, words]. */
function scale() {
  const most = 120 / view.k, ten = 10 ** Math.floor(Math.log10(most));
  const metres = [5, 2, 1].map((f) => f * ten).find((m) => m <= most);
  const words = metres >= 1000 ? `${metres / 1000} km` : metres >= 1 ? `${metres} m` : `${+(metres * 100).toPrecision(2)} cm`;
  return [metres * view.k, words];
}

function drawScale() {
  const [pixels, words] = scale();
  $("scale-bar").style.width = `${pixels}px`;
  $("scale-text").textContent = words;
}

// ---- everything together ------------------------------------------------------------------
function listen() {
  listenToGestures(view, {
    hover, leave, click: choose,
    enter: () => choose(view.width / 2, view.height / 2),
  });
  listenToSearch(data, $("search"), $("found"), {
    highlight,
    landmark: (l) => selectLandmark(l, true),
    segment: (i) => selectSegment(i, true),
    clear: () => state.classOf !== null && highlight(null),
  });
  $("zoom-in").addEventListener("click", () => view.zoom(1.6, undefined, undefined, true));
  $("zoom-out").addEventListener("click", () => view.zoom(1 / 1.6, undefined, undefined, true));
  $("zoom-fit").addEventListener("click", () => view.fly(...view.whole()));
  $("panel-close").addEventListener("click", closePanel);
  $("highlight-off").addEventListener("click", () => highlight(null));
  $("mode").addEventListener("change", (event) => setMode(event.target.value));
  $("dots").addEventListener("change", (event) => {
    state.dots = event.target.value;
    painter.recolour();
    fillClasses(fillClasses.all);
    painter.request();
  });
  for (const layer of Object.keys(state.layers)) {
    $(`layer-${layer}`).addEventListener("change", (event) => {
      state.layers[layer] = event.target.checked;
      painter.request();
    });
  }
  $("drawer").addEventListener("click", () => {
    const open = document.body.classList.toggle("tools-open");
    $("drawer").setAttribute("aria-expanded", open);
  });
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    if (!$("panel").hidden) closePanel();
    else if (state.classOf !== null) highlight(null);
    else document.body.classList.remove("tools-open");
  });
  window.addEventListener("hashchange", followHash);
  const theme = () => {
    painter.readTheme();
    painter.request();
    drawRamp();
    fillClasses(fillClasses.all);
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", theme);
  window.addEventListener("beforeprint", () => {
    root.classList.add("printing"); // light, whatever the screen is
    theme();
    painter.drawMap();
    painter.markChosen(painter.ctx); // on one sheet: print engines take a second canvas for white
    painter.markScale(...scale());
  });
  window.addEventListener("afterprint", () => {
    root.classList.remove("printing");
    theme();
  });
  new ResizeObserver(() => view.resize(canvas.clientWidth, canvas.clientHeight)).observe($("stage"));
}

fillHead();
fillNotices();
fillLegend();
fillClasses();
drawRamp();
listen();
view.resize(canvas.clientWidth, canvas.clientHeight);
followHash();
painter.draw();
root.dataset.ready = "true";
