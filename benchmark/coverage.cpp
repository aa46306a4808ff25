// Checks the coverage of the bounds: the share of new true systems inside bands of nominally 50,
// 90, 95 and 99 %, and of new experiments inside calibrated prediction intervals. docs/bounds.md
// explains the table. Arguments: number of identifications (200) and of new systems (200) for each
// case. Exits with 1 if a band that includes estimation errors misses its level by more than 2
// percentage points and two standard errors in a case whose model is true, or if prediction
// intervals miss their guarantee.
#include <cstdio>
#include <cstdlib>
#include <random>

#include "math/constants.h"
#include "paper_study.h"

namespace uncertainty_identification::paper {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::VectorXd;

constexpr int kFrequencies = 40;
constexpr int kPredicted = 20;  // new experiments for each identification

/// A truth. If its distribution is not a mixture, each run draws new systems.
struct Case {
  std::string name;
  Truth truth;
  Configuration configuration;
  bool model_is_true = true;
  bool heavy_tailed = false;
};

/// Student's t with 2 degrees of freedom instead of a mixture.
double heavyTail(std::uint64_t seed, int r) {
  std::mt19937_64 random(seed * 1000003 + static_cast<std::uint64_t>(r));
  return 0.3 * std::student_t_distribution<double>(2)(random);
}

Truth truthOf(const Case& of, std::uint64_t seed, int r) {
  Truth truth = of.truth;
  if (!of.heavy_tailed) return truth;
  const double xi = heavyTail(seed, r);
  truth.error_model.mixture = {
      {1.0}, {VectorXd::Constant(1, xi)}, {Eigen::MatrixXd::Constant(1, 1, 1e-12)}};
  return truth;
}

std::vector<Experiment> simulateCase(const Case& of, std::uint64_t seed, int count) {
  std::vector<Experiment> experiments;
  for (int r = 0; r < count; ++r)
    experiments.push_back(simulateExperiment(truthOf(of, seed, r), seed, r));
  return experiments;
}

/// `count` systems, beginning with number `first`.
ArrayXXd freshMagnitudes(const Case& of, int first, int count, const VectorXd& omega) {
  if (!of.heavy_tailed) return trueMagnitudes(of.truth, count, omega, first);
  ArrayXXd all(count, omega.size());
  for (int r = 0; r < count; ++r)
    all.row(r) = trueMagnitudes(truthOf(of, kFreshSeed, first + r), 1, omega, first + r).row(0);
  return all;
}

/// Standard error of a mean share. Where the systems hardly differ, as at low frequency, an
/// identification covers all of them or none. A few identifications may then agree by chance, so
/// the error is at least the binomial one at `level`.
double errorOf(const Spread& shares, double level) {
  bool all_or_none = true;
  for (double share : shares.values) all_or_none = all_or_none && (share == 0 || share == 1);
  const auto count = static_cast<double>(shares.values.size());
  return all_or_none ? std::sqrt(level * (1 - level) / count) : shares.errorOfMean();
}

/// Results for one kind of band at one level, over all identifications.
struct Tally {
  std::vector<Spread> inside;  ///< at each frequency
  Spread simultaneous;

  void add(const Band& pointwise, const Band& all, const ArrayXXd& fresh, const VectorXd& omega) {
    const ArrayXd shares = score(pointwise, fresh, omega).inside;
    inside.resize(static_cast<std::size_t>(shares.size()));
    for (Eigen::Index k = 0; k < shares.size(); ++k)
      inside[static_cast<std::size_t>(k)].values.push_back(shares[k]);
    simultaneous.values.push_back(score(all, fresh, omega).simultaneous);
  }
};

/// Results for one kind of band, one entry per level.
struct Kind {
  std::string name;
  std::vector<Tally> levels;

