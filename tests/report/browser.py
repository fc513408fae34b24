#!/usr/bin/env python3
"""Opens reports in headless Chromium and asks them: browser.py PROGRAM CHROMIUM SCENARIOS [SCREENSHOTS]

Panels are there, zooming one zooms all, events tell before and after, the keyboard works, nothing is loaded from
elsewhere and no error is logged; a run of a million rows opens in less than a second. One line per fault.
"""

import json
import re
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
    const { charts, data } = report, same = (a, b) => Math.abs(a - b) < 1e-9;
    say(charts.length >= 4, "only " + charts.length + " panels");
    say(charts.every((c) => c.numRows() > 100), "an empty panel");
    const narrow = [0.25 * data.trajectory.columns[0].values.at(-1), 0.5 * data.trajectory.columns[0].values.at(-1)];
    charts[1].updateOptions({ dateWindow: narrow });
    say(charts.every((c) => same(c.xAxisRange()[0], narrow[0]) && same(c.xAxisRange()[1], narrow[1])), "zoom is not linked");
    const press = (key) => document.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
    press("0");
    say(charts.every((c) => same(c.xAxisRange()[0], 0)), "0 does not show all");
    press("+");
    const [from, to] = charts[0].xAxisRange();
    say(to - from < 0.51 * narrow[1] / 0.5, "+ does not zoom");
    press("0");
    if (data.events.length) {
      press("n");
      const now = document.getElementById("now").textContent, first = data.events[0];
      say(now.includes("→") && now.includes(first.kind.replace(/_/g, " ")), "the event does not tell before and after: " + now);
      say(document.querySelectorAll("#events tr.chosen").length === 1, "no event is chosen in the table");
      const box = document.querySelector(".chart"), rect = box.getBoundingClientRect();
      const x = rect.left + charts[0].toDomXCoord(first.time), y = rect.top + rect.height / 2;
      charts[0].mouseMoveHandler_(new MouseEvent("mousemove", { clientX: x, clientY: y, bubbles: true }));
      say(document.getElementById("now").textContent.includes("→"), "hovering an event does not tell it");
    }
    say(document.querySelectorAll("#events tbody tr").length === data.events.length, "events are missing in the table");
    say(document.querySelectorAll("#parameters tbody tr").length > 10, "parameters are missing");
    say(document.querySelectorAll("#warnings li").length === data.warnings.length, "warnings are missing");
    say(performance.getEntriesByType("resource").length === 0, "something was loaded: " +
        performance.getEntriesByType("resource").map((e) => e.name).join(", "));
    window.answered = true;
  } catch (fault) { faults.push("exception: " + fault.message); }
  const answer = document.createElement("pre");
  answer.id = "answer";
  answer.textContent = JSON.stringify({ faults, ready: performance.now() });
  document.body.append(answer);
})();
</script>"""


def chromium(browser, page, *options):
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1200,2400", *options, page.as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def faults_of(browser, report):
    """Opens a copy that asks itself, and returns what it found wrong."""
    text = report.read_text(encoding="utf-8")
    asking = report.with_suffix(".asking.html")
    asking.write_text(text.replace("<head>", "<head>" + EARS, 1).replace("</body>", QUESTIONS + "</body>", 1), encoding="utf-8")
    dom = chromium(browser, asking, "--dump-dom").stdout
    found = re.search(r'<pre id="answer">(.*?)</pre>', dom, re.DOTALL)
    if not found:
        return ["the page does not answer"], 0.0
    answer = json.loads(found[1].replace("&gt;", ">").replace("&lt;", "<").replace("&amp;", "&"))
    return answer["faults"], answer["ready"] / 1000


def main(program, browser, scenarios, screenshots=None):
    faults = []
    runs = {"fig09": ["fig09_switching.toml"], "backlash": ["fig09_backlash.toml"], "controlled": ["fig10_sliding_014rad_bare.toml"],
            "long": ["fig09_switching.toml", "--set", "run.report_interval_s=2e-6", "--set", "run.solver=taylor"]}
    with tempfile.TemporaryDirectory() as folder:
        for name, (scenario, *options) in runs.items():
            result, report = Path(folder, f"{name}.h5"), Path(folder, f"{name}.html")
            subprocess.run([program, "run", Path(scenarios, scenario), "-q", "-o", result, *options], check=True)
            subprocess.run([program, "report", result, "-o", report], check=True, stdout=subprocess.DEVNULL)
            if re.search(r'(src|href)="', report.read_text(encoding="utf-8")):
                faults.append(f"{name}: refers to other files")
            found, seconds = faults_of(browser, report)
            faults += [f"{name}: {fault}" for fault in found]
            print(f"{name}: {report.stat().st_size / 1e6:.2f} MB, drawn and asked in {seconds:.2f} s")
            if name == "long" and seconds > 1.0:
                faults.append(f"{name}: takes {seconds:.2f} s")
            if screenshots:
                for scheme, option in (("light", []), ("dark", ["--force-dark-mode", "--blink-settings=preferredColorScheme=0"])):
                    chromium(browser, report, f"--screenshot={Path(screenshots).resolve()}/{name}_{scheme}.png", *option)
                chromium(browser, report, f"--print-to-pdf={Path(screenshots).resolve()}/{name}.pdf")
    print(*faults, f"report: {len(runs)} pages, {len(faults)} faults", sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) in (4, 5) else __doc__)
