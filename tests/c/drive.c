/* The library for C, seen by a C compiler: a closed form, snapshots, and what each fault says. Exit status 1 if anything
   differs. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "wormdrive.h"

static int faults = 0;

static void check(int holds, const char* what) {
  if (holds) return;
  ++faults;
  fprintf(stderr, "does not hold: %s; the latest error is: %s\n", what, wormdrive_error());
}
static void check_error(int failed, const char* words) {
  check(failed, words);
  if (strcmp(wormdrive_error(), words) == 0) return;
  ++faults;
  fprintf(stderr, "expected: %s\nfound:    %s\n", words, wormdrive_error());
}

int main(void) {
  const char* const rubbing = "[mesh]\nkind = \"none\"\ninertia_kgm2 = 1\n[effect.gear_coulomb]\ntorque_Nm = 1\n";
  wormdrive_drive* drive = wormdrive_parse(rubbing);
  check(drive != NULL, "a drive of TOML text");
  if (!drive) return 1;
  check(strcmp(wormdrive_set_aside(drive), "") == 0, "nothing is set aside");

  /* 2 rad/s^2 for 0.1 s, then -1 rad/s^2 for 0.2 s, then rest */
  wormdrive_state state;
  check(wormdrive_step(drive, 3.0, 0.1, &state) == WORMDRIVE_OK, "a step");
  check(fabs(state.gear_angle - 0.01) < 1e-11 && fabs(state.gear_speed - 0.2) < 1e-11, "the drive is pushed");
  check(state.motion == 1 && fabs(state.motor_torque - 3.0) < 1e-15, "it moves under the torque of the step");
  double speed = 0.0;
  check(strncmp(wormdrive_columns(drive), "time\ngear_angle\ngear_speed\n", 27) == 0, "the names of the columns");
  check(wormdrive_get_value(drive, "gear_speed", &speed) == WORMDRIVE_OK && speed == state.gear_speed, "a column");
  check_error(wormdrive_get_value(drive, "current", &speed) == WORMDRIVE_BAD_INPUT,
              "drive: error: has no column 'current'; it has time, gear_angle, gear_speed, gear_acceleration, motor_torque, "
              "load_torque, normal_force, motion, flank");
  check_error(wormdrive_get_value(drive, NULL, &speed) == WORMDRIVE_BAD_INPUT, "column is a null pointer");
  double kept[64];
  const size_t count = wormdrive_snapshot(drive, NULL, 0);
  check(count > 0 && wormdrive_snapshot(drive, kept, 64) == count, "a snapshot");
  check_error(wormdrive_snapshot(drive, kept, 3) == 0, "the snapshot has 27 numbers, more than the capacity of 3");
  check(wormdrive_step(drive, 0.0, 1.0, NULL) == WORMDRIVE_OK, "a step that shows nothing");
  check(wormdrive_get_state(drive, &state) == WORMDRIVE_OK, "the state");
  check(fabs(state.gear_angle - 0.03) < 1e-11 && state.gear_speed == 0.0 && state.motion == 0, "the drive has stopped");
  const double rest = state.gear_angle;
  check(wormdrive_restore(drive, kept, count) == WORMDRIVE_OK, "back to the snapshot");
  check(wormdrive_step(drive, 0.0, 1.0, &state) == WORMDRIVE_OK && state.gear_angle == rest, "the same bits again");
  check(wormdrive_reset(drive) == WORMDRIVE_OK && wormdrive_get_state(drive, &state) == WORMDRIVE_OK, "a reset");
  check(state.time == 0.0 && state.gear_angle == 0.0, "the start again");

  check_error(wormdrive_step(drive, NAN, 0.1, &state) == WORMDRIVE_BAD_INPUT,
              "step: error: torque = nan must be a finite number");
  check_error(wormdrive_step(drive, 1.0, 0.0, &state) == WORMDRIVE_BAD_INPUT,
              "step: error: dt = 0 s must be a finite number greater than 0");
  check_error(wormdrive_step(NULL, 1.0, 0.1, &state) == WORMDRIVE_BAD_INPUT, "drive is a null pointer");
  check_error(wormdrive_get_state(drive, NULL) == WORMDRIVE_BAD_INPUT, "state is a null pointer");
  kept[1] += 1.0;
  check_error(wormdrive_restore(drive, kept, count) == WORMDRIVE_BAD_INPUT,
              "snapshot: error: is of a drive with another scenario");
  check_error(wormdrive_open("no_such_file.toml") == NULL, "no_such_file.toml: error: cannot be read: No such file or directory");
  check_error(wormdrive_parse("[mesh]\nkind = \"none\"\n") == NULL,
              "text:1:1: error: [mesh] lacks 'inertia_kgm2' (inertia that moves)");
  check_error(wormdrive_parse(NULL) == NULL, "toml is a null pointer");
  check(wormdrive_get_state(drive, &state) == WORMDRIVE_OK && state.time == 0.0, "nothing has changed");
  wormdrive_close(drive);
  wormdrive_close(NULL);
  if (faults == 0) puts("the library for C is in order");
  return faults != 0;
}
