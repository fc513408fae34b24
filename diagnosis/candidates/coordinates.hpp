#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "core/effects.hpp"
#include "core/unit.hpp"
#include "diagnosis/candidates/recorded_drive.hpp"

namespace wormdrive {

/// How a number that a fit moves enters the fields of an effect.
enum class CoordinateForm {
  plain,         ///< it is the field
  inverse,       ///< 1/it is the field, which without the effect is infinite: what yields in place of a stiffness
  in_phase,      ///< amplitude cos(phase); its neighbour is in quadrature
  in_quadrature  ///< amplitude sin(phase); at amplitude zero a phase would have no gradient, these two have
};

/// What the predictor's own laws leave wrong in an estimate, as a standard deviation: a share of its value and of its
/// scale, and a size in SI. By default less than a thousandth of all that acts, for a size that shows.
struct ModelError {
  double of_value = 0.0, of_scale = 0.0035, size = 0.0;
};

/// A number that a fit moves.
struct Coordinate {
  std::string_view effect;  ///< id in the catalogue
  std::string_view field;   ///< of in_phase and in_quadrature the amplitude
  double scale = 1.0;       ///< a size that shows
  double low, high;         ///< a fit stays within
  CoordinateForm form = CoordinateForm::plain;
  double centre = 0.0;       ///< what the scenario states
  double whole = 0.0;        ///< change that doubles what is stated; 0 where nothing is stated that could be doubled
  bool none_at_low = false;  ///< the lower bound is no effect at all
  bool turns = false;        ///< an angle, to which a turn more is nothing
  double tolerance = 0.0;    ///< standard deviation of the truth about it; 0: nothing is known
  /// Whether the likelihood has steps over it instead of a slope: a model breaks away at one sample or at another.
  bool stepwise = false;
  ModelError model_error{};
  std::string_view blurred_by{}, blurred_by_field{};  ///< a law whose error this number shares where it is at work
  std::string_view tried{};  ///< another field of the effect, of which values are tried out and reported

  bool is(const Coordinate& other) const {
    return effect == other.effect && field == other.field && form == other.form;
  }
};

/// A field of an effect with a value in SI.
struct FieldValue {
  std::string_view effect, field;
  double value;
};

/// A field as the catalogue has it.
struct FieldOfEffect {
  bool on = false;  ///< the effect is
  double value{};   ///< of the field, if on
  Unit unit{};
  Bounds bounds{};
};

// A catalogue is the effects of a drive, or these with the faults of a recording.

/// Looks a field up by its names. Throws std::invalid_argument where the catalogue has none of that name.
template <class Catalogue = RecordedDrive>
FieldOfEffect field_of(const Catalogue& effects, std::string_view effect, std::string_view field);

/// Gives a field a value; an effect that is off is switched on, with zeros in its other fields.
template <class Catalogue>
void set_field(Catalogue& effects, const FieldValue& to);

/// Switches an effect off.
template <class Catalogue>
void switch_off(Catalogue& effects, std::string_view effect);

/// Gives the fields of all coordinates their values.
template <class Catalogue>
void apply(Catalogue& effects, std::span<const Coordinate> coordinates, std::span<const double> values);

/// Effects of which the fields of some coordinates move: they are looked up once, however often they move.
class MovedEffects {
 public:
  MovedEffects(const Effects<double>& start, std::span<const Coordinate> coordinates);
  MovedEffects(const MovedEffects&) = delete;  // what it has looked up are its own fields
  MovedEffects& operator=(const MovedEffects&) = delete;

  const Effects<double>& operator()(std::span<const double> values);

 private:
  struct Place {
    CoordinateForm form;
    double *field, *phase;  ///< the phase of one in_phase, else none
  };
  Effects<double> effects_;
  std::vector<Place> places_;
};

/// What a coordinate of an effect that is on amounts to.
double coordinate_value(const Effects<double>& effects, const Coordinate& coordinate);

/// The fields that a coordinate of an effect has a part in: itself, or amplitude and phase.
std::vector<std::string_view> fields_of(const Coordinate& coordinate);

}  // namespace wormdrive
