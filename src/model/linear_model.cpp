#include "model/linear_model.h"

#include <algorithm>

#include "math/polynomial.h"
#include "model/evaluation.h"
#include "model/filter.h"
#include "model/fused_statistics.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The simulated output x = q^-delay B/A u, and the two signals whose shifts are its derivatives
/// with respect to b_k and a_k.
struct Plant {
  Plant(const Polynomials& p, const Signals& input)
      : delay(p.delay), nb(static_cast<int>(p.b.size())) {
    filter(VectorXd::Ones(1), p.a, 0, input, &input_over_a);
    filter(p.b, VectorXd(), p.delay, input_over_a, &x);
    filter(VectorXd::Ones(1), p.a, 0, x, &x_over_a);
  }

  /// dx/db_(k+1) for k < nb, otherwise dx/da_(k-nb+1).
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

/// The plant's response with the error model's filters F T, with [b; a] as coordinates.
class FilteredResponse : public PlantResponse {
 public:
  FilteredResponse(const Polynomials& p, const ErrorBasis& basis, const Signals& input)
      : basis_(basis), plant_(p, input) {}

  Signals output() override { return plant_.x; }
  Signals outputDerivative(int k) override { return plant_.derivative(k); }
  std::vector<Signals> regressors() override { return applied(plant_.x); }
  std::vector<Signals> regressorDerivatives(int k) override {
    return applied(plant_.derivative(k));
  }

 private:
  std::vector<Signals> applied(const Signals& x) const {
    std::vector<Signals> out;
    basis_.apply(x, &out);
    return out;
  }

  const ErrorBasis& basis_;
  Plant plant_;
};

/// Evaluation with the coefficients [b; a; c; d] as coordinates.
class LinearEvaluation : public Evaluation {
 public:
  LinearEvaluation(const Polynomials& p, const ErrorBasis& basis, const EstimationOptions& options,
                   const Block& block, bool derivatives)
      : Evaluation(p, static_cast<int>(p.b.size() + p.a.size()), options, block, derivatives),
        basis_(basis) {}

 protected:
  std::unique_ptr<PlantResponse> respond(const Signals& input) const override {
    return std::make_unique<FilteredResponse>(polynomials(), basis_, input);
  }

  /// The free response of Go (1 + GDelta) for every eta: q^-j/(A D_F), j = 0..K-1, where D_F is the
  /// denominator of the basis.
  void addFreeResponse(Response* response) const override {
    const Polynomials& p = polynomials();
    const VectorXd of_basis = basis_.denominator();
    const int na = static_cast<int>(p.a.size()), nb = static_cast<int>(p.b.size());
    const int directions = freeResponseDirections(p, basis_, block().samples);
    const int duration = durationOfColumns({p.a, p.a, of_basis}, directions);
    Signals impulse = Signals::Zero(kLanes, duration), response_of_a, sensitivity, shifted;
    impulse.col(0).setOnes();
    filter(VectorXd::Ones(1), multiply(p.a, of_basis), 0, impulse, &response_of_a);
    for (int k = 0; k < directions; ++k) {
      shift(k, response_of_a, &shifted);
      const auto column = static_cast<std::size_t>(k);
      whiten(shifted, response, [column](WhitenedSignals* s) { return at(&s->columns, column); });
    }
    if (!derivatives()) return;
    filter(VectorXd::Ones(1), p.a, 0, -response_of_a, &sensitivity);
    for (int lag = 1; lag < directions + na;
         ++lag) {  // the derivative of column k to a_j depends on k + j only
      shift(lag, sensitivity, &shifted);
      const auto whitened = std::make_shared<Signals>();
      whitening().apply(shifted, whitened.get());
      for (int j = std::max(1, lag - directions + 1); j <= std::min(na, lag); ++j) {
        auto& columns = response->derivatives[static_cast<std::size_t>(nb + j - 1)].columns;
        columns.resize(static_cast<std::size_t>(directions));
        columns[static_cast<std::size_t>(lag - j)] = whitened;
      }
    }
  }

 private:
  const ErrorBasis& basis_;
};

}  // namespace

int freeResponseDirections(const Polynomials& go, const ErrorBasis& basis, int samples) {
  const int na = static_cast<int>(go.a.size()), nb = static_cast<int>(go.b.size());
  const int poles = static_cast<int>(basis.denominator().size());
  const int zeros = poles > 0 ? poles : std::max(basis.taps() - 1, 0);
  return std::min(std::max(na + poles, go.delay + nb - 1 + zeros), samples);
}

LinearModel::LinearModel(std::shared_ptr<const NominalModel> nominal, const ErrorBasis& basis,
                         const EstimationOptions& options)
    : nominal_(std::move(nominal)), basis_(basis), options_(options) {}

std::vector<std::string> LinearModel::names() const {
  std::vector<std::string> all = nominal_->names();
  if (hasCommonOffset())
    all.push_back(options_.offset_side == OffsetSide::input ? "offset_u" : "offset_y");
  return all;
}

std::vector<ParameterRole> LinearModel::roles() const {
  const std::vector<std::string> names = nominal_->names(), units = nominal_->units();
  std::vector<ParameterRole> all;
  for (std::size_t k = 0; k < names.size(); ++k)
    all.push_back({ParameterRole::Of::nominal_model, names[k], units[k], 0, "", ""});
  if (!hasCommonOffset()) return all;
  const bool at_input = options_.offset_side == OffsetSide::input;
  all.push_back({at_input ? ParameterRole::Of::input_offset : ParameterRole::Of::output_offset,
                 at_input ? "offset_u" : "offset_y", "", 0, "", ""});
  return all;
}

bool LinearModel::hasCommonOffset() const { return estimatesCommonOffset(options_); }

VectorXd LinearModel::theta(const VectorXd& parameters) const {
  return parameters.head(parameters.size() - (hasCommonOffset() ? 1 : 0));
}

double LinearModel::commonOffset(const VectorXd& parameters) const {
  return hasCommonOffset() ? parameters[parameters.size() - 1] : 0.0;
}

void LinearModel::evaluate(const Block& block, const VectorXd& parameters, bool derivatives,
                           Response* response) const {
  const VectorXd theta = this->theta(parameters);
  const Polynomials p = nominal_->polynomials(theta);
  *response = Response();
  LinearEvaluation(p, basis_, options_, block, derivatives).run(commonOffset(parameters), response);
  if (derivatives) applyJacobian(nominal_->jacobian(theta), &response->derivatives);
}

std::unique_ptr<const FusedSweep> LinearModel::prepare(const std::vector<Block>& blocks,
                                                       const VectorXd& parameters,
                                                       bool derivatives) const {
  const VectorXd theta = this->theta(parameters);
  // The sweep takes an empty Jacobian for derivatives that are not wanted.
  if (derivatives && theta.size() == 0) return nullptr;
  FusedInput input;
  input.polynomials = nominal_->polynomials(theta);
  if (derivatives) input.jacobian = nominal_->jacobian(theta);
  input.common_offset = commonOffset(parameters);
  if (estimatesInitialState(options_)) {
    int longest = 0;
    for (const Block& block : blocks) longest = std::max(longest, block.samples);
    input.states = freeResponseDirections(input.polynomials, basis_, longest);
  }
  return fusedBoxJenkins(input, basis_, options_, blocks);
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
  const double offset = commonOffset(parameters);
  const bool at_input = options_.offset_side == OffsetSide::input;
  const Plant plant(nominal_->polynomials(theta(parameters)),
                    at_input ? Signals(block.u + offset) : block.u);
  return plant.x + (at_input ? 0.0 : offset);
}

}  // namespace uncertainty_identification
