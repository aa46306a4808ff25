#include "model/evaluation.h"

#include <algorithm>
#include <cmath>

#include "math/constants.h"
#include "model/filter.h"
#include "model/shared_signal.h"

namespace uncertainty_identification {
namespace {

void addScaled(double factor, const Signals& from, Signals* to) {
  if (from.cols() == 0) return;
  if (to->cols() < from.cols()) *to = withZerosUntil(from.cols(), *to);
  addShifted(factor, 0, from, to);
}

void addScaled(double factor, const WhitenedSignals& from, WhitenedSignals* to) {
  addScaled(factor, from.residual, &to->residual);
  if (to->regressors.size() < from.regressors.size()) to->regressors.resize(from.regressors.size());
  for (std::size_t i = 0; i < from.regressors.size(); ++i)
    addScaled(factor, from.regressors[i], &to->regressors[i]);
  if (to->columns.size() < from.columns.size()) to->columns.resize(from.columns.size());
  for (std::size_t k = 0; k < from.columns.size(); ++k) {
    if (from.columns[k] == nullptr) continue;
    const auto sum = std::make_shared<Signals>();
    if (to->columns[k] != nullptr) *sum = *to->columns[k];
    addScaled(factor, *from.columns[k], sum.get());
    to->columns[k] = sum;
  }
  to->log_jacobian += factor * from.log_jacobian;
}

/// The coordinate that only column j of a Jacobian depends on, and by the factor 1, so that its
/// signals can be moved; -1 if there is none.
Eigen::Index coordinateOf(const Eigen::MatrixXd& jacobian, Eigen::Index j) {
  for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
    if (jacobian(i, j) == 1 && (jacobian.row(i).array() != 0).count() == 1) return i;
  }
  return -1;
}

}  // namespace

std::shared_ptr<const NoiseWhitening> whiteningOf(const Polynomials& polynomials,
                                                  const EstimationOptions& options,
                                                  const Block& block, bool derivatives) {
  const bool discard = options.initial_state == InitialState::discard;
  return std::make_shared<NoiseWhitening>(polynomials.c, polynomials.d, options.noise_start,
                                          discard ? options.discard_samples : 0, block,
                                          derivatives);
}

bool estimatesInitialState(const EstimationOptions& options) {
  return options.initial_state == InitialState::estimate ||
         options.initial_state == InitialState::automatic;
}

bool estimatesCommonOffset(const EstimationOptions& options) {
  return options.offsets == Offsets::estimate || options.offsets == Offsets::automatic;
}

double samplesOfPrior(const EstimationOptions& options) {
  return options.initial_variance > 0 && options.initial_precision > 0 ? 1 : 0;
}

double logOfPrior(const EstimationOptions& options) {
  if (samplesOfPrior(options) == 0) return 0;
  return 0.5 * std::log(2 * kPi * options.initial_variance * options.initial_precision);
}

Evaluation::Evaluation(const Polynomials& polynomials, int plant_coordinates,
                       const EstimationOptions& options, const Block& block, bool derivatives)
    : polynomials_(polynomials),
      plant_coordinates_(plant_coordinates),
      options_(options),
      block_(block),
      derivatives_(derivatives),
      whitening_(whiteningOf(polynomials, options, block, derivatives)),
      ones_(Signals::Ones(kLanes, block.samples)) {}

Evaluation::Evaluation(const Polynomials& polynomials, const EstimationOptions& options,
                       const Block& block, std::shared_ptr<const NoiseWhitening> whitening)
    : polynomials_(polynomials),
      plant_coordinates_(0),
      options_(options),
      block_(block),
      derivatives_(false),
      whitening_(std::move(whitening)),
      ones_(Signals::Ones(kLanes, block.samples)) {}

void Evaluation::run(double offset, Response* response) {
  response->effective_samples = whitening_->effectiveSamples();
  response->value.log_jacobian = whitening_->logJacobian();
  response->derivatives.assign(
      derivatives_ ? static_cast<std::size_t>(plant_coordinates_ + whitening_->parameters()) : 0,
      {});
  for (int j = 0; derivatives_ && j < whitening_->parameters(); ++j) {
    response->derivatives[static_cast<std::size_t>(plant_coordinates_ + j)].log_jacobian =
        whitening_->logJacobianDerivatives()[static_cast<std::size_t>(j)];
  }
  const bool at_input = options_.offset_side == OffsetSide::input;
  addOutput(at_input ? Signals(block_.u + offset) : block_.u, at_input ? 0.0 : offset, response);
  if (estimatesInitialState(options_)) addFreeResponse(response);
  if (options_.offsets == Offsets::per_experiment) addOwnOffset(response);
  if (estimatesCommonOffset(options_) && derivatives_) addCommonOffset(response);
  const auto columns = static_cast<Eigen::Index>(response->value.columns.size());
  response->column_precision =
      Eigen::VectorXd::Constant(columns, std::max(0.0, options_.initial_precision));
  if (at_input && options_.offsets == Offsets::per_experiment)
    response->column_precision[columns - 1] = 0;  // in units of u: the prior is stated for y
  const auto wide = static_cast<double>((response->column_precision.array() > 0).count());
  response->effective_samples -= wide * samplesOfPrior(options_);
  response->value.log_jacobian -= wide * logOfPrior(options_);
}

