#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "estimation/observed_information.h"
#include "estimation/scoring.h"
#include "estimation/stopwatch.h"
#include "math/interruption.h"
#include "math/symmetric_eigen.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// W with W'HW = 1 for the information H; directions of little or negative curvature are bounded.
MatrixXd whitener(const MatrixXd& information) {
  const VectorXd scale = (information.diagonal().cwiseAbs().array() + 1e-12).rsqrt();
  const MatrixXd unit = scale.asDiagonal() * information * scale.asDiagonal();
  const SymmetricEigen eigen(unit);
  return scale.asDiagonal() * eigen.eigenvectors() *
         eigen.eigenvalues().cwiseAbs().cwiseMax(1e-4).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Rounds of NLopt's L-BFGS in coordinates z = origin + W x. Keeps the best point itself: NLopt
/// reports rounding limits by exceptions and may return another point than the best.
class QuasiNewton {
 public:
  QuasiNewton(const Likelihood& likelihood, const Parametrisation& parametrisation,
              const OptimisationOptions& options, ScoredPoint start, Optimum* optimum)
      : likelihood_(likelihood),
        parametrisation_(parametrisation),
        options_(options),
        best_(std::move(start)),
        optimum_(optimum) {}

  const ScoredPoint& best() const { return best_; }

  /// Maximises from the best point, in coordinates whitened there.
  void round() {
    origin_ = best_.coordinates;
    scaling_ = whitener(observedInformation(likelihood_, parametrisation_, best_, false));
    nlopt::opt optimiser(nlopt::LD_LBFGS, static_cast<unsigned>(scaling_.cols()));
    optimiser.set_max_objective(&QuasiNewton::evaluate, this);
    optimiser.set_ftol_abs(0.01 * options_.tolerance);
    // a round that needs more evaluations has left the region where its whitening is valid
    const int most = 30 + 3 * static_cast<int>(scaling_.cols());
    optimiser.set_maxeval(std::min(most, options_.max_iterations - optimum_->iterations));
    std::vector<double> x(static_cast<std::size_t>(scaling_.cols()), 0.0);
    double value = 0;
    try {
      optimiser.optimize(x, value);
    } catch (const nlopt::forced_stop&) {
    } catch (const nlopt::roundoff_limited&) {
    } catch (const std::runtime_error&) {  // no progress: the best point so far is kept
    }
    checkpoint();  // NLopt turns CancelledError into an exception of its own
  }

  /// Gain that a Newton step in the whitened coordinates predicts [nats].
  double predictedGain() const {
    return 0.5 * (scaling_.transpose() * best_.gradient).squaredNorm();
  }

 private:
  static double evaluate(const std::vector<double>& x, std::vector<double>& gradient, void* self) {
    return static_cast<QuasiNewton*>(self)->evaluate(
        Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())), &gradient);
  }

  double evaluate(const VectorXd& x, std::vector<double>* gradient) {
    const Stopwatch watch;
    ScoredPoint point = scoredPoint(likelihood_, parametrisation_, origin_ + scaling_ * x);
    if (!std::isfinite(point.log_likelihood)) {  // outside the domain: a finite wall, so that line
                                                 // searches come back
      if (!gradient->empty()) Eigen::Map<VectorXd>(gradient->data(), x.size()) = -x;
      return -1e100;
    }
    const VectorXd whitened = scaling_.transpose() * point.gradient;
    if (!gradient->empty()) Eigen::Map<VectorXd>(gradient->data(), x.size()) = whitened;
    const double value = point.log_likelihood;
    const bool better = value > best_.log_likelihood;
    const StepSummary step{(point.coordinates - best_.coordinates).norm(), best_.gradient.norm(),
                           better, watch.seconds()};
    if (better) best_ = std::move(point);
    const TracePoint done{++optimum_->iterations, likelihood_.passes(), best_.log_likelihood, step};
    const bool converged = better && 0.5 * whitened.squaredNorm() < 0.1 * options_.tolerance;
    if (!options_.on_iterate(done) || converged) throw nlopt::forced_stop();
    return value;
  }

  const Likelihood& likelihood_;
  const Parametrisation& parametrisation_;
  const OptimisationOptions& options_;
  ScoredPoint best_;
  Optimum* optimum_;
  VectorXd origin_;
  MatrixXd scaling_;
};

