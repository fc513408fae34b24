#pragma once
// The event loop of an importing tool, with CVODE for the time between events, which it restarts where the model tells
// that the states have changed, and nowhere else.
#include <algorithm>
#include <limits>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "core/signal.hpp"
#include "fmi/importer.hpp"

namespace wormdrive::test {

struct ImportedRow {
  double t, gear_angle, gear_speed, normal_force;
  int motion, flank;
};
struct ImportedEvent {
  double t;
  int motion_before, flank_before, motion_after, flank_after;
};
struct ImportedRun {
  std::vector<ImportedRow> rows;
  std::vector<ImportedEvent> events;
};

/// Integrates an instance that is instantiated, from 0 to the end, with a motor torque that may jump at its knots.
class EventLoop {
 public:
  EventLoop(Instance& model, Signal torque, double longest_step = 1e-3)
      : model_(model),
        torque_(std::move(torque)),
        x_(N_VNew_Serial(static_cast<sunindextype>(model.fmu().states), context_)),
        solver_(CVodeCreate(CV_ADAMS, context_)),
        iteration_(SUNNonlinSol_FixedPoint(x_, 0, context_)) {
    CVodeInit(solver_, rates, 0.0, x_);
    CVodeSStolerances(solver_, 1e-12, 1e-14);
    CVodeSetUserData(solver_, this);
    CVodeSetNonlinearSolver(solver_, iteration_);
    CVodeSetMaxNumSteps(solver_, 1000000);
    CVodeSetMaxStep(solver_, longest_step);
    CVodeRootInit(solver_, static_cast<int>(model.fmu().indicators), indicators);
    CVodeSetNoInactiveRootWarn(solver_);
  }
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;
  ~EventLoop() {
    CVodeFree(&solver_);
    SUNNonlinSolFree(iteration_);
    N_VDestroy(x_);
  }

  ImportedRun operator()(double end, double every) {
    model_.call<decltype(fmi2SetupExperiment)>("fmi2SetupExperiment", 0, 0.0, 0.0, 1, end);
    model_.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode");
    piece_ = torque_.piece(0.0);
    knot_ = torque_.next_knot(0.0);
    model_.set("motor_torque", piece_(0.0));
    model_.call<decltype(fmi2ExitInitializationMode)>("fmi2ExitInitializationMode");
    pass_event(0.0);
    look();
    run_.events.clear();  // the start is none
    row(0.0);
    double t = 0.0;
    for (long k = 1; t < end;) {
      const double report = std::min(end, static_cast<double>(k) * every);
      const double next = std::min({report, knot_, timed_});
      CVodeSetStopTime(solver_, next);
      bool event = next == knot_ || next == timed_;
      if (next > t) {
        const int flag = CVode(solver_, next, x_, &t, CV_NORMAL);
        if (flag < 0) throw std::runtime_error("CVODE fails with " + std::to_string(flag));
        if (flag == CV_ROOT_RETURN) event = true;
        move_to(t, x_);
        fmi2Boolean enter = 0, terminate = 0;
        model_.call<decltype(fmi2CompletedIntegratorStep)>("fmi2CompletedIntegratorStep", 1, &enter, &terminate);
        event = event || enter;
      }
      if (event) {
        model_.call<decltype(fmi2EnterEventMode)>("fmi2EnterEventMode");
        if (t >= knot_) {  // an input may jump in event mode only
          piece_ = torque_.piece(t);
          knot_ = torque_.next_knot(t);
          model_.set("motor_torque", piece_(t));
        }
        pass_event(t);
        look();
      }
      if (t >= report) {
        row(t);
        ++k;
      }
    }
    model_.call<decltype(fmi2Terminate)>("fmi2Terminate");
    return std::move(run_);
  }
  /// Indicators that were 0 behind an event.
  int zeros = 0;

 private:
  static EventLoop& self(void* data) { return *static_cast<EventLoop*>(data); }
  static int rates(sunrealtype t, N_Vector x, N_Vector rate, void* data) {
    self(data).move_to(t, x);
    self(data).model_.call<decltype(fmi2GetDerivatives)>("fmi2GetDerivatives", N_VGetArrayPointer(rate),
                                                         self(data).model_.fmu().states);
    return 0;
  }
  static int indicators(sunrealtype t, N_Vector x, sunrealtype* z, void* data) {
    self(data).move_to(t, x);
    self(data).model_.call<decltype(fmi2GetEventIndicators)>("fmi2GetEventIndicators", z,
                                                             self(data).model_.fmu().indicators);
    return 0;
  }
  void move_to(double t, N_Vector x) {
    model_.call<decltype(fmi2SetTime)>("fmi2SetTime", t);
    model_.call<decltype(fmi2SetContinuousStates)>(
        "fmi2SetContinuousStates", static_cast<const double*>(N_VGetArrayPointer(x)), model_.fmu().states);
    model_.set("motor_torque", piece_(t));
  }
  void pass_event(double t) {
    fmi2EventInfo info{};
    bool changed = t == 0.0;  // at the start the states are asked for anyway
    do {
      model_.call<decltype(fmi2NewDiscreteStates)>("fmi2NewDiscreteStates", &info);
      changed = changed || info.valuesOfContinuousStatesChanged;
    } while (info.newDiscreteStatesNeeded);
    timed_ = info.nextEventTimeDefined ? info.nextEventTime : std::numeric_limits<double>::infinity();
    model_.call<decltype(fmi2EnterContinuousTimeMode)>("fmi2EnterContinuousTimeMode");
    std::vector<double> z(model_.fmu().indicators);
    model_.call<decltype(fmi2GetEventIndicators)>("fmi2GetEventIndicators", z.data(), z.size());
    zeros += static_cast<int>(std::count(z.begin(), z.end(), 0.0));
    t_ = t;
    if (!changed) return;
    model_.call<decltype(fmi2GetContinuousStates)>("fmi2GetContinuousStates", N_VGetArrayPointer(x_),
                                                   model_.fmu().states);
    CVodeReInit(solver_, t, x_);
  }
  void look() {
    const int motion = model_.integer("motion"), flank = model_.integer("flank");
    if (motion != motion_ || flank != flank_) run_.events.push_back({t_, motion_, flank_, motion, flank});
    motion_ = motion;
    flank_ = flank;
  }
  void row(double t) {
    run_.rows.push_back({t, model_.real("gear_angle"), model_.real("gear_speed"), model_.real("normal_force"),
                         model_.integer("motion"), model_.integer("flank")});
  }

  sundials::Context context_;
  Instance& model_;
  Signal torque_;
  Piece piece_;
  double knot_ = 0.0, timed_ = 0.0, t_ = 0.0;
  N_Vector x_;
  void* solver_;
  SUNNonlinearSolver iteration_;
  int motion_ = 0, flank_ = 0;
  ImportedRun run_;
};

}  // namespace wormdrive::test
