"""The Python package: the same numbers and words as the program, arrays that own themselves, threads, signals, leaks.

Run by ctest with PYTHONPATH, WORMDRIVE_SCENARIOS, WORMDRIVE_PROGRAM and, for the malformed scenarios, WORMDRIVE_TESTS;
once as it is and once more by tests/decimal_comma.py, for the module takes the locale of the user here.
"""

import concurrent.futures
import copy
import gc
import json
import locale
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import wormdrive

locale.setlocale(locale.LC_ALL, "")
SCENARIOS = Path(os.environ["WORMDRIVE_SCENARIOS"])
PROGRAM = os.environ.get("WORMDRIVE_PROGRAM")
FIG09 = SCENARIOS / "fig09_switching.toml"
FIG10 = SCENARIOS / "fig10_sliding_014rad_bare.toml"

SHORT = {
    "title": "A short one",
    "mesh": {"ratio": 60, "lead_angle_deg": 4, "pressure_angle_deg": 20, "worm_pitch_radius_m": 0.011,
             "gear_pitch_radius_m": 0.045, "friction": 0.25, "worm_inertia_kgm2": 2.53e-5, "gear_inertia_kgm2": 7.39e-4},
    "motor": {"torque": {"kind": "constant", "torque_Nm": -0.05}},
    "load": {"kind": "constant", "torque_Nm": 0.02},
    "run": {"duration_s": 0.01},
}


def resident_kib():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4


class Tables(unittest.TestCase):
    def test_a_table_shows_its_columns(self):
        shown = repr(wormdrive.run(SHORT).trajectory)
        self.assertTrue(shown.startswith("<wormdrive.Table of "), shown)
        self.assertIn(" rows: time [s], gear_angle [rad], ", shown)
        self.assertIn(" motion, flank>", shown)

    def test_flags_are_words_by_value(self):
        events = wormdrive.run(FIG09).events
        self.assertEqual(events.words("kind")[:2], ["break_away", "flank_change"])
        self.assertEqual(events.flag_meanings["motion_after"], {-1: "backward", 0: "stuck", 1: "forward"})
        self.assertEqual(events.words("motion_after")[0], "backward")


