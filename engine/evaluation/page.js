"use strict";
// Pick an environment in the legend; read the maps cell by cell with mouse or keyboard.
(() => {
  const words = new Map();
  const buttons = [...document.querySelectorAll(".legend button[data-code]")];
  for (const button of buttons) {
    words.set(button.dataset.code, button.textContent.trim());
    button.addEventListener("click", () => choose(button));
  }

  function choose(button) {
    const on = button.getAttribute("aria-pressed") !== "true";
    for (const other of buttons) {
      other.setAttribute("aria-pressed", String(on && other === button));
    }
    for (const shape of document.querySelectorAll(".maps [data-code]")) {
      shape.classList.toggle("dim", on && shape.dataset.code !== button.dataset.code);
    }
  }

  const marks = document.getElementById("marks");
  marks.addEventListener("click", () => {
    const on = marks.getAttribute("aria-pressed") !== "true";
    marks.setAttribute("aria-pressed", String(on));
    document.body.classList.toggle("no-marks", !on);
  });

  for (const maps of document.querySelectorAll(".maps")) {
    const side = Number(maps.dataset.cells);
    const { truth, label } = maps.dataset;
    const cursors = [...maps.querySelectorAll(".cursor")];
    const told = document.getElementById(maps.dataset.output);
    let cell = -1;

    // Cells are counted row by row from the south, the picture from the top.
    const at = (row, column) => row * side + column;
    const wrong = (i) => truth[i] !== "." && truth[i] !== label[i];

    function go(next) {
      cell = next;
      const row = Math.floor(cell / side), column = cell % side;
      for (const cursor of cursors) {
        cursor.setAttribute("x", column);
        cursor.setAttribute("y", side - 1 - row);
        cursor.removeAttribute("display");
      }
      const place = `Row ${row + 1} from the south, column ${column + 1} from the west: `;
      const says = `the map says ${words.get(label[cell]) ?? "unknown"}`;
      if (truth[cell] === ".") told.textContent = `${place}no truth; ${says}.`;
      else if (wrong(cell)) {
        told.textContent = `${place}wrong: the truth is ${words.get(truth[cell])}, ${says}.`;
      } else told.textContent = `${place}right: ${words.get(truth[cell])}.`;
    }

    function nextWrong(step) {
      for (let n = 1; n <= truth.length; n += 1) {
        const i = (Math.max(cell, 0) + n * step + n * truth.length) % truth.length;
        if (wrong(i)) return i;
      }
      return Math.max(cell, 0);
    }

    maps.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const row = cell < 0 ? side - 1 : Math.floor(cell / side), column = cell < 0 ? 0 : cell % side;
      const last = side - 1;
      const moves = {
        ArrowUp: () => at(Math.min(row + 1, last), column),
        ArrowDown: () => at(Math.max(row - 1, 0), column),
        ArrowLeft: () => at(row, Math.max(column - 1, 0)),
        ArrowRight: () => at(row, Math.min(column + 1, last)),
        Home: () => at(row, 0),
        End: () => at(row, last),
        n: () => nextWrong(1),
        p: () => nextWrong(-1),
      };
      if (!(event.key in moves)) return;
      event.preventDefault();
      go(cell < 0 && event.key.startsWith("Arrow") ? at(last, 0) : moves[event.key]());
    });

    for (const drawing of maps.querySelectorAll("svg")) {
      drawing.addEventListener("pointermove", (event) => {
        const box = drawing.querySelector(".frame").getBoundingClientRect();
        const column = Math.floor(((event.clientX - box.left) / box.width) * side);
        const row = side - 1 - Math.floor(((event.clientY - box.top) / box.height) * side);
        if (column >= 0 && column < side && row >= 0 && row < side) go(at(row, column));
      });
    }
  }
  document.documentElement.dataset.ready = "true";
})();
