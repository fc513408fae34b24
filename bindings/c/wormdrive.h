/* The drive for C: a worm-gear drive that is stepped inside a loop of one's own (docs/howto/stepping.md). SI throughout;
   on a linear axis torques are forces [N] and angles are positions [m]. A function that fails returns a null pointer, 0 or
   a status other than 0, and wormdrive_error() tells why in one line; nothing has changed then. Drives are independent of
   each other: different threads may step different drives. */
#ifndef WORMDRIVE_H
#define WORMDRIVE_H

#include <stddef.h>

#ifndef WORMDRIVE_API
#define WORMDRIVE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wormdrive_drive wormdrive_drive;

enum { WORMDRIVE_OK = 0, WORMDRIVE_BAD_INPUT = 2, WORMDRIVE_HALTED = 3 };

/* What a drive shows. Without teeth that are elastic the worm turns with the gear. */
typedef struct {
  double time;              /* [s] */
  double gear_angle;        /* [rad] */
  double gear_speed;        /* [rad/s] */
  double gear_acceleration; /* [rad/s^2] */
  double motor_torque;      /* on the worm, behind limit, delay and lag [N m] */
  double load_torque;       /* on the gear [N m] */
  double normal_force;      /* between the teeth [N] */
  double worm_angle;        /* [rad] */
  double worm_speed;        /* [rad/s] */
  int motion;               /* -1 backward, 0 stuck, 1 forward */
  int flank;                /* that carries the load: -1 right, 0 none, 1 left */
} wormdrive_state;

/* The drive of a scenario: a file (.toml, or a result .h5), or TOML text. */
WORMDRIVE_API wormdrive_drive* wormdrive_open(const char* path);
WORMDRIVE_API wormdrive_drive* wormdrive_parse(const char* toml);
WORMDRIVE_API void wormdrive_close(wormdrive_drive* drive);

/* What the scenario states and stepping has no use for, a sentence to a line; "" if there is nothing. It lives as long as
   the drive. */
WORMDRIVE_API const char* wormdrive_set_aside(const wormdrive_drive* drive);

/* Goes on by dt [s] under a motor torque [N m] that is held meanwhile, through all events on the way. state may be null.
   WORMDRIVE_HALTED: the drive cannot go on and stands where it halted until it is reset or restored. */
WORMDRIVE_API int wormdrive_step(wormdrive_drive* drive, double torque, double dt, wormdrive_state* state);
WORMDRIVE_API int wormdrive_get_state(const wormdrive_drive* drive, wormdrive_state* state);
/* The columns that a trajectory of the drive has (output/schema.md), a name to a line; among them currents, temperatures and
   other states of its effects. It lives as long as the drive. */
WORMDRIVE_API const char* wormdrive_columns(const wormdrive_drive* drive);
/* What such a column shows now. */
WORMDRIVE_API int wormdrive_get_value(const wormdrive_drive* drive, const char* column, double* value);
/* Starts again, as the scenario states. */
WORMDRIVE_API int wormdrive_reset(wormdrive_drive* drive);

/* All that changes in a drive, as numbers. Writes them if capacity suffices and returns how many there are, 0 for a fault;
   with numbers null it only counts. The count may change with every step where the motor has a delay. */
WORMDRIVE_API size_t wormdrive_snapshot(const wormdrive_drive* drive, double* numbers, size_t capacity);
/* Goes back to a snapshot of this drive or of one with the same scenario, in this process or another one. */
WORMDRIVE_API int wormdrive_restore(wormdrive_drive* drive, const double* numbers, size_t count);

/* Why the latest call of this thread failed; "" if none has. */
WORMDRIVE_API const char* wormdrive_error(void);

#ifdef __cplusplus
}
#endif

#endif
