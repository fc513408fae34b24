// Fig. 9 of the paper as one would program it for this case alone: constants worked out once, one switch per
// question, CVODE called directly. Equation numbers are those of Yeh & Wu 2009.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "bench/open_loop.hpp"

namespace bench {
namespace {

using std::cos;
using std::sin;

// Table 1
constexpr double pi = std::numbers::pi, degree = pi / 180.0;
constexpr double lambda = 4 * degree, phi_n = 20 * degree, lw = 0.011, lg = 0.045, mu = 0.25;
constexpr double Jw_i = 2.53e-5 * 60, Jg = 7.39e-4, surface = Jw_i / Jg;

// 1 where motion and flank have one sign (forward left, backward right), 2 where they differ
const double lever_1 = cos(phi_n) * cos(lambda) + mu * sin(lambda);
const double lever_2 = cos(phi_n) * cos(lambda) - mu * sin(lambda);
const double C1 = lw / lg * (cos(phi_n) * sin(lambda) - mu * cos(lambda)) / lever_1;
const double C2 = lw / lg * (cos(phi_n) * sin(lambda) + mu * cos(lambda)) / lever_2;
const double J1 = Jw_i + C1 * Jg, J2 = Jw_i + C2 * Jg;

double motor_torque(double t) { return 0.05 * cos(3 * pi * t + pi / 2); }
double load_torque(double theta) { return 0.0196 * cos(theta); }
double load_slope(double theta) { return -0.0196 * sin(theta); }

enum class Mode { stuck, forward_left, forward_right, backward_left, backward_right };

int motion(Mode mode) {
  switch (mode) {
    case Mode::stuck: return 0;
    case Mode::forward_left:
    case Mode::forward_right: return 1;
    case Mode::backward_left:
    case Mode::backward_right: return -1;
  }
  return 0;
}
int flank(Mode mode) {
  switch (mode) {
    case Mode::stuck: return 0;
    case Mode::forward_left:
    case Mode::backward_left: return 1;
    case Mode::forward_right:
    case Mode::backward_right: return -1;
  }
  return 0;
}

// eq. 18-19
double acceleration(Mode mode, double tau_m, double tau_l) {
  switch (mode) {
    case Mode::stuck: return 0.0;
    case Mode::forward_left:
    case Mode::backward_right: return (tau_m + C1 * tau_l) / J1;
    case Mode::forward_right:
    case Mode::backward_left: return (tau_m + C2 * tau_l) / J2;
  }
  return 0.0;
}

// eq. 6-7 at rest, 12 and 14 in motion
double normal_force(Mode mode, double tau_m, double tau_l, double alpha) {
  const double gear_torque = tau_l - Jg * alpha;
  switch (mode) {
    case Mode::stuck: return std::abs(tau_l / lg * cos(lambda) - tau_m / lw * sin(lambda)) / cos(phi_n);
    case Mode::forward_left: return gear_torque / (lever_1 * lg);
    case Mode::backward_right: return -gear_torque / (lever_1 * lg);
    case Mode::forward_right: return -gear_torque / (lever_2 * lg);
    case Mode::backward_left: return gear_torque / (lever_2 * lg);
  }
  return 0.0;
}

Mode other_flank(Mode mode) {
  switch (mode) {
    case Mode::stuck: return Mode::stuck;
    case Mode::forward_left: return Mode::forward_right;
    case Mode::forward_right: return Mode::forward_left;
    case Mode::backward_left: return Mode::backward_right;
    case Mode::backward_right: return Mode::backward_left;
  }
  return Mode::stuck;
}

// The mode in which the torques move the gear from rest, stuck if they do not.
Mode from_rest(double t, double theta) {
  const double tau_m = motor_torque(t), tau_l = load_torque(theta);
  const bool left = tau_m <= surface * tau_l;
  const Mode forward = left ? Mode::forward_left : Mode::forward_right;
  const Mode backward = left ? Mode::backward_left : Mode::backward_right;
  if (acceleration(forward, tau_m, tau_l) > 0.0) return forward;
  if (acceleration(backward, tau_m, tau_l) < 0.0) return backward;
  return Mode::stuck;
}

// Bisection to the last bit: stuck at the first time, not at the second.
double break_away(double stuck, double moving, double theta) {
  for (;;) {
    const double middle = stuck + 0.5 * (moving - stuck);
    if (middle <= stuck || middle >= moving) return moving;
    (from_rest(middle, theta) == Mode::stuck ? stuck : moving) = middle;
  }
}

// ---- what CVODE calls; the user data is the mode ----------------------------------------------------------------

int right_hand_side(sunrealtype t, N_Vector y, N_Vector ydot, void* mode) {
  NV_Ith_S(ydot, 0) = NV_Ith_S(y, 1);
  NV_Ith_S(ydot, 1) = acceleration(*static_cast<Mode*>(mode), motor_torque(t), load_torque(NV_Ith_S(y, 0)));
  return 0;
}

int jacobian(sunrealtype, N_Vector y, N_Vector, SUNMatrix J, void* mode, N_Vector, N_Vector, N_Vector) {
  SM_ELEMENT_D(J, 0, 0) = 0.0;
  SM_ELEMENT_D(J, 0, 1) = 1.0;
  SM_ELEMENT_D(J, 1, 0) = acceleration(*static_cast<Mode*>(mode), 0.0, load_slope(NV_Ith_S(y, 0)));
  SM_ELEMENT_D(J, 1, 1) = 0.0;
  return 0;
}

// Speed in its direction and distance to the switching surface: both fall through zero when the mode ends.
int roots(sunrealtype t, N_Vector y, sunrealtype* g, void* data) {
  const Mode mode = *static_cast<Mode*>(data);
  g[0] = motion(mode) * NV_Ith_S(y, 1);
  g[1] = -flank(mode) * (motor_torque(t) - surface * load_torque(NV_Ith_S(y, 0)));
  return 0;
}

void check(int flag, const char* what) {
  if (flag >= 0) return;
  std::fprintf(stderr, "%s failed with %d\n", what, flag);
  std::exit(1);
}

}  // namespace

Run by_hand(const Settings& settings) {
  sundials::Context context;
  Mode mode = Mode::stuck;
  double t = 0.0;
  N_Vector y = N_VNew_Serial(2, context);
  N_VConst(0.0, y);

  void* cvode = CVodeCreate(settings.bdf ? CV_BDF : CV_ADAMS, context);
  check(CVodeInit(cvode, right_hand_side, t, y), "CVodeInit");
  check(CVodeSStolerances(cvode, settings.relative_tolerance, settings.absolute_tolerance), "CVodeSStolerances");
  check(CVodeSetUserData(cvode, &mode), "CVodeSetUserData");
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  SUNNonlinearSolver fixed_point = nullptr;
  if (settings.bdf) {
    matrix = SUNDenseMatrix(2, 2, context);
    linear = SUNLinSol_Dense(y, matrix, context);
    check(CVodeSetLinearSolver(cvode, linear, matrix), "CVodeSetLinearSolver");
    check(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");
  } else {
    fixed_point = SUNNonlinSol_FixedPoint(y, 0, context);
    check(CVodeSetNonlinearSolver(cvode, fixed_point), "CVodeSetNonlinearSolver");
  }
  int falling[] = {-1, -1};
  check(CVodeRootInit(cvode, 2, roots), "CVodeRootInit");
  check(CVodeSetRootDirection(cvode, falling), "CVodeSetRootDirection");
  check(CVodeSetNoInactiveRootWarn(cvode), "CVodeSetNoInactiveRootWarn");

  Run run;
  run.rows.reserve(outputs + 100);
  const auto store = [&] {
    const double theta = NV_Ith_S(y, 0), tau_m = motor_torque(t), tau_l = load_torque(theta);
    const double alpha = acceleration(mode, tau_m, tau_l);
    run.rows.push_back({t, theta, NV_Ith_S(y, 1), alpha, tau_m, tau_l, normal_force(mode, tau_m, tau_l, alpha),
                        motion(mode), flank(mode)});
  };
  const auto count = [&] {  // before CVodeReInit, which forgets
    long steps = 0, evaluations = 0;
    check(CVodeGetNumSteps(cvode, &steps), "CVodeGetNumSteps");
    check(CVodeGetNumRhsEvals(cvode, &evaluations), "CVodeGetNumRhsEvals");
    run.steps += steps;
    run.evaluations += evaluations;
  };

  store();
  for (int k = 1; k <= outputs;) {
    const double output = k * output_interval;
    bool event = false;
    if (mode == Mode::stuck) {
      const double theta = NV_Ith_S(y, 0);
      event = from_rest(output, theta) != Mode::stuck;
      t = event ? break_away(t, output, theta) : output;
    } else {
      const int flag = CVode(cvode, output, y, &t, CV_NORMAL);
      check(flag, "CVode");
      event = flag == CV_ROOT_RETURN;
    }
    store();
    if (!event) {
      ++k;
      continue;
    }

    int fired[2] = {};
    if (mode != Mode::stuck) check(CVodeGetRootInfo(cvode, fired), "CVodeGetRootInfo");
    if (fired[1] != 0) {
      mode = other_flank(mode);
    } else {  // reversal or break-away
      NV_Ith_S(y, 1) = 0.0;
      mode = from_rest(t, NV_Ith_S(y, 0));
    }
    store();
    count();
    check(CVodeReInit(cvode, t, y), "CVodeReInit");
    check(CVodeSetStopTime(cvode, end_time), "CVodeSetStopTime");
  }
  count();

  CVodeFree(&cvode);
  SUNNonlinSolFree(fixed_point);
  SUNLinSolFree(linear);
  SUNMatDestroy(matrix);
  N_VDestroy(y);
  return run;
}

}  // namespace bench
