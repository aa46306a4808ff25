#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// Transfer functions num/den, one per row, in descending powers of z. num and den have the same
/// length, the delay is part of num, and the first coefficient of den is 1. So the coefficients are
/// those of ascending powers of z^-1 as well.
struct ExportedSystems {
  Eigen::MatrixXd num, den;
  Eigen::MatrixXcd response;  ///< rows x frequencies, as the library computes them
};

/// Pointwise bands of the frequency response, levels x frequencies.
struct ExportedBands {
  Eigen::VectorXd levels, omega;                     ///< omega in [rad/s]
  Eigen::MatrixXd magnitude_lower, magnitude_upper;  ///< [unit of y / unit of u]
  Eigen::MatrixXd phase_lower, phase_upper;          ///< [rad]
  Eigen::MatrixXd relative_error_upper;              ///< of |G/Go - 1|
};

/// Signals that the library computed, to compare other implementations with.
struct ReferenceSignals {
  Eigen::VectorXd u, y;                  ///< y: free simulation of Go from rest, offsets included
  Eigen::VectorXd residual, innovation;  ///< innovation: D/C of the residual, from rest
};

/// The numbers of a result that every export draws from.
struct ExportedModel {
  std::string name;                   ///< an identifier: what the file calls itself
  std::vector<std::string> about;     ///< where the model comes from, in lines of plain text
  double sample_time = 0;             ///< [s]
  int delay = 0;                      ///< [samples]
  double offset_u = 0, offset_y = 0;  ///< y = Go (u + offset_u) + offset_y
  double noise_variance = 0;
  Eigen::VectorXd omega;  ///< [rad/s] of all responses
  ExportedSystems plant, noise;
  std::optional<ExportedSystems> weight, samples;
  double weight_level = 0;  ///< share of the plants that the weight bounds
  std::uint64_t samples_seed = 0;
  bool samples_hold_estimation_errors = false;
  std::optional<ExportedBands> bands;
  PhysicalNumbers physical;
  Trust trust;
  ReferenceSignals reference;
  std::vector<std::string> missing;  ///< what the result does not hold, and why
};

/// Takes the numbers from a result, draws `count` plants and computes all responses at 500
/// frequencies. Parts that the result does not determine are left out and named in `missing`.
/// Throws DataError when the result holds no model.
ExportedModel exportedModel(const Result& result, const std::string& name, int count,
                            std::uint64_t seed);

/// A text without what could end a comment or a quoted string: characters other than letters,
/// digits, blanks and simple punctuation become '?'.
std::string plainText(const std::string& text);

/// A name that C, Python, Octave and ROS accept: letters, digits and '_', beginning with a letter,
/// at most 40 characters.
std::string identifierText(const std::string& text);

}  // namespace uncertainty_identification