int Evaluation::durationOfColumns(std::vector<Eigen::VectorXd> denominators, int directions) const {
  denominators.insert(denominators.end(), 2, polynomials_.c);
  int missing = 0;  // samples at which the noise model's state does not decay by C
  for (int lane = 0; block_.gaps && lane < block_.lanes; ++lane) {
    const int length = block_.lengths[static_cast<std::size_t>(lane)];
    const auto measured = static_cast<int>(block_.weight.row(lane).sum());
    missing = std::max(missing, length - measured);
  }
  const int decay = decayOf(denominators, block_.samples);
  return std::min(block_.samples,
                  decay + directions + static_cast<int>(polynomials_.d.size()) + missing);
}

Signals* Evaluation::at(std::vector<Signals>* list, std::size_t k) {
  if (list->size() <= k) list->resize(k + 1);
  return &(*list)[k];
}

Signals* Evaluation::at(std::vector<std::shared_ptr<const Signals>>* list, std::size_t k) {
  if (list->size() <= k) list->resize(k + 1);
  auto fresh = std::make_shared<Signals>();
  (*list)[k] = fresh;
  return fresh.get();
}

/// Whitens the derivative of a plant's response: the residual changes by minus the output, the
/// regressors by theirs.
void Evaluation::whitenTangent(const Signals& output, const std::vector<Signals>& regressors,
                               WhitenedSignals* out) const {
  whitening_->apply(-output, &out->residual);
  out->regressors.resize(regressors.size());
  for (std::size_t i = 0; i < regressors.size(); ++i)
    whitening_->apply(regressors[i], &out->regressors[i]);
}

void Evaluation::addOutput(const Signals& input, double output_offset, Response* response) const {
  const std::unique_ptr<PlantResponse> plant = respond(input);
  whiten(block_.y - plant->output() - output_offset, response,
         [](WhitenedSignals* s) { return &s->residual; });
  const std::vector<Signals> regressors = plant->regressors();
  for (std::size_t i = 0; i < regressors.size(); ++i) {
    whiten(regressors[i], response, [i](WhitenedSignals* s) { return at(&s->regressors, i); });
  }
  for (int k = 0; derivatives_ && k < plant_coordinates_; ++k) {
    whitenTangent(plant->outputDerivative(k), plant->regressorDerivatives(k),
                  &response->derivatives[static_cast<std::size_t>(k)]);
  }
}

void Evaluation::addOwnOffset(Response* response) const {
  const std::size_t column = response->value.columns.size();
  const auto slot = [column](WhitenedSignals* s) { return at(&s->columns, column); };
  if (options_.offset_side == OffsetSide::output) {
    whiten(ones_, response, slot);
    return;
  }
  const std::unique_ptr<PlantResponse> plant = respond(ones_);
  whiten(plant->expectedOutput(), response, slot);
  for (int k = 0; derivatives_ && k < plant_coordinates_; ++k) {
    whitening_->apply(plant->expectedOutputDerivative(k),
                      slot(&response->derivatives[static_cast<std::size_t>(k)]));
  }
}

void Evaluation::addCommonOffset(Response* response) const {
  response->derivatives.emplace_back();
  if (options_.offset_side == OffsetSide::output) {
    whitening_->apply(-ones_, &response->derivatives.back().residual);
  } else {
    const std::unique_ptr<PlantResponse> plant = respond(ones_);
    whitenTangent(plant->output(), plant->regressors(), &response->derivatives.back());
  }
}

void applyJacobian(const Eigen::MatrixXd& jacobian, std::vector<WhitenedSignals>* derivatives) {
  if (jacobian.rows() == jacobian.cols() && jacobian.isIdentity(0)) return;
  std::vector<WhitenedSignals> combined(static_cast<std::size_t>(jacobian.cols()));
  for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
    WhitenedSignals& sum = combined[static_cast<std::size_t>(j)];
    const Eigen::Index own = coordinateOf(jacobian, j);
    if (own >= 0) sum = std::move((*derivatives)[static_cast<std::size_t>(own)]);
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
      if (jacobian(i, j) == 0 || i == own) continue;
      addScaled(jacobian(i, j), (*derivatives)[static_cast<std::size_t>(i)], &sum);
    }
  }
  for (auto i = static_cast<std::size_t>(jacobian.rows()); i < derivatives->size(); ++i) {
    combined.push_back(std::move((*derivatives)[i]));
  }
  derivatives->swap(combined);
}

}  // namespace uncertainty_identification
