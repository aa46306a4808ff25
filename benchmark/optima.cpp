// Checks that an identification finds the optimum: models of the package's own structure are drawn
// and simulated by difference equations of the study (study/), identified with given orders, and
// compared with an optimisation that starts at the truth. The same systems are identified with
// everything chosen from the data; the held-out density tells what this costs. A third part does
// the first with dead times that are not whole samples. scripts/study_optima builds and runs it;
// --help lists the options. Exits with 1 on gross failure.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "study/arguments.h"
#include "study/embedded_model.h"
#include "study/score.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification::study {
namespace {

constexpr double kMissed = 0.5;  // [nats] below the optimum that counts as missing it
constexpr double kQuantile = 1.959963984540054;
constexpr int kHeldOut = 20;  // experiments
enum Purpose : std::uint64_t { kModel = 101, kData, kValidation };

/// Copied between processes, so without pointers.
struct Outcome {
  bool refused = false, converged = true;
  double below = 0;                   ///< [nats] below the optimum reached from the truth
  int parameters = 0;                 ///< of theta
  int finite = 0;                     ///< parameters with a finite standard error
  int inside = 0, inside_robust = 0;  ///< parameters whose 95 % interval holds the truth
  double density = NAN;  ///< [nats per held-out experiment] with everything automatic, less that
                         ///< with given orders
  bool components_right = false, orders_right = false;
  double seconds = 0, automatic_seconds = 0;  ///< [s] processor time
  char text[200] = "", automatic[120] = "";
};

template <std::size_t size>
void copyText(const std::string& from, char (&to)[size]) {
  std::snprintf(to, size, "%s", from.c_str());
}

/// A model of the part, with the number of its experiments.
struct Drawn {
  EmbeddedModel model;
  int experiments = 0;
};

Drawn drawSystem(bool dead_time, std::uint64_t seed) {
  Draw draw(seedOf(seed, kModel));
  EmbeddedModelSize size;
  size.order = draw.integer(1, dead_time ? 2 : 3);
  size.nc = draw.integer(0, dead_time ? 1 : 2);
  size.nd = draw.integer(0, dead_time ? 1 : 2);
  size.taps = dead_time ? 2 : draw.integer(2, 4);
  size.components = draw.integer(1, dead_time ? 1 : 3);
  size.samples = draw.integer(100, 300);
  Drawn drawn;
  drawn.experiments = draw.integer(20, 60);
  drawn.model = dead_time ? drawDeadTimeModel(size, draw) : drawEmbeddedModel(size, draw);
  return drawn;
}

void countIntervals(const Estimate& estimate, const Eigen::VectorXd& theta, Outcome* outcome) {
  const std::vector<ParameterEstimate>& parameters = estimate.nominal_model.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const ParameterEstimate& one = parameters[k];
    const double error = std::abs(one.value - theta[static_cast<Eigen::Index>(k)]);
    ++outcome->parameters;
    outcome->finite += std::isfinite(one.standard_error);
    outcome->inside += error <= kQuantile * one.standard_error;
    outcome->inside_robust += error <= kQuantile * one.robust_standard_error;
  }
}

void identifyAutomatically(const Drawn& drawn, const std::vector<Experiment>& experiments,
                           const std::vector<Experiment>& validation, double given_density,
                           Configuration configuration, Outcome* outcome) {
  configuration.nominal_model = NominalModelOptions();
  configuration.error_model.basis = BasisKind::automatic;
  configuration.error_model.components = kAutomatic;
  const double before = processorSeconds();
  const Estimate estimate = Identifier(configuration).identify(experiments, validation);
  outcome->automatic_seconds = processorSeconds() - before;
  outcome->density = estimate.validation.log_density_per_experiment - given_density;
  outcome->components_right =
      estimate.error_model.mixture.components() == drawn.model.mixture.components();
  outcome->orders_right = estimate.nominal_model.a.size() == drawn.model.a.size() &&
                          estimate.nominal_model.b.size() == drawn.model.b.size() &&
                          estimate.nominal_model.delay == 1;
  const auto size = [](const Eigen::VectorXd& values) { return std::to_string(values.size()); };
  const NominalModelEstimate& chosen = estimate.nominal_model;
  copyText("chosen nb=" + size(chosen.b) + " na=" + size(chosen.a) + " nc=" + size(chosen.c) +
               " nd=" + size(chosen.d) + " delay=" + std::to_string(chosen.delay) + " " +
               nameOf(estimate.error_model.options.basis) +
               " components=" + std::to_string(estimate.error_model.mixture.components()),
           outcome->automatic);
}

