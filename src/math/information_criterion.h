#pragma once

/// The Bayesian information criterion (BIC), by which models of different size are compared.
namespace uncertainty_identification {

/// Half of BIC's penalty, 1/2 parameters ln(observations) [nats]: what a log-likelihood is reduced
/// by for parameters that were fitted to so many independent observations. Of two models the one
/// with the higher log-likelihood minus this penalty has the lower BIC.
double bicPenalty(double parameters, double observations);

/// BIC: -2 log-likelihood + ln(samples) for each parameter of theta and sigma^2 + ln(experiments)
/// for each parameter of the mixture, of which each experiment is one observation.
double bic(double log_likelihood, int model_parameters, int mixture_parameters, double samples,
           int experiments);

}  // namespace uncertainty_identification
