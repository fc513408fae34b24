#pragma once
#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/effects.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "core/initial_state.hpp"
#include "core/load.hpp"
#include "core/mesh.hpp"
#include "core/signal.hpp"
#include "core/unit.hpp"
#include "core/worm_drive.hpp"

namespace wormdrive {

/// A parameter of a drive by the names that scenarios give it, with its value in SI.
struct Parameter {
  std::string_view table;  ///< an effect's id, "mesh" or "initial"
  std::string_view field;  ///< the key without its unit
  Unit unit;               ///< at the edge of the program; value and derivatives are in SI
  double value;
};

/// Everything that a rigid drive is made of: what its parameters are read from, and what carries their derivatives.
struct RigidDrive {
  GearMesh<double> mesh;
  LoadSum load;
  Effects<double> effects;
  Signal motor;
  InitialState<double> initial{};
};

/// The parameters of a mesh.
template <class T>
MeshParameters<T> stated(const GearMesh<T>& mesh) {
  return {mesh.i, mesh.lambda, mesh.phi_n, mesh.lw, mesh.lg, mesh.mu, mesh.Jw, mesh.Jg};
}

/// Calls visit(table, parameters) for every parameter struct of a drive: initial state, mesh, effects that are on.
template <class Visit>
void for_each_table(const RigidDrive& drive, Visit&& visit) {
  visit(std::string_view("initial"), drive.initial);
  const std::string_view mesh = "mesh";
  if (drive.mesh.has_teeth)
    visit(mesh, stated(drive.mesh));
  else
    visit(mesh, SingleInertia<double>{drive.mesh.Jg});
  drive.effects.for_each([&]<class E>(const std::optional<E>& effect) {
    if (effect) visit(E::id, *effect);
  });
}

/// Whether a state can have a derivative by a field: not by a number of things, an order or a choice.
template <class Owner, class Value>
constexpr bool continuous(const Field<Owner, Value>& field) {
  return !field.unit.whole;
}

/// Every parameter by which the motion has a derivative: of the initial state, of the mesh and of the effects that are
/// on, where it is stated. Throws std::invalid_argument where the teeth are elastic, for such a drive is not rigid.
inline std::vector<Parameter> continuous_parameters(const RigidDrive& drive) {
  if (has_elastic_teeth(drive.effects)) throw std::invalid_argument("a drive with elastic teeth is not rigid");
  std::vector<Parameter> all;
  for_each_table(drive, [&]<class P>(std::string_view table, const P& parameters) {
    for_each_field<P>([&](const auto& field) {
      const auto& stated = parameters.*field.member;
      using Value = std::remove_cvref_t<decltype(stated)>;
      if constexpr (std::is_same_v<Value, double>) {
        if (continuous(field)) all.push_back({table, field.name, field.unit, stated});
      } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
        if (continuous(field) && stated) all.push_back({table, field.name, field.unit, *stated});
      }
    });
  });
  return all;
}

/// One of them by its names. Throws std::invalid_argument where the drive has none of that name.
inline Parameter parameter(const RigidDrive& drive, std::string_view table, std::string_view field) {
  for (const Parameter& p : continuous_parameters(drive))
    if (p.table == table && p.field == field) return p;
  throw std::invalid_argument("the drive has no continuous parameter '" + std::string(field) + "' in '" +
                              std::string(table) + "'; an effect has to be on");
}

/// A parameter struct with another scalar: value(table, field, x) gives what a field holds for its present x.
template <class T, template <class> class P, class Value>
P<T> converted(const P<double>& stated, std::string_view table, Value&& value) {
  P<T> made;
  const auto convert = [&]<class From, class To>(const Field<P<double>, From>& from, const Field<P<T>, To>& to) {
    if constexpr (std::is_same_v<From, double>)
      made.*to.member = value(table, from.name, stated.*from.member);
    else if (stated.*from.member)  // may be absent
      made.*to.member = value(table, from.name, *(stated.*from.member));
  };
  const auto from = P<double>::fields();
  const auto to = P<T>::fields();
  [&]<std::size_t... I>(std::index_sequence<I...>) { (convert(std::get<I>(from), std::get<I>(to)), ...); }
  (std::make_index_sequence<std::tuple_size_v<decltype(from)>>());
  if constexpr (requires { made.take_table(stated); }) made.take_table(stated);
  return made;
}

template <class T, class Value>
GearMesh<T> converted(const GearMesh<double>& mesh, Value&& value) {
  if (mesh.has_teeth) return GearMesh<T>(converted<T>(stated(mesh), "mesh", value));
  return GearMesh<T>::without_teeth(converted<T>(SingleInertia<double>{mesh.Jg}, "mesh", value).J);
}

template <class T, class Value>
Effects<T> converted(const Effects<double>& effects, Value&& value) {
  Effects<T> made;
  const auto convert = [&]<class E, class F>(const std::optional<E>& effect, std::optional<F>& target) {
    if (effect) target = converted<T>(*effect, E::id, value);
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (convert(std::get<I>(effects.list), std::get<I>(made.list)), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<EffectList<double>>>());
  return made;
}

/// The drive with other values of some of its parameters.
inline RigidDrive changed(RigidDrive drive, std::span<const Parameter> to) {
  const auto value = [&](std::string_view table, std::string_view field, double x) {
    const auto found =
        std::find_if(to.begin(), to.end(), [&](const Parameter& p) { return p.table == table && p.field == field; });
    return found == to.end() ? x : found->value;
  };
  drive.mesh = converted<double>(drive.mesh, value);
  drive.effects = converted<double>(drive.effects, value);
  drive.initial = converted<double>(drive.initial, "initial", value);
  return drive;
}

/// A drive and its initial state that carry the derivatives by some of the parameters; T is a ceres::Jet of at least as
/// many, and the k-th partial derivative is that by the k-th parameter.
template <class T, bool with_states>
struct SeededDrive {
  WormDrive<T, SummedLoad, with_states> drive;
  InitialState<T> initial;

  SeededDrive(const RigidDrive& stated, std::span<const Parameter> by)
      : SeededDrive(stated, [by](std::string_view table, std::string_view field, double x) {
          for (std::size_t k = 0; k < by.size(); ++k)
            if (by[k].table == table && by[k].field == field) return T(x, static_cast<int>(k));
          return T(x);
        }) {}

 private:
  template <class Seed>
  SeededDrive(const RigidDrive& stated, const Seed& seed)
      : drive(converted<T>(stated.mesh, seed), make_load(stated.load), converted<T>(stated.effects, seed),
              stated.motor),
        initial(converted<T>(stated.initial, "initial", seed)) {}
};

}  // namespace wormdrive
