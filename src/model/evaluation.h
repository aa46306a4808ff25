#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/model.h"
#include "model/noise_whitening.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The response of a plant with error model to the input of a block, before noise whitening:
///   G u = output + sum_i xi_i regressors_i,
/// and its derivatives with respect to the k-th coordinate of the plant. (Notation:
/// docs/notation.md.)
class PlantResponse {
 public:
  virtual ~PlantResponse() = default;
  virtual Signals output() = 0;
  virtual Signals outputDerivative(int k) = 0;
  virtual std::vector<Signals> regressors() = 0;
  virtual std::vector<Signals> regressorDerivatives(int k) = 0;

  /// Best known value of G u, with each experiment's own xi where it is known. Gives the response
  /// to an unknown constant input.
  virtual Signals expectedOutput() { return output(); }
  virtual Signals expectedOutputDerivative(int k) { return outputDerivative(k); }
};

/// The inverse noise model H^-1 for a block, with the initial condition of the noise that `options`
/// specify.
std::shared_ptr<const NoiseWhitening> whiteningOf(const Polynomials& polynomials,
                                                  const EstimationOptions& options,
                                                  const Block& block, bool derivatives);

/// Whether the state of Go before the first sample is unknown: where nothing has resolved
/// InitialState::automatic, too.
bool estimatesInitialState(const EstimationOptions& options);

/// Whether one offset common to all experiments is estimated: where nothing has resolved
/// Offsets::automatic, too.
bool estimatesCommonOffset(const EstimationOptions& options);

/// Columns of precision p have a prior of variance sigma^2/p. Where the prior's variance V is fixed
/// (EstimationOptions::initial_variance), 1/2 log(sigma^2/p) of each column becomes 1/2 log V: the
/// column takes up one sample, and logOfPrior() leaves the log-Jacobian. The determinant keeps p,
/// which is small. 0 where V is not given.
double samplesOfPrior(const EstimationOptions& options);
double logOfPrior(const EstimationOptions& options);

/// Computes the whitened response of a block and its derivatives with respect to [coordinates of
/// the plant; c; d; common offset], including nuisances such as unknown initial states and offsets.
/// Subclasses define the plant and the effect of its initial state.
class Evaluation {
 public:
  /// `polynomials`, `options` and `block` must outlive this object.
  Evaluation(const Polynomials& polynomials, int plant_coordinates,
             const EstimationOptions& options, const Block& block, bool derivatives);
  /// Without derivatives. `whitening` must belong to the same C, D, options and block.
  Evaluation(const Polynomials& polynomials, const EstimationOptions& options, const Block& block,
             std::shared_ptr<const NoiseWhitening> whitening);
  virtual ~Evaluation() = default;
  Evaluation(const Evaluation&) = delete;
  Evaluation& operator=(const Evaluation&) = delete;

  /// Computes the response and, if requested in the constructor, its derivatives. `offset` is the
  /// common offset.
  void run(double offset, Response* response);

 protected:
  virtual std::unique_ptr<PlantResponse> respond(const Signals& input) const = 0;

  /// Adds the columns for the plant's initial state, and their derivatives.
  virtual void addFreeResponse(Response* response) const = 0;

  /// Whitens `raw` and writes the result to `slot` of the response, and its derivatives with
  /// respect to c and d to the same slot of the derivatives.
  template <typename Slot>
  void whiten(const Signals& raw, Response* response, const Slot& slot) const {
    if (!derivatives_) {
      whitening_->apply(raw, slot(&response->value));
      return;
    }
    std::vector<Signals> to_noise;
    whitening_->apply(raw, slot(&response->value), &to_noise);
    for (std::size_t j = 0; j < to_noise.size(); ++j) {
      slot(&response->derivatives[static_cast<std::size_t>(plant_coordinates_) + j])
          ->swap(to_noise[j]);
    }
  }

  static Signals* at(std::vector<Signals>* list, std::size_t k);
  static Signals* at(std::vector<std::shared_ptr<const Signals>>* list, std::size_t k);

  /// Number of samples after which the whitened columns q^-k/P, k < `directions`, and their
  /// derivatives have vanished. P is the product of `denominators`; one that the parameters change
  /// must be listed once more, because the derivative is divided by it again.
  int durationOfColumns(std::vector<Eigen::VectorXd> denominators, int directions) const;

  const Polynomials& polynomials() const { return polynomials_; }
  const Block& block() const { return block_; }
  bool derivatives() const { return derivatives_; }
  int plantCoordinates() const { return plant_coordinates_; }
  const NoiseWhitening& whitening() const { return *whitening_; }

 private:
  void whitenTangent(const Signals& output, const std::vector<Signals>& regressors,
                     WhitenedSignals* out) const;
  void addOutput(const Signals& input, double output_offset, Response* response) const;
  void addOwnOffset(Response* response) const;
  void addCommonOffset(Response* response) const;

  const Polynomials& polynomials_;
  int plant_coordinates_;
  const EstimationOptions& options_;
  const Block& block_;
  bool derivatives_;
  std::shared_ptr<const NoiseWhitening> whitening_;
  Signals ones_;
};

/// Chain rule from the coordinates of an Evaluation to theta. `jacobian` has a row for each
/// coordinate except the common offset, which stays unchanged.
void applyJacobian(const Eigen::MatrixXd& jacobian, std::vector<WhitenedSignals>* derivatives);

}  // namespace uncertainty_identification
