#include "inspection/closed_loop.h"

#include "data/text.h"
#include "inspection/signal_measures.h"

namespace uncertainty_identification {
namespace {

Channel channelOf(const std::vector<Experiment>& experiments, Eigen::VectorXd Experiment::*signal) {
  Channel channel;
  for (const Experiment& experiment : experiments) {
    StampedSignal record;
    const bool is_output = signal == &Experiment::y;
    for (int k = 0; k < experiment.samples(); ++k) {
      if (is_output && !experiment.isValid(k)) continue;
      record.stamps.push_back(k * experiment.sample_time);
      record.values.push_back((experiment.*signal)(k));
    }
    channel.records.push_back(std::move(record));
  }
  return channel;
}

}  // namespace

Following followingOf(const std::vector<Experiment>& experiments) {
  const Channel input = channelOf(experiments, &Experiment::u),
                output = channelOf(experiments, &Experiment::y);
  return followingOf(input, output, bandHertz(output).value_or(0));
}

std::optional<std::string> closedLoopWarning(const Following& following, const std::string& input,
                                             const std::string& output) {
  if (!following.inputFollows()) return std::nullopt;
  const std::string how = input + " follows " + output + " after about " + rounded(following.lead) +
                          " s (correlation " + rounded(following.before) +
                          " of what their own past does not predict, by chance " +
                          rounded(following.chance) + ")";
  const std::string reversed =
      following.before > following.after
          ? ", more than the other way round, so that input and output may be exchanged or"
          : ", so that";
  return how + reversed +
         " a controller probably computes the input (closed loop): noise that it feeds back biases "
         "the model, which its uncertainty does not include; record with an excitation that does "
         "not depend on the output, without the controller or larger than what it adds, or "
         "identify from its setpoint";
}

}  // namespace uncertainty_identification