class Runs(unittest.TestCase):
    def test_columns_are_those_of_the_result_file(self):
        import h5py

        with tempfile.TemporaryDirectory() as folder:
            for name, end in ((FIG09, 0.3), (SCENARIOS / "fig09_backlash.toml", 0.3), (FIG10, 1.2)):
                scenario = wormdrive.Scenario(name, run={"duration_s": end})
                result = scenario.run()
                path = Path(folder, "theirs.h5")
                subprocess.run([PROGRAM, "run", name, "--set", f"run.duration_s={end}", "-o", path, "--quiet"], check=True)
                result.write(Path(folder, "ours.h5"))
                with h5py.File(path) as theirs, h5py.File(Path(folder, "ours.h5")) as ours:
                    self.assertEqual(set(theirs), set(ours))
                    for group in theirs:
                        table = getattr(result, group)
                        self.assertEqual(set(theirs[group]), set(table))
                        for column, data in theirs[group].items():
                            np.testing.assert_array_equal(table[column], data[:])
                            np.testing.assert_array_equal(ours[group][column][:], data[:])
                            self.assertEqual(table.units[column], data.attrs.get("units", ""))
                    for key in ("title", "scenario", "solver", "solver_steps", "surface", "ratio"):
                        self.assertEqual(theirs.attrs[key], ours.attrs[key])
                    if "controller" in theirs:
                        self.assertEqual(result.metrics["error_rms"], theirs["controller"].attrs["error_rms"])

    def test_scenarios_are_paths_texts_dicts_or_prepared(self):
        text = FIG09.read_text()
        angle = wormdrive.run(FIG09).trajectory.gear_angle[-1]
        self.assertEqual(wormdrive.run(str(FIG09)).trajectory.gear_angle[-1], angle)
        self.assertEqual(wormdrive.run(text).trajectory.gear_angle[-1], angle)
        self.assertEqual(wormdrive.run(wormdrive.Scenario(text)).trajectory.gear_angle[-1], angle)
        short = wormdrive.run(SHORT)
        self.assertEqual(short.title, "A short one")
        self.assertEqual(short.trajectory.time[-1], 0.01)

    def test_overrides_are_tables_or_keys_with_dots(self):
        by_table = wormdrive.Scenario(SHORT, mesh={"friction": np.float64(0.2)}, effect={"worm_coulomb": {"torque_Nm": 1e-3}})
        by_key = wormdrive.Scenario(SHORT, **{"mesh.friction": 0.2, "effect.worm_coulomb.torque_Nm": 1e-3})
        self.assertEqual(by_table.toml, by_key.toml)
        self.assertIn("friction = 0.2", by_table.toml)
        self.assertEqual(wormdrive.Scenario(by_table, mesh={"friction": 0.1}).run().toml.count("friction = 0.1"), 1)

    def test_an_array_outlives_its_result(self):
        speed = wormdrive.run(FIG09).trajectory.gear_speed
        copy = speed.copy()
        gc.collect()
        for _ in range(20):
            wormdrive.run(SHORT).trajectory.gear_speed.sum()
        self.assertFalse(speed.flags.owndata)  # a capsule does
        np.testing.assert_array_equal(speed, copy)

    def test_xarray(self):
        try:
            import xarray  # noqa: F401
        except ImportError:
            self.skipTest("no xarray")
        dataset = wormdrive.run(FIG09).to_xarray()
        self.assertEqual(dataset.gear_speed.attrs["units"], "rad/s")
        self.assertLess(float(dataset.gear_speed.sel(time=1.0, method="nearest")), 2.0)
        self.assertEqual(dataset.motion.attrs["flag_values"], [-1, 0, 1])
        self.assertEqual(dataset.motion.attrs["flag_meanings"], "backward stuck forward")

    def test_values_of_numpy_are_values(self):
        stated = {**SHORT, "mesh": {key: np.float32(value) if key == "ratio" else np.array(value)
                                    for key, value in SHORT["mesh"].items()},
                  "effect": {"worm_coulomb": {"on": np.bool_(False), "torque_Nm": np.float64(1e-3)},
                             "worm_viscous": {"on": np.array(True), "coefficient_Nms_per_rad": np.array(1e-6)}},
                  "load": {"kind": np.str_("samples"), "times_s": np.array([0.0, 1.0]), "torques_Nm": np.array([0, 1]),
                           "interpolation": np.array("linear")},
                  "run": {"duration_s": np.array(0.01), "solver": np.str_("taylor")}}
        plain = {**SHORT, "effect": {"worm_viscous": {"coefficient_Nms_per_rad": 1e-6}},
                 "load": {"kind": "samples", "times_s": [0.0, 1.0], "torques_Nm": [0, 1], "interpolation": "linear"},
                 "run": {"duration_s": 0.01, "solver": "taylor"}}
        self.assertEqual(wormdrive.Scenario(stated).toml, wormdrive.Scenario(plain).toml)
        for value in (np.bool_(True), np.array(True), True):
            self.assertIn("[effect.worm_coulomb]", wormdrive.Scenario(
                SHORT, effect={"worm_coulomb": {"on": value, "torque_Nm": np.array(1e-3)}}).toml)
        self.assertIn("friction = 0.125\n", wormdrive.Scenario(SHORT, **{"mesh.friction": np.array(0.125)}).toml)
        with self.assertRaisesRegex(wormdrive.InputError, "mesh.friction must be a number, not true or false"):
            wormdrive.Scenario(SHORT, mesh={"friction": np.bool_(True)})
        wormdrive.sweep({**STUDY, "scenario": str(FIG09), "set": ["run.duration_s=0.001"], "sweep": {
            "design": "monte_carlo", "trials": np.int64(2), "seed": np.uint8(3)}}, threads=np.int64(1))
        with self.assertRaisesRegex(ValueError, "threads = 100000 must be at most 4096"):
            wormdrive.sweep({**STUDY, "scenario": str(FIG09)}, threads=100000)

    def test_a_title_is_one_line_that_every_file_can_hold(self):
        for title, told in (("a\u0001b", "2 is U+0001"), ("two\nlines", "4 is U+000A"), ("\x7f", "1 is U+007F"),
                            ("no \uffff", "4 is U+FFFF")):
            with self.subTest(told), self.assertRaises(wormdrive.InputError) as caught:
                wormdrive.Scenario({**SHORT, "title": title})
            self.assertTrue(str(caught.exception).endswith(
                f"error: title must be one line without control characters; its character {told}"), str(caught.exception))
        self.assertEqual(wormdrive.Scenario({**SHORT, "title": "µ < \"π\" & 'so on'"}).title, "µ < \"π\" & 'so on'")

    def test_steady_motion_is_none_at_rest(self):
        low, high = -0.05 * 0.02, 0.09 * 0.02
        for speeds in (0, 0.0, -0.0, [1.0, 0.0], np.array(0)):
            with self.subTest(speeds), self.assertRaises(wormdrive.InputError) as caught:
                wormdrive.steady(SHORT, speeds)
            said = str(caught.exception)
            self.assertRegex(said, r"^worm_speed = -?0 rad/s: error: at rest every motor torque from \S+ to \S+ N m holds "
                                   "the drive; ask for another speed$")
            held = sorted(float(word) for word in said.replace(" to ", " from ").split(" from ")[1:] for word in [word.split()[0]])
            self.assertTrue(2 * low < held[0] < held[1] < 2 * high, said)
        with self.assertRaisesRegex(wormdrive.InputError, "^worm_speed = nan rad/s: error: must be a finite number$"):
            wormdrive.steady(SHORT, [1.0, np.nan])
        self.assertEqual(wormdrive.steady(SHORT, np.float32(10)), wormdrive.steady(SHORT, 10))

    def test_steady_and_check(self):
        torque = wormdrive.steady(SHORT, [[-10.0, 10.0]], load={"torque_Nm": 0.0})
        self.assertEqual(torque.shape, (1, 2))
        np.testing.assert_allclose(torque, 0.0, atol=1e-15)  # without load and bearings nothing holds it up
        rubbing = wormdrive.steady(SHORT, [-10.0, 10.0], **{"effect.worm_coulomb.torque_Nm": 1e-3, "load.torque_Nm": 0.0})
        np.testing.assert_allclose(rubbing, [-1e-3, 1e-3], rtol=1e-12)
        told = json.loads(subprocess.run([PROGRAM, "check", FIG09, "--json"], check=True, capture_output=True).stdout)
        ours = wormdrive.check(FIG09)
        for key in ("title", "parameters", "derived", "warnings", "scenario"):
            self.assertEqual(ours[key], told[key])


