// Checks what a single record gives: 200 records are simulated by a program of the study's own
// (study/) and identified, with given orders and with the default configuration. Counts warnings
// that parameters cannot be determined, and 95 % intervals of theta that hold the truth.
// scripts/study_one_record builds and runs it; --help lists the options. Exits with 1 on gross
// failure.
#include <cmath>
#include <cstdio>

#include "study/arguments.h"
#include "study/embedded_model.h"
#include "study/score.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification::study {
namespace {

constexpr double kQuantile = 1.959963984540054;
enum Purpose : std::uint64_t { kModel = 201, kData };

/// Copied between processes, so without pointers.
struct Outcome {
  bool refused = false, warned = false, trusted = true;
  bool orders_right = false;
  int parameters = 0, finite = 0;  ///< of theta
  int compared = 0, inside = 0;    ///< intervals, finite and of the right orders
  double seconds = 0;              ///< [s] processor time
  char text[200] = "";
};

bool mentionsIndeterminate(const Estimate& estimate, Outcome* outcome) {
  for (const std::string& warning : estimate.warnings) {
    if (warning.find("cannot be told apart") == std::string::npos &&
        warning.find("cannot be determined") == std::string::npos)
      continue;
    std::snprintf(outcome->text, sizeof outcome->text, "%s", warning.c_str());
    return true;
  }
  return false;
}

EmbeddedModel drawRecord(std::uint64_t seed) {
  Draw draw(seedOf(seed, kModel));
  EmbeddedModelSize size;
  size.order = draw.integer(1, 2);
  size.nc = draw.integer(0, 1);
  size.nd = draw.integer(0, 1);
  size.taps = 0;
  size.samples = static_cast<int>(draw.logUniform(300, 3000));
  EmbeddedModel model = drawEmbeddedModel(size, draw);
  model.gaps = false;
  return model;
}

void countIntervals(const Estimate& estimate, const EmbeddedModel& model, Outcome* outcome) {
  const NominalModelEstimate& found = estimate.nominal_model;
  outcome->orders_right = found.delay == 1 && found.b.size() == model.b.size() &&
                          found.a.size() == model.a.size() && found.c.size() == model.c.size() &&
                          found.d.size() == model.d.size();
  const Eigen::VectorXd theta = thetaOf(model);
  for (std::size_t k = 0; k < found.parameters.size(); ++k) {
    const ParameterEstimate& one = found.parameters[k];
    ++outcome->parameters;
    outcome->finite += std::isfinite(one.standard_error);
    if (!outcome->orders_right || !std::isfinite(one.standard_error)) continue;
    ++outcome->compared;
    outcome->inside +=
        std::abs(one.value - theta[static_cast<Eigen::Index>(k)]) <= kQuantile * one.standard_error;
  }
}

Outcome judge(bool given, std::uint64_t seed, Configuration configuration) {
  Outcome outcome;
  const EmbeddedModel model = drawRecord(seed);
  Draw data(seedOf(seed, kData));
  if (given) setOrders(model, &configuration);
  try {
    const std::vector<Experiment> record = measure(model, 1, data);
    const double before = processorSeconds();
    const Estimate estimate = Identifier(configuration).identify(record);
    outcome.seconds = processorSeconds() - before;
    outcome.warned = mentionsIndeterminate(estimate, &outcome);
    outcome.trusted = estimate.trust.trusted;
    countIntervals(estimate, model, &outcome);
  } catch (const Error& error) {
    outcome.refused = true;
    std::snprintf(outcome.text, sizeof outcome.text, "%s", error.what());
  }
  return outcome;
}

/// Prints the shares of one configuration; whether none of them is grossly wrong.
bool summarise(const std::string& name, const std::vector<std::optional<Outcome>>& outcomes) {
  int failed = 0, refused = 0, warned = 0, untrusted = 0, right = 0, without = 0;
  int parameters = 0, finite = 0, compared = 0, inside = 0, scored = 0;
  std::vector<double> seconds;
  for (const std::optional<Outcome>& outcome : outcomes) {
    failed += !outcome;
    refused += outcome && outcome->refused;
    if (!outcome || outcome->refused) continue;
    ++scored;
    warned += outcome->warned;
    untrusted += !outcome->trusted;
    right += outcome->orders_right;
    without += outcome->finite < outcome->parameters;
    parameters += outcome->parameters;
    finite += outcome->finite;
    compared += outcome->compared;
    inside += outcome->inside;
    seconds.push_back(outcome->seconds);
  }
  const auto percent = [](int count, int of) { return of == 0 ? NAN : 100.0 * count / of; };
  std::printf(
      "%s: %zu records, %d crashed or too slow, %d refused; median %.2f s\n"
      "  warning that parameters cannot be told apart or determined: %.1f %%; not trusted: "
      "%.1f %%\n"
      "  without finite standard errors of all parameters: %.1f %%, of parameters: %.1f %%\n"
      "  right orders: %.1f %%; of these, finite 95 %% intervals of theta that hold the "
      "truth: %.1f %% of %d\n",
      name.c_str(), outcomes.size(), failed, refused, median(seconds), percent(warned, scored),
      percent(untrusted, scored), percent(without, scored),
      percent(parameters - finite, parameters), percent(right, scored), percent(inside, compared),
      compared);
  return failed == 0 && scored > 0 && 10 * warned <= scored && inside >= 0.85 * compared;
}

bool study(const std::string& name, bool given, const Arguments& arguments) {
  const int records = static_cast<int>(arguments.number("systems", 200));
  const std::vector<int> seeds = arguments.numbers("seeds", "1:" + std::to_string(records));
  const Configuration configuration = arguments.configuration();
  const auto outcomes =
      runTasks<Outcome>(static_cast<int>(seeds.size()), arguments.limits(30), [&](int k) {
        return judge(given, static_cast<std::uint64_t>(seeds[static_cast<std::size_t>(k)]),
                     configuration);
      });
  const bool good = summarise(name, outcomes);
  for (std::size_t k = 0; k < outcomes.size() && arguments.has("list"); ++k) {
    if (outcomes[k] && (outcomes[k]->warned || outcomes[k]->refused))
      std::printf("  seed %d: %s\n", seeds[k], outcomes[k]->text);
  }
  std::fflush(stdout);
  return good;
}

int studyBoth(const Arguments& arguments) {
  const bool given = study("given orders", true, arguments);
  const bool chosen = study("default configuration", false, arguments);
  const bool good = given && chosen;
  std::printf("\n%s: no crash, at most 10 %% warned, at least 85 %% of the intervals hold\n",
              good ? "passed" : "FAILED");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace uncertainty_identification::study

int main(int argc, char** argv) {
  using uncertainty_identification::study::Arguments;
  try {
    return uncertainty_identification::study::studyBoth(
        Arguments(argc, argv,
                  {{"systems", "number of records (200)"},
                   {"seeds", "seeds of the records, A:B, instead of --systems"},
                   {"list", "print the records with warnings"}},
                  {"list"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "one_record: %s\n", error.what());
    return 2;
  }
}
