#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "events/taylor/polynomial.hpp"
#include "events/taylor/tape.hpp"

namespace wormdrive {

/// The power series in time of all that stands on a tape, and how far each may stray from its value at the start.
class TapeSeries {
 public:
  /// The tape must outlive it.
  explicit TapeSeries(const Tape& tape);

  Coefficients& operator[](int place) { return series_[static_cast<std::size_t>(place)]; }
  const Coefficients& operator[](int place) const { return series_[static_cast<std::size_t>(place)]; }
  /// Works out coefficient k of the results of the first so many operations, in order; inputs have theirs.
  void work_out(int k, std::size_t operations);

  static constexpr double widest = 2.0;  ///< disc of a phase [rad] that is told about

  // ---- discs of complex numbers around coefficient 0 -------------------------------------------------------------

  double& radius(int place) { return radii_[static_cast<std::size_t>(place)]; }
  double radius(int place) const { return radii_[static_cast<std::size_t>(place)]; }
  /// Works out discs that hold the results wherever in theirs the inputs are, if shrinking() is 1.
  void work_out_discs();
  /// The factor, at most 1, by which the discs of the inputs have to be smaller.
  double shrinking() const;

  // ---- between which values the equations are these ----------------------------------------------------------------

  struct Range {
    int place;
    double low, high;
  };
  /// Calls visit(range) for every result that is bound to one.
  template <class Visit>
  void for_each_range(Visit&& visit) const {
    for (const Tape::Condition& c : tape_.conditions()) visit(Range{c.place, c.least, infinite});
    for (const Section& s : sections_) visit(Range{s.place, s.low, s.high});
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// The cubic of a table that holds now, or the constant before or behind all.
  struct Section {
    const CubicTable* table;
    int place;  ///< of the argument
    std::size_t number{};
    CubicTable::Cubic cubic{};
    double low{}, high{};

    void choose(std::size_t n);
    void find(double x);
    void turn_to(double x, double rate);
    double disc(double x, double radius) const;
  };

  const Tape& tape_;
  std::vector<Coefficients> series_;
  std::vector<double> radii_;
  std::vector<Section> sections_;  ///< of the tables, in order
};

}  // namespace wormdrive
