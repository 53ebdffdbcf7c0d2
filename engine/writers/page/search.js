// search.js: finds classes, segments and landmarks by name.

/** Classes, segments and landmarks that match, at most eight. */
function matches(data, text, go) {
  const word = text.trim().toLowerCase();
  if (!word) return [];
  const out = [];
  const rank = (name) => (name.startsWith(word) ? 0 : name.includes(word) ? 1 : 2);
  const classes = data.classes
    .map((f) => ({ f, rank: Math.min(rank(data.features[f].label.toLowerCase()), rank(data.features[f].plural.toLowerCase()), rank(data.features[f].name.toLowerCase())) }))
    .filter((c) => c.rank < 2).sort((a, b) => a.rank - b.rank).slice(0, 5);
  for (const { f } of classes) {
    out.push({ text: data.features[f].label, more: many(data.classCount[f], "landmark"), go: () => go.highlight(f) });
  }
  const byId = (ids, make) => {
    for (let exact = 1; exact >= 0; exact--) {
      for (let i = 0; i < ids.length && out.length < 8; i++) {
        const id = ids[i].toLowerCase();
        if (exact ? id === word : id !== word && id.startsWith(word)) out.push(make(i));
      }
    }
  };
  byId(data.id, (i) => ({ text: `Segment ${data.id[i]}`, more: data.label[i] < 0 ? "unknown" : data.envs[data.label[i]].label, go: () => go.segment(i) }));
  byId(data.landmarkId, (l) => ({ text: data.landmarkId[l], more: data.features[data.feature[l]].label, go: () => go.landmark(l) }));
  return out;
}

/**
 * A box with a list of matches below it (the ARIA combobox pattern).
 * @param {{highlight: Function, landmark: Function, segment: Function, clear: Function}} go
 */
function listenToSearch(data, box, list, go) {
  let found = [], at = 0;
  const mark = (to) => {
    at = (to + found.length) % found.length;
    [...list.children].forEach((node, j) => node.setAttribute("aria-selected", j === at));
    box.setAttribute("aria-activedescendant", `found-${at}`);
  };
  const show = (open) => {
    list.hidden = !open;
    box.setAttribute("aria-expanded", open);
    if (!open) box.removeAttribute("aria-activedescendant");
  };
  const take = (j) => {
    show(false);
    box.value = found[j].text.replace(/^Segment /, "");
    found[j].go();
  };
  box.addEventListener("input", () => {
    found = matches(data, box.value, go);
    list.replaceChildren(...found.map((m, j) => el("li", { id: `found-${j}`, role: "option", click: () => take(j) }, el("span", { text: m.text }), el("span", { class: "n", text: m.more }))));
    if (!found.length && box.value.trim()) list.replaceChildren(el("li", { class: "quiet", text: "Nothing has that name." }));
    show(Boolean(box.value.trim()));
    if (found.length) mark(0);
    if (!box.value) go.clear();
  });
  box.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !list.hidden) {
      show(false);
      event.stopPropagation();
    } else if (found.length && !list.hidden && event.key === "ArrowDown") mark(at + 1);
    else if (found.length && !list.hidden && event.key === "ArrowUp") mark(at - 1);
    else if (found.length && event.key === "Enter") take(at);
    else return;
    event.preventDefault();
  });
  list.addEventListener("pointerdown", (event) => event.preventDefault()); // keeps the focus
  box.addEventListener("blur", () => show(false));
}