def in_another_process(scenario):
    """What a worker of a pool does: it is given a scenario and gives back a run of it."""
    return scenario.run()


def halting(scenario):
    return wormdrive.Scenario(scenario, load={"kind": "constant", "torque_Nm": 0.5}, run={"duration_s": 0.2}, motor={
        "torque": [{"kind": "ramp", "rate_Nm_per_s": 1.0}, {"kind": "step", "time_s": 0.1, "torque_Nm": 1e308}]}).run()


class Shared(unittest.TestCase):
    """Arrays look into memory that others look into as well, and objects go from one process to another."""

    def tables(self):
        with tempfile.TemporaryDirectory() as folder:
            scenario = Path(folder, "short.toml")
            scenario.write_text(wormdrive.Scenario(SHORT).toml)
            trials = wormdrive.sweep({**STUDY, "scenario": str(scenario)}).trials
        run = wormdrive.run(FIG10, run={"duration_s": 1.1})
        return [run.trajectory, run.events, run.controller, trials]

    def test_nobody_writes_into_shared_columns(self):
        for table in self.tables():
            for again in (table, pickle.loads(pickle.dumps(table)), copy.deepcopy(table)):
                for name, array in again.items():
                    with self.subTest(name), self.assertRaises(ValueError):
                        array[:1] = 0
            name = next(iter(table))
            with self.assertRaises(ValueError):
                table[name].flags.writeable = True
            own = table[name].copy()
            own[:] = 0  # a copy is one's own

    def test_a_view_outlives_everything(self):
        views = [table[name][1:] for table in self.tables() for name in table]
        copies = [view.copy() for view in views]
        gc.collect()
        for _ in range(20):
            wormdrive.run(SHORT).trajectory.gear_speed.sum()
        for view, kept in zip(views, copies):
            np.testing.assert_array_equal(view, kept)

    def same(self, one, other):
        self.assertEqual(one.toml, other.toml)
        self.assertEqual(one.title, other.title)
        self.assertEqual(one.metrics, other.metrics)
        self.assertEqual(one.statistics, other.statistics)
        for table in ("trajectory", "events", "controller"):
            a, b = getattr(one, table), getattr(other, table)
            self.assertEqual(a is None, b is None)
            for name in a or ():
                np.testing.assert_array_equal(a[name], b[name], err_msg=name)
                self.assertEqual(a.units[name], b.units[name])

    def test_scenarios_and_results_are_pickled(self):
        import h5py

        for source in (FIG09, FIG10, SCENARIOS / "fig09_backlash.toml"):
            scenario = wormdrive.Scenario(source, run={"duration_s": 1.1 if source == FIG10 else 0.3})
            for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
                again = pickle.loads(pickle.dumps(scenario, protocol))
                self.assertEqual(again.toml, scenario.toml)
            result = scenario.run()
            for restored in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result),
                             pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result))))):
                self.same(restored, result)
                self.assertEqual(repr(restored), repr(result))
            with tempfile.TemporaryDirectory() as folder:
                restored.write(Path(folder, "restored.h5"))
                with h5py.File(Path(folder, "restored.h5")) as written:
                    np.testing.assert_array_equal(written["trajectory/gear_speed"][:], result.trajectory.gear_speed)

    def test_sweeps_diagnoses_and_halts_are_pickled(self):
        import h5py

        with tempfile.TemporaryDirectory() as folder:
            scenario = Path(folder, "short.toml")
            scenario.write_text(wormdrive.Scenario(SHORT).toml)
            sweep = wormdrive.sweep({**STUDY, "scenario": str(scenario)})
            for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
                restored = pickle.loads(pickle.dumps(sweep, protocol))
            sweep.write(Path(folder, "a.h5"), referee=0)
            restored.write(Path(folder, "b.h5"), referee=0)
            with h5py.File(Path(folder, "a.h5")) as a, h5py.File(Path(folder, "b.h5")) as b:
                for name in a["trials"]:
                    np.testing.assert_array_equal(a["trials"][name][:], b["trials"][name][:])
                    np.testing.assert_array_equal(restored.trials[name], sweep.trials[name])
        loads = [0.2 + 0.15 * k for k in range(10) for _ in range(2)]
        data = {"load_torque_Nm": loads,
                "motor_torque_Nm": [load * (0.0470713, -0.0837434)[k % 2] for k, load in enumerate(loads)]}
        found = wormdrive.diagnose(SCENARIOS / "fig07_break_in_07cm_forward.toml", data)
        noisy = {**data, "motor_torque_Nm": np.array(data["motor_torque_Nm"]) * np.random.default_rng(3).normal(1.0, 0.01, 20)}
        changed = wormdrive.diagnose(SCENARIOS / "fig07_break_in_07cm_forward.toml", noisy, since=noisy)
        self.assertTrue(changed.findings["sentence"].startswith("Nothing that these data show has changed."))
        self.assertFalse(any(change["certain"] for change in changed.findings["since"]["changes"]))
        again = pickle.loads(pickle.dumps(found))
        self.assertEqual((again.findings, again.extended), (found.findings, found.extended))
        np.testing.assert_array_equal(again.residual.after, found.residual.after)
        with self.assertRaises(wormdrive.SimulationHalted) as caught:
            halting(SHORT)
        halt = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual(str(halt), str(caught.exception))
        self.same(halt.result, caught.exception.result)

    def test_other_processes_take_scenarios_and_give_results(self):
        scenarios = [wormdrive.Scenario(SHORT, mesh={"friction": friction}) for friction in (0.1, 0.2, 0.3)]
        for way in ("fork", "spawn"):
            with self.subTest(way), concurrent.futures.ProcessPoolExecutor(
                    2, mp_context=multiprocessing.get_context(way)) as pool:
                for theirs, scenario in zip(pool.map(in_another_process, scenarios), scenarios):
                    self.same(theirs, scenario.run())
                with self.assertRaises(wormdrive.SimulationHalted) as caught:
                    pool.submit(halting, SHORT).result()
                self.assertEqual(caught.exception.result.trajectory.time[-1], 0.1)


