// The page with YASGUI: its editor (YASQE) and its table (YASR). Nothing is kept in the browser.
"use strict";

// The detail of a problem, which YASGUI would show as the JSON that it is in.
async function said(error) {
  try {
    const made = document.createElement("p");
    made.className = "problem";
    made.textContent = JSON.parse(error.text).detail;
    return made.textContent ? made : undefined;
  } catch {
    return undefined;
  }
}

/* exported richEditor */
function richEditor(prefixes, endpoint, headers) {
  const { Yasqe, Yasr } = window.Yasgui;
  const place = document.getElementById("editor");
  const results = document.getElementById("results");

  // Those that YASGUI brings ask other servers or know other prefixes.
  Yasqe.forkAutocompleter("prefixes", {
    name: "ours",
    persistenceId: null,
    get: () => Object.entries(prefixes).map(([name, iri]) => `${name}: <${iri}>`).sort(),
  }, true);
  Yasqe.defaults.autocompleters = ["ours", "variables"];

  place.hidden = false;
  document.getElementById("plain").hidden = true;
  const editor = new Yasqe(place, {
    autocompleters: ["ours", "variables"],
    persistenceId: null,
    consumeShareLink: null,
    createShareableLink: (yasqe) => {
      const link = new URL("query", document.baseURI);
      link.searchParams.set("query", yasqe.getValue());
      return link.href;
    },
    collapsePrefixesOnLoad: false,
    resizeable: true,
    editorHeight: "340px",
    requestConfig: {
      endpoint,
      method: "POST",
      acceptHeaderSelect: "application/sparql-results+json",
      acceptHeaderGraph: "text/turtle",
      acceptHeaderUpdate: "*/*",
      headers,
    },
  });
  const table = new Yasr(results, {
    persistenceId: null,
    prefixes: () => ({ ...prefixes, ...editor.getPrefixesFromQuery() }),
    getDownloadFileName: () => "results",
    plugins: { table: { dynamicConfig: { compact: true } } },
    errorRenderers: [said],
  });
  editor.on("queryResponse", (_, response, duration) => table.setResponse(response, duration));
  return {
    get: () => editor.getValue(),
    set: (query) => editor.setValue(query),
  };
}
