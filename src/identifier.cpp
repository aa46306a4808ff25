#include "uncertainty_identification/identifier.h"

#include "identification.h"

namespace uncertainty_identification {

Identifier::Identifier(Configuration configuration) : configuration_(std::move(configuration)) {
  configuration_.validate();
}

Estimate Identifier::identify(const std::vector<Experiment>& experiments, const std::vector<Experiment>& validation,
                              const ProgressCallback& progress) const {
  return Identification(configuration_, progress).run(experiments, validation, nullptr);
}

Estimate Identifier::reidentify(const Estimate& previous, const std::vector<Experiment>& experiments,
                                const ProgressCallback& progress) const {
  if (!previous.usable()) return identify(experiments, {}, progress);
  return Identification(previous.configuration, progress).run(experiments, {}, &previous);
}

}  // namespace uncertainty_identification
