#include "support/effect_setup.h"

#include <cmath>
#include <random>

#include "support/core_setup.h"

namespace uncertainty_identification::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Experiment> recordedForEffects() {
  constexpr int kExperiments = 11;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all;
  for (int r = 0; r < kExperiments; ++r) {
    Experiment experiment;
    const int samples = 35 + (7 * r) % 16;
    experiment.id = "recorded_" + std::to_string(r);
    experiment.sample_time = 0.5;
    experiment.u = experiment.y = experiment.stamp_offset = VectorXd::Zero(samples);
    VectorXd flow(samples);
    double x = 0;
    for (int t = 0; t < samples; ++t) {
      experiment.y[t] = x + 0.3 * normal(engine);
      experiment.u[t] = 2 * normal(engine);
      experiment.stamp_offset[t] = 0.05 * normal(engine);
      flow[t] = normal(engine);
      x = 0.7 * x + (0.9 + 0.02 * r) * experiment.u[t];
    }
    experiment.scalars["temp"] = 20 + 3 * normal(engine);
    experiment.signals["flow"] = flow;
    all.push_back(std::move(experiment));
  }
  return all;
}

Configuration effectConfiguration() {
  Configuration configuration = atRest(1, 1, 1, 1, 1);
  configuration.error_model.taps = 3;
  configuration.error_model.components = 2;
  configuration.estimation.noise_start = NoiseStart::stationary;
  return configuration;
}

EffectSetup::EffectSetup(const Configuration& configuration, std::vector<Experiment> experiments)
    : experiments_(std::move(experiments)),
      blocks_(makeBlocks(experiments_)),
      options_(configuration.estimation),
      nominal_(makeNominalModel(configuration.nominal_model, experiments_.front().sample_time)),
      basis_(configuration.error_model),
      summary_(summarise(experiments_)),
      linear_(std::make_unique<LinearModel>(nominal_, basis_, options_)) {
  summary_.regressors = basis_.dimension();
  summary_.plant_parameters = plantParameters(
      *nominal_, nominal_->fromUnbounded(VectorXd::Constant(nominal_->parameterCount(), 0.1)));
  all_ = catalogue(summary_);
}

std::unique_ptr<ExtendedModel> EffectSetup::extendedBy(const Effects& effects) const {
  return std::make_unique<ExtendedModel>(nominal_, basis_, options_, effects, summary_,
                                         static_cast<int>(experiments_.size()));
}

std::unique_ptr<ExtendedModel> EffectSetup::extended(
    const std::vector<std::pair<std::string, std::string>>& effects) const {
  Effects found;
  for (const auto& [name, variant] : effects) found.push_back(findEffect(all_, name, variant));
  return extendedBy(found);
}

ModelParameters EffectSetup::at(const VectorXd& psi) const {
  const Index own = linear_->parameterCount(), n = basis_.dimension();
  ModelParameters at;
  at.parameters = VectorXd::Constant(own + psi.size(), 0.2);
  const VectorXd theta = vectorOf({0.9, -0.6, 0.3, -0.4});
  at.parameters.head(std::min<Index>(nominal_->parameterCount(), 4)) =
      theta.head(std::min<Index>(nominal_->parameterCount(), 4));
  at.parameters.tail(psi.size()) = psi;
  const MatrixXd unit = MatrixXd::Identity(n, n);
  at.mixture = {{0.4, 0.6},
                {VectorXd::Constant(n, 0.2), VectorXd::Constant(n, -0.15)},
                {0.01 * unit, 0.02 * unit}};
  at.noise_variance = 0.2;
  return at;
}

VectorXd EffectSetup::logLikelihoods(const LinearModel& model, const ModelParameters& at) const {
  const Likelihood likelihood(model, blocks_, static_cast<int>(experiments_.size()), 1);
  return likelihood.expect(likelihood.statistics(at.parameters, false), at).log_likelihood;
}

std::vector<VectorXd> EffectSetup::simulated(const ExtendedModel& model, const VectorXd& parameters,
                                             const MatrixXd& xi) const {
  std::vector<VectorXd> all(experiments_.size());
  const MatrixXd given =
      xi.size() > 0 ? xi
                    : MatrixXd::Zero(basis_.dimension(), static_cast<Index>(experiments_.size()));
  for (const Block& block : blocks_) {
    const Signals expected = model.simulated(block, parameters, given).expected();
    for (int lane = 0; lane < block.lanes; ++lane)
      all[static_cast<std::size_t>(block.index[static_cast<std::size_t>(lane)])] =
          expected.row(lane).head(block.lengths[static_cast<std::size_t>(lane)]).transpose();
  }
  return all;
}

namespace {

/// Neutral and noticeable parameters of each effect.
using Values = std::pair<std::vector<double>, std::vector<double>>;

const std::map<std::string, Values>& known() {
  static const std::map<std::string, Values> all{
      {"act_backlash", {{0}, {0.6}}},
      {"act_deadzone", {{0}, {0.5}}},
      {"act_delay", {{0}, {1.3}}},
      {"act_hammerstein", {{0, 0}, {0.1, -0.02}}},
      {"act_loss", {{0, 8}, {0.4, 7.2}}},
      {"act_offset", {{0}, {0.3}}},
      {"act_quantisation", {{2.5e-6}, {1.1}}},
      {"act_quantisation (shifted)", {{2.5e-6, 0}, {1.1, 0.3}}},
      {"act_ratelimit", {{150}, {1.2}}},
      {"act_saturation", {{150}, {1.7}}},
      {"exp_clock", {{-14}, {1}}},
      {"exp_input2", {{0, 0.5}, {0.4, 0.6}}},
      {"exp_jitter", {{0}, {0.8}}},
      {"noise_colour", {{0, 0}, {0.3, -0.2}}},
      {"noise_hetero", {{0}, {0.4}}},
      {"noise_step", {{1, 9}, {1.6, 9.3}}},
      {"plant_aging", {{0, 0}, {0.2, -0.3}}},
      {"plant_coulomb", {{0, 0.5}, {0.3, 0.5}}},
      {"plant_cubic", {{0}, {0.01}}},
      {"plant_drift", {{0}, {0.3}}},
      {"plant_init", {{-14}, {2}}},
      {"plant_parameter_spread", {{-14}, {-2}}},
      {"plant_pole", {{0}, {0.3}}},
      {"plant_resonance", {{0.9, 2, 0, 0}, {0.9, 2, 0.1, -0.05}}},
      {"plant_temp", {{0}, {0.3}}},
      {"sens_bias", {{0}, {0.4}}},
      {"sens_bias (per_experiment)", {{-14}, {1}}},
      {"sens_clip", {{200}, {2.5}}},
      {"sens_drift", {{0}, {0.5}}},
      {"sens_drift (per_experiment)", {{-14}, {1}}},
      {"sens_hum", {{0, 0, 1.5}, {0.3, 0.2, 1.5}}},
      {"sens_hum (per_experiment)", {{-14, 1.5}, {1, 1.5}}},
      {"sens_lag", {{0}, {0.4}}},
      {"sens_wiener", {{0, 0}, {0.05, 0.01}}}};
  return all;
}

const Values& of(const Effect& effect) {
  const auto with_variant = known().find(effect.label());
  return with_variant != known().end() ? with_variant->second : known().at(effect.name());
}

VectorXd asVector(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

}  // namespace

VectorXd neutral(const Effect& effect) { return asVector(of(effect).first); }
VectorXd noticeable(const Effect& effect) { return asVector(of(effect).second); }

}  // namespace uncertainty_identification::test
