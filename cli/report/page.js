"use strict";
// Draws what stands in #data: groups of charts that zoom together, events, tables. Plain browser, no network.
// report.show(data) draws another result in its place; the same signals keep their zoom.
(function () {
  let data = JSON.parse(document.getElementById("data").textContent), groups = [];
  const $ = (id) => document.getElementById(id);
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  function show(x, digits = 6) {
    if (x === null || x === undefined) return "–";
    if (typeof x !== "number") return x;
    const short = Number(x.toPrecision(digits));
    return short !== 0 && Math.abs(short) < 1e-3 ? short.toExponential() : String(short);
  }
  const typeset = (unit) => (unit && unit !== "1" ? unit.replace(/\^2/g, "²") : "");
  const with_unit = (name, unit) => (typeset(unit) ? `${name} [${typeset(unit)}]` : name);
  // "theta_g''" as the paper writes it
  const symbols = { theta: "θ", tau: "τ" };
  const written = (text) => text.replace(/\b(theta|tau)_/g, (all, name) => symbols[name] + "_").replace(/''/g, "″").replace(/(_\w)'/g, "$1′");

  function element(name, text, attributes) {
    const made = document.createElement(name);
    if (text !== undefined) made.textContent = text;
    Object.entries(attributes || {}).forEach(([key, value]) => made.setAttribute(key, value));
    return made;
  }

  // ---- head ---------------------------------------------------------------------------------------------------
  function head() {
    const thinned = data.groups.flatMap((g) => g.panels).find((p) => p.over.length < p.rows && p.style !== "points");
    $("title").textContent = data.title;
    $("summary").textContent = data.summary +
      (thinned ? `; of long signals the rows are drawn where they are largest or smallest (${thinned.over.length} of ${thinned.rows})` : "") + ".";
    $("verdict").textContent = data.verdict;
    $("verdict").hidden = !data.verdict;
    $("remarks").replaceChildren(...data.remarks.map((w) => element("li", w)));
    $("remarks").hidden = !data.remarks.length;
  }

  // ---- charts -------------------------------------------------------------------------------------------------
  const colors = ["--line1", "--line2", "--line3", "--line4"];
  let current = null;  // the group that keys act on

  function Group(group) {
    const self = { charts: [], events: group.events, chosen: -1, table: null };
    let panels, begin, end;
    function take(next) {
      group = next;
      self.events = group.events;
      panels = group.panels;
      begin = Math.min(...panels.map((p) => p.over[0]));
      end = Math.max(...panels.map((p) => p.over[p.over.length - 1]));
    }
    take(group);
    const box = element("section", undefined, { class: "group", "aria-label": group.title || "signals over " + group.over });
    if (group.title) box.append(element("h2", group.title));
    const legend = element("p", undefined, { class: "bands" });
    function legend_of_bands() {
      const meanings = new Map(group.bands.map(([, , kind, meaning]) => [kind, meaning]));
      legend.replaceChildren(...["stuck", "left", "right"].filter((kind) => meanings.has(kind)).map((kind) =>
        element("span", meanings.get(kind), { style: `background: var(--${kind})` })));
      legend.hidden = !group.bands.length;
    }
    legend_of_bands();
    const hint = () => "Point at a curve for its values" + (group.events.length ? ", at a line for the event" : "") + ".";
    const now = element("p", hint(), { class: "now", role: "status", "aria-live": "polite" });
    box.append(legend, now);
    $("groups").append(box);
    let zooming = false;

    function underlay(n) {
      return (canvas, area, chart) => {
        const panel = panels[n], [from, to] = chart.xAxisRange();
        group.bands.forEach(([low, high, kind]) => {
          if (high < from || low > to) return;
          const left = chart.toDomXCoord(Math.max(low, from)), right = chart.toDomXCoord(Math.min(high, to));
          canvas.fillStyle = css("--" + kind);
          canvas.fillRect(left, area.y, Math.max(right - left, 0.5), area.h);
        });
        if (panel.filled) {
          const [low, high] = panel.series, at = panel.over.map((x, k) => k);
          canvas.fillStyle = css("--stuck");
          canvas.beginPath();
          at.forEach((k) => canvas.lineTo(chart.toDomXCoord(panel.over[k]), chart.toDomYCoord(low.values[k])));
          at.reverse().forEach((k) => canvas.lineTo(chart.toDomXCoord(panel.over[k]), chart.toDomYCoord(high.values[k])));
          canvas.fill();
        }
        const line = (x0, y0, x1, y1, color, width) => {
          canvas.strokeStyle = css(color);
          canvas.lineWidth = width;
          canvas.beginPath();
          canvas.moveTo(x0, y0);
          canvas.lineTo(x1, y1);
          canvas.stroke();
        };
        panel.limits.forEach((y) => {
          const at = chart.toDomYCoord(y);
          line(area.x, at, area.x + area.w, at, "--chosen", 1.5);
        });
        group.events.forEach((e, k) => {
          if (e.at < from || e.at > to) return;
          const x = Math.round(chart.toDomXCoord(e.at)) + 0.5, is_chosen = k === self.chosen;
          line(x, area.y, x, area.y + area.h, is_chosen ? "--chosen" : "--event", is_chosen ? 2 : 1);
        });
      };
    }

    const rows_of = (panel) => panel.over.map((x, k) => [x, ...panel.series.map((s) => s.values[k])]);
    function draw(panel, n) {
      const frame = element("div", undefined, { class: "panel" }), heading = element("h3");
      const chart_box = element("div", undefined, { class: "chart", tabindex: "0", role: "img",
        "aria-label": panel.series.map((s) => s.meaning).join(", ") + " over " + group.over });
      if (panels.length === 1) chart_box.classList.add("tall");
      panel.series.forEach((s, k) =>
        heading.append(element("span", with_unit(written(s.meaning), s.units), { style: `--line: var(${colors[k]})` })));
      panel.limits.forEach((y) => heading.append(element("span", "limit " + show(y), { style: "--line: var(--chosen)" })));
      frame.append(heading, chart_box);
      box.append(frame);
      // what is filled is what matters: a line beside it may leave the picture
      const kept = panel.filled ? panel.series.slice(0, 2).flatMap((s) => s.values).filter((y) => y !== null) : [];
      const low = Math.min(...kept), high = Math.max(...kept), room = 0.15 * (high - low);
      const values = high > low ? [low - room, high + room] : null;  // null: as far as the lines in sight reach
      const cloud = panel.style === "points" ? { [panel.series[0].name]: { strokeWidth: 0, drawPoints: true, pointSize: panel.over.length > 500 ? 1.5 : 2.5, highlightCircleSize: 4 } } : {};
      const chart = new Dygraph(chart_box, rows_of(panel), {
        labels: [group.over, ...panel.series.map((s) => s.name)], series: cloud, colors: panel.series.map((_, k) => css(colors[k])),
        gridLineColor: css("--grid"), axisLineColor: css("--rule"), dateWindow: [begin, end], legend: "never", strokeWidth: 1.4,
        yRangePad: 8, valueRange: values, labelsKMB: false, stepPlot: panel.style === "steps", underlayCallback: underlay(n),
        xlabel: panel === panels[panels.length - 1] ? with_unit(group.over, group.units) : undefined, xLabelHeight: 16,
        axes: { x: { axisLabelFormatter: (x) => show(x) },
                y: { axisLabelWidth: 72, pixelsPerLabel: 22, axisLabelFormatter: (y) => show(y) } },
        highlightCallback: (event, x, points) => tell(x, points, chart_box), unhighlightCallback: () => tell(null),
        drawCallback: (drawn, initial) => { if (!initial) follow(drawn.xAxisRange(), drawn); }
      });
      chart.first_values = values;
      chart_box.addEventListener("keydown", key);
      chart_box.addEventListener("dblclick", () => self.all());
      chart_box.addEventListener("focus", () => { current = self; });
      chart_box.addEventListener("pointerdown", () => { current = self; });
      self.charts.push(chart);
    }

    // All axes of a group are one.
    function follow(range, source) {
      if (zooming) return;
      zooming = true;
      self.charts.forEach((chart) => { if (chart !== source) chart.updateOptions({ dateWindow: range }); });
      zooming = false;
    }
    self.range = () => self.charts[0].xAxisRange();
    self.zoom_to = (from, to) => {
      const width = Math.min(to - from, end - begin), left = Math.min(Math.max(from, begin), end - width);
      self.charts[0].updateOptions({ dateWindow: [left, left + width] });
      follow([left, left + width], self.charts[0]);
    };
    self.all = () => {
      self.charts.forEach((chart) => chart.updateOptions({ valueRange: chart.first_values }));
      self.zoom_to(begin, end);
    };

    // ---- what is under the pointer ----------------------------------------------------------------------------
    function describe(e) {
      const changes = e.changes.filter(([, , before, after]) => before !== after)
        .map(([name, unit, before, after]) => `${name} ${show(before)} → ${show(after)} ${typeset(unit)}`);
      return [`${e.what} at ${show(e.at, 9)} ${group.units}: ${e.before} → ${e.after}`, ...changes].join("; ");
    }
    function tell(x, points, chart_box) {
      if (x === null) { now.textContent = self.chosen >= 0 ? describe(group.events[self.chosen]) : hint(); return; }
      const [from, to] = self.range(), near = (to - from) / Math.max(chart_box.clientWidth, 1) * 5;
      const event = group.events.find((e) => Math.abs(e.at - x) <= near);
      now.textContent = event ? describe(event)
        : `${show(x)} ${group.units !== "1" ? group.units : ""}: ` + points.map((p) => `${p.name.replace(/_/g, " ")} ${show(p.yval)}`).join(", ");
    }
    self.choose = (k) => {
      if (!group.events.length) return;
      self.chosen = Math.min(Math.max(k, 0), group.events.length - 1);
      const [from, to] = self.range(), at = group.events[self.chosen].at;
      if (at < from || at > to) self.zoom_to(at - (to - from) / 2, at + (to - from) / 2);
      else self.charts.forEach((chart) => chart.updateOptions({}));
      self.table.querySelectorAll("tbody tr").forEach((row, n) => row.classList.toggle("chosen", n === self.chosen));
      tell(null);
    };
    panels.forEach(draw);
    if (group.events.length) event_table(self, group);
    // Whether another group has the same signals, which the charts can show in place of these.
    const signals = (g) => JSON.stringify([g.title, g.over, g.panels.map((p) => [p.style, p.filled, p.series.map((s) => s.name)])]);
    self.fits = (next) => signals(group) === signals(next) && !panels.some((p) => p.filled);
    self.update = (next) => {
      const range = self.range(), all = range[0] <= begin && range[1] >= end;
      take(next);
      self.chosen = Math.min(self.chosen, group.events.length - 1);
      legend_of_bands();
      zooming = true;
      self.charts.forEach((chart, n) => chart.updateOptions({ file: rows_of(panels[n]), dateWindow: all ? [begin, end] : range }));
      zooming = false;
      if (group.events.length) event_table(self, group);
      if (self.chosen >= 0) self.table.querySelectorAll("tbody tr")[self.chosen].classList.add("chosen");
      tell(null);
    };
    // Colours of charts are drawn, not styled.
    self.recolour = () => self.charts.forEach((chart, n) => chart.updateOptions({
      colors: panels[n].series.map((_, k) => css(colors[k])), gridLineColor: css("--grid"), axisLineColor: css("--rule") }));
    return self;
  }

  // ---- keyboard -----------------------------------------------------------------------------------------------
  function key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || !current || event.target instanceof HTMLInputElement) return;
    const g = current, [from, to] = g.range(), width = to - from;
    const middle = g.chosen >= 0 ? g.events[g.chosen].at : (from + to) / 2;
    const actions = {
      n: () => g.choose(g.chosen + 1), p: () => g.choose(g.chosen < 0 ? g.events.length - 1 : g.chosen - 1),
      "+": () => g.zoom_to(middle - width / 4, middle + width / 4), "-": () => g.zoom_to(middle - width, middle + width),
      ArrowLeft: () => g.zoom_to(from - width / 4, to - width / 4), ArrowRight: () => g.zoom_to(from + width / 4, to + width / 4),
      0: g.all, Home: g.all
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    event.stopPropagation();
    actions[event.key]();
  }
  document.addEventListener("keydown", key);

  // ---- tables -------------------------------------------------------------------------------------------------
  function table_of(title, heads, rows, note) {
    const box = element("section"), wide = element("div", undefined, { class: "wide" }), table = element("table");
    const head = element("tr"), top = element("thead"), body = element("tbody");
    // a long key may be parted at its dots
    heads.forEach(([name, number]) => head.append(element("th", name.replace(/\./g, ".\u200b"), number ? { class: "number", scope: "col" } : { scope: "col" })));
    rows.forEach((row) => {
      const line = element("tr");
      row.forEach((cell, k) => {
        const unit = heads[k][0] === "unit";
        line.append(element("td", unit ? typeset(cell) : show(cell), heads[k][1] ? { class: "number" } : unit ? { class: "unit" } : {}));
      });
      body.append(line);
    });
    top.append(head);
    table.append(top, body);
    wide.append(table);
    box.append(element("h2", title), wide);
    if (note) box.append(element("p", note, { class: "note" }));
    $("tables").append(box);
    return table;
  }
  function event_table(self, group) {
    const changes = group.events[0].changes;
    const heads = [["#", 1], [with_unit(group.over, group.units), 1], ["event"], ["before"], ["after"],
                   ...changes.map(([name, unit]) => [with_unit(name, unit), 1])];
    const change = (before, after) => show(before) === show(after) ? before : `${show(before)} → ${show(after)}`;
    const note = group.events.length < group.all_events
      ? `The first ${group.events.length} of ${group.all_events} events; /events of the result file has them all.` : "";
    self.table = table_of("Events", heads, group.events.map((e, k) =>
      [k + 1, show(e.at, 9), e.what, e.before, e.after, ...e.changes.map(([, , before, after]) => change(before, after))]), note);
    self.table.classList.add("events");
    self.table.querySelectorAll("tbody tr").forEach((row, k) => {
      row.tabIndex = 0;
      row.addEventListener("click", () => self.choose(k));
      row.addEventListener("keydown", (event) => { if (event.key === "Enter") self.choose(k); });
    });
  }

  function show_page(next) {
    data = next;
    head();
    $("tables").replaceChildren();
    if (groups.length === data.groups.length && groups.every((g, k) => g.fits(data.groups[k]))) {
      groups.forEach((g, k) => g.update(data.groups[k]));
    } else {
      $("groups").replaceChildren();
      groups = data.groups.map(Group);
      current = groups[0] || null;
    }
    $("keys").hidden = !groups.length;
    $("event_keys").hidden = !groups.some((g) => g.events.length);
    data.tables.forEach((t) => table_of(t.title, t.heads, t.rows, t.note));
    const open = [...$("texts").children].map((details) => details.open);
    $("texts").replaceChildren(...data.texts.map(([title, text], k) => {
      const details = element("details", undefined, open[k] ? { open: "" } : {});
      details.append(element("summary", title), element("pre", text));
      return details;
    }));
  }
  show_page(data);

  // Charts follow a change of the scheme, and print in the light one.
  const recolour = () => groups.forEach((g) => g.recolour());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
  matchMedia("print").addEventListener("change", recolour);
  // for whoever drives the page from outside
  window.report = { get groups() { return groups; }, get data() { return data; }, show: show_page };
})();
