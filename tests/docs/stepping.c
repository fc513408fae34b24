/* The joint in C of docs/howto/stepping.md. What stands between the markers stands on that page, word for word. The test
   compiles it as C and runs it on a shipped scenario. */
// [howto]
#include <stdio.h>
#include <stdlib.h>

#include "wormdrive.h"

static int fail(const char* what) {
  fprintf(stderr, "%s: %s\n", what, wormdrive_error());
  return EXIT_FAILURE;
}

int main(int argc, char** argv) {
  if (argc != 2) return EXIT_FAILURE;
  wormdrive_drive* drive = wormdrive_open(argv[1]);
  if (!drive) return fail("open");
  printf("%s\n", wormdrive_set_aside(drive));

  wormdrive_state joint;
  if (wormdrive_get_state(drive, &joint)) return fail("state");
  const double dt = 0.002, wanted = 0.5;
  for (int k = 0; k < 1000; ++k) {
    const double torque = k < 900 ? 0.6 * (wanted - joint.gear_angle) - 0.02 * joint.gear_speed : 0.0;
    if (wormdrive_step(drive, torque, dt, &joint)) return fail("step");
  }
  printf("%.1f s: %.3f rad, %s\n", joint.time, joint.gear_angle, joint.motion == 0 ? "held by friction" : "moving");

  double kept[64];
  const size_t count = wormdrive_snapshot(drive, kept, 64);
  if (count == 0) return fail("snapshot");
  wormdrive_step(drive, 0.05, 0.1, &joint);
  const double once = joint.gear_angle;
  if (wormdrive_restore(drive, kept, count)) return fail("restore");
  wormdrive_step(drive, 0.05, 0.1, &joint);
  printf("again from the snapshot: %s\n", joint.gear_angle == once ? "the same bits" : "something else");
  wormdrive_close(drive);
  return EXIT_SUCCESS;
}
// [/howto]
