#include <limits>
#include <map>

#include "effects/extended_model.h"
#include "estimation/initial_guess.h"
#include "estimation/selection.h"
#include "identification/identification.h"
#include "uncertainty_identification/errors.h"

/// Where the climb starts, and with how many components.
namespace uncertainty_identification {

using Eigen::VectorXd;

namespace {

/// What an earlier estimate tells of the effects' parameters, as the model keeps them.
void addEffects(const Estimate& previous, const Effects& effects,
                std::map<std::string, double>* values) {
  const auto of = [&](const EffectParameter& parameter, const EffectEstimate& estimate) {
    for (const ParameterEstimate& each : estimate.parameters) {
      if (each.name == parameter.name)
        (*values)[estimate.name + "." + each.name] =
            kept(parameter, each.value, previous.noise_variance.value);
    }
  };
  for (const auto& effect : effects) {
    for (const EffectEstimate& estimate : previous.effects) {
      if (estimate.name != effect->name() || estimate.variant != effect->description().variant)
        continue;
      for (const EffectParameter& parameter : effect->description().parameters)
        of(parameter, estimate);
    }
  }
}

}  // namespace

std::vector<VectorXd> Identification::starts() const {
  const Configuration& configuration = estimate_.configuration;
  const LinearModel plain(nominal_, model_->basis(), configuration.estimation);
  std::vector<VectorXd> all = plant_.has_value()
                                  ? noiseStarts(plain, *plant_, plant_offset_, experiments_)
                                  : nominalStarts(plain, configuration.nominal_model, experiments_);
  for (VectorXd& start : all) start = withEffects(start);
  return all;
}

/// The start with those of the effects' parameters.
VectorXd Identification::withEffects(const VectorXd& start) const {
  const auto* extended = dynamic_cast<const ExtendedModel*>(model_.get());
  if (extended == nullptr) return start;
  const VectorXd psi = startingValues(extended->effects(), estimate_.configuration.effects);
  VectorXd all(start.size() + psi.size());
  all << start, psi;
  return all;
}

bool Identification::isGiven(const Estimate* previous) const {
  return previous != nullptr || estimate_.configuration.initial.theta.size() > 0;
}

/// The start that a previous estimate or the configuration's `initial` gives, for the parameters of
/// `model`.
VectorXd Identification::given(const LinearModel& model, const Estimate* previous) const {
  const Configuration& configuration = estimate_.configuration;
  std::map<std::string, double> values;
  if (previous != nullptr) {
    for (const ParameterEstimate& parameter : previous->nominal_model.parameters)
      values[parameter.name] = parameter.value;
    values["offset_u"] = previous->offset_u;
    values["offset_y"] = previous->offset_y;
    if (const auto* extended = dynamic_cast<const ExtendedModel*>(&model))
      addEffects(*previous, extended->effects(), &values);
  } else {
    const std::vector<std::string> names = nominalModel()->names();
    const VectorXd& theta = configuration.initial.theta;
    if (theta.size() != static_cast<Eigen::Index>(names.size())) {
      std::string all;
      for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
      throw ConfigurationError("initial.theta: the model has " + std::to_string(names.size()) +
                               " parameters (" + all + "), found " + std::to_string(theta.size()));
    }
    for (std::size_t k = 0; k < names.size(); ++k)
      values[names[k]] = theta[static_cast<Eigen::Index>(k)];
    const VectorXd psi = withEffects(VectorXd());
    for (Eigen::Index k = 0; k < psi.size(); ++k)
      values[*(model.names().end() - psi.size() + k)] = psi[k];
  }
  VectorXd at = VectorXd::Zero(model.parameterCount());
  const std::vector<std::string> names = model.names();
  for (std::size_t k = 0; k < names.size(); ++k)
    at[static_cast<Eigen::Index>(k)] = values[names[k]];
  if (!model.admissible(at)) {
    throw ConfigurationError(
        "initial.theta: A, C and D must have their roots inside the unit circle");
  }
  return at;
}

/// A given mixture to start from, with the noise variance that is given or fits it.
ModelParameters Identification::givenMixture(const Mixture& mixture, const VectorXd& at,
                                             const Estimate* previous) const {
  const InitialOptions& initial = estimate_.configuration.initial;
  if (mixture.dimension() != model_->regressors()) {
    throw ConfigurationError("initial.means: the error model has " +
                             std::to_string(model_->regressors()) + " free parameters, found " +
                             std::to_string(mixture.dimension()));
  }
  ModelParameters start{at, mixture, 1.0};
  if (previous != nullptr) {
    start.noise_variance = previous->noise_variance.value;
  } else if (initial.noise_variance.has_value()) {
    start.noise_variance = *initial.noise_variance;
  } else {
    const Statistics statistics = likelihood_->statistics(at, false);
    updateMixture(statistics, likelihood_->expect(statistics, start), ClimbOptions(), &start);
    start.mixture = mixture;
  }
  return start;
}

ModelParameters Identification::start(const Estimate* previous) {
  const Configuration& configuration = estimate_.configuration;
  const std::vector<VectorXd> from =
      isGiven(previous) ? std::vector<VectorXd>{given(*model_, previous)} : starts();
  if (from.empty())
    throw DataError("no start could be found for these orders; give `initial: {theta: [...]}`");
  const Mixture& mixture =
      previous != nullptr ? previous->error_model.mixture : configuration.initial.mixture;
  if (mixture.components() > 0) return givenMixture(mixture, from.front(), previous);

  const ModelParameters single =
      bestSingleComponent(*likelihood_, from, climbOptions("starting values", 0.6, 0.7));
  if (single.mixture.components() == 0 || !model_->admissible(single.parameters)) {
    throw DataError(
        "the likelihood is not finite at any start; check the units and the scale of the data");
  }
  if (configuration.error_model.components == 1) return single;
  ClimbOptions options = climbOptions("starting values", 0.7, 0.75);
  options.floor = covarianceFloor(single.mixture);
  return chooseComponents(single, options);
}

ModelParameters Identification::chooseComponents(const ModelParameters& single,
                                                 const ClimbOptions& options) {
  ErrorModelOptions& error_model = estimate_.configuration.error_model;
  const bool automatic = error_model.components == kAutomatic;
  const int first = automatic ? 1 : error_model.components;
  const int last =
      automatic ? std::min(error_model.max_components, estimate_.experiment_count / 4) : first;
  const Statistics statistics = likelihood_->statistics(single.parameters, false);
  ModelParameters best = single;
  double lowest = std::numeric_limits<double>::infinity();
  std::size_t chosen = 0;
  for (int components = first; components <= std::max(last, first); ++components) {
    double reached = 0;
    const ModelParameters at = spreadComponents(
        *likelihood_, statistics, single, components, estimate_.configuration.estimation.restarts,
        estimate_.configuration.estimation.seed, options, &reached);
    const int mixture = mixtureParameters(error_model.constraint, model_->regressors(), components);
    const double criterion = bic(reached, model_->parameterCount() + 1, mixture,
                                 statistics.samples().sum(), estimate_.experiment_count);
    if (automatic) {
      estimate_.candidates.push_back({"components", "components=" + std::to_string(components),
                                      model_->parameterCount() + 1 + mixture, reached, criterion,
                                      std::numeric_limits<double>::quiet_NaN(), false});
    }
    if (criterion < lowest) {
      lowest = criterion;
      best = at;
      chosen = estimate_.candidates.size() - 1;
    }
  }
  if (automatic) estimate_.candidates[chosen].chosen = true;
  error_model.components = best.mixture.components();
  return best;
}

}  // namespace uncertainty_identification