STUDY = {
    "title": "Friction", "scenario": "short.toml",
    "sweep": {"design": "monte_carlo", "trials": 40, "seed": 3},
    "parameter": [{"path": "mesh.friction", "distribution": "uniform", "low": 0.2, "high": 0.3}],
    "threshold": [{"metric": "final_gear_speed", "above_rad_per_s": 0.0}],
}


class Studies(unittest.TestCase):
    def test_a_sweep_has_the_rows_of_the_program(self):
        import h5py

        with tempfile.TemporaryDirectory() as folder:
            study = SCENARIOS / "studies/fig10_sliding.toml"
            shorter = study.read_text().replace("trials = 200", "trials = 20").replace("../", f"{SCENARIOS}/")
            Path(folder, "study.toml").write_text(shorter)
            subprocess.run([PROGRAM, "sweep", "study.toml", "-q", "-o", "theirs.h5"], check=True, cwd=folder)
            ours = wormdrive.sweep(Path(folder, "study.toml"), threads=2)
            ours.write(Path(folder, "ours.h5"), referee=3)
            with h5py.File(Path(folder, "theirs.h5")) as theirs, h5py.File(Path(folder, "ours.h5")) as written:
                self.assertEqual(set(theirs["trials"]), set(ours.trials))
                for name, column in theirs["trials"].items():
                    np.testing.assert_array_equal(ours.trials[name], column[:], err_msg=name)
                    np.testing.assert_array_equal(written["trials"][name][:], column[:], err_msg=name)
                np.testing.assert_array_equal(written["summary/thresholds/missed"][:], theirs["summary/thresholds/missed"][:])
                def judged(file):
                    rows = np.flatnonzero(file["referee/judged"][:])
                    return dict(zip(file["referee/trial"][:][rows], file["referee/angle_difference"][:][rows]))

                self.assertEqual(len(judged(written)), 3)
                self.assertLessEqual(judged(written).items(), judged(theirs).items())

    def test_a_study_is_a_dict_or_text_too(self):
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            Path("short.toml").write_text(wormdrive.Scenario(SHORT).toml)
            sweep = wormdrive.sweep(STUDY)
            self.assertEqual(len(sweep.trials.index), 40)
            self.assertTrue(np.all((sweep.trials["mesh.friction"] >= 0.2) & (sweep.trials["mesh.friction"] <= 0.3)))
            self.assertEqual(sweep.reasons, [])
            friction = sweep.trials["mesh.friction"]
            del sweep
            gc.collect()
            self.assertLessEqual(friction.max(), 0.3)  # an array keeps its sweep alive
            with self.assertRaises(wormdrive.InputError) as caught:
                wormdrive.sweep({**STUDY, "scenario": "no.toml"})
            self.assertIn("no.toml", str(caught.exception))
            os.chdir("/")

    def test_a_summary_is_that_of_the_program_also_of_a_sweep_that_runs_or_was_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            def told(name, *words):
                theirs = subprocess.run([PROGRAM, "summary", name, "--json", *words], cwd=folder, check=True,
                                        capture_output=True, text=True)
                return json.loads(theirs.stdout)

            Path(folder, "short.toml").write_text(wormdrive.Scenario(SHORT).toml)
            study = "".join(f"{key} = {wormdrive._toml(value)}\n" for key, value in STUDY.items())
            Path(folder, "study.toml").write_text(study)
            subprocess.run([PROGRAM, "sweep", "study.toml", "-q", "-o", "whole.h5"], check=True, cwd=folder)
            whole = wormdrive.summary(Path(folder, "whole.h5"))
            self.assertEqual(whole, told("whole.h5"))
            self.assertEqual((whole["trials"], whole["of"], whole["running"]), (40, 40, False))
            other = {"metric": "final_gear_angle", "worst": 2, "done_only": True}
            self.assertEqual(wormdrive.summary(Path(folder, "whole.h5"), **other),
                             told("whole.h5", "--metric", "final_gear_angle", "--worst", "2", "--done-only"))
            with self.assertRaises(wormdrive.InputError) as caught:
                wormdrive.summary(Path(folder, "whole.h5"), metric="speed")
            self.assertIn("speed", str(caught.exception))
            with self.assertRaises(wormdrive.InputError):
                wormdrive.summary(Path(folder, "none.h5"))
            os.chdir(folder)
            self.assertEqual(wormdrive.sweep("study.toml").summary(), whole)
            os.chdir("/")

            long = wormdrive.Scenario(SHORT, run={"duration_s": 1000, "report_interval_s": 0.1})
            Path(folder, "short.toml").write_text(long.toml)  # trials take long, their file is small
            Path(folder, "study.toml").write_text(study.replace("40", "20000"))
            with subprocess.Popen([PROGRAM, "sweep", "study.toml", "-q", "-o", "long.h5"], cwd=folder) as process:
                while not Path(folder, "long.h5.part").exists() or told("long.h5")["trials"] == 0:
                    time.sleep(0.05)
                os.kill(process.pid, signal.SIGSTOP)  # so that both look at the same trials
                running = wormdrive.summary(Path(folder, "long.h5"))
                self.assertEqual(running, told("long.h5"))
                process.kill()
            self.assertTrue(running["running"])
            self.assertGreater(running["trials"], 0)
            self.assertLess(running["trials"], running["of"])
            for name in ("long.h5", "long.h5.part"):
                self.assertEqual(wormdrive.summary(Path(folder, name)), {**running, "running": False})
                self.assertEqual(told(name), {**running, "running": False})

    def test_a_diagnosis_says_what_the_program_says(self):
        bench = SCENARIOS / "example_bench.toml", SCENARIOS / "example_bench.csv"
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "diagnose", *bench, "-q", "--no-pictures", "--draws", "10", "-o", folder], check=True)
            theirs = json.loads(Path(folder, "diagnosis.json").read_text())
            ours = wormdrive.diagnose(*bench, output=Path(folder, "ours"), draws=10)
            self.assertEqual(Path(folder, "ours/draws.csv").read_text(), Path(folder, "draws.csv").read_text())
            written = json.loads(Path(folder, "ours/diagnosis.json").read_text())
            self.assertEqual(written, ours.findings)
            self.assertEqual(Path(folder, "ours/extended.toml").read_text(), ours.extended)
            subprocess.run([PROGRAM, "report", Path(folder, "ours")], check=True, capture_output=True)
            self.assertTrue(Path(folder, "ours/report.html").exists())
            with self.assertRaisesRegex(wormdrive.InputError, "diagnosis.h5: error: the result would overwrite .*diagnosis.h5"):
                wormdrive.diagnose(Path(folder, "diagnosis.h5"), bench[1], output=folder)
            del ours.findings["program"], theirs["program"]
            self.assertEqual(ours.findings, theirs)
            self.assertEqual(ours.extended, Path(folder, "extended.toml").read_text())
            self.assertLess(np.nanstd(ours.residual.after), np.nanstd(ours.residual.before))


    def test_a_diagnosis_of_data_in_a_dict_is_kept_in_its_folder_too(self):
        loads = [0.2 + 0.15 * k for k in range(10) for _ in range(2)]
        data = {"load_torque_Nm": loads,
                "motor_torque_Nm": [load * (0.0470713, -0.0837434)[k % 2] for k, load in enumerate(loads)]}
        with tempfile.TemporaryDirectory() as folder:
            found = wormdrive.diagnose(SCENARIOS / "fig07_break_in_07cm_forward.toml", data, output=Path(folder, "out"))
            self.assertEqual(json.loads(Path(folder, "out/diagnosis.json").read_text()), found.findings)