Outcome judge(bool dead_time, bool automatic, std::uint64_t seed,
              const Configuration& configuration) {
  Outcome outcome;
  const Drawn drawn = drawSystem(dead_time, seed);
  Draw data(seedOf(seed, kData)), held_out(seedOf(seed, kValidation));
  const std::vector<Experiment> experiments = measure(drawn.model, drawn.experiments, data);
  const std::vector<Experiment> validation = measure(drawn.model, kHeldOut, held_out);
  try {
    Configuration given = configuration;
    setOrders(drawn.model, &given);
    const double before = processorSeconds();
    const Estimate found = Identifier(given).identify(experiments, validation);
    outcome.seconds = processorSeconds() - before;
    startAtTruth(drawn.model, &given);
    given.estimation.offsets = found.configuration.estimation.offsets;  // the same model
    const Estimate best = Identifier(given).identify(experiments);
    outcome.below = best.log_likelihood - found.log_likelihood;
    outcome.converged = found.termination == Termination::converged;
    copyText(toString(found.termination) + ": " + found.message, outcome.text);
    countIntervals(found, thetaOf(drawn.model), &outcome);
    if (automatic)
      identifyAutomatically(drawn, experiments, validation,
                            found.validation.log_density_per_experiment, configuration, &outcome);
  } catch (const Error& error) {
    outcome.refused = true;
    copyText(error.what(), outcome.text);
  }
  return outcome;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Sums over the systems of a part.
struct Part {
  int systems = 0, failed = 0, refused = 0, missed = 0, unconverged = 0;
  int parameters = 0, finite = 0, inside = 0, inside_robust = 0;
  int components_right = 0, orders_right = 0;
  std::vector<double> seconds, densities, automatic_seconds;

  void add(const std::optional<Outcome>& outcome) {
    ++systems;
    failed += !outcome;
    refused += outcome && outcome->refused;
    if (!outcome || outcome->refused) return;
    missed += outcome->below > kMissed;
    unconverged += !outcome->converged;
    parameters += outcome->parameters;
    finite += outcome->finite;
    inside += outcome->inside;
    inside_robust += outcome->inside_robust;
    seconds.push_back(outcome->seconds);
    if (std::isnan(outcome->density)) return;
    densities.push_back(outcome->density);
    automatic_seconds.push_back(outcome->automatic_seconds);
    components_right += outcome->components_right;
    orders_right += outcome->orders_right;
  }

  void print(const std::string& name) const {
    const auto percent = [](int count, std::size_t of) {
      return of == 0 ? NAN : 100.0 * count / static_cast<double>(of);
    };
    const auto theta = static_cast<std::size_t>(parameters);
    std::printf(
        "%s: %d systems, %d crashed or too slow, %d refused, %d not converged\n"
        "  %d more than %.1f nats below the optimum reached from the truth (%.1f %%)\n"
        "  95 %% intervals of theta: %.1f %% of %d hold the truth (robust: %.1f %%)\n"
        "  finite standard errors: %.1f %%; of these intervals, %.1f %% hold; median %.2f s\n",
        name.c_str(), systems, failed, refused, unconverged, missed, kMissed,
        percent(missed, seconds.size()), percent(inside, theta), parameters,
        percent(inside_robust, theta), percent(finite, theta),
        percent(inside, static_cast<std::size_t>(finite)), median(seconds));
    if (densities.empty()) return;
    double sum = 0;
    for (double density : densities) sum += density;
    std::printf(
        "  everything automatic against given orders: held-out log density per experiment "
        "%+.2f nats (mean; 10, 50, 90 %%: %+.2f %+.2f %+.2f)\n"
        "  right number of components: %.1f %%, right orders of Go: %.1f %%; median %.2f s\n",
        sum / static_cast<double>(densities.size()), quantile(densities, 0.1),
        quantile(densities, 0.5), quantile(densities, 0.9),
        percent(components_right, densities.size()), percent(orders_right, densities.size()),
        median(automatic_seconds));
  }

  /// Failures that need no statistics to be seen.
  bool good() const {
    const auto scored = static_cast<int>(seconds.size());
    return scored > 0 && failed == 0 && 20 * missed <= systems && inside >= 0.85 * parameters;
  }
};

/// One system's result: printed if it is missed or if all are asked for.
void print(int seed, const EmbeddedModel& model, const Outcome& outcome, bool all) {
  if (!all && !outcome.refused && outcome.below <= kMissed) return;
  std::printf("  seed %d, nb=%d na=%d nc=%d nd=%d components=%d: %.2f nats below, %s", seed,
              static_cast<int>(model.b.size()), static_cast<int>(model.a.size()),
              static_cast<int>(model.c.size()), static_cast<int>(model.d.size()),
              model.mixture.components(), outcome.below, outcome.text);
  if (!std::isnan(outcome.density))
    std::printf("; automatic: %+.2f nats, %s", outcome.density, outcome.automatic);
  std::printf("\n");
}

bool study(const std::string& name, bool dead_time, bool automatic, const std::vector<int>& seeds,
           const Arguments& arguments) {
  const Configuration configuration = arguments.configuration();
  const auto outcomes =
      runTasks<Outcome>(static_cast<int>(seeds.size()), arguments.limits(60), [&](int k) {
        const int seed = seeds[static_cast<std::size_t>(k)];
        return judge(dead_time, automatic, static_cast<std::uint64_t>(seed), configuration);
      });
  Part part;
  for (const std::optional<Outcome>& outcome : outcomes) part.add(outcome);
  part.print(name);
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const EmbeddedModel model = drawSystem(dead_time, static_cast<std::uint64_t>(seeds[k])).model;
    if (outcomes[k]) print(seeds[k], model, *outcomes[k], arguments.has("list"));
  }
  std::fflush(stdout);
  return part.good();
}

