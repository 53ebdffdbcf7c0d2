// The page without YASGUI: a text field, a table, CSV from the server itself.
"use strict";

/* exported plainEditor */
function plainEditor(ask) {
  const form = document.getElementById("plain");
  const field = document.getElementById("text");
  const save = document.getElementById("save");
  const results = document.getElementById("results");

  function table(found) {
    const names = found.head.vars;
    const made = document.createElement("table");
    const head = made.createTHead().insertRow();
    for (const name of names) {
      const cell = document.createElement("th");
      cell.textContent = name;
      head.append(cell);
    }
    const body = made.createTBody();
    for (const solution of found.results.bindings) {
      const row = body.insertRow();
      for (const name of names) row.insertCell().textContent = solution[name]?.value ?? "";
    }
    return made;
  }

  function text(content) {
    const made = document.createElement("pre");
    made.textContent = content;
    return made;
  }

  async function run() {
    const response = await ask(field.value, "application/sparql-results+json, text/turtle;q=0.9");
    results.replaceChildren();
    save.hidden = true;
    if (!response) return;
    const content = await response.text();
    if (!(response.headers.get("Content-Type") ?? "").includes("json")) {
      results.append(text(content || "done"));
      return;
    }
    const found = JSON.parse(content);
    if ("boolean" in found) {
      results.append(text(found.boolean ? "yes" : "no"));
      return;
    }
    results.append(table(found));
    save.hidden = false;
  }

  form.addEventListener("submit", (event) => {
    event.preventDefault();
    run();
  });
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      run();
    }
  });
  save.addEventListener("click", async () => {
    const response = await ask(field.value, "text/csv");
    if (!response) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(await response.blob());
    link.download = "results.csv";
    link.click();
    URL.revokeObjectURL(link.href);
  });
  return {
    get: () => field.value,
    set: (query) => { field.value = query; },
  };
}
