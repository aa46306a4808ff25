#include "model/sensitivity_model.h"

#include <algorithm>

#include "model/column_coefficients.h"
#include "model/evaluation.h"
#include "model/filter.h"
#include "model/plant_derivatives.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The plants of a block: at the common theta, or each at the point of its experiment.
struct LanePlants {
  VectorXd theta;                        ///< the common parameters
  MatrixXd points;                       ///< t_r of each lane (n x lanes); empty: all at theta
  MatrixXd start;                        ///< zeta_r of each lane; empty: zero
  std::vector<PlantCoefficients> lanes;  ///< coefficients at theta or t_r

  bool areApart() const { return points.cols() > 0; }

  /// Whether theta_l has its own value in each lane, which does not change with the common theta.
  bool areApart(const SensitivityTerms& terms, int l) const {
    return areApart() && std::any_of(terms.indices.begin(), terms.indices.end(),
                                     [l](const auto& term) { return term.front() == l; });
  }

  /// theta_j - t_rj, if term i is that of theta_j.
  Lanes distance(int i, int j) const {
    Lanes values = Lanes::Zero();
    values.head(points.cols()) = theta[j] - points.row(i).transpose().array();
    return values;
  }
};

/// The response with theta as coordinates. theta includes the parameters of H, on which it does not
/// depend.
class SensitivityResponse : public PlantResponse {
 public:
  SensitivityResponse(const SensitivityTerms& terms, LanePlants* at, const Signals& input)
      : terms_(terms), at_(*at), plant_(&at->lanes, input, at->start) {}

  Signals output() override { return expanded({}); }
  Signals outputDerivative(int l) override {
    return isApart(l) ? plant_.signal({l}) : expanded({l});
  }

  std::vector<Signals> regressors() override {
    std::vector<Signals> all;
    all.reserve(terms_.indices.size());
    for (int i = 0; i < terms_.count(); ++i)
      all.push_back(terms_.scale(i, at_.theta) * plant_.signal(term(i)));
    return all;
  }

  std::vector<Signals> regressorDerivatives(int l) override {
    std::vector<Signals> all;
    for (int i = 0; i < terms_.count(); ++i) {
      const double of_scale = terms_.scaleDerivative(i, l, at_.theta);
      const double scale = terms_.scale(i, at_.theta);
      if (isApart(l)) {
        all.push_back(of_scale * plant_.signal(term(i)));
      } else if (of_scale == 0) {
        all.push_back(scale * plant_.signal(with(term(i), l)));
      } else {
        all.push_back(of_scale * plant_.signal(term(i)) + scale * plant_.signal(with(term(i), l)));
      }
    }
    return all;
  }

  Signals expectedOutput() override { return plant_.signal({}); }
  Signals expectedOutputDerivative(int l) override {
    return isApart(l) ? Signals(Signals::Zero(kLanes, plant_.signal({}).cols()))
                      : plant_.signal({l});
  }

 private:
  const std::vector<int>& term(int i) const { return terms_.indices[static_cast<std::size_t>(i)]; }

  bool isApart(int l) const { return at_.areApart(terms_, l); }

  /// The linearised x_S at theta: x_S + sum_j x_Sj (theta_j - t_rj), with x_S and x_Sj at t_r.
  Signals expanded(const DerivativeIndex& index) {
    Signals sum = plant_.signal(index);
    for (int i = 0; at_.areApart() && i < terms_.count(); ++i) {
      const int j = term(i).front();
      sum += plant_.signal(with(index, j)).colwise() * at_.distance(i, j);
    }
    return sum;
  }

  const SensitivityTerms& terms_;
  const LanePlants& at_;
  PlantDerivatives plant_;
};

int freeDirections(const PlantCoefficients& go, int power) {
  const int na = static_cast<int>(go.na()), nb = static_cast<int>(go.nb());
  return std::max(power * na, go.delay() + nb - 1 + (power - 1) * na);
}