int studyParts(const Arguments& arguments) {
  const std::string parts = arguments.text("parts", "given,automatic,dead_times");
  const auto asked = [&](const char* part) { return parts.find(part) != std::string::npos; };
  const auto seeds = [&](int systems) {
    const int count = static_cast<int>(arguments.number("systems", systems));
    return arguments.numbers("seeds", "1:" + std::to_string(count));
  };
  bool good = true;
  if (asked("given") || asked("automatic"))
    good = study("orders", false, asked("automatic"), seeds(300), arguments);
  if (asked("dead_times")) good = study("dead times", true, false, seeds(40), arguments) && good;
  std::printf(
      "\n%s: no crash, at most 5 %% miss the optimum, at least 85 %% of the intervals hold\n",
      good ? "passed" : "FAILED");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace uncertainty_identification::study

int main(int argc, char** argv) {
  using uncertainty_identification::study::Arguments;
  try {
    return uncertainty_identification::study::studyParts(
        Arguments(argc, argv,
                  {{"systems", "systems of each part (300, dead times 40)"},
                   {"seeds", "seeds of the systems, A:B, instead of --systems"},
                   {"parts", "given,automatic,dead_times: which parts to run"},
                   {"list", "print the result of every system"}},
                  {"list"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "optima: %s\n", error.what());
    return 2;
  }
}
