#!/usr/bin/env python3
"""Opens reports in headless Chromium and asks them: browser.py PROGRAM CHROMIUM SCENARIOS [SCREENSHOTS]

Panels are there, zooming one zooms all of its group, events tell before and after, the keyboard works, nothing is loaded
from elsewhere and no error is logged; a run of a million rows, a sweep of 10^5 trials and a diagnosis open in less than
a second of CPU time. One line per fault.
"""

import json
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

EARS = """<script>
window.faults = [];
window.addEventListener("error", (e) => faults.push("error: " + (e.message || e.target.src)), true);
console.error = (...words) => faults.push("console: " + words.join(" "));
</script>"""

QUESTIONS = """<script>
(function () {
  const say = (truth, what) => { if (!truth) faults.push(what); };
  try {
    const { groups, data } = report, near = (a, b) => Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(a));
    say(groups.length > 0 && groups.every((g) => g.charts.length > 0), "no panels");
    say(document.querySelectorAll(".chart canvas").length >= 2 * groups.flatMap((g) => g.charts).length, "a panel is not drawn");
    groups.forEach((g, n) => {
      g.charts[0].canvas_.closest(".chart").focus();
      const [begin, end] = g.range(), to = begin + 0.5 * (end - begin), from = begin + 0.25 * (end - begin);
      g.charts[g.charts.length - 1].updateOptions({ dateWindow: [from, to] });
      say(g.charts.every((c) => near(c.xAxisRange()[0], from) && near(c.xAxisRange()[1], to)), "group " + n + ": zoom is not linked");
      const press = (key) => document.activeElement.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
      press("0");
      say(g.charts.every((c) => near(c.xAxisRange()[0], begin) && near(c.xAxisRange()[1], end)), "group " + n + ": 0 does not show all");
      press("+");
      say(near(g.range()[1] - g.range()[0], (end - begin) / 2), "group " + n + ": + does not zoom");
      press("0");
      const first = g.charts.map((c) => c.yAxisRange()), box_of = (c) => c.canvas_.closest(".chart");
      const as_before = (how) => g.charts.forEach((c, k) => say(c.yAxisRange().every((y, m) => near(y, first[k][m])), "group " + n + ": " + how + " does not show all values"));
      g.charts.forEach((c) => c.updateOptions({ valueRange: [1e3, 2e3] }));
      press("0");
      as_before("0");
      g.charts.forEach((c) => { c.updateOptions({ valueRange: [1e3, 2e3] }); c.resetZoom(); box_of(c).dispatchEvent(new MouseEvent("dblclick")); });
      as_before("double-click");
      if (!g.events.length) return;
      const now = () => document.querySelectorAll(".now")[n].textContent, event = g.events[0];
      press("n");
      say(now().includes(event.before + " → " + event.after) && now().includes(event.what), "the event does not tell before and after: " + now());
      say(g.table.querySelectorAll("tr.chosen").length === 1, "no event is chosen in the table");
      say(g.table.querySelectorAll("tbody tr").length === g.events.length, "events are missing in the table");
      g.choose(g.events.length - 1);
      const rect = box_of(g.charts[0]).getBoundingClientRect();
      const x = rect.left + g.charts[0].toDomXCoord(event.at), y = rect.top + rect.height / 2;
      g.charts[0].mouseEventElement_.dispatchEvent(new MouseEvent("mousemove", { clientX: x, clientY: y, bubbles: true }));
      say(now().includes(event.what + " at"), "hovering an event does not tell it: " + now());
    });
    const count = (selector) => document.querySelectorAll(selector).length;
    say(count("#tables table") === data.tables.length + groups.filter((g) => g.events.length).length, "tables are missing");
    say(data.tables.every((t) => t.rows.length > 0), "an empty table");
    say(count("#remarks li") === data.remarks.length, "remarks are missing");
    say((document.getElementById("verdict") || { textContent: "" }).textContent === data.verdict, "the verdict is missing");
    say(performance.getEntriesByType("resource").length === 0, "something was loaded: " +
        performance.getEntriesByType("resource").map((e) => e.name).join(", "));
  } catch (fault) { faults.push("exception: " + fault.message); }
  const answer = document.createElement("pre");
  answer.id = "answer";
  answer.textContent = JSON.stringify(faults);
  document.body.append(answer);
})();
</script>"""


