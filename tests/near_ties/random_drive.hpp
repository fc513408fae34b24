#pragma once
#include "judge/drive.hpp"
#include "near_ties/dice.hpp"

namespace wormdrive::test::near_ties {

/// What a random drive is made for: how fast its inputs change [s], how large its torques are [N m, at the gear].
struct Scale {
  double time, load;
  bool elastic;  ///< its teeth will be made elastic: without effects that these exclude
};

/// A drive of any regime of locking with 0 to 5 effects, at rest and without inputs; it moves by a radian or less while
/// its inputs change, so that what depends on its angle can be followed.
judge::Drive random_drive(Dice& dice, const Scale& scale);

/// The motor torque at which a drive at rest begins to move in a direction under a load over time of this size [N m].
double break_in(const judge::Drive& drive, int direction, double load);
/// The motor torque at which the flank changes under a load, at the drive's initial angle and speed [N m].
double surface(const judge::Drive& drive, int direction, double load);

}  // namespace wormdrive::test::near_ties