/// Evaluation with [theta; c; d] as coordinates; theta acts here through Go only.
class SensitivityEvaluation : public Evaluation {
 public:
  /// The free response has the denominator A^power.
  SensitivityEvaluation(const Polynomials& p, const SensitivityTerms& terms, LanePlants* at,
                        int power, const EstimationOptions& options, const Block& block,
                        bool derivatives)
      : Evaluation(p, static_cast<int>(at->theta.size()), options, block, derivatives),
        terms_(terms),
        at_(at),
        power_(power) {}

 protected:
  std::unique_ptr<PlantResponse> respond(const Signals& input) const override {
    return std::make_unique<SensitivityResponse>(terms_, at_, input);
  }

  /// The columns q^-k/A^power, k = 0, 1, ... span the free responses for every xi, up to the order
  /// of the terms.
  void addFreeResponse(Response* response) const override {
    const PlantCoefficients& go = at_->lanes.front();
    const int directions = std::min(freeDirections(go, power_), block().samples);
    Signals free = Signals::Zero(kLanes, durationOfColumns(directions)), shifted;
    free.col(0).setOnes();
    PlantDerivatives plant(&at_->lanes, free);
    for (int m = 0; m < power_; ++m) plant.divideByA(&free);
    const auto put = [&](const Signals& signal, int k) {
      shift(k, signal, &shifted);
      return static_cast<std::size_t>(k);
    };
    for (int k = 0; k < directions; ++k) {
      const std::size_t column = put(free, k);
      whiten(shifted, response, [column](WhitenedSignals* s) { return at(&s->columns, column); });
    }
    for (int l = 0; derivatives() && l < plantCoordinates(); ++l) {
      if (at_->areApart(terms_, l)) continue;
      Signals change = -power_ * plant.timesA({l}, free);
      plant.divideByA(&change);
      if ((change == 0).all()) continue;
      auto& columns = response->derivatives[static_cast<std::size_t>(l)].columns;
      for (int k = 0; k < directions; ++k) whitening().apply(shifted, at(&columns, put(change, k)));
    }
  }

 private:
  /// That of the slowest lane.
  int durationOfColumns(int directions) const {
    int longest = 0;
    for (const PlantCoefficients& go : at_->lanes) {
      if (longest == block().samples) break;
      const std::vector<VectorXd> powers(static_cast<std::size_t>(power_) + 1, go.a());
      longest = std::max(longest, Evaluation::durationOfColumns(powers, directions));
    }
    return longest;
  }

  const SensitivityTerms& terms_;
  LanePlants* at_;
  int power_;
};

/// d[theta; c; d]/dtheta.
MatrixXd withNoise(const MatrixXd& jacobian, const Polynomials& p) {
  const Index own = jacobian.cols(), noise = p.c.size() + p.d.size();
  MatrixXd all(own + noise, own);
  all << MatrixXd::Identity(own, own), jacobian.bottomRows(noise);
  return all;
}

}  // namespace

SensitivityModel::SensitivityModel(std::shared_ptr<const NominalModel> nominal,
                                   const ErrorModelOptions& error_model,
                                   const EstimationOptions& options, MatrixXd points)
    : LinearModel(std::move(nominal), ErrorBasis(error_model), options),
      error_model_(error_model),
      terms_(sensitivityTerms(this->nominal(), error_model)),
      points_(std::move(points)) {}

/// theta with the varied entries replaced by those of a point.
VectorXd SensitivityModel::at(const VectorXd& point, const VectorXd& theta) const {
  VectorXd own = theta;
  for (int i = 0; i < terms_.count(); ++i)
    own[terms_.indices[static_cast<std::size_t>(i)].front()] = point[i];
  return own;
}

