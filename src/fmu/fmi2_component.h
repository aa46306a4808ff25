#pragma once

#include <vector>

#include "fmu/fmi2_api.h"
#include "fmu/fmu_instance.h"

namespace uncertainty_identification {

/// What co-simulation and model exchange of FMI 2.0 share.
class Fmi2Component : public FmuInstance {
 public:
  Fmi2Component(const FmuToRun& fmu, fmi2::Type type);
  ~Fmi2Component() override;

  void set(unsigned int reference, double value) override;
  double get(unsigned int reference) override;
  void initialise() override;

 protected:
  /// Calls a function of the FMU. Throws DataError where it answers with an error.
  template <class Function, class... Arguments>
  void call(const char* name, Arguments... arguments) {
    require(name, fmu_.library.function<Function>(name)(component_, arguments...));
  }

  const FmuToRun fmu_;

 private:
  static void require(const char* name, fmi2::Status status);

  fmi2::Component component_ = nullptr;
};

}  // namespace uncertainty_identification
