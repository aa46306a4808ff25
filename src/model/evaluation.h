#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/model.h"
#include "model/noise_whitening.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// What a plant with its error model makes of one input, before noise whitening:
///   G u = output + sum_i xi_i regressors_i,
/// and the derivatives of both to the plant's k-th coordinate.
class PlantResponse {
 public:
  virtual ~PlantResponse() = default;
  virtual Signals output() = 0;
  virtual Signals outputDerivative(int k) = 0;
  virtual std::vector<Signals> regressors() = 0;
  virtual std::vector<Signals> regressorDerivatives(int k) = 0;

  /// G u at the experiment's own xi as far as that is known: what an unknown constant input does.
  virtual Signals expectedOutput() { return output(); }
  virtual Signals expectedOutputDerivative(int k) { return outputDerivative(k); }
};

/// H^-1 of a block as `options` have it start.
std::shared_ptr<const NoiseWhitening> whiteningOf(const Polynomials& polynomials,
                                                  const EstimationOptions& options,
                                                  const Block& block, bool derivatives);

/// Builds the whitened response of a block in the coordinates [those of the plant; c; d; common
/// offset], with the nuisances of real records. What the plant is, and what its initial state does,
/// is left to subclasses.
class Evaluation {
 public:
  /// `polynomials`, `options` and `block` must outlive this object.
  Evaluation(const Polynomials& polynomials, int plant_coordinates,
             const EstimationOptions& options, const Block& block, bool derivatives);
  /// Value only, whitened by `whitening` of the same C, D, options and block.
  Evaluation(const Polynomials& polynomials, const EstimationOptions& options, const Block& block,
             std::shared_ptr<const NoiseWhitening> whitening);
  virtual ~Evaluation() = default;
  Evaluation(const Evaluation&) = delete;
  Evaluation& operator=(const Evaluation&) = delete;

  /// Value and, if asked for, derivatives. `offset` is the common one.
  void run(double offset, Response* response);

 protected:
  virtual std::unique_ptr<PlantResponse> respond(const Signals& input) const = 0;

  /// Adds the columns of the plant's free response and their derivatives.
  virtual void addFreeResponse(Response* response) const = 0;

  /// Whitens a raw signal into `slot` of the value and, through C and D, of the derivatives.
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

/// Chain rule from the coordinates of an Evaluation to theta: `jacobian` has a row per coordinate
/// but the common offset, which stays as it is.
void applyJacobian(const Eigen::MatrixXd& jacobian, std::vector<WhitenedSignals>* derivatives);

}  // namespace uncertainty_identification
