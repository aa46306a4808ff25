#include "uncertainty_identification/explanation/explanation.h"

#include <Eigen/QR>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <set>
#include <thread>

#include "checks.h"
#include "search.h"
#include "signatures.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/model/sensitivity.h"
#include "uncertainty_identification/require.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::set<std::string>& noiseClass() {
  static const std::set<std::string> all{"noise_colour", "noise_hetero", "noise_tails",
                                         "noise_step", "sens_outliers"};
  return all;
}

/// Experiments to fit to and to measure with.
struct Split {
  std::vector<Experiment> train, held;
};

Split split(const Configuration& configuration, const std::vector<Experiment>& experiments,
            const std::vector<Experiment>& validation) {
  constexpr std::size_t kFewest = 4;
  if (!validation.empty()) return {experiments, validation};
  if (experiments.size() < kFewest) return {experiments, experiments};
  std::vector<std::size_t> order(experiments.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::mt19937_64 random(configuration.estimation.seed);
  for (std::size_t k = order.size() - 1; k > 0; --k) std::swap(order[k], order[random() % (k + 1)]);
  const auto share = configuration.explanation.validation_share;
  const auto held = std::max<std::size_t>(
      1, static_cast<std::size_t>(share * static_cast<double>(experiments.size())));
  const std::set<std::size_t> chosen(order.begin(),
                                     order.begin() + static_cast<std::ptrdiff_t>(held));
  Split parts;
  for (std::size_t k = 0; k < experiments.size(); ++k)
    (chosen.count(k) > 0 ? parts.held : parts.train).push_back(experiments[k]);
  return parts;
}

/// The model of an estimate, ready to be extended.
Fit baseFit(const Estimate& estimate, const FitData& data, const DataSummary& summary) {
  NominalModelOptions options = estimate.configuration.nominal_model;
  options.fit = PlantFit::likelihood;
  const auto nominal = makeNominalModel(options, estimate.nominal_model.sample_time);
  const ErrorBasis basis(estimate.configuration.error_model);
  const auto model = std::make_shared<const ExtendedModel>(
      nominal, basis, estimate.configuration.estimation, Effects(), summary, data.count());
  ModelParameters at{VectorXd::Zero(model->LinearModel::parameterCount()),
                     estimate.error_model.mixture, estimate.noise_variance.value};
  Polynomials p;
  p.delay = estimate.nominal_model.delay;
  p.b = estimate.nominal_model.b;
  p.a = estimate.nominal_model.a;
  p.c = estimate.nominal_model.c;
  p.d = estimate.nominal_model.d;
  const Index own = nominal->parameterCount();
  if (static_cast<Index>(estimate.nominal_model.parameters.size()) == own) {
    for (Index k = 0; k < own; ++k)
      at.parameters[k] = estimate.nominal_model.parameters[static_cast<std::size_t>(k)].value;
  } else {
    at.parameters.head(own) = nominal->fromPolynomials(p);
  }
  if (at.parameters.size() > own)
    at.parameters[own] = options.structure == Structure::continuous || estimate.offset_u == 0
                             ? estimate.offset_y
                             : estimate.offset_u;
  return evaluated(model, at, data);
}

/// Largest peaks of the residual's spectrum, where a hum would start.
void findPeaks(const Residuals& residuals, const FitData& data, DataSummary* summary) {
  constexpr int kRefinement = 4;
  const int samples = summary->samples, points = kRefinement * samples / 2;
  Eigen::ArrayXd common = Eigen::ArrayXd::Zero(points), own = common;
  VectorXd mean = VectorXd::Zero(samples);
  const auto spectrum = [&](const VectorXd& signal) {
    Eigen::ArrayXd power(points);
    for (int i = 0; i < points; ++i) {
      const double frequency = M_PI * i / points;
      double cosine = 0, sine = 0;  // Goertzel's recursion
      const double turn = 2 * std::cos(frequency);
      for (Index t = 0; t < signal.size(); ++t) {
        const double next = signal[t] + turn * cosine - sine;
        sine = cosine;
        cosine = next;
      }
      power[i] = cosine * cosine + sine * sine - turn * cosine * sine;
    }
    return power;
  };
  constexpr int kMostSpectra = 12;
  int spectra = 0;
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Index length = block.lengths[static_cast<std::size_t>(lane)];
      VectorXd signal = residuals.standardised[b].row(lane).head(length).transpose().matrix();
      signal.array() -= signal.mean();
      for (Index t = 0; t < length; ++t)
        signal[t] *= 0.5 - 0.5 * std::cos(2 * M_PI * (static_cast<double>(t) + 0.5) /
                                          static_cast<double>(length));
      mean.head(length) += signal;
      if (spectra++ < kMostSpectra) own += spectrum(signal);
    }
  }
  common = spectrum(mean);
  Index at = 0;
  constexpr int kLowest = 2 * kRefinement;
  if (points <= kLowest) return;
  common.tail(points - kLowest).maxCoeff(&at);
  summary->common_peak = M_PI * static_cast<double>(at + kLowest) / points;
  own.tail(points - kLowest).maxCoeff(&at);
  summary->own_peak = M_PI * static_cast<double>(at + kLowest) / points;
}

