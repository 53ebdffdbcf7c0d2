// Search over all terms, filter and sort tables. Plain script; nothing is loaded from the network.
"use strict";

function fold(text) {
  return text.normalize("NFD").replace(/[\u0300-\u036f]/g, "").toLowerCase();
}

function score(entry, words) {
  // Lower is better; a negative number is no hit. Names count before definitions.
  let total = 0;
  for (const word of words) {
    const at = Math.min(
      ...[entry.folded, entry.name].map((t) => {
        const i = t.indexOf(word);
        return i === 0 ? (t.length === word.length ? 0 : 1) : i > 0 ? 2 : 9;
      })
    );
    if (at === 9 && !entry.rest.includes(word)) return -1;
    total += at;
  }
  return total;
}

function siteSearch(box, list) {
  const entries = (window.TERMS || []).map(([label, name, where, href, rest]) => ({
    label, where, href, folded: fold(label), name: fold(name), rest: fold(rest + " " + where), text: rest,
  }));
  let on = -1;
  const mark = (next) => {
    const items = [...list.children];
    if (!items.length) return;
    on = (next + items.length) % items.length;
    items.forEach((item, i) => item.classList.toggle("on", i === on));
    items[on].scrollIntoView({ block: "nearest" });
  };
  const show = () => {
    const words = fold(box.value).split(/\s+/).filter(Boolean);
    const hits = words.length
      ? entries.map((e) => [score(e, words), e]).filter(([s]) => s >= 0)
          .sort(([a, x], [b, y]) => a - b || x.label.length - y.label.length).slice(0, 25)
      : [];
    list.replaceChildren(...hits.map(([, e]) => {
      const item = document.createElement("li");
      const link = document.createElement("a");
      const about = document.createElement("small");
      link.href = e.href;
      about.textContent = e.where + (e.text ? " · " + e.text : "");
      link.append(e.label, about);
      item.append(link);
      return item;
    }));
    if (words.length && !hits.length) {
      const none = document.createElement("li");
      none.textContent = "nothing found";
      list.append(none);
    }
    list.hidden = !words.length;
    on = -1;
  };
  box.addEventListener("input", show);
  box.addEventListener("focus", show);
  box.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown") mark(on + 1);
    else if (event.key === "ArrowUp") mark(on - 1);
    else if (event.key === "Escape") list.hidden = true;
    else if (event.key === "Enter") {
      const link = (list.children[Math.max(on, 0)] || list).querySelector("a");
      if (link) { link.click(); list.hidden = true; }
    } else return;
    event.preventDefault();
  });
  list.addEventListener("click", () => { list.hidden = true; });
  document.addEventListener("click", (event) => {
    if (!event.target.closest(".search")) list.hidden = true;
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "/" && !/input|textarea/i.test(document.activeElement.tagName)) {
      event.preventDefault();
      box.focus();
    }
  });
}

function filterRows(box) {
  const target = document.getElementById(box.dataset.filter);
  const rows = [...target.querySelectorAll("[data-row]")];
  const texts = rows.map((row) => fold(row.textContent));
  const count = document.getElementById(box.dataset.filter + "-count");
  const apply = () => {
    const words = fold(box.value).split(/\s+/).filter(Boolean);
    let shown = 0;
    rows.forEach((row, i) => {
      const hit = words.every((word) => texts[i].includes(word));
      row.hidden = !hit;
      shown += hit;
    });
    if (count) count.textContent = words.length ? `${shown} of ${rows.length}` : "";
  };
  box.addEventListener("input", apply);
  apply();
}

function sortTable(table) {
  const body = table.tBodies[0];
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => {
    const button = head.querySelector("button");
    if (!button) return;
    const key = (row) => {
      const cell = row.cells[column];
      return cell.dataset.value === undefined ? cell.textContent.trim() : Number(cell.dataset.value);
    };
    button.addEventListener("click", () => {
      const numeric = body.rows.length && typeof key(body.rows[0]) === "number";
      const was = head.getAttribute("aria-sort");
      const up = was ? was === "descending" : !numeric;
      heads.forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      const rows = [...body.rows].sort((a, b) => {
        const [x, y] = [key(a), key(b)];
        const order = numeric ? x - y : x.localeCompare(y);
        return up ? order : -order;
      });
      body.append(...rows);
    });
  });
}

const box = document.getElementById("site-search");
if (box) siteSearch(box, document.getElementById("site-results"));
document.querySelectorAll("input[data-filter]").forEach(filterRows);
document.querySelectorAll("table.sortable").forEach(sortTable);
window.addEventListener("beforeprint", () => {
  document.querySelectorAll("details").forEach((details) => { details.open = true; });
});
