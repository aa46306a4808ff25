#include "uncertainty_identification/identifier.h"

#include "identification.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

Identifier::Identifier(Configuration configuration) : configuration_(std::move(configuration)) {
  configuration_.validate();
}

Identifier::Identifier(Configuration configuration, NominalModelFactory nominal_model)
    : Identifier(std::move(configuration)) {
  const NominalModelOptions& options = configuration_.nominal_model;
  if (options.orders_auto) {
    throw ConfigurationError(
        "nominal_model.orders: found auto, which chooses among Box-Jenkins models; leave it out "
        "with a model of your own");
  }
  if (options.fit != PlantFit::likelihood) {
    throw ConfigurationError(
        "nominal_model.fit: found simulation, which is for Box-Jenkins models; a model of your "
        "own takes likelihood");
  }
  nominal_model_ = std::move(nominal_model);
}

Estimate Identifier::identify(const std::vector<Experiment>& experiments,
                              const std::vector<Experiment>& validation,
                              const ProgressCallback& progress) const {
  return Identification(configuration_, nominal_model_, progress)
      .run(experiments, validation, nullptr);
}

Estimate Identifier::reidentify(const Estimate& previous,
                                const std::vector<Experiment>& experiments,
                                const ProgressCallback& progress) const {
  if (!previous.usable()) return identify(experiments, {}, progress);
  return Identification(previous.configuration, nominal_model_, progress)
      .run(experiments, {}, &previous);
}

}  // namespace uncertainty_identification
