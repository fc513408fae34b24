"use strict";
// Draws what stands in #data: panels over time that zoom together, events, tables. Plain browser, no network.
(function () {
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const columns = (table) => Object.fromEntries(table.columns.map((c) => [c.name, c]));
  const run = columns(data.trajectory), control = data.controller ? columns(data.controller) : null;
  const time = run.time.values, end = time[time.length - 1], begin = time[0];
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const show = (x) => (x === null || x === undefined ? "–" : typeof x === "number" ? String(Number(x.toPrecision(6))) : x);

  function element(name, text, attributes) {
    const made = document.createElement(name);
    if (text !== undefined) made.textContent = text;
    Object.entries(attributes || {}).forEach(([key, value]) => made.setAttribute(key, value));
    return made;
  }

  // ---- head ---------------------------------------------------------------------------------------------------
  $("title").textContent = data.title;
  const shown = data.trajectory.shown < data.trajectory.rows
    ? `; ${data.trajectory.shown} of ${data.trajectory.rows} rows are drawn, every extreme among them` : "";
  $("summary").textContent = `${data.regime ? data.regime + ". " : ""}${show(end - begin)} s, ${data.events.length} events${shown}.`;
  data.warnings.forEach((w) => $("warnings").append(element("li", w)));
  if (!data.warnings.length) $("warnings").remove();

  // ---- panels -------------------------------------------------------------------------------------------------
  const wanted = [["gear_angle"], ["gear_speed", "worm_speed"], ["motor_torque", "load_torque"],
                  ["normal_force", "friction_force"], ["deflection"]];
  const panels = wanted.map((names) => ({ table: run, names: names.filter((n) => run[n]) }));
  if (control) {
    const error = control.gear_angle.values.map((x, k) => x - control.reference_angle.values[k]);
    control.tracking_error = { name: "tracking_error", units: control.gear_angle.units, long_name: "gear angle minus reference", values: error };
    panels.splice(1, 0, { table: control, names: ["tracking_error"] }, { table: control, names: ["sliding_variable"] });
  }
  const bands = mode_bands();
  const charts = [];
  let zooming = false, chosen = -1;

  function mode_bands() {
    const list = [];
    for (let k = 0; k < time.length; ++k) {
      const mode = run.motion.values[k] === 0 ? "stuck" : run.flank.values[k] > 0 ? "left" : run.flank.values[k] < 0 ? "right" : "";
      const last = list[list.length - 1];
      if (last && last.mode === mode) last.to = time[k];
      else {
        if (last) last.to = time[k];
        list.push({ mode, from: time[k], to: time[k] });
      }
    }
    return list;
  }
  const band_names = { stuck: "stuck", left: "left flank", right: "right flank" };
  Object.keys(band_names).filter((mode) => bands.some((b) => b.mode === mode)).forEach((mode) =>
    $("bands").append(element("span", band_names[mode], { style: `background: var(--${mode})` })));

  function underlay(canvas, area, chart) {
    const [from, to] = chart.xAxisRange();
    bands.forEach((b) => {
      if (!b.mode || b.to < from || b.from > to) return;
      const left = chart.toDomXCoord(Math.max(b.from, from)), right = chart.toDomXCoord(Math.min(b.to, to));
      canvas.fillStyle = css("--" + b.mode);
      canvas.fillRect(left, area.y, Math.max(right - left, 0.5), area.h);
    });
    data.events.forEach((e, k) => {
      if (e.time < from || e.time > to) return;
      const x = Math.round(chart.toDomXCoord(e.time)) + 0.5;
      canvas.strokeStyle = css(k === chosen ? "--chosen" : "--event");
      canvas.lineWidth = k === chosen ? 2 : 1;
      canvas.beginPath();
      canvas.moveTo(x, area.y);
      canvas.lineTo(x, area.y + area.h);
      canvas.stroke();
    });
  }

  function draw(panel) {
    const box = element("div", undefined, { class: "panel" }), heading = element("h3"), chart_box = element("div", undefined, {
      class: "chart", tabindex: "0", role: "img", "aria-label": panel.names.map((n) => panel.table[n].long_name).join(", ") + " over time" });
    const colors = ["--line1", "--line2", "--line3", "--line4"];
    panel.names.forEach((n, k) => {
      const c = panel.table[n];
      heading.append(element("span", `${c.long_name} [${c.units}]`, { style: `--line: var(${colors[k]})` }));
    });
    box.append(heading, chart_box);
    $("panels").append(box);
    const at = panel.table.time.values;
    const rows = at.map((t, k) => [t, ...panel.names.map((n) => panel.table[n].values[k])]);
    const chart = new Dygraph(chart_box, rows, {
      labels: ["time", ...panel.names], colors: panel.names.map((_, k) => css(colors[k])), gridLineColor: css("--grid"),
      axisLineColor: css("--rule"), dateWindow: [begin, end], legend: "never", strokeWidth: 1.4, labelsKMB: false, sigFigs: 6,
      axes: { x: { axisLabelFormatter: (x) => show(x) + " s" }, y: { axisLabelWidth: 72, axisLabelFormatter: (y) => show(y) } },
      stepPlot: panel.table === control && panel.names[0] === "torque", underlayCallback: underlay,
      highlightCallback: (event, x, points) => tell(x, points, chart_box), unhighlightCallback: () => tell(null),
      drawCallback: (self, initial) => { if (!initial) follow(self.xAxisRange(), self); }
    });
    chart_box.addEventListener("keydown", key);
    charts.push({ chart, colors });
  }
  panels.filter((p) => p.names.length).forEach(draw);

  // All axes of time are one.
  function follow(range, source) {
    if (zooming) return;
    zooming = true;
    charts.forEach(({ chart }) => { if (chart !== source) chart.updateOptions({ dateWindow: range }); });
    zooming = false;
  }
  function zoom_to(from, to) {
    const width = Math.min(to - from, end - begin), left = Math.min(Math.max(from, begin), end - width);
    charts[0].chart.updateOptions({ dateWindow: [left, left + width] });
    follow([left, left + width], charts[0].chart);
  }

  // ---- what is under the pointer ------------------------------------------------------------------------------
  const motions = { "-1": "backward", 0: "stuck", 1: "forward" }, flanks = { "-1": "right flank", 0: "", 1: "left flank" };
  const mode = (motion, flank) => [motions[motion], flanks[flank]].filter(Boolean).join(", ");
  function describe(e) {
    const gear = e.gear_motion_before !== undefined && e.gear_motion_before !== e.gear_motion_after
      ? `; gear ${motions[e.gear_motion_before]} → ${motions[e.gear_motion_after]}` : "";
    return `${e.kind.replace(/_/g, " ")} at ${Number(e.time.toPrecision(9))} s: ${mode(e.motion_before, e.flank_before)} → ` +
      `${mode(e.motion_after, e.flank_after)}${gear}; acceleration ${show(e.acceleration_before)} → ${show(e.acceleration_after)}`;
  }
  function tell(x, points, box) {
    if (x === null) { $("now").textContent = chosen >= 0 ? describe(data.events[chosen]) : "\u00a0"; return; }
    const [from, to] = charts[0].chart.xAxisRange(), near = (to - from) / Math.max(box.clientWidth, 1) * 5;
    const event = data.events.find((e) => Math.abs(e.time - x) <= near);
    $("now").textContent = event ? describe(event)
      : `${show(x)} s: ` + points.map((p) => `${p.name.replace(/_/g, " ")} ${show(p.yval)}`).join(", ");
  }

  // ---- keyboard -----------------------------------------------------------------------------------------------
  function choose(k) {
    if (!data.events.length) return;
    chosen = Math.min(Math.max(k, 0), data.events.length - 1);
    const [from, to] = charts[0].chart.xAxisRange(), t = data.events[chosen].time;
    if (t < from || t > to) zoom_to(t - (to - from) / 2, t + (to - from) / 2);
    else charts.forEach(({ chart }) => chart.updateOptions({}));
    $("events").querySelectorAll("tbody tr").forEach((row, n) => row.classList.toggle("chosen", n === chosen));
    tell(null);
  }
  function key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const [from, to] = charts[0].chart.xAxisRange(), middle = chosen >= 0 ? data.events[chosen].time : (from + to) / 2, width = to - from;
    const actions = {
      n: () => choose(chosen + 1), p: () => choose(chosen < 0 ? data.events.length - 1 : chosen - 1),
      "+": () => zoom_to(middle - width / 4, middle + width / 4), "-": () => zoom_to(middle - width, middle + width),
      ArrowLeft: () => zoom_to(from - width / 4, to - width / 4), ArrowRight: () => zoom_to(from + width / 4, to + width / 4),
      0: () => zoom_to(begin, end), Home: () => zoom_to(begin, end)
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    event.stopPropagation();
    actions[event.key]();
  }
  document.addEventListener("keydown", key);

  // ---- tables -------------------------------------------------------------------------------------------------
  function fill(table, heads, rows) {
    const head = element("tr");
    heads.forEach(([name, number]) => head.append(element("th", name, number ? { class: "number", scope: "col" } : { scope: "col" })));
    const body = element("tbody");
    rows.forEach((row) => {
      const line = element("tr");
      row.forEach((cell, k) => line.append(element("td", show(cell), heads[k][1] ? { class: "number" } : {})));
      body.append(line);
    });
    const top = element("thead");
    top.append(head);
    table.append(top, body);
  }
  const unit = (name) => (run[name] ? ` [${run[name].units}]` : "");
  fill($("events"), [["#", 1], ["time [s]", 1], ["event"], ["before"], ["after"], ["gear angle" + unit("gear_angle"), 1],
                     ["acceleration before", 1], ["after" + unit("gear_acceleration"), 1], ["motor torque" + unit("motor_torque"), 1]],
       data.events.map((e, k) => [k + 1, Number(e.time.toPrecision(9)).toString(), e.kind.replace(/_/g, " "), mode(e.motion_before, e.flank_before),
                                  mode(e.motion_after, e.flank_after), e.gear_angle, e.acceleration_before, e.acceleration_after,
                                  e.motor_torque_after]));
  $("events").querySelectorAll("tbody tr").forEach((row, k) => {
    row.tabIndex = 0;
    row.addEventListener("click", () => choose(k));
    row.addEventListener("keydown", (event) => { if (event.key === "Enter") choose(k); });
  });
  const quantities = (list) => list.map((q) => [q.name, q.value, q.unit === "1" ? "" : q.unit, q.meaning]);
  const heads = [["name"], ["value", 1], ["unit"], ["meaning"]];
  fill($("parameters"), heads, quantities(data.parameters));
  if (data.derived.length) fill($("derived"), heads, quantities(data.derived));
  else $("follows").remove();
  fill($("provenance"), [["what"], ["which"]], Object.entries(data.provenance).map(([k, v]) => [k.replace(/_/g, " "), v]));

  // Colours of the charts are drawn, not styled: they follow a change of the scheme, and print in the light one.
  function recolour() {
    charts.forEach(({ chart, colors }) => chart.updateOptions({
      colors: colors.slice(0, chart.numColumns() - 1).map(css), gridLineColor: css("--grid"), axisLineColor: css("--rule") }));
  }
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
  matchMedia("print").addEventListener("change", recolour);
  // for whoever drives the page from outside
  window.report = { charts: charts.map((c) => c.chart), zoom_to, choose, data };
})();
