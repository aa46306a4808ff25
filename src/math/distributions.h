#pragma once

/// Tails and quantiles of the distributions that tests and bounds use, by Boost.Math. One place,
/// because its headers take seconds to compile.
namespace uncertainty_identification {

/// P(X > x), X chi-squared.
double chiSquaredTail(double x, double degrees);

/// The x with P(X < x) = probability, X chi-squared.
double chiSquaredQuantile(double probability, double degrees);

/// P(X > x), X distributed as F.
double fisherTail(double x, double numerator_degrees, double denominator_degrees);

/// P(X > x), X beta-distributed.
double betaTail(double x, double alpha, double beta);
double betaQuantile(double probability, double alpha, double beta);

/// P(Z > z), Z standard normal.
double normalTail(double z);

/// The z >= 0 with P(Z > z) = tail, tail in (0, 0.5].
double normalTailQuantile(double tail);

/// The z with P(Z < z) = probability, to the accuracy of double without promotion: for many draws.
double fastNormalQuantile(double probability);

double studentQuantile(double probability, double degrees);

/// P(X > k), X Poisson-distributed.
double poissonTail(double k, double mean);

/// P(X <= k) and P(X > k), X the number of successes in `trials`.
double binomialProbability(double k, double trials, double probability);
double binomialTail(double k, double trials, double probability);

}  // namespace uncertainty_identification
