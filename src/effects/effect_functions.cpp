#include "effects/effect_functions.h"

#include <algorithm>
#include <utility>

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

class ChainEffect : public Effect {
 public:
  ChainEffect(EffectDescription description, ChainFunction apply)
      : Effect(std::move(description)), apply_(std::move(apply)) {}

  void apply(const VectorXd& psi, Chain* chain) const override { apply_(psi, chain); }

 private:
  ChainFunction apply_;
};

class LoopEffect : public Effect {
 public:
  LoopEffect(EffectDescription description, FeedbackFunction feedback)
      : Effect(std::move(description)), feedback_(std::move(feedback)) {}

  Lanes feedback(const VectorXd& psi, const Lanes& x, const Lanes& before) const override {
    return feedback_(psi, x, before);
  }

 private:
  FeedbackFunction feedback_;
};

}  // namespace

std::shared_ptr<Effect> chainEffect(EffectDescription description, ChainFunction apply) {
  return std::make_shared<ChainEffect>(std::move(description), std::move(apply));
}

std::shared_ptr<Effect> loopEffect(EffectDescription description, FeedbackFunction feedback) {
  return std::make_shared<LoopEffect>(std::move(description), std::move(feedback));
}

std::vector<VectorXd> quantileStarts(const VectorXd& sorted,
                                     const std::vector<double>& probabilities, double lowest) {
  std::vector<double> all;
  all.reserve(probabilities.size());
  for (const double q : probabilities) all.push_back(std::max(sortedQuantile(sorted, q), lowest));
  return values(all);
}

EffectParameter instantParameter(const DataSummary& data) {
  return {"time", "s", 0.1 * data.samples * data.sample_time, 0.0, data.samples * data.sample_time,
          false};
}

std::vector<VectorXd> instantStarts(const std::vector<double>& sizes, const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double size : sizes) {
    for (int k = 1; k < 10; ++k)
      all.push_back(Eigen::Vector2d(size, 0.1 * k * data.samples * data.sample_time));
  }
  return all;
}

Eigen::Array<double, 1, Eigen::Dynamic> stepFrom(double first, const Chain& chain) {
  return (chain.time() - first + 1).max(0.0).min(1.0);
}

}  // namespace uncertainty_identification