def chromium(browser, page, *options):
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1200,2400", *options, page.as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def cpu_time():
    """Of all programs that have ended [s]: other than the time on the wall it does not depend on who else is at work."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def seconds_to_open(browser, page):
    """What it takes the browser to start and open a page [s]."""
    begin = cpu_time()
    chromium(browser, page, "--dump-dom")
    return cpu_time() - begin


def faults_of(browser, report):
    """Opens a copy that asks itself, and returns what it found wrong."""
    text = report.read_text(encoding="utf-8")
    asking = report.with_suffix(".asking.html")
    asking.write_text(text.replace("<head>", "<head>" + EARS, 1).replace("</body>", QUESTIONS + "</body>", 1), encoding="utf-8")
    dom = chromium(browser, asking, "--dump-dom").stdout
    found = re.search(r'<pre id="answer">(.*?)</pre>', dom, re.DOTALL)
    if not found:
        return ["the page does not answer"]
    return json.loads(found[1].replace("&gt;", ">").replace("&lt;", "<").replace("&amp;", "&"))


def results(program, scenarios, folder):
    """Makes a result of every kind: yields name and file, or folder."""
    def made(name, *words):
        path = Path(folder, f"{name}.h5")
        subprocess.run([program, *words, "-q", "-o", path], check=True, stdout=subprocess.DEVNULL)
        return name, path

    fig09, fig10 = scenarios / "fig09_switching.toml", scenarios / "fig10_sliding_014rad_bare.toml"
    yield made("fig09", "run", fig09)
    yield made("backlash", "run", scenarios / "fig09_backlash.toml")
    yield made("controlled", "run", fig10)
    yield made("million", "run", fig09, "--set", "run.report_interval_s=2e-6", "--set", "run.solver=taylor")
    yield made("statics", "statics", scenarios / "fig07_break_in_07cm_forward.toml")
    yield made("steady", "steady", scenarios / "measured_worm_drive.toml")
    study = Path(folder, "study.toml")
    study.write_text(f"""title = "Where a drive stands after 20 ms"
scenario = "{fig09}"
set = ["run.solver=taylor", "run.duration_s=0.02", "run.report_interval_s=0.02"]
[sweep]
design = "monte_carlo"
trials = 100000
seed = 1
[[parameter]]
path = "mesh.friction"
distribution = "uniform"
low = 0.2
high = 0.3
[[parameter]]
path = "effect.worm_coulomb.torque_Nm"
distribution = "lognormal"
median = 1e-3
log_deviation = 0.3
[[threshold]]
metric = "final_gear_angle"
above_rad = 1e-4
""")
    yield made("sweep", "sweep", study, "--referee", "0")
    rare = Path(folder, "rare.h5")
    subprocess.run([program, "rare", scenarios / "studies/fig10_sliding.toml", "--per-level", "100", "-o", rare], check=True,
                   stdout=subprocess.DEVNULL)
    yield "rare", rare
    bench = Path(folder, "bench")
    subprocess.run([program, "diagnose", scenarios / "example_bench.toml", scenarios / "example_bench.csv", "-q", "--no-pictures",
                    "-o", bench], check=True)
    yield "diagnosis", bench


def main(program, browser, scenarios, screenshots=None):
    faults, pages = [], 0
    with tempfile.TemporaryDirectory() as folder:
        empty = Path(folder, "empty.html")
        empty.write_text("<!DOCTYPE html>", encoding="utf-8")
        start = min(seconds_to_open(browser, empty) for _ in range(3))  # the least: the first start reads the disk
        for name, result in results(program, Path(scenarios).resolve(), folder):
            report, pages = Path(folder, f"{name}.html"), pages + 1
            subprocess.run([program, "report", result, "-o", report], check=True, stdout=subprocess.DEVNULL)
            if re.search(r'(src|href)="(?!data:)', report.read_text(encoding="utf-8")):
                faults.append(f"{name}: refers to other files")
            faults += [f"{name}: {fault}" for fault in faults_of(browser, report)]
            seconds = seconds_to_open(browser, report) - start
            print(f"{name}: {report.stat().st_size / 1e6:.2f} MB, opened in {seconds:.2f} s", flush=True)
            if seconds > 1.0:
                faults.append(f"{name}: takes {seconds:.2f} s")
            if screenshots:
                for scheme, option in (("light", []), ("dark", ["--force-dark-mode", "--blink-settings=preferredColorScheme=0"])):
                    chromium(browser, report, f"--screenshot={Path(screenshots).resolve()}/{name}_{scheme}.png", *option)
                chromium(browser, report, f"--print-to-pdf={Path(screenshots).resolve()}/{name}.pdf")
    print(*faults, f"report: {pages} pages, {len(faults)} faults", sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) in (4, 5) else __doc__)
