#include "ros/explain_request.h"

#include <ros/time.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <utility>

#include "estimation/stopwatch.h"
#include "ros/answer.h"
#include "ros/explanation_message.h"
#include "ros/request.h"

namespace uncertainty_identification {
namespace {

using Goal = messages::ExplainExperimentsGoal;
using Response = messages::ExplainExperimentsResult;

/// Throws CancelledError, and DataError when there are no experiments or the limit for requests has
/// passed. That of explanation.time_limit only ends the search.
Explanation explained(LoadedData data, const Configuration& configuration,
                      const ProgressCallback& progress) {
  if (data.experiments.empty() && data.rejected.empty()) {
    throw DataError("there are no experiments to explain; record some, or name bags");
  }
  const Stopwatch watch;
  const double limit = configuration.limits.max_request_time;
  std::atomic<bool> late{false};
  Explanation explanation = explain(configuration, data.experiments, {}, [&](const Progress& now) {
    late = watch.seconds() > limit;
    return !late && progress(now);
  });
  if (explanation.termination == Termination::cancelled && late)
    throw DataError("there was no explanation within limits.max_request_time (" +
                    std::to_string(std::lround(limit)) +
                    " s); lower the orders, or name fewer bags");
  if (explanation.termination == Termination::cancelled) throw CancelledError("cancelled");
  std::move(data.warnings.begin(), data.warnings.end(), std::back_inserter(explanation.warnings));
  std::copy(data.rejected.begin(), data.rejected.end(),
            std::back_inserter(explanation.before.rejected));
  std::move(data.rejected.begin(), data.rejected.end(),
            std::back_inserter(explanation.after.rejected));
  return explanation;
}

}  // namespace

ExplainAnswer answerExplain(const Goal& goal, const Configuration& own,
                            const std::function<std::vector<Experiment>()>& kept,
                            std::uint32_t sequence, const ProgressCallback& progress) {
  ExplainAnswer answer;
  answer.result = answerErrors<Response>([&] {
    const Configuration configuration = requestedConfiguration(goal.configuration, own);
    LoadedData data = loadRequestedBags(goal.bags, own.bag_directory, configuration, progress);
    if (goal.bags.empty()) data.experiments = kept();
    requireEnoughSamples(configuration, data.experiments);
    const ros::Time stamp = ros::Time::now();
    Explanation explanation = explained(std::move(data), configuration, progress);
    if (!explanation.before.usable()) {
      return answerOf<Response>(Response::NOT_USABLE,
                                "no usable model was found: " + explanation.before.message);
    }
    Response response = answerOf<Response>(Response::OK, explanation.message);
    response.explanation = toMessage(explanation, stamp, goal.bags.empty() ? sequence : 0);
    answer.explanation = std::move(explanation);
    return response;
  });
  return answer;
}

}  // namespace uncertainty_identification
