#pragma once

#include <cstddef>

/// What this package calls of the C interface of FMI 3.0 (fmi-standard.org): types and functions as
/// an FMU exports them, without the prefix fmi3.
namespace fmi3 {

using Instance = void*;
using Environment = void*;
using Reference = unsigned int;
using Float64 = double;
using Boolean = bool;
using String = const char*;

enum Status { ok, warning, discard, error, fatal };

using Logger = void (*)(Environment, Status, String category, String message);
using IntermediateUpdate = void (*)(Environment, Float64 time, Boolean set_requested,
                                    Boolean get_allowed, Boolean step_finished,
                                    Boolean can_return_early, Boolean* early_return_requested,
                                    Float64* early_return_time);

using InstantiateCoSimulation = Instance(String name, String token, String resources,
                                         Boolean visible, Boolean logging, Boolean event_mode,
                                         Boolean early_return, const Reference required[],
                                         std::size_t, Environment, Logger, IntermediateUpdate);
using FreeInstance = void(Instance);
using EnterInitializationMode = Status(Instance, Boolean has_tolerance, Float64 tolerance,
                                       Float64 start, Boolean has_stop, Float64 stop);
using Enter = Status(Instance);  ///< ExitInitializationMode and others without arguments
using SetFloat64 = Status(Instance, const Reference[], std::size_t, const Float64[], std::size_t);
using GetFloat64 = Status(Instance, const Reference[], std::size_t, Float64[], std::size_t);
using DoStep = Status(Instance, Float64 time, Float64 step, Boolean no_earlier_state,
                      Boolean* event_needed, Boolean* terminate, Boolean* early_return,
                      Float64* last_time);

}  // namespace fmi3