/// Standard errors and intervals of an effect's parameters in the final fit.
std::vector<CauseParameter> parametersOf(const Fit& fit, const FitData& data,
                                         const std::shared_ptr<const Effect>& effect) {
  constexpr double kNinety = 1.6449, kDrop = 1.3528;  // normal and likelihood intervals
  const auto& effects = fit.model->effects();
  const auto found = std::find(effects.begin(), effects.end(), effect);
  if (found == effects.end()) return {};
  const auto k = static_cast<std::size_t>(found - effects.begin());
  const Likelihood likelihood(*fit.model, data.blocks(), data.count(), 1);
  const Expectation expectation =
      likelihood.expect(likelihood.statistics(fit.at.parameters, false), fit.at);
  MatrixXd information = likelihood.information(fit.at, latentMoments(expectation)).observed;
  information.diagonal() *= 1 + 1e-12;
  const MatrixXd covariance = information.completeOrthogonalDecomposition().pseudoInverse();
  std::vector<CauseParameter> all;
  for (int i = 0; i < effect->parameterCount(); ++i) {
    const EffectParameter& parameter =
        effect->description().parameters[static_cast<std::size_t>(i)];
    const int at = fit.model->offsetOf(k) + i;
    CauseParameter out{parameter.name, parameter.unit, fit.at.parameters[at], 0, 0, 0};
    if (parameter.log_variance) {
      out.value = std::sqrt(fit.at.noise_variance) * std::exp(0.5 * fit.at.parameters[at]);
      const double relative = 1 / std::sqrt(2.0 * data.count());  // of a deviation from M draws
      out.standard_error = out.value * relative;
      out.lower_90 = out.value * std::exp(-kNinety * relative);
      out.upper_90 = out.value * std::exp(kNinety * relative);
    } else if (parameter.smooth && covariance(at, at) > 0) {
      out.standard_error = std::sqrt(covariance(at, at));
      out.lower_90 = out.value - kNinety * out.standard_error;
      out.upper_90 = out.value + kNinety * out.standard_error;
    } else {
      const auto reach = [&](double direction) {
        double inside = 0, outside = direction * 0.2 * parameter.scale;
        const auto drop = [&](double distance) {
          ModelParameters moved = fit.at;
          moved.parameters[at] += distance;
          return fit.log_likelihood - evaluated(fit.model, moved, data).log_likelihood;
        };
        for (int step = 0; step < 18; ++step) {
          const double middle = 0.5 * (inside + outside);
          (drop(middle) < kDrop ? inside : outside) = middle;
        }
        return inside;
      };
      out.lower_90 = out.value + reach(-1);
      out.upper_90 = out.value + reach(1);
      out.standard_error = (out.upper_90 - out.lower_90) / (2 * kNinety);
    }
    all.push_back(out);
  }
  return all;
}

