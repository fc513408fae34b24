#pragma once
#include <algorithm>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "bindings/fmi/instance.hpp"

namespace wormdrive {

/// What a call amounts to; fmi2Status and fmi3Status have these values.
enum class Status { ok, warning, discard, error, fatal };

/// What an importer's pointer to an instance points to: the instance and its importer's log.
struct Component {
  /// log(status, category, text)
  using Log = std::function<void(Status, const char*, const std::string&)>;
  Log log;
  FmuInstance instance;
  bool silent = false;  ///< the importer has switched messages off

  void tell(Status status, const std::string& text) const {
    if (log && !silent) log(status, log_categories[status == Status::discard ? 0 : 1].data(), text);
  }
};

/// Throws where an importer passes no place for what it wants, or no values.
inline void need(const void* pointer, const char* what) {
  if (!pointer) throw std::invalid_argument(std::string(what) + " is a null pointer");
}
inline void need_list(const void* list, std::size_t count, const char* what) {
  if (count > 0) need(list, what);
}
inline void need_count(std::size_t count, std::size_t wanted, const char* what) {
  if (count != wanted) throw std::invalid_argument(fmt::format("{} {} where there are {}", count, what, wanted));
}

/// Calls use(instance) where its phase allows the function; no exception passes the C interface, each becomes a status
/// with its text in the log, and changes nothing.
template <class Use>
Status call(void* pointer, const char* function, Phases allowed, Use&& use) {
  if (!pointer) return Status::error;
  Component& component = *static_cast<Component*>(pointer);
  try {
    const Phase phase = component.instance.phase();
    if (!allowed.contain(phase))
      throw std::logic_error(fmt::format("{} must not be called {}", function, describe(phase)));
    use(component.instance);
    return Status::ok;
  } catch (const StepHalted& halt) {
    component.tell(Status::discard, halt.what());
    return Status::discard;
  } catch (const std::exception& fault) {
    component.tell(Status::error, fault.what());
    return Status::error;
  }
}

/// Says that a function is there for the linker only.
inline Status unsupported(void* pointer, const char* function) {
  return call(pointer, function, whole_life,
              [&](FmuInstance&) { throw std::logic_error(std::string(function) + " is not supported"); });
}

/// Switches messages on or off. Throws where a category is none of those.
inline void switch_messages(Component& component, bool on, std::size_t count, const char* const categories[]) {
  need_list(categories, count, "categories");
  for (std::size_t k = 0; k < count; ++k) {
    need(categories[k], "a category");
    if (std::find(log_categories.begin(), log_categories.end(), categories[k]) == log_categories.end())
      throw std::invalid_argument(fmt::format("there is no category of messages '{}'", categories[k]));
  }
  component.silent = !on;
}

/// The instance of an FMU from the folder of its resources. Throws std::exception.
FmuInstance make_instance(const char* name, const char* token, const char* resources, InterfaceType type);

/// Makes a component; null, with the reason in the log, where that fails.
template <class Kind = Component>
Component* instantiate(const char* name, const char* token, const char* resources, InterfaceType type,
                       Component::Log log) {
  try {
    return new Kind{Component{log, make_instance(name, token, resources, type)}};
  } catch (const std::exception& fault) {
    if (log) log(Status::error, log_categories[1].data(), fault.what());
    return nullptr;
  }
}

// ---- what both versions ask alike -----------------------------------------------------------------------------------

inline Status get_reals(void* c, const char* function, const unsigned references[], std::size_t count,
                        double values[]) {
  return call(c, function, whole_life, [&](FmuInstance& instance) {
    need_list(references, count, "the list of value references");
    need_list(values, count, "the list of values");
    for (std::size_t k = 0; k < count; ++k) values[k] = instance.real(references[k]);
  });
}
inline Status set_reals(void* c, const char* function, const unsigned references[], std::size_t count,
                        const double values[]) {
  return call(c, function, before_run | any_mode, [&](FmuInstance& instance) {
    need_list(references, count, "the list of value references");
    need_list(values, count, "the list of values");
    if (count > 0) instance.set_reals({references, count}, {values, count});
  });
}
inline Status get_integers(void* c, const char* function, const unsigned references[], std::size_t count,
                           int values[]) {
  return call(c, function, whole_life, [&](FmuInstance& instance) {
    need_list(references, count, "the list of value references");
    need_list(values, count, "the list of values");
    for (std::size_t k = 0; k < count; ++k) values[k] = instance.integer(references[k]);
  });
}
inline Status set_integers(void* c, const char* function, const unsigned references[], std::size_t count) {
  return call(c, function, before_run | any_mode, [&](FmuInstance& instance) {
    need_list(references, count, "the list of value references");
    if (count > 0) instance.set_integer(references[0]);
  });
}
/// There are no variables of this type.
inline Status no_variables(void* c, const char* function, std::size_t count) {
  return call(c, function, whole_life, [&](FmuInstance&) {
    if (count > 0) throw std::invalid_argument(fmt::format("{}: there are no variables of this type", function));
  });
}

/// Derivatives of outputs by time, of the first order.
inline Status output_derivatives(void* c, const char* function, const unsigned references[], std::size_t count,
                                 const int orders[], double values[]) {
  return call(
      c, function, Phase::step | Phase::event | Phase::intermediate | Phase::terminated, [&](FmuInstance& instance) {
        need_list(references, count, "the list of value references");
        need_list(orders, count, "the list of orders");
        need_list(values, count, "the list of values");
        for (std::size_t k = 0; k < count; ++k)
          if (orders[k] != 1)
            throw std::invalid_argument(fmt::format("there are no derivatives of order {}, only of 1", orders[k]));
        for (std::size_t k = 0; k < count; ++k) values[k] = instance.output_rate(references[k]);
      });
}

/// Calls add(row, column, derivative) for every one of the Jacobian, with the result set to zero before.
template <class Add>
Status differentiate(void* c, const char* function, std::span<const unsigned> unknowns,
                     std::span<const unsigned> knowns, const double* seed, std::span<double> result, Add&& add) {
  return call(c, function, Phase::initialization | Phase::event | Phase::continuous | Phase::terminated,
              [&](FmuInstance& instance) {
                need_list(unknowns.data(), unknowns.size(), "the list of unknowns");
                need_list(knowns.data(), knowns.size(), "the list of knowns");
                need(seed, "the seed");
                need_list(result.data(), result.size(), "the list of derivatives");
                const std::vector<double> matrix = instance.jacobian(unknowns, knowns);
                std::fill(result.begin(), result.end(), 0.0);
                for (std::size_t row = 0; row < unknowns.size(); ++row)
                  for (std::size_t column = 0; column < knowns.size(); ++column)
                    add(row, column, matrix[row * knowns.size() + column]);
              });
}
/// The Jacobian times a seed of the knowns.
inline Status directional_derivative(void* c, const char* function, std::span<const unsigned> unknowns,
                                     std::span<const unsigned> knowns, const double* seed, double* result) {
  return differentiate(c, function, unknowns, knowns, seed, {result, unknowns.size()},
                       [&](std::size_t row, std::size_t column, double d) { result[row] += d * seed[column]; });
}
/// A seed of the unknowns times the Jacobian.
inline Status adjoint_derivative(void* c, const char* function, std::span<const unsigned> unknowns,
                                 std::span<const unsigned> knowns, const double* seed, double* result) {
  return differentiate(c, function, unknowns, knowns, seed, {result, knowns.size()},
                       [&](std::size_t row, std::size_t column, double d) { result[column] += d * seed[row]; });
}

inline Status keep_state(void* c, const char* function, void** state) {
  return call(c, function, outside_step, [&](FmuInstance& instance) {
    need(state, "the place of the state");
    if (*state)
      *static_cast<FmuInstance::Kept*>(*state) = instance.keep();
    else
      *state = new FmuInstance::Kept(instance.keep());
  });
}
inline Status restore_state(void* c, const char* function, void* state) {
  return call(c, function, outside_step, [&](FmuInstance& instance) {
    need(state, "the state");
    instance.restore(*static_cast<FmuInstance::Kept*>(state));
  });
}
inline Status free_state(void* c, const char* function, void** state) {
  return call(c, function, whole_life, [&](FmuInstance&) {
    if (!state) return;
    delete static_cast<FmuInstance::Kept*>(*state);
    *state = nullptr;
  });
}

inline Status set_states(void* c, const char* function, const double x[], std::size_t count) {
  return call(c, function, Phase::event | Phase::continuous, [&](FmuInstance& instance) {
    need(x, "the list of states");
    instance.with_moved_run([&](auto& run) {
      need_count(count, run.present().size(), "states");
      for (std::size_t k = 0; k < count; ++k)
        if (!std::isfinite(x[k])) throw std::invalid_argument(fmt::format("state {} = {} is not finite", k, x[k]));
      run.set_states(x);
    });
  });
}
/// Copies what list(run) has; what: in the plural.
template <class List>
Status get_list(void* c, const char* function, double values[], std::size_t count, const char* what, List&& list) {
  return call(c, function, Phase::initialization | any_mode | Phase::terminated, [&](FmuInstance& instance) {
    need(values, "the list of values");
    instance.with_moved_run([&](auto& run) {
      const auto found = list(run);
      need_count(count, found.size(), what);
      std::copy(found.begin(), found.end(), values);
    });
  });
}
/// Of numbers that all states of a drive's type have, those of the states that there are.
template <class Run>
std::vector<double> present_of(const Run& run, const typename Run::States& all) {
  std::vector<double> present;
  for (const std::size_t k : run.present()) present.push_back(all[k]);
  return present;
}
inline constexpr auto states_of = [](auto& run) { return present_of(run, run.states()); };
inline constexpr auto rates_of = [](auto& run) { return present_of(run, run.rates()); };
inline constexpr auto indicators_of = [](auto& run) { return run.indicators(); };
/// Angles, speeds, currents and shares are of the order of 1 in SI.
inline constexpr auto nominals_of = [](auto& run) { return std::vector<double>(run.present().size(), 1.0); };

}  // namespace wormdrive
