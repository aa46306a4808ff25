#include "explanation/limits_of_time.h"

#include <algorithm>
#include <sstream>

#include "curves/preparation.h"
#include "data/thinning.h"

namespace uncertainty_identification {

namespace {

int samplesOf(const std::vector<Experiment>& experiments) {
  int samples = 0;
  for (const Experiment& experiment : experiments) samples += experiment.samples();
  return samples;
}

}  // namespace

bool areMany(const std::vector<Experiment>& experiments) {
  constexpr int kMany = 20000;
  return samplesOf(experiments) > kMany;
}

std::string thinLongRecords(Split* data) {
  constexpr int kMany = 5000;  // samples
  const int samples = samplesOf(data->train);
  const int thinning = std::min(planWindows(data->train).thinning, (samples + kMany - 1) / kMany);
  if (thinning <= 1) return "";
  for (auto* part : {&data->train, &data->held})
    for (Experiment& experiment : *part) experiment = thinned(experiment, thinning);
  std::ostringstream text;
  text << "the records hold " << samples << " samples to fit to, far faster than the output moves: "
       << "each " << thinning << " were taken together, so that the model has a sample time of "
       << data->train.front().sample_time << " s; explanation.time_limit: 0 explains all samples";
  return text.str();
}

NominalModelOptions ofOrder(int order) {
  NominalModelOptions nominal;
  nominal.orders_auto = false;
  constexpr int kHighest = 4;  // those of a structure with many modes take too long
  nominal.na = nominal.nb = std::clamp(order, 1, kHighest);
  nominal.nc = 0;
  nominal.nd = 1;
  nominal.delay = 1;
  return nominal;
}

void limitTime(double share, Configuration* configuration) {
  const double most = share * configuration->explanation.time_limit;
  double& limit = configuration->estimation.time_limit;
  if (most > 0) limit = limit > 0 ? std::min(limit, most) : most;
}

Estimate identifyInTime(double share, int order, const std::vector<Experiment>& experiments,
                        const ProgressCallback& progress, Configuration* configuration,
                        std::string* remark) {
  Configuration limited = *configuration;
  limitTime(share, &limited);
  Estimate chosen = Identifier(limited).identify(experiments, {}, progress);
  const bool is_hurried = chosen.termination == Termination::time_limit;
  if (is_hurried)
    *remark =
        "explanation.time_limit cut the choice of a model short; the best one until then is taken";
  if (is_hurried && !chosen.usable()) {
    if (configuration->nominal_model.orders_auto) configuration->nominal_model = ofOrder(order);
    *remark = "explanation.time_limit left no time to choose a model; its order is " +
              std::to_string(configuration->nominal_model.na);
    chosen = Identifier(*configuration).identify(experiments, {}, progress);
  }
  chosen.configuration.estimation.time_limit = configuration->estimation.time_limit;
  return chosen;
}

}  // namespace uncertainty_identification
