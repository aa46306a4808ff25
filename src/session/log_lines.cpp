#include "session/log_lines.h"

#include <algorithm>

#include "data/experiment_checks.h"
#include "data/text.h"

namespace uncertainty_identification {
namespace {

double staticGain(const Estimate& estimate) {
  return estimate.nominal_model.b.sum() / (1 + estimate.nominal_model.a.sum());
}

/// "what 1.02 (before 1.01)"
std::string change(const std::string& what, double now, const Estimate* before, double then) {
  return ", " + what + " " + rounded(now) +
         (before == nullptr ? "" : " (before " + rounded(then) + ")");
}

}  // namespace

std::string keptLine(const KeptExperiment& kept, const LimitOptions& limits) {
  const Experiment& experiment = *kept.experiment;
  const std::string defect = defectOf(experiment, limits);
  return named(experiment.id) + " has " + std::to_string(experiment.samples()) + " samples of " +
         rounded(experiment.sample_time) + " s and was accepted" +
         (defect.empty() ? "" : ", but cannot be identified from: " + defect);
}

std::string rejectedLine(const RejectedExperiment& rejected) {
  return named(rejected.id) + " was rejected: " + rejected.reason;
}

std::string resultLine(const WorkerResult& result, std::uint32_t sequence, const Estimate* before) {
  const Estimate& now = *result.estimate;
  const auto of = [before](const auto& value) { return before == nullptr ? 0.0 : value(*before); };
  return "result " + std::to_string(sequence) +
         (result.preliminary ? " (quick update)" : " (identified from scratch)") + ": " +
         toString(now.termination) + " in " + rounded(now.seconds) + " s" +
         change("experiments", now.experiment_count, before,
                of([](const Estimate& e) { return e.experiment_count * 1.0; })) +
         change("log-likelihood", now.log_likelihood, before,
                of([](const Estimate& e) { return e.log_likelihood; })) +
         change("static gain", staticGain(now), before, of(staticGain)) +
         change("noise variance", now.noise_variance.value, before,
                of([](const Estimate& e) { return e.noise_variance.value; })) +
         (now.trust.trusted ? "" : "; do not rely on the bounds: " + now.trust.reasons.front());
}

std::string unwrittenLine(const std::vector<std::string>& files) {
  constexpr std::size_t kNamed = 20;
  std::string text = "the store could not write what was in memory, and the node has ended; lost: ";
  for (std::size_t k = 0; k < std::min(kNamed, files.size()); ++k)
    text += (k == 0 ? "" : ", ") + files[k];
  if (files.size() > kNamed) text += " and " + std::to_string(files.size() - kNamed) + " more";
  return text;
}

std::optional<std::string> StoreLog::line(const StoreStatus& now) {
  const bool began = now.failing && !failing_, ended = failing_ && !now.failing;
  const bool gave_up = now.lost > 0 && !lost_;
  failing_ = now.failing;
  lost_ = now.lost > 0;
  if (began || gave_up) return now.message;
  if (ended) return "the store can be written again";
  return std::nullopt;
}

}  // namespace uncertainty_identification
