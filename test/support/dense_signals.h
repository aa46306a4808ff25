#pragma once

#include <Eigen/Core>

/// Building blocks of the dense reference (dense_likelihood.h): impulse responses and the N x N
/// matrices made of them, in extended precision. Written for clarity; nothing here is shared with
/// the package's own recursions.
namespace uncertainty_identification::dense {

using Real = long double;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// [1, tail]: the full coefficients of a monic polynomial in q^-1.
Eigen::VectorXd monic(const Eigen::VectorXd& tail);

/// Product of two polynomials given by their full coefficients.
Eigen::VectorXd product(const Eigen::VectorXd& p, const Eigen::VectorXd& q);

/// First `samples` values of the response of q^-delay numerator/denominator to a unit pulse at
/// sample 0. Both are full coefficients; the denominator is monic.
Vector impulseResponse(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                       int delay, int samples);

/// Lower-triangular Toeplitz matrix of a filter at rest: column j is the impulse response moved by
/// j samples.
Matrix toeplitz(const Vector& impulse_response);

/// Autocovariance at lags 0..lags-1 of C/D driven by white noise of variance 1 that has run for
/// ever, as the sum over k of h_k h_(k+lag) of its impulse response. The sum ends after `terms`
/// terms, or where h has died out.
Vector autocovariance(const Eigen::VectorXd& c, const Eigen::VectorXd& d, int lags,
                      int terms = 100000);

/// Impulse responses (samples x taps) of q^0..q^-(taps-1), equation (12).
Eigen::MatrixXd firBasis(int taps, int samples);

/// Impulse responses (samples x taps) of the orthonormal Laguerre filters that begin at q^0:
/// sqrt(1-p^2)/(1-p q^-1) ((q^-1-p)/(1-p q^-1))^k for k = 0..taps-1; p = 0 gives firBasis.
Eigen::MatrixXd laguerreBasis(double pole, int taps, int samples);

/// Impulse responses (samples x taps) of the two-parameter Kautz filters of a pole pair r, conj(r),
/// that begin at q^0. With c = -|r|^2, b = 2 Re r / (1 - c), D = 1 + b (c - 1) q^-1 - c q^-2 and
/// the all-pass A = (-c + b (c - 1) q^-1 + q^-2)/D they are, in pairs k = 0, 1, ...,
/// sqrt(1-c^2) (1 - b q^-1)/D A^k and sqrt((1-c^2)(1-b^2)) q^-1/D A^k (Wahlberg 1994, times q).
Eigen::MatrixXd kautzBasis(double pole_real, double pole_imag, int taps, int samples);

}  // namespace uncertainty_identification::dense