class Faults(unittest.TestCase):
    def test_data_that_are_none_or_do_not_fit_together_are_rejected(self):
        for data, message in (([], "data: error: no file is given"), ((), "data: error: no file is given"),
                              ({"time_s": [0.0, 1.0], "gear_angle_rad": [0.0]},
                               "data: error: its columns differ in length: 'time_s' has 2 values, 'gear_angle_rad' has 1 values"),
                              ({"time_s": np.array([0.0, 1.0]), "gear_angle_rad": np.array([0.0, 1j])},
                               "data: error: 'gear_angle_rad' holds complex numbers")):
            for arguments in ((data, None), ({"time_s": [0.0]}, data)):
                with self.assertRaises(wormdrive.InputError) as caught:
                    wormdrive.diagnose(FIG09, arguments[0], since=arguments[1])
                self.assertEqual(str(caught.exception), message)

    def test_errors_are_the_usual_exceptions_too(self):
        with self.assertRaises(ValueError):
            wormdrive.run(SHORT, mesh={"frction": 1})
        self.assertTrue(issubclass(wormdrive.OutputError, OSError))
        with self.assertRaisesRegex(wormdrive.OutputError, "cannot create /nowhere/a.h5.part: No such file or directory"):
            wormdrive.run(SHORT).write("/nowhere/a.h5")
        with self.assertRaisesRegex(wormdrive.InputError, r"no.toml: error: cannot be read: No such file or directory"):
            wormdrive.run("no.toml")
        with self.assertRaises(wormdrive.InputError) as caught:
            wormdrive.run(SHORT, **{"mesh.friction": 14})
        self.assertTrue(str(caught.exception).startswith("--set mesh.friction=14: error: mesh.friction = 14 is not below mu_g"))
        with self.assertRaises(TypeError):
            wormdrive.run(SHORT, mesh={"friction": object()})

    def test_a_halt_keeps_the_run_up_to_there(self):
        with self.assertRaises(wormdrive.SimulationHalted) as caught:
            wormdrive.run({**SHORT, "load": {"kind": "constant", "torque_Nm": 0.5}, "motor": {"torque": [
                {"kind": "ramp", "rate_Nm_per_s": 1.0}, {"kind": "step", "time_s": 0.1, "torque_Nm": 1e308}]}},
                run={"duration_s": 0.2})
        self.assertTrue(str(caught.exception).startswith("cannot go on at t = 0.1 s, forward, "), str(caught.exception))
        self.assertEqual(caught.exception.result.trajectory.time[-1], 0.1)

    def test_malformed_scenarios_say_what_the_program_says(self):
        tests = os.environ.get("WORMDRIVE_TESTS")
        if not tests:
            self.skipTest("the program of the C++ tests is not built")
        with tempfile.TemporaryDirectory() as folder:
            listed = Path(folder, "cases")
            subprocess.run([tests, "--filenames-as-tags", "[#bad_scenarios],[#bad_effects],[#bad_controllers],[#bad_tables],[#bad_teeth]"],
                           env={**os.environ, "WORMDRIVE_LIST_CASES": str(listed)}, check=True, capture_output=True)
            cases = [json.loads(line) for line in listed.read_text().splitlines()]
            self.assertGreater(len(cases), 100)
            os.chdir(folder)
            os.mkdir("folder")  # which a case takes for a file
            for case in cases:
                for name, content in {**case["beside"], "s.toml": case["scenario"]}.items():
                    Path(name).write_bytes(bytes.fromhex(content))
                with self.subTest(case["name"]), self.assertRaises(wormdrive.InputError) as caught:
                    wormdrive.run("s.toml")
                said, expected = str(caught.exception), case["message"]
                if expected.endswith("*"):
                    self.assertTrue(said.startswith(expected[:-1]) and "\n" not in said, said)
                else:
                    self.assertEqual(said, expected)
            os.chdir("/")


