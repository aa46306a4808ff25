#include "explanation/base_model.h"

#include <algorithm>

#include "configuration/require.h"
#include "curves/curve_words.h"
#include "identification/own_levels.h"
#include "model/sensitivity.h"
#include "uncertainty_identification/effects/catalogue.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

namespace {

void requireKnown(const std::vector<std::string>& excluded,
                  const std::vector<Experiment>& experiments) {
  for (const std::string& name : excluded) {
    const std::string nearest = nearestEffect(name, summarise(experiments));
    if (nearest == name || isCurveCause(name)) continue;
    throw ConfigurationError("explanation.exclude: found " + name +
                             "; the catalogue has no such effect, the nearest is " + nearest);
  }
}

}  // namespace

void requireExplainable(const Configuration& configuration,
                        const std::vector<Experiment>& experiments) {
  configuration.validate();
  require(!variesParameters(configuration.error_model.basis), "error_model.basis",
          nameOf(configuration.error_model.basis),
          "fir, laguerre or kautz: explain looks for parameters that vary by itself");
  requireKnown(configuration.explanation.exclude, experiments);
}

Configuration ofBaseModel(Configuration configuration) {
  if (configuration.error_model.basis == BasisKind::automatic)
    configuration.error_model.basis = BasisKind::fir;
  InitialState& start = configuration.estimation.initial_state;
  if (start == InitialState::automatic) start = InitialState::estimate;
  configuration.estimation.thinning = 1;  // long records are thinned for all steps together
  NominalModelOptions& nominal = configuration.nominal_model;
  if (nominal.orders_auto && nominal.focus == Focus::simulation) nominal.fit = PlantFit::simulation;
  return configuration;
}

Offsets offsetsOfBaseModel(const Configuration& asked, const std::vector<Experiment>& experiments) {
  constexpr std::size_t kFewest = 4;  // of which one is held out
  const Offsets offsets = asked.estimation.offsets;
  if (offsets != Offsets::automatic) return offsets;
  const bool is_open = asked.nominal_model.orders_auto && experiments.size() >= kFewest;
  return is_open && levelsDiffer(experiments) ? Offsets::automatic : Offsets::estimate;
}

}  // namespace uncertainty_identification