std::string messageOf(const Explanation& explanation) {
  std::string names, failed;
  for (const Cause& cause : explanation.causes) names += (names.empty() ? "" : ", ") + cause.name;
  for (const Check& check : explanation.checks_after)
    if (!check.passed) failed += (failed.empty() ? "" : ", ") + check.name;
  switch (explanation.verdict) {
    case Verdict::none:
      return "the simulation agrees with the data: nothing is wrong that these experiments show";
    case Verdict::explained:
      return "explained by " + names + "; with it nothing is left that the checks see";
    case Verdict::partly_explained:
      return names + " explains part; what remains is not explained (" + failed + ")";
    case Verdict::unknown:
      return "something is wrong that the catalogue does not name (" + failed + ")";
  }
  return "";
}

/// One run of explain().
class Explaining {
 public:
  Explaining(const Configuration& configuration, const ProgressCallback& progress)
      : configuration_(configuration), progress_(progress) {}

  Explanation run(const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation);

 private:
  bool report(const std::string& phase, double fraction, double log_likelihood);
  FitContext context(const Estimate& estimate);
  void describe(const SearchState& base, SearchState state);

  Configuration configuration_;
  ProgressCallback progress_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  bool cancelled_ = false;
  std::unique_ptr<WorkerPool> pool_;
  Explanation explanation_;
};

bool Explaining::report(const std::string& phase, double fraction, double log_likelihood) {
  cancelled_ = cancelled_ || (progress_ && !progress_({phase, fraction, log_likelihood}));
  return !cancelled_;
}

FitContext Explaining::context(const Estimate& estimate) {
  FitContext context;
  context.options.constraint = estimate.configuration.error_model.constraint;
  if (estimate.error_model.mixture.components() > 0)
    context.options.floor = covarianceFloor(estimate.error_model.mixture);
  context.seed = configuration_.estimation.seed;
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  const int asked = configuration_.estimation.threads;
  pool_ = std::make_unique<WorkerPool>(asked == kAutomatic ? std::max(1, cores - 1) : asked);
  context.pool = pool_.get();
  context.going_on = [this] { return !cancelled_; };
  return context;
}

