#include "fmu/fmi2_component.h"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// Messages of the FMU belong to the standard error.
void logMessage(fmi2::Environment /*environment*/, fmi2::String instance, fmi2::Status status,
                fmi2::String /*category*/, fmi2::String message, ...) {
  if (status < fmi2::warning) return;
  std::va_list values;
  va_start(values, message);
  std::fprintf(stderr, "%s: ", instance ? instance : "FMU");
  std::vfprintf(stderr, message, values);
  std::fprintf(stderr, "\n");
  va_end(values);
}

const fmi2::Callbacks kCallbacks{logMessage, std::calloc, std::free, nullptr, nullptr};

}  // namespace

Fmi2Component::Fmi2Component(const FmuToRun& fmu, fmi2::Type type) : fmu_(fmu) {
  const std::string resources = "file://" + fmu.resources;
  component_ = fmu.library.function<fmi2::Instantiate>("fmi2Instantiate")(
      "FMU", type, fmu.description.token.c_str(), resources.c_str(), &kCallbacks, 0, 0);
  if (!component_) throw DataError("fmi2Instantiate failed");
}

Fmi2Component::~Fmi2Component() {
  fmu_.library.function<fmi2::FreeInstance>("fmi2FreeInstance")(component_);
}

void Fmi2Component::require(const char* name, fmi2::Status status) {
  if (status > fmi2::warning) throw DataError(std::string(name) + " failed");
}

void Fmi2Component::set(unsigned int reference, double value) {
  call<fmi2::SetReal>("fmi2SetReal", &reference, std::size_t{1}, &value);
}

double Fmi2Component::get(unsigned int reference) {
  double value = 0;
  call<fmi2::GetReal>("fmi2GetReal", &reference, std::size_t{1}, &value);
  return value;
}

void Fmi2Component::initialise() {
  call<fmi2::Enter>("fmi2EnterInitializationMode");
  call<fmi2::Enter>("fmi2ExitInitializationMode");
}

}  // namespace uncertainty_identification
