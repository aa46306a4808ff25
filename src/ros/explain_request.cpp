#include "ros/explain_request.h"

#include <ros/time.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "ros/answer.h"
#include "ros/explanation_message.h"
#include "ros/request.h"

namespace uncertainty_identification {
namespace {

using Goal = messages::ExplainExperimentsGoal;
using Response = messages::ExplainExperimentsResult;

/// Throws CancelledError, and DataError when there are no experiments.
Explanation explained(LoadedData data, const Configuration& configuration,
                      const ProgressCallback& progress) {
  if (data.experiments.empty() && data.rejected.empty()) {
    throw DataError("there are no experiments to explain; record some, or name bags");
  }
  Explanation explanation = explain(configuration, data.experiments, {}, progress);
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