/// Rounds of L-BFGS, until one ends the optimisation.
Termination maximise(const OptimisationOptions& options, const bool& cancelled, Optimum* optimum,
                     QuasiNewton* search) {
  constexpr int kRounds = 8;
  double last = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds && !cancelled; ++round) {
    if (optimum->iterations >= options.max_iterations) break;
    search->round();
    if (cancelled) break;
    if (search->predictedGain() < options.tolerance) return Termination::converged;
    if (search->best().log_likelihood - last < options.tolerance) break;
    last = search->best().log_likelihood;
  }
  if (cancelled) return Termination::cancelled;
  return optimum->iterations >= options.max_iterations ? Termination::iteration_limit
                                                       : Termination::stalled;
}

std::string messageOf(Termination termination) {
  switch (termination) {
    case Termination::converged:
      return "no step would raise the log-likelihood by more than the tolerance";
    case Termination::iteration_limit:
      return "the iteration limit was reached; raise estimation.max_iterations";
    case Termination::cancelled:
      return "cancelled";
    default:
      return "the optimisation stopped making progress before the gradient vanished; the "
             "likelihood may be flat, or its maximum lie at the edge of the parameters' domain";
  }
}

/// How scoring steps ended that were all there was to do.
Termination endOfScoring(const std::vector<TracePoint>& steps, int max_iterations) {
  if (static_cast<int>(steps.size()) >= max_iterations) return Termination::iteration_limit;
  const bool accepted = steps.empty() || !steps.back().step || steps.back().step->accepted;
  return accepted ? Termination::converged : Termination::stalled;
}

double logLikelihoodAt(const Likelihood& likelihood, const ModelParameters& point) {
  return likelihood.expect(likelihood.statistics(point.parameters, false), point).total();
}

}  // namespace

Optimum maximumLikelihood(const Likelihood& likelihood, const ModelParameters& start,
                          const OptimisationOptions& options) {
  constexpr int kScoringSteps = 5;
  Optimum optimum;
  bool cancelled = false;
  OptimisationOptions recording = options;
  recording.on_iterate = [&](const TracePoint& done) {
    optimum.trace.push_back(done);
    cancelled = cancelled || (options.on_iterate && !options.on_iterate(done));
    return !cancelled;
  };
  optimum.point = scoringSteps(likelihood, start, recording,
                               std::min(kScoringSteps, options.max_iterations), options.tolerance);
  optimum.iterations = static_cast<int>(optimum.trace.size());
  pruneComponents(options.constraint, &optimum.point.mixture);
  const Parametrisation parametrisation(likelihood.model(), options.constraint,
                                        optimum.point.mixture.components(), options.floor);
  ScoredPoint near =
      scoredPoint(likelihood, parametrisation, parametrisation.toCoordinates(optimum.point));
  optimum.log_likelihood = near.log_likelihood;
  if (!std::isfinite(near.log_likelihood)) {
    optimum.termination = Termination::stalled;
    optimum.log_likelihood = logLikelihoodAt(likelihood, optimum.point);
    optimum.is_lost = true;
    optimum.message = std::isfinite(optimum.log_likelihood)
                          ? "the likelihood is lost in rounding near the start: the model may have "
                            "slow poles that the data do not determine; lower its orders"
                          : "the likelihood is not finite at the start (a model that fits without "
                            "error leaves no noise to estimate)";
    return optimum;
  }
  const Termination of_scoring = endOfScoring(optimum.trace, options.max_iterations);
  optimum.trace.push_back({optimum.iterations, likelihood.passes(), near.log_likelihood, {}});
  if (options.max_iterations <= kScoringSteps) {  // the whitening costs more than all of these
    optimum.termination = cancelled ? Termination::cancelled : of_scoring;
    optimum.message = messageOf(optimum.termination);
    optimum.point = near.parameters;
    return optimum;
  }
  QuasiNewton search(likelihood, parametrisation, recording, std::move(near), &optimum);
  optimum.termination = maximise(options, cancelled, &optimum, &search);
  optimum.message = messageOf(optimum.termination);
  optimum.point = search.best().parameters;
  optimum.log_likelihood = search.best().log_likelihood;
  return optimum;
}

}  // namespace uncertainty_identification
