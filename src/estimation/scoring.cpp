#include "estimation/scoring.h"

#include <Eigen/Cholesky>

#include "estimation/stopwatch.h"

namespace uncertainty_identification {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::optional<VectorXd> Damping::step(const MatrixXd& information, const VectorXd& gradient,
                                      const std::function<bool(const VectorXd&)>& improves) {
  constexpr int kAttempts = 12;
  const VectorXd diagonal = information.diagonal().cwiseAbs().array() + 1e-300;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    MatrixXd damped = information;
    damped.diagonal() += lambda_ * diagonal;
    const Eigen::LLT<MatrixXd> factor(damped);
    if (factor.info() == Eigen::Success) {
      const VectorXd step = factor.solve(gradient);
      if (step.allFinite() && improves(step)) {
        lambda_ = std::max(lambda_ / 8, 1e-9);
        return step;
      }
    }
    lambda_ = std::max(lambda_ * 8, 1e-6);
  }
  return {};
}

namespace {

/// A point of the scoring iteration with its statistics and its log-likelihood.
class Scoring {
 public:
  Scoring(const Likelihood& likelihood, ModelParameters start, const OptimisationOptions& options,
          double tolerance)
      : likelihood_(likelihood),
        options_(options),
        tolerance_(tolerance),
        theta_(likelihood.model().parameterCount()),
        means_(likelihood.model().regressors()),
        shifts_(options.constraint != Constraint::zero_mean && means_ > 0),
        point_(std::move(start)),
        statistics_(likelihood.statistics(point_.parameters, true)) {
    fitMixture();
  }

  const ModelParameters& point() const { return point_; }
  double reached() const { return reached_; }

  /// Number of coordinates: theta, and the means' common shift where the constraint allows one.
  Eigen::Index size() const { return shifts_ ? theta_ + means_ : theta_; }

  /// One step; what it did, without the number of the iteration.
  TracePoint step() {
    const Stopwatch watch;
    const Expectation e = likelihood_.expect(statistics_, point_);
    const VectorXd gradient = gradientOf(scores(statistics_, point_, e).rowwise().sum());
    const MatrixXd information =
        likelihood_.information(point_, latentMoments(e)).observed.topLeftCorner(size(), size());
    failures_ = 0;
    const auto step = damping_.step(information, gradient,
                                    [this](const VectorXd& along) { return improves(along); });
    with_derivatives_ = failures_ == 0;
    if (step) fitMixture();
    return {
        0, likelihood_.passes(), reached_,
        StepSummary{step ? step->norm() : 0.0, gradient.norm(), step.has_value(), watch.seconds()}};
  }

 private:
  VectorXd gradientOf(const VectorXd& score) const {
    VectorXd gradient(size());
    gradient.head(theta_) = score.head(theta_);
    if (!shifts_) return gradient;
    gradient.tail(means_).setZero();
    const int kappa = point_.mixture.components();
    for (int i = 0; i < kappa; ++i)
      gradient.tail(means_) += score.segment(theta_ + kappa + i * means_, means_);
    return gradient;
  }

  /// Moves there if the log-likelihood is no lower. Derivatives cost several times the value: after
  /// a trial that failed they are computed only where one succeeds.
  bool improves(const VectorXd& step) {
    ModelParameters trial = point_;
    trial.parameters += step.head(theta_);
    for (VectorXd& mean : trial.mixture.means) {
      if (shifts_) mean += step.tail(means_);
    }
    if (!likelihood_.model().admissible(trial.parameters)) return false;
    const bool with_derivatives = with_derivatives_ && failures_ == 0;
    Statistics there = likelihood_.statistics(trial.parameters, with_derivatives);
    if (!(likelihood_.expect(there, trial).total() >= reached_)) {
      ++failures_;
      return false;
    }
    if (!with_derivatives) there = likelihood_.statistics(trial.parameters, true);
    point_ = std::move(trial);
    statistics_ = std::move(there);
    return true;
  }

  void fitMixture() {
    constexpr int kMixtureSteps = 10;
    reached_ = uncertainty_identification::fitMixture(likelihood_, statistics_, options_,
                                                      kMixtureSteps, tolerance_, &point_);
  }

  const Likelihood& likelihood_;
  const OptimisationOptions& options_;
  double tolerance_;
  Eigen::Index theta_, means_;
  bool shifts_;
  ModelParameters point_;
  Statistics statistics_;
  double reached_ = 0;
  Damping damping_;
  int failures_ = 0;              ///< trials of this step that were evaluated and did not gain
  bool with_derivatives_ = true;  ///< the step before had no such trial
};

}  // namespace

ModelParameters scoringSteps(const Likelihood& likelihood, ModelParameters start,
                             const OptimisationOptions& options, int steps, double tolerance,
                             double* log_likelihood) {
  Scoring scoring(likelihood, std::move(start), options, tolerance);
  for (int k = 1; k <= steps && scoring.size() > 0; ++k) {
    const double before = scoring.reached();
    TracePoint done = scoring.step();
    done.iteration = k;
    const bool cancelled = options.on_iterate && !options.on_iterate(done);
    if (cancelled || !done.step->accepted || done.log_likelihood - before < tolerance) break;
  }
  if (log_likelihood != nullptr) *log_likelihood = scoring.reached();
  return scoring.point();
}

}  // namespace uncertainty_identification
