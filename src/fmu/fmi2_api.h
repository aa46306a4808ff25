#pragma once

#include <cstddef>

/// What this package calls of the C interface of FMI 2.0 (fmi-standard.org): types and functions as
/// an FMU exports them, without the prefix fmi2.
namespace fmi2 {

using Component = void*;
using Environment = void*;
using Reference = unsigned int;
using Real = double;
using Boolean = int;
using String = const char*;

enum Status { ok, warning, discard, error, fatal, pending };
enum Type { model_exchange, co_simulation };

struct Callbacks {
  void (*logger)(Environment, String instance, Status, String category, String message, ...);
  void* (*allocate)(std::size_t count, std::size_t size);
  void (*release)(void*);
  void (*step_finished)(Environment, Status);
  Environment environment;
};

struct EventInfo {
  Boolean new_discrete_states_needed;
  Boolean terminate_simulation;
  Boolean nominals_changed;
  Boolean states_changed;
  Boolean next_event_time_defined;
  Real next_event_time;
};

using Instantiate = Component(String name, Type, String guid, String resources, const Callbacks*,
                              Boolean visible, Boolean logging);
using FreeInstance = void(Component);
using SetupExperiment = Status(Component, Boolean has_tolerance, Real tolerance, Real start,
                               Boolean has_stop, Real stop);
using Enter = Status(Component);  ///< EnterInitializationMode and others without arguments
using SetReal = Status(Component, const Reference[], std::size_t, const Real[]);
using GetReal = Status(Component, const Reference[], std::size_t, Real[]);
using DoStep = Status(Component, Real time, Real step, Boolean no_earlier_state);
using NewDiscreteStates = Status(Component, EventInfo*);
using CompletedIntegratorStep = Status(Component, Boolean no_earlier_state, Boolean* enter_events,
                                       Boolean* terminate);
using SetTime = Status(Component, Real);
using SetStates = Status(Component, const Real[], std::size_t);
using GetReals = Status(Component, Real[], std::size_t);  ///< states, derivatives, indicators

}  // namespace fmi2
