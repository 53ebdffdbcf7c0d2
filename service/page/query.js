// What the query page does whichever editor it has: examples, maps, the token, what went wrong.
"use strict";

(async () => {
  const TOKEN = "symboslam-token";
  const EXAMPLE_MAP = "https://w3id.org/symboslam/map/town/";
  const MAPS = "SELECT DISTINCT ?map WHERE { GRAPH ?g { ?map a <https://w3id.org/symboslam#EnvironmentMap> } } LIMIT 1000";
  const endpoint = new URL("sparql", document.baseURI).href;
  const prefixes = JSON.parse(document.getElementById("prefixes").textContent);
  const asked = new URLSearchParams(location.search);
  const menu = document.getElementById("example");
  const maps = document.getElementById("map");
  const token = document.getElementById("token");
  const about = document.getElementById("about");
  const problem = document.getElementById("problem");

  const headers = () => (token.value ? { Authorization: `Bearer ${token.value}` } : {});

  function tell(text) {
    problem.textContent = text;
    problem.hidden = !text;
  }

  async function post(query, accept) {
    return fetch(endpoint, {
      method: "POST",
      headers: { "Content-Type": "application/sparql-query", Accept: accept, ...headers() },
      body: query,
    });
  }

  async function ask(query, accept) {
    tell("");
    try {
      const response = await post(query, accept);
      if (response.ok) return response;
      const said = await response.json().catch(() => ({}));
      tell(said.detail ?? `${response.status} ${response.statusText}`);
    } catch (error) {
      tell(`the service does not answer (${error.message})`);
    }
    return null;
  }

  token.value = sessionStorage.getItem(TOKEN) ?? "";
  const editor = window.Yasgui
    ? richEditor(prefixes, endpoint, headers)
    : plainEditor(ask);

  let examples = [];

  function show(name) {
    const example = examples.find((each) => each.name === name);
    about.textContent = example ? example.description : "";
    if (!example) return;
    const query = example.query.split("\n").slice(3).join("\n").trimStart(); // title and so on: see above
    editor.set(maps.value ? query.replaceAll(EXAMPLE_MAP, maps.value) : query);
  }

  async function listExamples() {
    const response = await fetch("v1/examples", { headers: headers() });
    if (!response.ok) return;
    examples = await response.json();
    const groups = new Map();
    for (const example of examples) {
      const who = example.audience[0];
      if (!groups.has(who)) {
        const group = document.createElement("optgroup");
        group.label = who;
        groups.set(who, group);
      }
      groups.get(who).append(new Option(example.title, example.name));
    }
    menu.length = 1;
    menu.append(...groups.values());
  }

  async function listMaps() {
    const response = await post(MAPS, "application/sparql-results+json");
    if (!response.ok) return;
    const found = (await response.json()).results.bindings.map((each) => each.map.value);
    maps.length = 1;
    for (const iri of found.sort()) {
      const base = iri.replace(/map$/, "");
      maps.append(new Option(base.replace(/\/$/, "").split("/").pop(), base));
    }
  }

  document.getElementById("choices").addEventListener("submit", (event) => event.preventDefault());
  menu.addEventListener("change", () => show(menu.value));
  maps.addEventListener("change", () => show(menu.value));
  token.addEventListener("change", async () => {
    if (token.value) sessionStorage.setItem(TOKEN, token.value);
    else sessionStorage.removeItem(TOKEN);
    await Promise.allSettled([listExamples(), listMaps()]);
  });

  await Promise.allSettled([listExamples(), listMaps()]);
  if (asked.has("example")) {
    menu.value = asked.get("example");
    show(menu.value);
  }
  if (asked.get("query")) editor.set(asked.get("query"));
  document.documentElement.dataset.ready = "true";
})();