class Python(unittest.TestCase):
    def test_threads_run_side_by_side(self):
        scenario, ticks, done = wormdrive.Scenario(FIG10, run={"duration_s": 5}), [], threading.Event()
        runner = threading.Thread(target=lambda: (scenario.run(), done.set()))
        runner.start()
        while not done.wait(0.005):
            ticks.append(time.monotonic())
        runner.join()
        self.assertGreater(len(ticks), 3)  # with the lock held there would be one

    def test_ctrl_c_ends_a_run(self):
        code = ("import signal, sys, wormdrive\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"  # nohup ignores it
                "print('ready', flush=True)\n"
                f"try: wormdrive.run({str(FIG10)!r}, run={{'duration_s': 100000, 'report_interval_s': 0.1}})\n"
                "except KeyboardInterrupt: sys.exit(42)\n")
        child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
        child.stdout.readline()
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        self.assertEqual(child.wait(30), 42)
        child.stdout.close()

    @unittest.skipIf("san.so" in Path("/proc/self/maps").read_text(), "a memory checker keeps what is freed")
    def test_ten_thousand_runs_leave_nothing_behind(self):
        scenario = wormdrive.Scenario(SHORT, run={"solver": "taylor", "report_interval_s": 0.005})
        for k in range(10000):
            if k == 1000:
                before = resident_kib()
            scenario.run().trajectory.gear_angle
        self.assertLess(resident_kib() - before, 2000)  # 220 bytes a run


if __name__ == "__main__":
    unittest.main()
