#include "uncertainty_identification/model/linear_model.h"

#include <algorithm>

#include "fused_statistics.h"
#include "uncertainty_identification/model/filter.h"
#include "uncertainty_identification/model/noise_whitening.h"
#include "uncertainty_identification/model/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x = q^-delay B/A u and what its sensitivities to b_k and a_k are shifts of.
struct Plant {
  Plant(const Polynomials& p, const Signals& input)
      : delay(p.delay), nb(static_cast<int>(p.b.size())) {
    filter(VectorXd::Ones(1), p.a, 0, input, &input_over_a);
    filter(p.b, VectorXd(), p.delay, input_over_a, &x);
    filter(VectorXd::Ones(1), p.a, 0, x, &x_over_a);
  }

  /// dx/db_(k+1) for k < nb, dx/da_(k-nb+1) from there on.
  Signals derivative(int k) const {
    Signals out;
    if (k < nb) {
      shift(delay + k, input_over_a, &out);
    } else {
      shift(k - nb + 1, x_over_a, &out);
      out = -out;
    }
    return out;
  }

  int delay, nb;
  Signals input_over_a, x, x_over_a;
};

/// Builds the response in the coordinates of the polynomials' coefficients [b; a; c; d].
class Evaluation {
 public:
  Evaluation(const Polynomials& p, const ErrorBasis& basis, const EstimationOptions& options,
             const Block& block, bool derivatives)
      : p_(p),
        basis_(basis),
        options_(options),
        block_(block),
        derivatives_(derivatives),
        plants_(static_cast<int>(p.b.size() + p.a.size())),
        whitening_(p.c, p.d, options.noise_start,
                   options.initial_state == InitialState::discard ? options.discard_samples : 0,
                   block, derivatives),
        ones_(Signals::Ones(kLanes, block.samples)) {}

  /// Value, and derivatives to the coefficients and then to the common offset.
  void run(double offset, Response* response) {
    response->effective_samples = whitening_.effectiveSamples();
    response->value.log_jacobian = whitening_.logJacobian();
    response->derivatives.assign(
        derivatives_ ? static_cast<std::size_t>(plants_ + whitening_.parameters()) : 0, {});
    for (int j = 0; derivatives_ && j < whitening_.parameters(); ++j) {
      response->derivatives[static_cast<std::size_t>(plants_ + j)].log_jacobian =
          whitening_.logJacobianDerivatives()[static_cast<std::size_t>(j)];
    }
    const bool at_input = options_.offset_side == OffsetSide::input;
    const Plant plant(p_, at_input ? Signals(block_.u + offset) : block_.u);
    simulation(plant, at_input ? 0.0 : offset, response);
    if (options_.initial_state == InitialState::estimate) initialState(response);
    if (options_.offsets == Offsets::per_experiment) ownOffset(response);
    if (options_.offsets == Offsets::estimate && derivatives_) commonOffset(response);
    response->column_precision =
        VectorXd::Zero(static_cast<Eigen::Index>(response->value.columns.size()));
  }

 private:
  /// Whitens a raw signal into `slot` of the value and, through C and D, of the derivatives.
  template <typename Slot>
  void whiten(const Signals& raw, Response* response, const Slot& slot) {
    if (!derivatives_) {
      whitening_.apply(raw, slot(&response->value));
      return;
    }
    std::vector<Signals> to_noise;
    whitening_.apply(raw, slot(&response->value), &to_noise);
    for (std::size_t j = 0; j < to_noise.size(); ++j) {
      slot(&response->derivatives[static_cast<std::size_t>(plants_) + j])->swap(to_noise[j]);
    }
  }

  static Signals* at(std::vector<Signals>* list, std::size_t k) {
    if (list->size() <= k) list->resize(k + 1);
    return &(*list)[k];
  }

  static Signals* at(std::vector<std::shared_ptr<const Signals>>* list, std::size_t k) {
    if (list->size() <= k) list->resize(k + 1);
    auto fresh = std::make_shared<Signals>();
    (*list)[k] = fresh;
    return fresh.get();
  }

