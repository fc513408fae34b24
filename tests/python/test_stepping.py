"""Drives that Python steps: the bits of a run, closed forms, snapshots, arrays without copies, faults word for word.

Run by ctest as test_wormdrive.py is.
"""

import copy
import math
import multiprocessing
import os
import pickle
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import wormdrive

SCENARIOS = Path(os.environ["WORMDRIVE_SCENARIOS"])
FIG09 = SCENARIOS / "fig09_switching.toml"
RUBBING = {"mesh": {"kind": "none", "inertia_kgm2": 1}, "effect": {"gear_coulomb": {"torque_Nm": 1}}, "run": {"duration_s": 1}}
GEAR = {"mesh": {"ratio": 60, "lead_angle_deg": 4, "pressure_angle_deg": 20, "worm_pitch_radius_m": 0.011,
                 "gear_pitch_radius_m": 0.045, "friction": 0.25, "worm_inertia_kgm2": 2.53e-5, "gear_inertia_kgm2": 7.39e-4},
        "load": {"kind": "gravity_arm", "torque_Nm": 0.0196}}


def go_on(pickled):
    return pickle.loads(pickled).step(0.03, 0.1)


class OneDrive(unittest.TestCase):
    def test_steps_have_the_bits_of_a_run_under_a_table_of_the_same_torques(self):
        torques = [0.0, *(0.08 * math.sin(k) for k in range(1, 40))]
        table = {"kind": "samples", "times_s": [0.03 * k for k in range(40)], "torques_Nm": torques, "interpolation": "hold"}
        for solver in ("cvode", "taylor"):
            settings = {"solver": solver, "duration_s": 1.2, "report_interval_s": 1.2}
            run = wormdrive.run({**GEAR, "motor": {"torque": table}, "run": settings})
            drive = wormdrive.Drive({**GEAR, "run": settings})
            rows = {t: k for k, t in enumerate(run.trajectory.time)}
            for torque in torques:
                state = drive.step(torque, 0.03)
                self.assertEqual(state.gear_angle, run.trajectory.gear_angle[rows[state.time]])
                self.assertEqual(state.gear_speed, run.trajectory.gear_speed[rows[state.time]])
            self.assertEqual(sum(drive.events.values()), len(run.events.time))
            self.assertGreater(sum(drive.events.values()), 5)

    def test_a_stop_inside_of_a_step_is_where_the_closed_form_has_it(self):
        for solver in ("cvode", "taylor"):
            drive = wormdrive.Drive(RUBBING, run={"solver": solver})
            pushed = drive.step(3.0, 0.1)  # 2 rad/s^2 for 0.1 s, then -1 rad/s^2 for 0.2 s
            self.assertAlmostEqual(pushed.gear_angle, 0.01, delta=1e-11)
            self.assertAlmostEqual(pushed.gear_speed, 0.2, delta=1e-11)
            rest = drive.step(0.0, 1.0)
            self.assertAlmostEqual(rest.gear_angle, 0.03, delta=1e-11)
            self.assertEqual((rest.time, rest.gear_speed, rest.motion), (1.1, 0.0, 0))
            self.assertEqual(drive.step(-0.999, 1.0).motion, 0)
            self.assertEqual(drive.step(-1.001, 1.0).motion, -1)
            self.assertEqual({name: count for name, count in drive.events.items() if count}, {"stop": 1, "break_away": 1})

    def test_snapshots_and_pickles_go_on_to_the_same_bits(self):
        for overrides in ({}, {"effect": {"actuator_delay": {"delay_s": 0.03}, "actuator_lag": {"time_constant_s": 0.02}}}):
            drive = wormdrive.Drive(FIG09, **overrides)
            for k in range(20):
                drive.step(0.06 * math.sin(0.5 * k), 0.011)
            snapshot, pickled, twin = drive.snapshot(), pickle.dumps(drive), copy.copy(drive)
            state = drive.step(0.03, 0.1)
            self.assertNotEqual(drive.snapshot(), snapshot)
            self.assertEqual(twin.step(0.03, 0.1), state)
            drive.restore(snapshot)
            self.assertEqual(drive.step(0.03, 0.1), state)
            with multiprocessing.get_context("spawn").Pool(1) as pool:
                self.assertEqual(pool.map(go_on, [pickled]), [state])
            self.assertEqual(drive.reset(), wormdrive.Drive(FIG09, **overrides).state)

    def test_every_column_of_a_run_shows_in_a_step(self):
        torques = [0.0, *(0.15 * math.sin(k) for k in range(1, 40))]
        table = {"kind": "samples", "times_s": [0.03 * k for k in range(40)], "torques_Nm": torques, "interpolation": "hold"}
        states = {"dc_motor": {"resistance_ohm": 1.2, "torque_constant_Nm_per_A": 0.025, "inductance_H": 2e-3},
                  "worm_lugre": {"coulomb_torque_Nm": 1e-3, "stiffness_Nm_per_rad": 0.05},
                  "gearbox_heat": {"heat_capacity_J_per_K": 1, "friction_decay_per_K": 0.01, "starting_rise_K": 7},
                  "load_coupling": {"inertia_kgm2": 1e-3, "stiffness_Nm_per_rad": 3, "damping_Nms_per_rad": 0.01}}
        teeth = {"tooth_compliance": {"stiffness_N_per_m": 1e6, "damping_s_per_m": 0.1}}
        for effect, least in ((states, 16), (teeth, 15), ({}, 9)):
            settings = {"duration_s": 1.2, "report_interval_s": 1.2}
            run = wormdrive.run({**GEAR, "effect": effect, "motor": {"torque": table}, "run": settings}).trajectory
            drive = wormdrive.Drive({**GEAR, "effect": effect, "run": settings})
            rows = {t: k for k, t in enumerate(run.time)}
            self.assertGreaterEqual(len(drive.columns), least)
            for torque in torques:
                drive.step(torque, 0.03)
                row = rows[drive.time]
                for name, value in drive.columns.items():
                    # motor torque, and what follows from it, jump with the next row of the table
                    if name in ("gear_angle", "gear_speed", "load_coupling_twist", "load_coupling_speed", "worm_angle",
                                "motor_current", "worm_lugre_deflection", "gearbox_heat_temperature_rise", "time"):
                        self.assertEqual(value, getattr(run, name)[row], name)

    def test_what_is_set_aside_is_told(self):
        drive = wormdrive.Drive(SCENARIOS / "fig10_sliding_014rad_bare.toml")
        self.assertEqual(drive.set_aside, ["[controller], its reference, sensor and disturbance are not used: every step "
                                           "states the torque of the motor"])
        self.assertIn(drive.set_aside[0], repr(drive))
        self.assertEqual(wormdrive.Drive(RUBBING).set_aside, [])

    def test_faults_are_told_in_one_line(self):
        drive = wormdrive.Drive(FIG09)
        for call, words in (
                (lambda: drive.step(math.inf, 0.1), "step: error: torque = inf must be a finite number"),
                (lambda: drive.step(0.0, -0.1), "step: error: dt = -0.1 s must be a finite number greater than 0"),
                (lambda: drive.restore(b"x"), "snapshot: error: is none, or of another version of wormdrive"),
                (lambda: drive.restore(wormdrive.Drive(RUBBING).snapshot()),
                 "snapshot: error: is of a drive with another scenario"),
                (lambda: wormdrive.Drive(FIG09, mesh={"friction": 20}),
                 "drive: error: mesh.friction = 20 is not below mu_g = 13.4382 (cos(phi_n)/tan(lambda)): the worm would lock "
                 "itself; only elastic teeth, [effect.tooth_compliance], allow it")):
            with self.assertRaises(wormdrive.InputError) as fault:
                call()
            self.assertEqual(str(fault.exception), words)
        self.assertEqual(drive.time, 0.0)


