#include "effects/chain_evaluation.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "model/filter.h"
#include "model/linear_model.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// x = Go (u - sum f(x)), simulated sample by sample. Where the loop is unstable, x is clipped so
/// that it stays finite.
Signals loopOutput(const Polynomials& go, const std::vector<const SetEffect*>& loop,
                   const Signals& u) {
  constexpr double kLargest = 1e150;
  const Index samples = u.cols();
  Signals x = Signals::Zero(kLanes, samples), driven = Signals::Zero(kLanes, samples);
  for (Index t = 0; t < samples; ++t) {
    Lanes now = Lanes::Zero();
    for (Index i = 1; i <= std::min(t, go.a.size()); ++i) now -= go.a[i - 1] * x.col(t - i);
    for (Index j = 0; j < go.b.size() && go.delay + j <= t; ++j)
      now += go.b[j] * driven.col(t - go.delay - j);
    x.col(t) = now.max(-kLargest).min(kLargest);
    driven.col(t) = u.col(t);
    const Lanes before = t > 0 ? Lanes(x.col(t - 1)) : Lanes(Lanes::Zero());
    for (const SetEffect* set : loop)
      driven.col(t) -= set->effect->feedback(set->psi, x.col(t), before);
  }
  return x;
}

/// The output of a plant with effects in its loop, and its derivatives with respect to xi at the
/// point, as finite differences.
void runLoop(const Polynomials& go, const ErrorBasis& basis,
             const std::vector<const SetEffect*>& loop, Chain* chain) {
  constexpr double kStep = 1e-5;
  std::vector<Signals> of_input;
  basis.apply(chain->u, &of_input);
  Signals input = chain->u;
  for (std::size_t i = 0; i < of_input.size(); ++i) {
    for (int lane = 0; lane < chain->block.lanes; ++lane)
      input.row(lane) += chain->points(static_cast<Index>(i), lane) * of_input[i].row(lane);
  }
  const Signals output = loopOutput(go, loop, input);
  chain->X.clear();
  for (const Signals& direction : of_input)
    chain->X.push_back((loopOutput(go, loop, input + kStep * direction) - output) / kStep);
  chain->x.setZero(kLanes, output.cols());
  chain->x = output - chain->expected();
}

/// A simulated chain as the response of a plant. It has no derivatives: those of an extended model
/// are differences of whole evaluations.
class RespondedChain : public PlantResponse {
 public:
  explicit RespondedChain(const Chain& chain) : chain_(chain) {}
  Signals output() override { return chain_.x; }
  std::vector<Signals> regressors() override { return chain_.X; }
  Signals expectedOutput() override { return chain_.expected(); }
  Signals outputDerivative(int /*k*/) override { return {}; }
  std::vector<Signals> regressorDerivatives(int /*k*/) override { return {}; }

 private:
  const Chain& chain_;
};

}  // namespace

void applyStage(Stage stage, const std::vector<SetEffect>& effects, Chain* chain) {
  for (const SetEffect& set : effects) {
    if (set.effect->stage() != stage) continue;
    chain->own_point = set.own_point;
    set.effect->apply(set.psi, chain);
  }
}

void runChain(const Polynomials& go, const ErrorBasis& basis, const std::vector<SetEffect>& effects,
              const Signals& input, Chain* chain) {
  chain->u = input;
  chain->random.clear();
  applyStage(Stage::actuator, effects, chain);
  std::vector<const SetEffect*> loop;
  for (const SetEffect& set : effects) {
    if (set.effect->stage() == Stage::loop) loop.push_back(&set);
  }
  if (loop.empty()) {
    filter(go.b, go.a, go.delay, chain->u, &chain->x);
    applyStage(Stage::plant, effects, chain);
    basis.apply(chain->x, &chain->X);
  } else {
    runLoop(go, basis, loop, chain);
    applyStage(Stage::plant, effects, chain);
  }
  applyStage(Stage::output, effects, chain);
}

std::unique_ptr<PlantResponse> ChainEvaluation::respond(const Signals& input) const {
  runChain(polynomials(), basis_, effects_, input, &chain_);
  return std::make_unique<RespondedChain>(chain_);
}

/// The free response of unknown initial states is that of the linear model: columns q^-k/(A D_F)
/// with D_F the denominator of the error basis.
void ChainEvaluation::addFreeResponse(Response* response) const {
  const VectorXd of_basis = basis_.denominator();
  const int directions =
      freeResponseDirections(polynomials(), basis_, static_cast<int>(chain_.x.cols()));
  const int duration = durationOfColumns({polynomials().a, polynomials().a, of_basis}, directions);
  Signals impulse = Signals::Zero(kLanes, duration), free, shifted;
  impulse.col(0).setOnes();
  filter(VectorXd::Ones(1), multiply(polynomials().a, of_basis), 0, impulse, &free);
  for (int k = 0; k < directions; ++k) {
    shift(k, free, &shifted);
    const auto column = static_cast<std::size_t>(k);
    whiten(shifted, response, [column](WhitenedSignals* s) { return at(&s->columns, column); });
  }
}

void ChainEvaluation::addRandom(Response* response) const {
  for (const RandomSignal& random : chain_.random) {
    const std::size_t column = response->value.columns.size();
    whitening().apply(random.z, at(&response->value.columns, column));
    VectorXd& precision = response->column_precision;
    precision.conservativeResize(precision.size() + 1);
    precision[precision.size() - 1] = 1 / random.variance;
  }
}

void ChainEvaluation::divideByDeviation(Response* response) const {
  const Signals weight = chain_.deviation.inverse();
  WhitenedSignals& value = response->value;
  value.residual *= weight;
  for (Signals& regressor : value.regressors) regressor *= weight;
  for (auto& column : value.columns)
    column = std::make_shared<Signals>(*column * weight.leftCols(column->cols()));
  value.log_jacobian += (weight.log() * block().weight).rowwise().sum();
}

void ChainEvaluation::complete(Response* response) const {
  addRandom(response);
  applyStage(Stage::noise, effects_, &chain_);
  if (chain_.deviation.size() > 0) divideByDeviation(response);
  response->value.log_jacobian += chain_.log_jacobian;
}

}  // namespace uncertainty_identification