  void add(const Bands& bands, const ArrayXXd& fresh, const VectorXd& omega) {
    levels.resize(bands.pointwise.size());
    for (std::size_t k = 0; k < levels.size(); ++k)
      levels[k].add(bands.pointwise[k], bands.simultaneous[k], fresh, omega);
  }
};

struct CaseResult {
  Kind total{"mixture and estimate's errors", {}}, mixture{"mixture alone", {}},
      pooled{"pooled prediction-error fit", {}};
  std::vector<Spread> predicted;  ///< at each level
  std::vector<double> guaranteed;
};

void addBounds(const Case& of, const std::vector<Experiment>& experiments, const ArrayXXd& fresh,
               const VectorXd& omega, CaseResult* result) {
  const Estimate estimate = Identifier(of.configuration).identify(experiments);
  const FrequencyBounds bounds =
      frequencyBounds(PlantDistribution(estimate), omega, of.configuration.bounds, 1);
  result->total.add(bounds.magnitude_bands.total, fresh, omega);
  result->mixture.add(bounds.magnitude_bands.mixture, fresh, omega);

  Configuration plain = of.configuration;  // the usual method: one model and its covariance
  plain.error_model = ErrorModelOptions();
  plain.error_model.taps = 0;
  plain.error_model.components = 1;
  const Estimate pooled = Identifier(plain).identify(experiments);
  result->pooled.add(
      frequencyBounds(PlantDistribution(pooled), omega, plain.bounds, 1).magnitude_bands.total,
      fresh, omega);

  const PredictionCalibration calibration =
      Identifier(of.configuration).calibrate(estimate, experiments);
  const auto seed =
      500000 + static_cast<std::uint64_t>(result->pooled.levels[0].simultaneous.values.size());
  const std::vector<Experiment> others = simulateCase(of, seed, kPredicted);
  result->predicted.resize(calibration.levels.size());
  result->guaranteed = calibration.guaranteed;
  for (std::size_t k = 0; k < calibration.levels.size(); ++k) {
    int inside = 0;
    for (const Experiment& other : others) {
      const PredictionInterval interval = predictionInterval(calibration, calibration.levels[k],
                                                             of.configuration.estimation, other);
      inside += (other.y.array() <= interval.upper.array()).all() &&
                (other.y.array() >= interval.lower.array()).all();
    }
    result->predicted[k].values.push_back(inside / static_cast<double>(kPredicted));
  }
}

void print(const Kind& kind, const std::vector<double>& levels) {
  std::printf("  %-32s", kind.name.c_str());
  for (std::size_t k = 0; k < levels.size(); ++k) {
    double least = 1, most = 0;
    for (const Spread& at : kind.levels[k].inside) {
      least = std::min(least, at.mean());
      most = std::max(most, at.mean());
    }
    std::printf("  %5.1f to %5.1f  %5.1f", 100 * least, 100 * most,
                100 * kind.levels[k].simultaneous.mean());
  }
  std::printf("\n");
}

void judge(const Case& of, const CaseResult& result, Checks* checks) {
  const std::vector<double>& levels = of.configuration.bounds.levels;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    char what[100];
    std::snprintf(what, sizeof what, "%s, prediction, %.0f %%", of.name.c_str(), 100 * levels[k]);
    const Spread& predicted = result.predicted[k];
    checks->within(what, predicted.mean(), result.guaranteed[k] - 2 * predicted.errorOfMean(),
                   1.001);
    if (!of.model_is_true) continue;
    const Tally& tally = result.total.levels[k];
    // The frequency with the largest deviation relative to its tolerance.
    const Spread* worst = &tally.simultaneous;
    const auto strays = [&](const Spread& spread) {
      return std::abs(spread.mean() - levels[k]) / (0.02 + 2 * errorOf(spread, levels[k]));
    };
    for (const Spread& at : tally.inside) {
      if (strays(at) > strays(*worst)) worst = &at;
    }
    const double tolerance = 0.02 + 2 * errorOf(*worst, levels[k]);
    std::snprintf(what, sizeof what, "%s, total, %.0f %%, worst", of.name.c_str(), 100 * levels[k]);
    checks->within(what, worst->mean(), levels[k] - tolerance, levels[k] + tolerance);
  }
}

Configuration configured(const std::string& name) {
  Configuration configuration = loadConfiguration(configPath(name));
  configuration.estimation.threads = 1;
  return configuration;
}

std::vector<Case> cases() {
  const Truth example1 = loadTruth(configPath("example1_truth")),
              example2 = loadTruth(configPath("example2_truth"));
  std::vector<Case> all = {
      {"Example 1", example1, configured("example1"), true, false},
      {"Example 2, paper's error model", example2, configured("example2"), false, false},
      {"Example 2, sensitivity", example2, configured("example2_sensitivity"), false, false},
      {"Example 2, parameter_spread", example2, configured("example2_parameter_spread"), false,
       false},
      {"three components", example1, configured("example1"), true, false},
      {"heavy tails", example1, configured("example1"), false, true}};
  const auto scalar = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
  const auto at = [](double x) { return VectorXd::Constant(1, x); };
  all[4].truth.error_model.mixture = {
      {0.3, 0.4, 0.3}, {at(-1.5), at(0), at(1.5)}, {scalar(0.05), scalar(0.05), scalar(0.05)}};
  all[4].configuration.error_model.components = 3;
  return all;
}

int study(int identifications, int systems) {
  Checks checks(true);
  for (const Case& of : cases()) {
    const double nyquist = kPi / of.truth.sample_time;
    const VectorXd omega =
        VectorXd::LinSpaced(kFrequencies, std::log(1e-3 * nyquist), std::log(0.9999 * nyquist))
            .array()
            .exp();
    CaseResult result;
    for (int k = 1; k <= identifications; ++k) {
      const auto seed = 100000 + static_cast<std::uint64_t>(k);
      addBounds(of, simulateCase(of, seed, of.truth.experiments),
                freshMagnitudes(of, k * systems, systems, omega), omega, &result);
    }
    std::printf("%s\n  %-32s", of.name.c_str(), "share inside [%]: each | all");
    for (double level : of.configuration.bounds.levels)
      std::printf("  nominally %5.0f       ", 100 * level);
    std::printf("\n");
    for (const Kind* kind : {&result.total, &result.mixture, &result.pooled})
      print(*kind, of.configuration.bounds.levels);
    std::printf("  %-32s", "prediction (guaranteed)");
    for (std::size_t k = 0; k < result.predicted.size(); ++k) {
      std::printf("  %5.1f (%5.1f)          ", 100 * result.predicted[k].mean(),
                  100 * result.guaranteed[k]);
    }
    std::printf("\n\n");
    std::fflush(stdout);
    judge(of, result, &checks);
  }
  return checks.report();
}

}  // namespace
}  // namespace uncertainty_identification::paper

int main(int argc, char** argv) {
  const int identifications = argc > 1 ? std::atoi(argv[1]) : 200;
  const int systems = argc > 2 ? std::atoi(argv[2]) : 200;
  if (identifications < 2 || systems < 2) {
    std::fprintf(stderr, "usage: coverage [identifications [fresh systems]], at least 2 each\n");
    return 2;
  }
  return uncertainty_identification::paper::study(identifications, systems);
}
