"use strict";
// Sliders over a page: every change is run by the program that serves the page, and what comes back is drawn.
(function () {
  const view = JSON.parse(document.getElementById("sliders").textContent), box = document.getElementById("view");
  const changed = new Map();  // values by key, of those that are not as the scenario states them
  const patience = 1000;      // a run that takes longer [ms] is given up for a later one
  let asking = null, asked_at = 0, stale = false;

  function element(name, text, attributes) {
    const made = document.createElement(name);
    if (text !== undefined) made.textContent = text;
    Object.entries(attributes || {}).forEach(([key, value]) => made.setAttribute(key, value));
    return made;
  }
  const fault = element("p", "", { class: "fault", role: "alert" }), command = element("code", view.command);
  const reset = element("button", "As stated", { type: "button", title: "all parameters as the scenario states them" });
  const short = (x) => String(Number(x.toPrecision(6)));

  async function run() {
    if (asking) {
      stale = true;
      if (performance.now() - asked_at > patience) asking.abort();
      return;
    }
    do {
      stale = false;
      asking = new AbortController();
      asked_at = performance.now();
      try {
        const answer = await fetch("run", { method: "POST", signal: asking.signal, headers: { "Content-Type": "application/json" },
                                            body: JSON.stringify(Object.fromEntries(changed)) });
        const found = await answer.json();
        if (answer.ok) window.report.show(found);
        if (answer.status !== 409) fault.textContent = answer.ok ? "" : found.message;
      } catch (error) {
        if (error.name !== "AbortError") fault.textContent = "The program that serves this page has ended; start wormdrive view again.";
      }
    } while (stale);
    asking = null;
    document.dispatchEvent(new Event("wormdrive:drawn"));
  }
  function told() {
    command.textContent = view.command + [...changed].map(([key, value]) => ` --set ${key.includes("[") ? `'${key}=${value}'` : `${key}=${value}`}`).join("");
    reset.disabled = changed.size === 0;
  }

  const sliders = view.sliders.map((s, k) => {
    const row = element("div", undefined, { class: "slider" }), name = s.key.slice(s.key.indexOf(".") + 1);
    const range = element("input", undefined, { type: "range", id: "slider" + k, min: s.low, max: s.high, step: "any" });
    const number = element("input", undefined, { type: "number", step: "any", "aria-label": s.key });
    row.append(element("label", name, { for: "slider" + k, title: s.meaning }), range, number, element("span", s.unit === "1" ? "" : s.unit.replace(/\^2/g, "²")));
    const self = { key: s.key, row, set(value) {
      if (value === s.value) changed.delete(s.key);
      else changed.set(s.key, value);
      range.value = value;
      if (document.activeElement !== number) number.value = short(value);
      row.classList.toggle("changed", changed.has(s.key));
      told();
    }, reset() { self.set(s.value); } };
    range.addEventListener("input", () => { self.set(Number(range.value)); run(); });
    range.addEventListener("dblclick", () => { self.reset(); run(); });
    number.addEventListener("change", () => {
      if (number.value === "" || !Number.isFinite(Number(number.value))) self.reset();
      else self.set(Number(number.value));
      number.value = short(changed.has(s.key) ? changed.get(s.key) : s.value);
      run();
    });
    self.reset();
    return self;
  });
  const tables = new Map();
  sliders.forEach((s) => {
    const table = s.key.slice(0, s.key.lastIndexOf("."));
    if (!tables.has(table)) tables.set(table, element("details"));
    if (!tables.get(table).childElementCount) tables.get(table).append(element("summary", table));
    tables.get(table).append(s.row);
  });
  // few are all in sight; of many, those of the first table
  const few = 8;
  [...tables.values()].forEach((details, k) => { details.open = k === 0 || sliders.length <= few; });
  reset.addEventListener("click", () => { sliders.forEach((s) => s.reset()); run(); });
  const last = element("p");
  last.append(reset, command);
  box.append(...tables.values(), fault, last);
  told();
  // the browser compiles what draws before anybody moves a slider
  requestAnimationFrame(() => setTimeout(() => window.report.show(window.report.data)));
  window.view = { sliders, changed };  // for whoever drives the page from outside
})();
