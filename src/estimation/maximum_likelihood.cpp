#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "estimation/climb.h"
#include "estimation/observed_information.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// W with W'HW = 1 for the information H; directions of little or negative curvature are bounded.
MatrixXd whitener(const MatrixXd& information) {
  const VectorXd scale = (information.diagonal().cwiseAbs().array() + 1e-12).rsqrt();
  const MatrixXd unit = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(unit);
  return scale.asDiagonal() * eigen.eigenvectors() *
         eigen.eigenvalues().cwiseAbs().cwiseMax(1e-4).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// One run of NLopt in coordinates z = origin + W x. Keeps the best point itself: NLopt reports
/// rounding limits by exceptions and may hand back another point than the best.
class Run {
 public:
  Run(const Likelihood& likelihood, const Parametrisation& parametrisation,
      const ClimbOptions& options, Climb* climb)
      : likelihood_(likelihood),
        parametrisation_(parametrisation),
        options_(options),
        climb_(climb) {}

  /// Climbs from `best` and leaves the best point there.
  void climb(ScoredPoint* best, const MatrixXd& W) {
    origin_ = best->coordinates;
    scaling_ = &W;
    best_ = best;
    nlopt::opt optimiser(nlopt::LD_LBFGS, static_cast<unsigned>(W.cols()));
    optimiser.set_max_objective(&Run::evaluate, this);
    optimiser.set_ftol_abs(0.01 * options_.tolerance);
    // a round that needs more has outgrown its whitening: a fresh one does better
    const int most = 30 + 3 * static_cast<int>(W.cols());
    optimiser.set_maxeval(
        std::max(1, std::min(most, options_.max_iterations - climb_->iterations)));
    std::vector<double> x(static_cast<std::size_t>(W.cols()), 0.0);
    double value = 0;
    try {
      optimiser.optimize(x, value);
    } catch (const nlopt::forced_stop&) {
    } catch (const nlopt::roundoff_limited&) {
    } catch (
        const std::runtime_error&) {  // L-BFGS gives up without progress: the best point stands
    }
  }

  /// Gain that a Newton step in the whitened coordinates predicts [nats].
  double predictedGain(const ScoredPoint& at) const {
    return 0.5 * (scaling_->transpose() * at.gradient).squaredNorm();
  }

 private:
  static double evaluate(const std::vector<double>& x, std::vector<double>& gradient, void* self) {
    return static_cast<Run*>(self)->evaluate(
        Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())), &gradient);
  }

  double evaluate(const VectorXd& x, std::vector<double>* gradient) {
    ScoredPoint point = scoredPoint(likelihood_, parametrisation_, origin_ + *scaling_ * x);
    if (!std::isfinite(point.log_likelihood)) {  // outside the domain: a finite wall, so that line
                                                 // searches come back
      if (!gradient->empty()) Eigen::Map<VectorXd>(gradient->data(), x.size()) = -x;
      return -1e100;
    }
    const VectorXd whitened = scaling_->transpose() * point.gradient;
    if (!gradient->empty()) Eigen::Map<VectorXd>(gradient->data(), x.size()) = whitened;
    const double value = point.log_likelihood;
    ++climb_->iterations;
    const bool better = value > best_->log_likelihood;
    if (better) {
      *best_ = std::move(point);
      climb_->trace.push_back({climb_->iterations, likelihood_.passes(), value});
      if (options_.on_iterate && !options_.on_iterate(climb_->trace.back())) {
        throw nlopt::forced_stop();
      }
      if (0.5 * whitened.squaredNorm() < 0.1 * options_.tolerance) throw nlopt::forced_stop();
    }
    return value;
  }

  const Likelihood& likelihood_;
  const Parametrisation& parametrisation_;
  const ClimbOptions& options_;
  Climb* climb_;
  VectorXd origin_;
  const MatrixXd* scaling_ = nullptr;
  ScoredPoint* best_ = nullptr;
};

void finish(const ScoredPoint& best, Termination termination, const std::string& message,
            Climb* climb) {
  climb->at = best.parameters;
  climb->log_likelihood = best.log_likelihood;
  climb->termination = termination;
  climb->message = message;
}

}  // namespace

Climb maximumLikelihood(const Likelihood& likelihood, const ModelParameters& start,
                        const ClimbOptions& options) {
  constexpr int kScoringSteps = 5, kRounds = 8;
  Climb climb;
  bool cancelled = false;
  ClimbOptions asking = options;
  asking.on_iterate = [&](const TracePoint& point) {
    cancelled = cancelled || (options.on_iterate && !options.on_iterate(point));
    return !cancelled;
  };
  ModelParameters near = scoringSteps(likelihood, start, asking, kScoringSteps, options.tolerance);
  pruneComponents(options.constraint, &near.mixture);
  const Parametrisation parametrisation(likelihood.model(), options.constraint,
                                        near.mixture.components(), options.floor);
  ScoredPoint best = scoredPoint(likelihood, parametrisation, parametrisation.toCoordinates(near));
  if (!std::isfinite(best.log_likelihood)) {
    finish(best, Termination::stalled,
           "the likelihood is not finite at the start (a model that fits without error leaves no "
           "noise to estimate)",
           &climb);
    climb.at = near;
    return climb;
  }
  climb.trace.push_back({climb.iterations, likelihood.passes(), best.log_likelihood});
  Run run(likelihood, parametrisation, asking, &climb);
  double last = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds && !cancelled; ++round) {
    const MatrixXd W = whitener(observedInformation(likelihood, parametrisation, best, false));
    run.climb(&best, W);
    if (cancelled) break;
    if (run.predictedGain(best) < options.tolerance) {
      finish(best, Termination::converged, "the gain predicted to be left fell below the tolerance",
             &climb);
      return climb;
    }
    if (climb.iterations >= options.max_iterations) {
      finish(best, Termination::iteration_limit,
             "the iteration limit was reached; raise estimation.max_iterations", &climb);
      return climb;
    }
    if (best.log_likelihood - last < options.tolerance) break;
    last = best.log_likelihood;
  }
  if (cancelled) {
    finish(best, Termination::cancelled, "cancelled", &climb);
    return climb;
  }
  finish(best, Termination::stalled,
         "the climb stopped making progress before the gradient vanished; the likelihood may be "
         "flat or its maximum lie "
         "at the edge of the parameters' domain",
         &climb);
  return climb;
}

}  // namespace uncertainty_identification
