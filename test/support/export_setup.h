#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "export/named_array.h"
#include "support/plain_estimate.h"
#include "support/process.h"
#include "support/temporary_folder.h"

/// Results to be exported, and the programs that read what was written.
namespace uncertainty_identification::test {

/// A result with bounds of few points.
inline Result withBounds(Estimate estimate) {
  estimate.configuration.bounds.samples = 500;
  estimate.configuration.bounds.frequencies = 40;
  const Bounds bounds = computeBounds(estimate);
  return {estimate, bounds};
}

/// Dead time, offsets, coloured noise, error model of two FIR taps.
inline Estimate delayedEstimate() {
  Estimate estimate = plainEstimate(Eigen::Vector2d(0.5, 0.3), Eigen::Vector2d(-1.2, 0.5));
  estimate.nominal_model.delay = 4;
  estimate.nominal_model.c = Eigen::VectorXd::Constant(1, 0.3);
  estimate.nominal_model.d = Eigen::Vector2d(-0.7, 0.2);
  estimate.offset_u = -0.25;
  estimate.offset_y = 3.5;
  estimate.version = "1.2.3";
  estimate.data_fingerprint = "0123abcd";
  return estimate;
}

/// The same with bounds, which are computed once.
inline Result delayedResult() {
  static const Result result = withBounds(delayedEstimate());
  return result;
}

/// An error model of Laguerre functions, which have a pole of their own.
inline Result laguerreResult() {
  Estimate estimate = plainEstimate(Eigen::Vector2d(0.2, 0.1), Eigen::Vector2d(-0.9, 0.1));
  ErrorModelOptions& options = estimate.error_model.options;
  options.basis = BasisKind::laguerre;
  options.pole = 0.6;
  estimate.error_model.T = ErrorBasis(options).T();
  return {estimate, {}};
}

/// A gain without dead time, white noise, nothing known of the uncertainty.
inline Result bareResult() {
  Estimate estimate =
      estimateWithoutErrorModel(Eigen::VectorXd::Constant(1, 2.5), Eigen::VectorXd(0));
  estimate.nominal_model.delay = 0;
  estimate.joint_covariance.resize(0, 0);
  return {estimate, {}};
}

/// Three poles at 0.999, so that rounding alone costs seven digits at low frequencies.
inline Result slowResult() {
  const double p = 0.999;
  return {estimateWithoutErrorModel(Eigen::VectorXd::Constant(1, 1e-9),
                                    Eigen::Vector3d(-3 * p, 3 * p * p, -p * p * p), 1e-12),
          {}};
}

inline std::vector<Result> resultsToExport() {
  return {delayedResult(), laguerreResult(), bareResult(), slowResult()};
}

inline ExportedModel exportedAs(const std::string& name, const Result& result) {
  return exportedModel(result, name, 5, 1);
}

/// A folder with a written file.
class WrittenFile {
 public:
  WrittenFile(const std::string& name, const std::string& content) : name_(name) {
    std::ofstream(path(), std::ios::binary) << content;
  }
  std::string path() const { return folder_ / name_; }
  std::string folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  std::string name_;
};

/// Runs Debian's Python, not one that a user has put before it. What is absent fails the test:
/// scripts/setup --test installs it.
inline ProcessResult python(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"/usr/bin/python3", "-B"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return runProcess(command);
}

/// Runs commands of Octave in a folder. Octave 7 may complain of its own end on standard error.
inline ProcessResult octave(const std::string& folder, const std::string& commands) {
  return runProcess(
      {"/usr/bin/octave-cli", "--quiet", "--norc", "--eval", "cd('" + folder + "'); " + commands});
}

/// `text` with the first number behind `name` made larger by 1e-7.
inline std::string tampered(std::string text, const std::string& name) {
  const std::size_t at = text.find_first_of("-0123456789", text.find(name) + name.size());
  std::size_t length = 0;
  const double value = std::stod(text.substr(at, 30), &length);
  return text.replace(at, length, exactText(value + 1e-7));
}

}  // namespace uncertainty_identification::test