  /// Residual and regressors of dx, the change of x: -dx and F dx.
  void tangent(const Signals& dx, WhitenedSignals* out) {
    whitening_.apply(-dx, &out->residual);
    std::vector<Signals> raw;
    basis_.apply(dx, &raw);
    out->regressors.resize(raw.size());
    for (std::size_t i = 0; i < raw.size(); ++i) whitening_.apply(raw[i], &out->regressors[i]);
  }

  void simulation(const Plant& plant, double output_offset, Response* response) {
    whiten(block_.y - plant.x - output_offset, response,
           [](WhitenedSignals* s) { return &s->residual; });
    std::vector<Signals> raw;
    basis_.apply(plant.x, &raw);
    for (std::size_t i = 0; i < raw.size(); ++i) {
      whiten(raw[i], response, [i](WhitenedSignals* s) { return at(&s->regressors, i); });
    }
    for (int k = 0; derivatives_ && k < plants_; ++k) {
      tangent(plant.derivative(k), &response->derivatives[static_cast<std::size_t>(k)]);
    }
  }

  /// The free response of Go (1 + GDelta), whatever eta: q^-j/(A D_F), j = 0..K-1, with D_F the
  /// basis' denominator.
  void initialState(Response* response) {
    const VectorXd of_basis = basis_.denominator();
    const int na = static_cast<int>(p_.a.size()), nb = static_cast<int>(p_.b.size());
    const int poles = static_cast<int>(of_basis.size());
    const int zeros = poles > 0 ? poles : std::max(basis_.taps() - 1, 0);
    const int directions =
        std::min(std::max(na + poles, p_.delay + nb - 1 + zeros), block_.samples);
    Signals impulse = Signals::Zero(kLanes, block_.samples), response_of_a, sensitivity, shifted;
    impulse.col(0).setOnes();
    filter(VectorXd::Ones(1), multiply(p_.a, of_basis), 0, impulse, &response_of_a);
    for (int k = 0; k < directions; ++k) {
      shift(k, response_of_a, &shifted);
      const auto column = static_cast<std::size_t>(k);
      whiten(shifted, response, [column](WhitenedSignals* s) { return at(&s->columns, column); });
    }
    if (!derivatives_) return;
    filter(VectorXd::Ones(1), p_.a, 0, -response_of_a, &sensitivity);
    for (int lag = 1; lag < directions + na;
         ++lag) {  // column k's sensitivity to a_j depends on k + j only
      shift(lag, sensitivity, &shifted);
      const auto whitened = std::make_shared<Signals>();
      whitening_.apply(shifted, whitened.get());
      for (int j = std::max(1, lag - directions + 1); j <= std::min(na, lag); ++j) {
        auto& columns = response->derivatives[static_cast<std::size_t>(nb + j - 1)].columns;
        columns.resize(static_cast<std::size_t>(directions));
        columns[static_cast<std::size_t>(lag - j)] = whitened;
      }
    }
  }

  void ownOffset(Response* response) {
    const std::size_t column = response->value.columns.size();
    const auto slot = [column](WhitenedSignals* s) { return at(&s->columns, column); };
    if (options_.offset_side == OffsetSide::output) {
      whiten(ones_, response, slot);
      return;
    }
    const Plant plant(p_, ones_);
    whiten(plant.x, response, slot);
    for (int k = 0; derivatives_ && k < plants_; ++k) {
      whitening_.apply(plant.derivative(k),
                       slot(&response->derivatives[static_cast<std::size_t>(k)]));
    }
  }

  void commonOffset(Response* response) {
    response->derivatives.emplace_back();
    if (options_.offset_side == OffsetSide::output) {
      whitening_.apply(-ones_, &response->derivatives.back().residual);
    } else {
      tangent(Plant(p_, ones_).x, &response->derivatives.back());
    }
  }

  const Polynomials& p_;
  const ErrorBasis& basis_;
  const EstimationOptions& options_;
  const Block& block_;
  bool derivatives_;
  int plants_;  ///< number of coefficients of B and A
  NoiseWhitening whitening_;
  Signals ones_;
};