Explanation Explaining::run(const std::vector<Experiment>& experiments,
                            const std::vector<Experiment>& validation) {
  configuration_.validate();
  require(!variesParameters(configuration_.error_model.basis), "error_model.basis",
          nameOf(configuration_.error_model.basis),
          "fir, laguerre or kautz: explain looks for parameters that vary by itself");
  Split data = split(configuration_, experiments, validation);
  const std::vector<Signature> signatures = signaturesOf(data.train);
  for (const Signature& signature : signatures) {
    if (std::find(configuration_.explanation.exclude.begin(),
                  configuration_.explanation.exclude.end(),
                  signature.name) != configuration_.explanation.exclude.end())
      continue;
    data.train = withoutSpoiled(std::move(data.train), signature);
    data.held = withoutSpoiled(std::move(data.held), signature);
  }
  explanation_.before =
      Identifier(configuration_).identify(data.train, {}, [this](const Progress& at) {
        return report(at.phase, 0.3 * at.fraction, at.log_likelihood);
      });
  explanation_.warnings = explanation_.before.warnings;
  std::vector<Experiment> used;
  std::size_t next = 0;
  for (Experiment& experiment : data.train) {
    if (next == explanation_.before.experiments.size()) break;
    if (experiment.id != explanation_.before.experiments[next].id) continue;
    used.push_back(std::move(experiment));
    ++next;
  }
  for (const Experiment& experiment : data.held) explanation_.held_out.push_back(experiment.id);
  SearchState base{{}, FitData(std::move(used)), FitData(std::move(data.held)), {}, {}, false, 0};
  DataSummary summary = summarise(base.train.experiments());
  const FitContext context = this->context(explanation_.before);
  base.fit = settled(baseFit(explanation_.before, base.train, summary), base.train, context);
  summary.regressors = base.fit.model->regressors();
  summary.plant_parameters =
      plantParameters(base.fit.model->nominal(),
                      base.fit.at.parameters.head(base.fit.model->nominal().parameterCount()));
  findPeaks(residualsOf(base.fit, base.train), base.train, &summary);
  const Effects effects = catalogue(summary);
  bool quantised = false;
  for (const Signature& signature : signatures) {
    const auto effect = findEffect(effects, signature.name, "");
    if (signature.name == "sens_quant") {
      const double step = signature.parameters.front().value;
      quantised = step * step / 12 > 0.2 * base.fit.at.noise_variance;
      if (!quantised) continue;
    }
    FoundCause cause{effect, 0, 0, 1, {}, {}, signature.parameters, {}};
    cause.gain = gainOf(heldOut(base.fit, base.held), heldOut(base.fit, base.held),
                        VectorXd::Zero(base.held.count()));
    base.causes.push_back(std::move(cause));
    base.banned.push_back(signature.name);
  }
  base.heavy_tails = quantised;
  explanation_.checks_before = checksOf(base.fit, base.train, base.heavy_tails);
  Search search(configuration_.explanation, context, effects);
  report("searching causes", 0.4, base.fit.log_likelihood);
  SearchState found = quantised ? base : search.run(base);
  explanation_.candidates = search.tried();
  const auto excluded = [&](const char* name) {
    const auto& list = configuration_.explanation.exclude;
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  constexpr double kFeedback = 1e-4;
  if (!excluded("exp_feedback") &&
      feedbackProbability(residualsOf(found.fit, found.train), found.train) < kFeedback) {
    found.causes.push_back({findEffect(effects, "exp_feedback", ""), 0, 0, 1, {}, {}, {}, {}});
    explanation_.warnings.push_back(
        "the input depends on the output (closed loop): the estimates are consistent only if the "
        "noise model is right");
  }
  describe(base, std::move(found));
  return std::move(explanation_);
}

void Explaining::describe(const SearchState& base, SearchState state) {
  report("describing", 0.9, state.fit.log_likelihood);
  explanation_.checks_after = checksOf(state.fit, state.train, state.heavy_tails);
  const bool passed = allPassed(explanation_.checks_after);
  for (FoundCause& found : state.causes) {
    if (!passed && noiseClass().count(found.effect->name()) > 0) {
      explanation_.warnings.push_back(found.effect->name() +
                                      " is a symptom as long as what remains is not explained");
      continue;
    }
    const EffectDescription& description = found.effect->description();
    Cause cause;
    cause.name = description.name;
    cause.variant = description.variant;
    cause.group = description.name.substr(0, description.name.find('_'));
    cause.description = description.meaning;
    cause.advice = description.advice;
    cause.confidence = found.confidence;
    cause.equivalent = found.equivalent;
    cause.gain = found.gain;
    cause.parameters = found.parameters.empty() ? parametersOf(state.fit, state.train, found.effect)
                                                : found.parameters;
    if (!description.variant.empty()) cause.description = description.meaning;
    explanation_.causes.push_back(std::move(cause));
  }
  explanation_.verdict = explanation_.causes.empty()
                             ? (passed ? Verdict::none : Verdict::unknown)
                             : (passed ? Verdict::explained : Verdict::partly_explained);
  explanation_.message = messageOf(explanation_);
  explanation_.after = explanation_.before;
  explanation_.residual_before = residualPicture(base.fit, base.train);
  explanation_.residual_after = residualPicture(state.fit, state.train);
  explanation_.pictures = picturesOf(base.fit, state.fit, state.held);
  explanation_.termination = cancelled_ ? Termination::cancelled : Termination::converged;
  explanation_.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

}  // namespace

Explanation explain(const Configuration& configuration, const std::vector<Experiment>& experiments,
                    const std::vector<Experiment>& validation, const ProgressCallback& progress) {
  return Explaining(configuration, progress).run(experiments, validation);
}

}  // namespace uncertainty_identification
