// panel.js: the explanation of one segment or landmark, in sentences and bars.

/** Makes an element: el("p", {class: "x", text: "..."}, child, child). Text is never markup. */
function el(tag, options = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(options)) {
    if (value === null || value === undefined || value === false) continue;
    if (name === "text") node.textContent = value;
    else if (name === "colour") node.style.backgroundColor = value;
    else if (name === "width") node.style.width = `${value}%`;
    else if (name === "left") node.style.left = `${value}%`;
    else if (name === "click") node.addEventListener("click", value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

const number = (n) => n.toLocaleString("en");
const many = (n, one, more = `${one}s`) => `${number(n)} ${n === 1 ? one : more}`;
const percent = (p) => (p > 0 && p < 0.005 ? "< 1%" : p < 1 && p >= 0.995 ? "> 99%" : `${Math.round(p * 100)}%`);
const amount = (v) => (Math.abs(v) < 0.005 ? "less than 0.01" : Math.abs(v).toFixed(2));
const running = (label) => (/^\p{Lu}\p{Ll}/u.test(label) ? label[0].toLowerCase() + label.slice(1) : label);
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
const sentence = (text) => (text && !/[.!?]$/.test(text) ? `${text}.` : text);

function areaText(m2) {
  if (m2 >= 1e6) return `${(m2 / 1e6).toPrecision(3)}\u00a0km²`;
  if (m2 >= 1e4) return `${(m2 / 1e4).toPrecision(3)}\u00a0ha`;
  return `${m2 >= 100 ? number(Math.round(m2)) : +m2.toPrecision(3)}\u00a0m²`;
}

class Panel {
  /** @param {{compare: Function, highlight: Function, landmark: Function, segment: Function}} go */
  constructor(body, data, painter, go) {
    Object.assign(this, { body, data, painter, go });
  }

  certainty(i) {
    const m = this.data.margin[i];
    return m >= 0.5 ? "clear" : m >= 0.2 ? "fairly clear" : "a close call";
  }

  swatch(k) {
    return el("span", { class: k < 0 ? "swatch unknown" : "swatch", colour: k < 0 ? null : this.data.envs[k].colour });
  }

  /** Fills the panel with segment i; `rival` is the environment of "why not". */
  showSegment(i, rival) {
    const { data } = this, k = data.label[i];
    const about = `Segment ${data.id[i]} · ${areaText(data.area[i])} · ${many(data.count[i], "landmark")}`;
    if (k < 0) {
      this.body.replaceChildren(
        ...this.head(-1, "Unknown", about),
        el("p", { class: "note", text: this.whyUnknown(i) }),
        this.insideList(i),
      );
      return;
    }
    const order = data.order(i), other = rival ?? order.find((j) => j !== k) ?? -1;
    const lead = el("p", { class: "lead" },
      el("strong", { text: percent(data.p(i, k)) }), ` probable, ${this.certainty(i)}`, this.lead(i, order));
    this.body.replaceChildren(
      ...this.head(k, data.envs[k].label, about),
      lead,
      this.special(i),
      this.distribution(i, order, k, other),
      this.levels(i, k),
      this.why(i, k),
      other >= 0 ? this.whyNot(i, k, other) : null,
      this.insideList(i),
    );
    this.body.querySelectorAll(":scope > .nothing").forEach((node) => node.remove());
  }

  /** How far the winner is ahead of the next, as the end of a sentence. */
  lead(i, order) {
    const { data } = this, next = order[1], points = Math.round(data.margin[i] * 100);
    if (next === undefined || data.p(i, next) < 0.005) return ".";
    return points ? `: ${many(points, "point")} ahead of ${data.envs[next].label}.` : `: level with ${data.envs[next].label}.`;
  }

  head(k, title, about) {
    const definition = k >= 0 && this.data.envs[k].definition;
    return this.title(this.swatch(k), title, about, definition);
  }

  title(mark, title, about, definition) {
    const parts = [el("h2", {}, mark, el("span", { text: title })), el("p", { class: "about", text: about })];
    if (definition) parts.push(el("p", { class: "definition", text: sentence(definition) }));
    return parts;
  }

  whyUnknown(i) {
    const { data } = this;
    if (data.unsurveyed.has(i)) {
      return "Nobody has looked here: the segment lies outside the surveyed area. What was not seen is unknown, not empty.";
    }
    if (!data.raw.count) return "The map has no landmarks, so nothing speaks for any environment.";
    if (!data.count[i]) return "No landmark stands here, and none nearby says what kind of place this is.";
    return `${capital(many(data.count[i], "landmark"))} inside, but none of them says what kind of place this is with this method.`;
  }

  special(i) {
    const { data } = this;
    if (data.count[i] === 1) {
      const only = data.inside[i][0];
      const what = only === undefined ? "One landmark" : `One landmark, ${/^[aeiou]/i.test(data.features[data.feature[only]].label) ? "an" : "a"} ${running(data.features[data.feature[only]].label)},`;
      return el("p", { class: "note", text: `${what} stands in this segment. A single one is thin evidence; read the result with care.` });
    }
    if (!data.count[i]) {
      return el("p", { class: "note", text: "No landmark stands inside. The result rests on what lies around and on the open ground." });
    }
    return el("p", { class: "nothing" });
  }

  distribution(i, order, winner, rival) {
    const { data } = this, top = Math.max(data.p(i, order[0]), 1e-9), shown = order.length > 9 ? 7 : 9;
    const row = (k) => el("li", {}, el("button", {
      type: "button", class: "bar", "aria-pressed": k === rival, disabled: k === winner,
      title: k === winner ? null : `Why not ${data.envs[k].label}?`, click: () => this.go.compare(k),
    },
    el("span", { class: "bar-name", text: data.envs[k].label }),
    el("span", { class: "track" }, el("span", { class: "fill", colour: data.envs[k].colour, width: (data.p(i, k) / top) * 100 })),
    el("span", { class: "bar-value", text: percent(data.p(i, k)) })));
    const rest = order.slice(shown);
    return el("section", { "aria-label": "Probabilities" },
      el("h3", { text: "Probabilities" }),
      el("ul", { class: "bars" }, ...order.slice(0, shown).map(row)),
      rest.length ? el("details", {}, el("summary", { text: `${many(rest.length, "more environment")}` }), el("ul", { class: "bars" }, ...rest.map(row))) : null);
  }

  /** The coarser area of the winner, and its plan zones where the evidence tells them apart. */
  levels(i, k) {
    const { data } = this, { raw } = data, zones = data.zones(i), group = data.envs[k].group;
    if (!zones) return null;
    const members = data.envs.map((env, j) => j).filter((j) => data.envs[j].group === group);
    const p = members.reduce((sum, j) => sum + data.p(i, j), 0);
    const above = group ? el("p", { class: "quiet", text: `${group} in all: ${percent(p)}.` }) : null;
    const row = ([zone, share]) => el("li", { title: raw.zones[zone].definition },
      el("span", { class: "bar static" },
        el("span", { class: "bar-name", text: raw.zones[zone].label }),
        el("span", { class: "track" }, el("span", { class: "fill", colour: data.envs[k].colour, width: (share / Math.max(data.p(i, k), 1e-9)) * 100 })),
        el("span", { class: "bar-value", text: percent(share) })));
    if (!data.envs[k].zoned && !above) return null;
    const below = zones.length ? el("ul", { class: "bars" }, ...zones.map(row))
      : el("p", { class: "quiet", text: "The evidence does not tell its zones apart." });
    return el("section", { id: "levels" },
      el("h3", { text: data.envs[k].zoned ? "Plan zone" : "Kind of area" }),
      data.envs[k].zoned ? below : null,
      above);
  }

  why(i, k) {
    const { data } = this, reasons = data.reasons(i);
    const title = el("h3", { text: `Why ${data.envs[k].label}?` });
    if (!reasons) {
      return el("section", {}, title, el("p", { class: "quiet", text: "This page was written without reasons; the command “symboslam explain” gives them." }));
    }
    return el("section", { id: "why" }, title, this.reasonList(i, k, reasons));
  }

  whyNot(i, winner, k) {
    const { data } = this, reasons = data.reasons(i);
    if (!reasons) return null;
    const behind = data.p(i, winner) - data.p(i, k), name = data.envs[k].label;
    const speaks = reasons.some((r) => (r.share.get(k) || 0) > 0.0005);
    const text = speaks
      ? `${name} reaches ${data.p(i, k).toFixed(2)}, which is ${behind.toFixed(2)} less. For it:`
      : `Nothing here speaks for ${name}.`;
    return el("section", { id: "why-not" },
      el("h3", { text: `Why not ${name}?` }), el("p", { class: "quiet", text }),
      speaks ? this.reasonList(i, k, reasons) : null);
  }

  /** Reasons for environment k, the strongest first; together with the rest they make P(k). */
  reasonList(i, k, reasons) {
    const { data } = this, p = data.p(i, k);
    const told = reasons.filter((r) => Math.abs(r.share.get(k) || 0) >= 0.0005)
      .sort((a, b) => Math.abs(b.share.get(k)) - Math.abs(a.share.get(k)));
    const rest = p - told.reduce((sum, r) => sum + r.share.get(k), 0);
    const most = Math.max(...told.map((r) => Math.abs(r.share.get(k))), Math.abs(rest), 1e-9);
    const rows = told.map((r) => this.reason(i, r, k, most));
    if (Math.abs(rest) >= 0.0015) {
      rows.push(this.reasonRow("Everything else", rest, k, most, rest < 0 ? " takes away" : " adds", ""));
    }
    const shown = 6, list = el("ol", { class: "reasons" }, ...rows.slice(0, shown));
    const more = rows.length > shown
      ? el("details", {}, el("summary", { text: `${many(rows.length - shown, "smaller reason")}` }), el("ol", { class: "reasons" }, ...rows.slice(shown)))
      : null;
    return el("div", {}, list, more, el("p", { class: "total" }, el("span", {}, "Together ", el("b", { text: p.toFixed(2) }))));
  }

  reason(i, r, k, most) {
    const { data } = this, f = data.features[r.feature], share = r.share.get(k);
    const one = r.count === 1 || f.absence || !r.count;
    const who = f.absence || !r.count ? f.label : r.count === 1 ? `1 ${running(f.label)}` : `${number(r.count)} ${f.plural}`;
    const here = Math.min(r.count, data.inside[i].filter((l) => data.feature[l] === r.feature).length);
    const around = r.count - here;
    const where = f.absence || !around || !data.n ? "" : here ? ` (${number(here)} inside, ${number(around)} around)` : " around";
    const said = data.indication(r.feature, k);
    let because = said ? sentence(said.reason) : "";
    if (share < 0) because = `${one ? "Its" : "Their"} close neighbours point elsewhere.`;
    else if (!said) because = `Through what stands next to ${one ? "it" : "them"}.`;
    const verb = share < 0 ? (one ? "takes away" : "take away") : one ? "adds" : "add";
    const click = data.classCount[r.feature] ? () => this.go.highlight(r.feature) : null;
    return this.reasonRow(who, share, k, most, where + " " + verb, because, click);
  }

  reasonRow(who, share, k, most, verb, because, click = null) {
    const width = (Math.abs(share) / most) * 100;
    return el("li", { class: share < 0 ? "against" : null },
      el("span", { class: "track" }, el("span", { class: "fill", width, colour: share < 0 ? null : this.data.envs[k].colour })),
      el("p", {},
        click ? el("button", { type: "button", class: "link", click, title: "Show them on the map", text: who }) : el("strong", { text: who }),
        `${verb} `, el("b", { text: amount(share) }), because ? ": " : ".", because ? el("span", { class: "because", text: because }) : null));
  }

  /** What stands inside segment i, by class, each landmark reachable. */
  insideList(i) {
    const { data } = this, groups = new Map();
    for (const l of data.inside[i]) {
      const f = data.feature[l];
      if (groups.has(f)) groups.get(f).push(l);
      else groups.set(f, [l]);
    }
    if (!groups.size) return el("p", { class: "nothing" });
    const rows = [...groups].sort((a, b) => b[1].length - a[1].length).map(([f, all]) => {
      const items = all.slice(0, 100).map((l) => el("li", {}, el("button", {
        type: "button", class: "link", text: data.landmarkId[l], click: () => this.go.landmark(l),
      })));
      if (all.length > 100) items.push(el("li", { text: `and ${number(all.length - 100)} more` }));
      return el("li", {}, el("details", { class: "class" },
        el("summary", {},
          el("span", { class: "dot", colour: this.painter.dotColour(f) }),
          el("span", { text: data.features[f].label }), el("span", { class: "n", text: number(all.length) })),
        el("ul", { class: "ids" }, ...items)));
    });
    return el("section", {}, el("h3", { text: "Landmarks inside" }), el("ul", { class: "inside" }, ...rows));
  }

  /** Fills the panel with landmark l. */
  showLandmark(l) {
    const { data } = this, f = data.feature[l], feature = data.features[f], home = data.home[l];
    const place = data.degrees(data.lx[l], data.ly[l]);
    const facts = [
      ["Id", data.landmarkId[l]],
      ["Confidence", percent(data.confidence[l])],
      ["Kind", feature.static ? "stays where it is" : "moves about"],
      ["Position", place ? degreesText(place) : metresText(data.lx[l], data.ly[l], data.raw.unit)],
    ];
    if (data.time && data.time[l]) facts.push(["Seen", data.time[l]]);
    if (data.agent && data.agent[l]) facts.push(["By", data.agent[l]]);
    this.body.replaceChildren(
      ...this.title(el("span", { class: "dot", colour: this.painter.dotColour(f) }), feature.label, "Landmark", feature.definition),
      el("dl", { class: "facts" }, ...facts.flatMap(([name, value]) => [el("dt", { text: name }), el("dd", { text: value })])),
      el("section", {}, el("h3", { text: `What ${feature.plural} indicate` }), this.indications(f)),
      el("p", { class: "actions" },
        home >= 0 ? el("button", { type: "button", click: () => this.go.segment(home), text: `Segment ${data.id[home]}` }) : null,
        el("button", { type: "button", click: () => this.go.highlight(f), text: `Show all ${number(data.classCount[f])} ${feature.plural}` })));
  }

  indications(f) {
    const { data } = this, all = data.features[f].indicates;
    if (!all.length) return el("p", { class: "quiet", text: "Nothing: they occur in every kind of place." });
    return el("ol", { class: "reasons indications" }, ...all.map(([k, strength, steps, path, reason, source]) => {
      const near = strength / (1 + steps);
      const way = steps ? `${path.join(" → ")}: strength ${strength.toFixed(2)} over ${many(steps, "more step")}` : "";
      return el("li", {},
        el("span", { class: "track" }, el("span", { class: "fill", width: near * 100, colour: data.envs[k].colour })),
        el("p", {}, el("strong", { text: data.envs[k].label }), " ", el("b", { text: near.toFixed(2) }), reason ? ": " : "", el("span", { class: "because", text: sentence(reason) }),
          way || source ? el("small", { text: [way, source && `Source: ${source}`].filter(Boolean).join(" · ") }) : null));
    }));
  }
}

function degreesText([lon, lat]) {
  const half = (v, plus, minus) => `${Math.abs(v).toFixed(5)}° ${v < 0 ? minus : plus}`;
  return `${half(lat, "N", "S")}, ${half(lon, "E", "W")}`;
}

function metresText(x, y, unit) {
  const digits = unit < 0.01 ? 2 : 1;
  return `x ${x.toFixed(digits)} m, y ${y.toFixed(digits)} m`;
}
