#include "support/dense_likelihood.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace uncertainty_identification::dense {
namespace {

/// One experiment as vectors and matrices over its observed samples.
struct Problem {
  Vector residual;    ///< y - Go u - offset
  Matrix regressors;  ///< Psi
  Matrix diffuse;     ///< X
  Matrix noise;       ///< R
};

/// What one mixture component says of an experiment.
struct Component {
  Real log_density = 0;
  Eigen::Index rank = 0;
  Vector mean;
  Matrix covariance;
};

std::vector<Eigen::Index> observedSamples(const Experiment& experiment, const Options& options) {
  const int first = options.initial_state == InitialState::discard ? options.discard_samples : 0;
  std::vector<Eigen::Index> observed;
  for (int k = first; k < experiment.samples(); ++k) {
    if (experiment.isValid(k)) observed.push_back(k);
  }
  return observed;
}

Matrix selectRows(const Matrix& matrix, const std::vector<Eigen::Index>& rows) {
  Matrix selected(static_cast<Eigen::Index>(rows.size()), matrix.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    selected.row(static_cast<Eigen::Index>(i)) = matrix.row(rows[i]);
  }
  return selected;
}

/// F(u): the responses of the basis filters to u (samples x taps).
Matrix basisResponses(const Eigen::MatrixXd& basis, const Vector& u) {
  Matrix responses(u.size(), basis.cols());
  const Eigen::Index known = std::min(u.size(), basis.rows());
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    Vector impulse_response = Vector::Zero(u.size());
    impulse_response.head(known) = basis.col(k).head(known).cast<Real>();
    responses.col(k) = toeplitz(impulse_response) * u;
  }
  return responses;
}

Matrix diffuseDirections(const Model& model, const Options& options, int samples) {
  Matrix directions(samples, 0);
  if (options.initial_state == InitialState::estimate) directions = stateDirections(model, samples);
  if (options.diffuse_offset) {
    directions.conservativeResize(Eigen::NoChange, directions.cols() + 1);
    directions.rightCols(1).setOnes();
  }
  return directions;
}

/// `noise` covers at least the experiment's samples.
Problem buildProblem(const Experiment& experiment, const Model& model, const Options& options,
                     const Matrix& noise) {
  const int samples = experiment.samples();
  const auto observed = observedSamples(experiment, options);
  const Matrix go = toeplitz(impulseResponse(model.b, monic(model.a), model.delay, samples));
  const Vector u = (experiment.u.array() - options.input_offset).matrix().cast<Real>();
  const Vector y = (experiment.y.array() - options.output_offset).matrix().cast<Real>();
  Problem problem;
  problem.residual = selectRows(y - go * u, observed);
  problem.regressors = Matrix::Zero(problem.residual.size(), model.T.cols());
  if (model.T.cols() > 0) {
    const Matrix filtered = basisResponses(model.basis, u) * model.T.cast<Real>();
    problem.regressors = selectRows(go * filtered, observed);
  }
  problem.diffuse = selectRows(diffuseDirections(model, options, samples), observed);
  problem.noise = selectRows(selectRows(noise, observed).transpose(), observed);
  return problem;
}

/// Log density, and posterior of xi, of an experiment under xi ~ N(mean, covariance).
Component evaluateComponent(const Problem& problem, const Vector& mean, const Matrix& covariance,
                            Real noise_variance) {
  const Matrix v = noise_variance * problem.noise +
                   problem.regressors * covariance * problem.regressors.transpose();
  const Eigen::LLT<Matrix> cholesky(v);
  const auto factor = cholesky.matrixL();
  Vector residual = factor.solve(problem.residual - problem.regressors * mean);
  Matrix regressors = factor.solve(problem.regressors);
  Real log_determinant = 0;
  for (Eigen::Index t = 0; t < v.rows(); ++t) {
    log_determinant += 2 * std::log(cholesky.matrixLLT()(t, t));
  }

  Component result;
  if (problem.diffuse.cols() > 0) {
    Eigen::JacobiSVD<Matrix> svd(factor.solve(problem.diffuse), Eigen::ComputeThinU);
    svd.setThreshold(1e-13L);
    result.rank = svd.rank();
    log_determinant += 2 * svd.singularValues().head(result.rank).array().log().sum();
    const Matrix range = svd.matrixU().leftCols(result.rank);
    residual -= range * (range.transpose() * residual).eval();
    regressors -= range * (range.transpose() * regressors).eval();
  }
  const Real count = static_cast<Real>(residual.size() - result.rank);
  result.log_density =
      -0.5L * (count * std::log(2 * std::acos(-1.0L)) + log_determinant + residual.squaredNorm());
  const Matrix gain = covariance * regressors.transpose();
  result.mean = mean + gain * residual;
  result.covariance = covariance - gain * gain.transpose();
  return result;
}