class ManyDrives(unittest.TestCase):
    def setUp(self):
        self.count = 37
        self.friction = np.linspace(0.1, 0.3, self.count)
        self.drives = wormdrive.Drives(FIG09, self.count, run={"solver": "taylor"}, mesh={"friction": self.friction})

    def torques(self, step):
        return 0.07 * np.sin(np.arange(self.count) + 0.3 * step)

    def test_each_has_the_bits_that_it_has_alone(self):
        self.assertTrue(self.drives.in_lanes)
        alone = [wormdrive.Drive(FIG09, run={"solver": "taylor"}, mesh={"friction": mu}) for mu in self.friction]
        for step in range(60):
            self.drives.step(self.torques(step), 0.01)
            for drive, torque in zip(alone, self.torques(step)):
                drive.step(torque, 0.01)
        for k, drive in enumerate(alone):
            self.assertEqual(self.drives[k], drive.state)
            self.assertEqual(self.drives.gear_angle[k], drive.state.gear_angle)
            self.assertEqual(self.drives.events(k), drive.events)

    def test_arrays_show_the_present_without_a_copy(self):
        angle = self.drives.gear_angle
        for step in range(30):
            self.drives.step(self.torques(step), 0.01)
        self.assertTrue(np.any(angle != 0.0))
        self.assertIs(angle, self.drives.gear_angle)
        with self.assertRaises(ValueError):
            angle[0] = 1.0
        with self.assertRaises(ValueError):
            angle.flags.writeable = True
        self.assertEqual(set(self.drives.motion) - {-1, 0, 1}, set())
        self.drives.step(self.torques(3).astype(np.float32), 0.01)  # another type is converted
        last = angle.copy()
        del self.drives
        self.assertTrue(np.array_equal(angle, last))  # who looks there keeps the drives alive

    def test_some_start_again_and_all_go_back(self):
        for step in range(10):
            self.drives.step(self.torques(step), 0.01)
        self.drives.reset([3, -1])
        self.drives.reset(np.arange(self.count) == 5)
        self.assertEqual(list(np.flatnonzero(self.drives.time == 0.0)), [3, 5, self.count - 1])
        self.drives.reset()
        for step in range(10):
            self.drives.step(self.torques(step), 0.01)
        snapshot, pickled = self.drives.snapshot(), pickle.dumps(self.drives)
        self.drives.step(self.torques(10), 0.05)
        expected = self.drives.gear_angle.copy()
        self.drives.restore(snapshot)
        for drives in (self.drives, pickle.loads(pickled)):
            drives.step(self.torques(10), 0.05)
            self.assertTrue(np.array_equal(drives.gear_angle, expected))

    def test_all_go_on_from_where_one_is(self):
        one = wormdrive.Drive(FIG09, run={"solver": "taylor"})
        for _ in range(20):
            one.step(0.06, 0.01)
        fan = wormdrive.Drives(FIG09, 5, run={"solver": "taylor"})
        fan.restore(one.snapshot())
        torques = np.linspace(-0.06, 0.06, 5)
        fan.step(torques, 0.05)
        one.step(torques[1], 0.05)
        self.assertEqual(fan[1], one.state)

    def test_a_column_shows_what_each_has_alone(self):
        friction = np.linspace(0.1, 0.3, 5)
        heat = {"effect": {"gearbox_heat": {"heat_capacity_J_per_K": 0.1}}}
        drives = wormdrive.Drives(FIG09, 5, mesh={"friction": friction}, **heat)
        drives.step(np.full(5, 0.06), 0.5)
        rises = drives.column("gearbox_heat_temperature_rise")
        for k in range(5):
            drive = wormdrive.Drive(FIG09, mesh={"friction": friction[k]}, **heat)
            drive.step(0.06, 0.5)
            self.assertEqual(drive.columns["gearbox_heat_temperature_rise"], rises[k])
        self.assertTrue((np.diff(rises) != 0).all())
        with self.assertRaises(wormdrive.InputError) as fault:
            drives.column("temperature")
        self.assertEqual(str(fault.exception),
                         "drive: error: has no column 'temperature'; it has time, gear_angle, gear_speed, gear_acceleration, "
                         "motor_torque, load_torque, normal_force, motion, flank, gearbox_heat_temperature_rise")

    def test_others_run_while_drives_are_stepped(self):
        drives = wormdrive.Drives(FIG09, 200)  # by CVODE, one after the other
        torques, ticks, done = np.full(200, 0.05), [], threading.Event()
        runner = threading.Thread(target=lambda: ([drives.step(torques, 0.2) for _ in range(10)], done.set()))
        runner.start()
        while not done.wait(0.002):
            ticks.append(time.monotonic())
        runner.join()
        self.assertGreater(len(ticks), 3)

    def test_faults_are_told_in_one_line(self):
        for call, words in (
                (lambda: self.drives.step([0.0], 0.1), "step: error: 1 torques for 37 drives; state one for each"),
                (lambda: self.drives.step(np.zeros((37, 1)), 0.1),
                 "step: error: torques must be an array of one axis, a torque for each drive"),
                (lambda: self.drives.step(np.full(37, np.nan), 0.1), "step: error: torque[0] = nan must be a finite number"),
                (lambda: self.drives.reset(np.array([True])), "drives: error: 1 truth values for 37 drives"),
                (lambda: self.drives.restore(np.array([99.0, 0.0]).tobytes()), "snapshot: error: is none of drives"),
                (lambda: wormdrive.Drives(FIG09, 0), "drives: error: count = 0 must be at least 1"),
                (lambda: wormdrive.Drives(FIG09, 3, mesh={"friction": np.zeros(2)}),
                 "drives: error: mesh.friction has 2 values for 3 drives")):
            with self.assertRaises(wormdrive.InputError) as fault:
                call()
            self.assertEqual(str(fault.exception), words)
        with self.assertRaises(IndexError):
            self.drives[37]
        self.assertEqual(self.drives.time.max(), 0.0)


if __name__ == "__main__":
    unittest.main()
