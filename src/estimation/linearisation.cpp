#include "estimation/linearisation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// `target`, or the first point on the line from there to `point` (halving the distance) at which
/// the model is defined.
VectorXd towards(const LinearModel& model, const VectorXd& parameters, const VectorXd& point,
                 const VectorXd& target) {
  constexpr int kHalvings = 10;
  VectorXd step = target - point;
  for (int k = 0; k < kHalvings && step.allFinite(); ++k, step /= 2) {
    if (model.linearisedAbout(point + step)->admissible(parameters)) return point + step;
  }
  return point;
}

/// The change of the points in standard deviations of the mixture; empty without error parameters,
/// when all experiments have the same plant.
MatrixXd stepOf(const LinearModel& model, const ModelParameters& at, const MatrixXd& from,
                const MatrixXd& to) {
  if (to.size() == 0) return {};
  const VectorXd deviation = at.mixture.covariance().diagonal().cwiseMax(0).cwiseSqrt();
  const VectorXd unit =
      model.pointDeviations(at.parameters, at.noise_variance, deviation).cwiseMax(1e-300);
  const Index n = unit.size();  // initial values below the points have no deviation
  return unit.cwiseInverse().asDiagonal() * (to.topRows(n) - from.topRows(n));
}

}  // namespace

bool FixedPointProgress::approaches(double log_likelihood, double move) {
  slows_down_ = move < last_move_;
  last_move_ = move;
  const bool better = log_likelihood > highest_ || move < least_move_;
  highest_ = std::max(highest_, log_likelihood);
  least_move_ = std::min(least_move_, move);
  if (better)
    in_vain_ = 0;
  else if (!slows_down_)
    ++in_vain_;
  return in_vain_ < kPatience;
}

double StepShare::of(const MatrixXd& step) {
  constexpr double kHardlySmaller = 0.7, kOtherWay = 0.7, kLeast = 0.125;
  if (step.size() == last_.size() && step.size() > 0) {
    const double before = last_.norm(), now = step.norm();
    const double cosine = (step.array() * last_.array()).sum() / std::max(before * now, 1e-300);
    if (now > kHardlySmaller * before && cosine < kOtherWay) share_ = std::max(share_ / 2, kLeast);
  }
  last_ = step;
  return share_;
}

Linearisation nextLinearisation(const LinearModel& model, const Likelihood& likelihood,
                                const ModelParameters& point, const MatrixXd& points,
                                StepShare* share) {
  const Statistics statistics = likelihood.statistics(point.parameters, false);
  const MatrixXd means = latentMoments(likelihood.expect(statistics, point)).means;
  Linearisation next;
  next.points = model.pointsOf(likelihood.blocks(), point.parameters, means);
  next.model = model.linearisedAbout(next.points);
  if (!next.points.allFinite() || !next.model->admissible(point.parameters)) {
    for (Index r = 0; r < points.cols(); ++r)
      next.points.col(r) = towards(model, point.parameters, points.col(r), next.points.col(r));
    next.model = model.linearisedAbout(next.points);
  }
  const MatrixXd step = stepOf(model, point, points, next.points);
  next.move = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0;
  const double part = share->of(step);
  if (part < 1) {
    const MatrixXd between = points + part * (next.points - points);
    std::unique_ptr<LinearModel> damped = model.linearisedAbout(between);
    if (damped->admissible(point.parameters)) {
      next.points = between;
      next.model = std::move(damped);
    }
  }
  return next;
}

std::unique_ptr<LinearModel> linearisedAtStart(const LinearModel& model,
                                               const std::vector<Block>& blocks, int experiments,
                                               const VectorXd& parameters) {
  if (!model.isLocallyLinear()) return nullptr;
  const MatrixXd points = model.firstPoints(blocks, parameters, experiments);
  const MatrixXd without_start = model.points(parameters, MatrixXd::Zero(model.regressors(), 1));
  if (points.rows() == without_start.rows()) return nullptr;
  return model.linearisedAbout(points);
}

std::optional<Linearisation> linearisedAtPosteriorMeans(const LinearModel& model,
                                                        const std::vector<Block>& blocks,
                                                        int experiments, int threads,
                                                        const ModelParameters& point, int* passes,
                                                        const MatrixXd& from) {
  constexpr int kMostSteps = 50;
  if (!model.isLocallyLinear()) return {};
  Linearisation now;
  now.points = from.size() > 0 ? from : model.firstPoints(blocks, point.parameters, experiments);
  now.model = model.linearisedAbout(now.points);
  now.move = 1;
  StepShare share;
  for (int k = 0; k < kMostSteps && now.move >= kFixedPointTolerance; ++k) {
    const Likelihood likelihood(*now.model, blocks, experiments, threads);
    Linearisation next = nextLinearisation(*now.model, likelihood, point, now.points, &share);
    *passes += likelihood.passes();
    now = std::move(next);
  }
  return now;
}

MatrixXd pointsAt(const LinearModel& model, const std::vector<Block>& blocks,
                  const VectorXd& parameters, const MatrixXd& xi) {
  return model.linearisedAbout(model.points(parameters, xi))->pointsOf(blocks, parameters, xi);
}

double logLikelihoodAtPoints(const LinearModel& model, const Likelihood& likelihood,
                             const ModelParameters& point, const MatrixXd& points) {
  const Expectation expected =
      likelihood.expect(likelihood.statistics(point.parameters, false), point);
  const Index n = model.regressors();
  if (points.size() == 0 || n == 0) return expected.total();
  const LatentMoments moments = latentMoments(expected);
  const MatrixXd& means = moments.means;
  const MatrixXd of_zero = model.points(point.parameters, 0 * means).topRows(n);
  const MatrixXd of_one =
      model.points(point.parameters, MatrixXd::Ones(n, means.cols())).topRows(n);
  // A parameter of zero does not vary, whatever xi is.
  const Eigen::ArrayXXd scale = (of_one - of_zero).array();
  const MatrixXd xi = (scale == 0)
                          .select(means.array(), (points.topRows(n) - of_zero).array() /
                                                     (scale == 0).select(1.0, scale));
  double beyond = 0;
  for (Index r = 0; r < means.cols(); ++r) {
    const Eigen::Map<const MatrixXd> covariance(moments.covariances.col(r).data(), n, n);
    const VectorXd distance = means.col(r) - xi.col(r);
    beyond += distance.dot(covariance.ldlt().solve(distance)) / 2;
  }
  return expected.total() - beyond;
}

}  // namespace uncertainty_identification