/// A model without an error model is a mixture of one component over no parameters.
Mixture effectiveMixture(const Model& model) {
  if (model.mixture.components() > 0) return model.mixture;
  const Eigen::Index n = model.T.cols();
  return Mixture{{1.0}, {Eigen::VectorXd::Zero(n)}, {Eigen::MatrixXd::Zero(n, n)}};
}

Evaluation evaluateProblem(const Problem& problem, const Model& model) {
  const Mixture mixture = effectiveMixture(model);
  Evaluation result;
  std::vector<Real> terms;
  for (std::size_t i = 0; i < mixture.weights.size(); ++i) {
    const Component component =
        evaluateComponent(problem, mixture.means[i].cast<Real>(),
                          mixture.covariances[i].cast<Real>(), model.noise_variance);
    terms.push_back(std::log(Real(mixture.weights[i])) + component.log_density);
    result.degrees_of_freedom = static_cast<int>(problem.residual.size() - component.rank);
    result.error_means.push_back(component.mean.cast<double>());
    result.error_covariances.push_back(component.covariance.cast<double>());
  }
  const Real largest = *std::max_element(terms.begin(), terms.end());
  Real sum = 0;
  for (const Real term : terms) sum += std::exp(term - largest);
  const Real log_likelihood = largest + std::log(sum);
  result.log_likelihood = static_cast<double>(log_likelihood);
  for (const Real term : terms) {
    result.responsibilities.push_back(static_cast<double>(std::exp(term - log_likelihood)));
  }
  return result;
}

}  // namespace

Matrix noiseCovariance(const Model& model, NoiseStart start, int samples) {
  if (start == NoiseStart::zero) {
    const Matrix h = toeplitz(impulseResponse(monic(model.c), monic(model.d), 0, samples));
    return h * h.transpose();
  }
  const Matrix lower = toeplitz(autocovariance(model.c, model.d, samples));
  return lower.selfadjointView<Eigen::Lower>();
}

Matrix stateDirections(const Model& model, int samples) {
  const auto poles = model.a.size() + model.basis_denominator.size();
  const auto count = std::max(poles, model.delay + model.b.size() - 1 + model.basis_order);
  const Eigen::VectorXd denominator = product(monic(model.a), monic(model.basis_denominator));
  const Vector response = impulseResponse(Eigen::VectorXd::Ones(1), denominator, 0, samples);
  return toeplitz(response).leftCols(std::min<Eigen::Index>(count, samples));
}

Evaluation evaluate(const Experiment& experiment, const Model& model, const Options& options) {
  const Matrix noise = noiseCovariance(model, options.noise_start, experiment.samples());
  return evaluateProblem(buildProblem(experiment, model, options, noise), model);
}

double logLikelihood(const std::vector<Experiment>& experiments, const Model& model,
                     const Options& options) {
  int longest = 0;
  for (const auto& experiment : experiments) longest = std::max(longest, experiment.samples());
  const Matrix noise = noiseCovariance(model, options.noise_start, longest);
  Real sum = 0;
  for (const auto& experiment : experiments) {
    sum += evaluateProblem(buildProblem(experiment, model, options, noise), model).log_likelihood;
  }
  return static_cast<double>(sum);
}

}  // namespace uncertainty_identification::dense
