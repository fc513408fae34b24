#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace wormdrive {

/// Why an integration pauses.
enum class Reason {
  knot,    ///< an input jumps or bends
  latch,   ///< the sensor takes the angle that a later sample will see; nothing changes
  sample,  ///< the controller takes a sample
  guard,   ///< a guard of the present mode fell through zero
  report,  ///< a row is due; nothing changes
  end,
};

/// In the place of a guard's index: none fell through zero.
inline constexpr int no_guard = -1;

/// When a controller takes its samples: at offset + k period [s], k = 0, 1, ...; by default never.
struct Sampling {
  double period = std::numeric_limits<double>::infinity();
  double offset = std::numeric_limits<double>::infinity();
  double age = 0.0;  ///< of the angle that a sample sees [s]; above 0 every sample has a latch that long before it
};

/// The time events of a run: knots of the inputs, samples, reports at begin + k interval, the end.
class Timetable {
 public:
  /// Times in s; report_interval > 0, infinity for none.
  Timetable(double begin, double end, double report_interval, Sampling sampling = {})
      : begin_(begin), end_(end), interval_(report_interval), knot_(begin), sampling_(sampling) {
    schedule_sample();
    schedule_latch();
    schedule_report();
    find_next();
  }

  /// The next time event of any kind.
  double next_time() const { return next_; }
  /// The next time past which no solver may look: behind it the inputs differ.
  double next_stop() const { return next_stop_; }

  /// Takes the event that is due at next_time(); simultaneous ones in the order knot, latch, sample, report, end.
  [[gnu::always_inline]] Reason pop() {
    const Reason due = next();
    find_next();
    return due;
  }

  void schedule_knot(double t) {
    knot_ = t;
    find_next();
  }

  /// Puts the end [s] elsewhere, for a run that goes on; what stands at the former end is due then.
  void end_at(double end) {
    end_ = end;
    find_next();
  }

  /// Takes up the timetable of a run that has had so many samples and latches.
  void take_up(long samples, long latches) {
    samples_ = samples;
    latches_ = latches;
    schedule_sample();
    schedule_latch();
    find_next();
  }

  /// Leaves out what comes before the k-th sample and takes that; no sample sees an angle from before the one before.
  void skip_to_sample(long k) {
    samples_ = latches_ = k + 1;
    schedule_sample();
    schedule_latch();
    while (report_ < sample_time(k)) {
      ++reports_;
      schedule_report();
    }
    find_next();
  }
  /// When the k-th sample is due [s].
  double sample_time(long k) const {
    // Counted, not accumulated, so that it is where its number says; 0 times an infinite period would be no number.
    return begin_ + sampling_.offset + (k == 0 ? 0.0 : static_cast<double>(k) * sampling_.period);
  }

 private:
  Reason next() {
    if (knot_ <= next_ && knot_ < end_) {
      knot_ = std::numeric_limits<double>::infinity();
      return Reason::knot;
    }
    if (latch_ <= next_ && latch_ < end_) {
      ++latches_;
      schedule_latch();
      return Reason::latch;
    }
    if (sample_ <= next_ && sample_ < end_) {
      ++samples_;
      schedule_sample();
      return Reason::sample;
    }
    if (report_ <= next_) {
      ++reports_;
      schedule_report();
      return Reason::report;
    }
    return Reason::end;
  }
  void find_next() {
    next_stop_ = std::min({knot_, sample_, end_});
    next_ = std::min({next_stop_, latch_, report_});
  }

  void schedule_sample() { sample_ = sample_time(samples_); }
  /// What a sample sees from before the begin is the angle at the begin.
  void schedule_latch() {
    if (sampling_.age > 0.0) latch_ = std::max(begin_, sample_time(latches_) - sampling_.age);
  }
  /// A report on the end is the end's own row; one that rounding keeps from a sample is on it, so that no solver sees
  /// it.
  void schedule_report() {
    double t = begin_ + static_cast<double>(reports_) * interval_;
    const double samples = std::round((t - begin_ - sampling_.offset) / sampling_.period);
    if (samples >= 0.0 && samples < 0x1p52) {
      const double sample = sample_time(static_cast<long>(samples));
      if (std::abs(t - sample) <= 2.0 * std::numeric_limits<double>::epsilon() * t) t = sample;
    }
    report_ = t < end_ - 1e-9 * interval_ ? t : std::numeric_limits<double>::infinity();
  }

  double begin_, end_, interval_, knot_;
  Sampling sampling_;
  double sample_ = 0.0, latch_ = std::numeric_limits<double>::infinity(), report_ = 0.0;
  long samples_ = 0, latches_ = 0, reports_ = 1;
  double next_stop_ = 0.0, next_ = 0.0;
};

/// True where so little time is left that a solver could not take a step: at most 2 ulp of t.
inline bool already_there(double t, double target) {
  return target - t <= 2.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), std::abs(target));
}

}  // namespace wormdrive
