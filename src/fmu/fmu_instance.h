#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fmu/fmu_library.h"
#include "fmu/model_description.h"

namespace uncertainty_identification {

/// One simulation by an FMU. Whatever the FMU answers with an error is a DataError that names the
/// function.
class FmuInstance {
 public:
  virtual ~FmuInstance() = default;

  virtual void set(unsigned int reference, double value) = 0;
  virtual double get(unsigned int reference) = 0;

  /// Ends the setting of parameters; time is 0 then.
  virtual void initialise() = 0;

  /// Simulates from `time` to `time + length` [s] with the inputs as they are set.
  virtual void step(double time, double length) = 0;
};

/// What an instance is made of; both must outlive it.
struct FmuToRun {
  const FmuLibrary& library;
  const ModelDescription& description;
  std::string resources;      ///< folder
  int steps_per_sample = 10;  ///< of the integration by Runge and Kutta, of model exchange
};

/// A new instance, of the kind that the description says.
std::unique_ptr<FmuInstance> makeInstance(const FmuToRun& fmu);

// Of the three kinds.
std::unique_ptr<FmuInstance> makeCoSimulation2(const FmuToRun& fmu);
std::unique_ptr<FmuInstance> makeModelExchange2(const FmuToRun& fmu);
std::unique_ptr<FmuInstance> makeCoSimulation3(const FmuToRun& fmu);

}  // namespace uncertainty_identification