void addScaled(double factor, const Signals& from, Signals* to) {
  if (from.cols() == 0) return;
  if (to->cols() == 0) to->setZero(kLanes, from.cols());
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

/// Chain rule from polynomial coefficients (and what follows them) to theta.
void applyJacobian(const MatrixXd& jacobian, std::vector<WhitenedSignals>* derivatives) {
  if (jacobian.rows() == jacobian.cols() && jacobian.isIdentity(0)) return;
  std::vector<WhitenedSignals> combined(static_cast<std::size_t>(jacobian.cols()));
  for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
      if (jacobian(i, j) == 0) continue;
      addScaled(jacobian(i, j), (*derivatives)[static_cast<std::size_t>(i)],
                &combined[static_cast<std::size_t>(j)]);
    }
  }
  for (auto i = static_cast<std::size_t>(jacobian.rows()); i < derivatives->size(); ++i) {
    combined.push_back(std::move((*derivatives)[i]));
  }
  derivatives->swap(combined);
}

}  // namespace

LinearModel::LinearModel(std::shared_ptr<const NominalModel> nominal, const ErrorBasis& basis,
                         const EstimationOptions& options)
    : nominal_(std::move(nominal)), basis_(basis), options_(options) {}

std::vector<std::string> LinearModel::names() const {
  std::vector<std::string> all = nominal_->names();
  if (hasCommonOffset())
    all.push_back(options_.offset_side == OffsetSide::input ? "offset_u" : "offset_y");
  return all;
}

VectorXd LinearModel::theta(const VectorXd& parameters) const {
  return parameters.head(parameters.size() - (hasCommonOffset() ? 1 : 0));
}

void LinearModel::evaluate(const Block& block, const VectorXd& parameters, bool derivatives,
                           Response* response) const {
  const VectorXd theta = this->theta(parameters);
  const Polynomials p = nominal_->polynomials(theta);
  const double offset = hasCommonOffset() ? parameters[parameters.size() - 1] : 0.0;
  *response = Response();
  Evaluation(p, basis_, options_, block, derivatives).run(offset, response);
  if (derivatives) applyJacobian(nominal_->jacobian(theta), &response->derivatives);
}

bool LinearModel::fusedStatistics(const Block& block, const VectorXd& parameters, bool derivatives,
                                  Statistics* statistics) const {
  if (options_.initial_state != InitialState::zero || options_.offsets != Offsets::none ||
      basis_.kind() != BasisKind::fir || block.gaps) {
    return false;
  }
  const Polynomials p = nominal_->polynomials(parameters);
  if (options_.noise_start == NoiseStart::stationary && p.c.size() + p.d.size() > 0) return false;
  return fusedBoxJenkins(block, p, basis_.T(),
                         derivatives ? nominal_->jacobian(parameters) : MatrixXd(), statistics);
}

bool LinearModel::admissible(const VectorXd& parameters) const {
  return parameters.allFinite() && nominal_->admissible(theta(parameters));
}

VectorXd LinearModel::toUnbounded(const VectorXd& parameters) const {
  VectorXd z = parameters;
  const VectorXd own = theta(parameters);
  z.head(own.size()) = nominal_->toUnbounded(own);
  return z;
}

VectorXd LinearModel::fromUnbounded(const VectorXd& unbounded) const {
  VectorXd parameters = unbounded;
  const VectorXd own = theta(unbounded);
  parameters.head(own.size()) = nominal_->fromUnbounded(own);
  return parameters;
}

MatrixXd LinearModel::unboundedJacobian(const VectorXd& unbounded) const {
  MatrixXd jacobian = MatrixXd::Identity(unbounded.size(), unbounded.size());
  const VectorXd own = theta(unbounded);
  jacobian.topLeftCorner(own.size(), own.size()) = nominal_->unboundedJacobian(own);
  return jacobian;
}

Signals LinearModel::simulate(const Block& block, const VectorXd& parameters) const {
  const double offset = hasCommonOffset() ? parameters[parameters.size() - 1] : 0.0;
  const bool at_input = options_.offset_side == OffsetSide::input;
  const Plant plant(nominal_->polynomials(theta(parameters)),
                    at_input ? Signals(block.u + offset) : block.u);
  return plant.x + (at_input ? 0.0 : offset);
}

}  // namespace uncertainty_identification
