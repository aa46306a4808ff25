#include "fmu/fmi2_component.h"
#include "fmu/fmi3_api.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class CoSimulation2 : public Fmi2Component {
 public:
  explicit CoSimulation2(const FmuToRun& fmu) : Fmi2Component(fmu, fmi2::co_simulation) {
    call<fmi2::SetupExperiment>("fmi2SetupExperiment", 0, 0.0, 0.0, 0, 0.0);
  }

  void step(double time, double length) override {
    call<fmi2::DoStep>("fmi2DoStep", time, length, 1);
  }
};

void logMessage3(fmi3::Environment /*environment*/, fmi3::Status status, fmi3::String /*category*/,
                 fmi3::String message) {
  if (status >= fmi3::warning) std::fprintf(stderr, "FMU: %s\n", message ? message : "");
}

class CoSimulation3 : public FmuInstance {
 public:
  explicit CoSimulation3(const FmuToRun& fmu) : fmu_(fmu) {
    const std::string resources = fmu.resources + "/";
    instance_ = fmu.library.function<fmi3::InstantiateCoSimulation>("fmi3InstantiateCoSimulation")(
        "FMU", fmu.description.token.c_str(), resources.c_str(), false, false, false, false,
        nullptr, 0, nullptr, logMessage3, nullptr);
    if (!instance_) throw DataError("fmi3InstantiateCoSimulation failed");
  }

  ~CoSimulation3() override {
    fmu_.library.function<fmi3::FreeInstance>("fmi3FreeInstance")(instance_);
  }

  void set(unsigned int reference, double value) override {
    call<fmi3::SetFloat64>("fmi3SetFloat64", &reference, std::size_t{1}, &value, std::size_t{1});
  }

  double get(unsigned int reference) override {
    double value = 0;
    call<fmi3::GetFloat64>("fmi3GetFloat64", &reference, std::size_t{1}, &value, std::size_t{1});
    return value;
  }

  void initialise() override {
    call<fmi3::EnterInitializationMode>("fmi3EnterInitializationMode", false, 0.0, 0.0, false, 0.0);
    call<fmi3::Enter>("fmi3ExitInitializationMode");
  }

  void step(double time, double length) override {
    bool event_needed = false, terminate = false, early_return = false;
    double last_time = time + length;
    call<fmi3::DoStep>("fmi3DoStep", time, length, true, &event_needed, &terminate, &early_return,
                       &last_time);
    if (terminate) throw DataError("the FMU ends the simulation (terminateSimulation)");
  }

 private:
  template <class Function, class... Arguments>
  void call(const char* name, Arguments... arguments) {
    const fmi3::Status status = fmu_.library.function<Function>(name)(instance_, arguments...);
    if (status > fmi3::warning) throw DataError(std::string(name) + " failed");
  }

  const FmuToRun fmu_;
  fmi3::Instance instance_ = nullptr;
};

}  // namespace

std::unique_ptr<FmuInstance> makeCoSimulation2(const FmuToRun& fmu) {
  return std::make_unique<CoSimulation2>(fmu);
}

std::unique_ptr<FmuInstance> makeCoSimulation3(const FmuToRun& fmu) {
  return std::make_unique<CoSimulation3>(fmu);
}

std::unique_ptr<FmuInstance> makeInstance(const FmuToRun& fmu) {
  switch (fmu.description.kind) {
    case FmuKind::co_simulation_2:
      return makeCoSimulation2(fmu);
    case FmuKind::model_exchange_2:
      return makeModelExchange2(fmu);
    case FmuKind::co_simulation_3:
      break;
  }
  return makeCoSimulation3(fmu);
}

}  // namespace uncertainty_identification