void SensitivityModel::evaluate(const Block& block, const VectorXd& parameters, bool derivatives,
                                Response* response) const {
  LanePlants plants{theta(parameters), {}, {}, {}};
  if (points_.cols() == 0) {
    plants.lanes.emplace_back(nominal(), plants.theta);
  } else {
    const Index n = terms_.count();
    plants.points.resize(n, block.lanes);
    plants.start.resize(points_.rows() - n, block.lanes);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const auto own = points_.col(block.index[static_cast<std::size_t>(lane)]);
      plants.points.col(lane) = own.head(n);
      plants.start.col(lane) = own.tail(points_.rows() - n);
      plants.lanes.emplace_back(nominal(), at(plants.points.col(lane), plants.theta));
    }
  }
  const Polynomials p = nominal().polynomials(plants.theta);
  const int power =
      error_model_.basis == BasisKind::parameter_spread ? 1 : 1 + error_model_.sensitivity_order;
  *response = Response();
  SensitivityEvaluation(p, terms_, &plants, power, options(), block, derivatives)
      .run(commonOffset(parameters), response);
  if (derivatives)
    applyJacobian(withNoise(nominal().jacobian(plants.theta), p), &response->derivatives);
}

std::unique_ptr<const FusedSweep> SensitivityModel::prepare(const std::vector<Block>& /*blocks*/,
                                                            const VectorXd& /*parameters*/,
                                                            bool /*derivatives*/) const {
  return nullptr;
}

bool SensitivityModel::admissible(const VectorXd& parameters) const {
  if (!LinearModel::admissible(parameters)) return false;
  const VectorXd common = theta(parameters);
  for (Index r = 0; r < points_.cols(); ++r) {
    if (!nominal().admissible(at(points_.col(r), common))) return false;
  }
  return true;
}

bool SensitivityModel::isLocallyLinear() const {
  return error_model_.basis == BasisKind::parameter_spread;
}

MatrixXd SensitivityModel::points(const VectorXd& parameters, const MatrixXd& xi) const {
  const VectorXd common = theta(parameters);
  MatrixXd all = (1 + xi.array()).matrix();
  for (int i = 0; i < terms_.count(); ++i)
    all.row(i) *= common[terms_.indices[static_cast<std::size_t>(i)].front()];
  return all;
}

bool SensitivityModel::knowsStart() const {
  const bool at_input =
      options().offsets != Offsets::none && options().offset_side == OffsetSide::input;
  return isLocallyLinear() && estimatesInitialState(options()) && !at_input;
}

MatrixXd SensitivityModel::pointsOf(const std::vector<Block>& blocks, const VectorXd& parameters,
                                    const MatrixXd& xi) const {
  const MatrixXd of_xi = points(parameters, xi);
  if (!knowsStart()) return of_xi;
  const Index n = of_xi.rows();
  PlantCoefficients go(nominal(), theta(parameters));
  const int directions = freeDirections(go, 1);
  MatrixXd all = MatrixXd::Zero(n + directions, of_xi.cols());
  all.topRows(n) = of_xi;
  if (points_.rows() > n) all.bottomRows(directions) = points_.bottomRows(directions);
  for (const Block& block : blocks) {
    Response response;
    evaluate(block, parameters, false, &response);
    const MatrixXd zeta =
        columnCoefficients(response, unexplainedBy(response, block, xi), block.lanes);
    const Index known = std::min<Index>(directions, block.samples);
    for (int lane = 0; lane < block.lanes; ++lane)
      all.col(block.index[static_cast<std::size_t>(lane)]).segment(n, known) +=
          zeta.col(lane).head(known);
  }
  return all;
}

MatrixXd SensitivityModel::firstPoints(const std::vector<Block>& blocks, const VectorXd& parameters,
                                       int experiments) const {
  return pointsOf(blocks, parameters, MatrixXd::Zero(regressors(), experiments));
}

std::unique_ptr<LinearModel> SensitivityModel::linearisedAbout(const MatrixXd& points) const {
  auto model = std::make_unique<SensitivityModel>(*this);
  model->points_ = points;
  return model;
}

std::unique_ptr<LinearModel> makeLinearModel(std::shared_ptr<const NominalModel> nominal,
                                             const ErrorModelOptions& error_model,
                                             const EstimationOptions& options) {
  if (variesParameters(error_model.basis) && error_model.taps != 0)
    return std::make_unique<SensitivityModel>(std::move(nominal), error_model, options);
  return std::make_unique<LinearModel>(std::move(nominal), ErrorBasis(error_model), options);
}

}  // namespace uncertainty_identification
