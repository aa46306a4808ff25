#include <cmath>
#include <limits>

#include "fmu/fmi2_component.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Reals = std::vector<double>;

/// Integrates the FMU's differential equations by Runge and Kutta's method of the fourth order with
/// a fixed step. Events act at the end of the step in which they occur.
class ModelExchange2 : public Fmi2Component {
 public:
  explicit ModelExchange2(const FmuToRun& fmu)
      : Fmi2Component(fmu, fmi2::model_exchange),
        states_(static_cast<std::size_t>(fmu.description.states)),
        indicators_(static_cast<std::size_t>(fmu.description.event_indicators)) {
    call<fmi2::SetupExperiment>("fmi2SetupExperiment", 0, 0.0, 0.0, 0, 0.0);
  }

  void initialise() override {
    Fmi2Component::initialise();
    handleEvents();
  }

  void step(double time, double length) override {
    const double part = length / fmu_.steps_per_sample;
    for (int k = 0; k < fmu_.steps_per_sample; ++k) {
      integrate(time + k * part, part);
      if (hasEvent(time + (k + 1) * part)) {
        call<fmi2::Enter>("fmi2EnterEventMode");
        handleEvents();
      }
    }
  }

 private:
  Reals reals(const char* name, std::size_t count) {
    Reals values(count);
    if (count > 0) call<fmi2::GetReals>(name, values.data(), count);
    return values;
  }

  Reals states() { return reals("fmi2GetContinuousStates", states_); }

  /// Goes to a time and a state.
  void moveTo(double time, const Reals& states) {
    call<fmi2::SetTime>("fmi2SetTime", time);
    if (states_ > 0) call<fmi2::SetStates>("fmi2SetContinuousStates", states.data(), states.size());
  }

  Reals slopeAt(double time, const Reals& states) {
    moveTo(time, states);
    return reals("fmi2GetDerivatives", states_);
  }

  static Reals stepped(const Reals& from, double length, const Reals& slope) {
    Reals to = from;
    for (std::size_t k = 0; k < to.size(); ++k) to[k] += length * slope[k];
    return to;
  }

  void integrate(double time, double length) {
    const Reals from = states();
    const Reals first = slopeAt(time, from);
    const Reals second = slopeAt(time + length / 2, stepped(from, length / 2, first));
    const Reals third = slopeAt(time + length / 2, stepped(from, length / 2, second));
    const Reals fourth = slopeAt(time + length, stepped(from, length, third));
    Reals mean = first;
    for (std::size_t k = 0; k < mean.size(); ++k)
      mean[k] = (first[k] + 2 * second[k] + 2 * third[k] + fourth[k]) / 6;
    moveTo(time + length, stepped(from, length, mean));
  }

  /// Whether an indicator changed its sign, the time of an event has come, or the FMU says so.
  bool hasEvent(double time) {
    fmi2::Boolean enter = 0, terminate = 0;
    call<fmi2::CompletedIntegratorStep>("fmi2CompletedIntegratorStep", 1, &enter, &terminate);
    if (terminate) throw DataError("the FMU ends the simulation (terminateSimulation)");
    const Reals now = reals("fmi2GetEventIndicators", indicators_);
    bool crossed = false;
    for (std::size_t k = 0; k < now.size(); ++k)
      crossed = crossed || (now[k] > 0) != (indicators_at_[k] > 0);
    return enter || crossed || time >= next_event_ - 1e-12;
  }

  void handleEvents() {
    constexpr int kMost = 100;
    fmi2::EventInfo info{1, 0, 0, 0, 0, 0};
    for (int k = 0; info.new_discrete_states_needed && k < kMost; ++k) {
      call<fmi2::NewDiscreteStates>("fmi2NewDiscreteStates", &info);
      if (info.terminate_simulation)
        throw DataError("the FMU ends the simulation (terminateSimulation)");
    }
    next_event_ = info.next_event_time_defined ? info.next_event_time
                                               : std::numeric_limits<double>::infinity();
    call<fmi2::Enter>("fmi2EnterContinuousTimeMode");
    indicators_at_ = reals("fmi2GetEventIndicators", indicators_);
  }

  const std::size_t states_, indicators_;
  double next_event_ = 0;
  Reals indicators_at_;
};

}  // namespace

std::unique_ptr<FmuInstance> makeModelExchange2(const FmuToRun& fmu) {
  return std::make_unique<ModelExchange2>(fmu);
}

}  // namespace uncertainty_identification
