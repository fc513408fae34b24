#include "diagnosis/candidates/coordinates.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace wormdrive {

namespace {

template <class Value>
constexpr bool is_number = std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>;

/// Calls visit(optional effect, field) for the field of those names.
template <class Catalogue, class Visit>
void with_field(Catalogue& effects, std::string_view effect, std::string_view field, Visit&& visit) {
  bool found = false;
  effects.for_each([&](auto& optional) {
    using E = typename std::remove_cvref_t<decltype(optional)>::value_type;
    if (E::id != effect) return;
    for_each_field<E>([&](const auto& f) {
      if constexpr (is_number<std::remove_cvref_t<decltype(std::declval<E&>().*f.member)>>)
        if (!found && f.name == field) {
          found = true;
          visit(optional, f);
        }
    });
  });
  if (!found)
    throw std::invalid_argument("no effect '" + std::string(effect) + "' with a field '" + std::string(field) + "'");
}

constexpr std::string_view phase = "phase";

/// Where a catalogue keeps a field; an effect that is off is switched on, with zeros in its other fields.
template <class Catalogue>
double* field_at(Catalogue& effects, std::string_view effect, std::string_view field) {
  double* place = nullptr;
  with_field(effects, effect, field, [&](auto& optional, const auto& f) {
    if (!optional) optional.emplace();
    auto& value = (*optional).*f.member;
    if constexpr (requires { value.has_value(); })
      place = &(value ? *value : value.emplace(0.0));
    else
      place = &value;
  });
  return place;
}

template <class Catalogue>
double* phase_at(Catalogue& effects, const Coordinate& c) {
  return c.form == CoordinateForm::in_phase ? field_at(effects, c.effect, phase) : nullptr;
}

/// Gives a field, and its phase, the first of the values, or the first two.
void move(CoordinateForm form, double* field, double* phase_of_it, std::span<const double> values) {
  switch (form) {
    case CoordinateForm::plain: *field = values[0]; break;
    case CoordinateForm::inverse: *field = 1.0 / values[0]; break;
    case CoordinateForm::in_phase:
      *field = std::hypot(values[0], values[1]);
      *phase_of_it = std::atan2(values[1], values[0]);
      break;
    case CoordinateForm::in_quadrature: break;  // done with its neighbour
  }
}

}  // namespace

template <class Catalogue>
FieldOfEffect field_of(const Catalogue& effects, std::string_view effect, std::string_view field) {
  FieldOfEffect found;
  with_field(effects, effect, field, [&](const auto& optional, const auto& f) {
    found = {optional.has_value(), 0.0, f.unit, f.bounds};
    if (!optional) return;
    const auto& value = (*optional).*f.member;
    if constexpr (requires { value.has_value(); })
      found.value = value.value_or(0.0);
    else
      found.value = value;
  });
  return found;
}

template <class Catalogue>
void set_field(Catalogue& effects, const FieldValue& to) {
  *field_at(effects, to.effect, to.field) = to.value;
}

template <class Catalogue>
void switch_off(Catalogue& effects, std::string_view id) {
  effects.for_each([&]<class E>(std::optional<E>& optional) {
    if (E::id == id) optional.reset();
  });
}

template <class Catalogue>
void apply(Catalogue& effects, std::span<const Coordinate> coordinates, std::span<const double> values) {
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const Coordinate& c = coordinates[k];
    move(c.form, field_at(effects, c.effect, c.field), phase_at(effects, c), values.subspan(k));
  }
}

MovedEffects::MovedEffects(const Effects<double>& start, std::span<const Coordinate> coordinates) : effects_(start) {
  for (const Coordinate& c : coordinates)
    places_.push_back({c.form, field_at(effects_, c.effect, c.field), phase_at(effects_, c)});
}

const Effects<double>& MovedEffects::operator()(std::span<const double> values) {
  for (std::size_t k = 0; k < places_.size(); ++k)
    move(places_[k].form, places_[k].field, places_[k].phase, values.subspan(k));
  return effects_;
}

template FieldOfEffect field_of(const Effects<double>&, std::string_view, std::string_view);
template FieldOfEffect field_of(const RecordedDrive&, std::string_view, std::string_view);
template void set_field(Effects<double>&, const FieldValue&);
template void set_field(RecordedDrive&, const FieldValue&);
template void switch_off(Effects<double>&, std::string_view);
template void switch_off(RecordedDrive&, std::string_view);
template void apply(Effects<double>&, std::span<const Coordinate>, std::span<const double>);
template void apply(RecordedDrive&, std::span<const Coordinate>, std::span<const double>);

double coordinate_value(const Effects<double>& effects, const Coordinate& c) {
  const double value = field_of(effects, c.effect, c.field).value;
  switch (c.form) {
    case CoordinateForm::plain: return value;
    case CoordinateForm::inverse: return 1.0 / value;
    case CoordinateForm::in_phase: return value * std::cos(field_of(effects, c.effect, phase).value);
    case CoordinateForm::in_quadrature: return value * std::sin(field_of(effects, c.effect, phase).value);
  }
  return value;
}

std::vector<std::string_view> fields_of(const Coordinate& c) {
  switch (c.form) {
    case CoordinateForm::plain:
    case CoordinateForm::inverse: return {c.field};
    case CoordinateForm::in_phase: return {c.field, phase};
    case CoordinateForm::in_quadrature: return {};
  }
  return {};
}

}  // namespace wormdrive
