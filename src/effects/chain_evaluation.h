#pragma once

#include <memory>

#include "effects/extended_model.h"
#include "model/evaluation.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {

/// Applies the effects of one stage, in the order given.
void applyStage(Stage stage, const std::vector<SetEffect>& effects, Chain* chain);

/// Simulates a chain from its input through the stages actuator, loop, plant and output, with the
/// error model behind the plant.
void runChain(const Polynomials& go, const ErrorBasis& basis, const std::vector<SetEffect>& effects,
              const Signals& input, Chain* chain);

/// The whitened response of a chain at given parameters, without derivatives.
class ChainEvaluation : public Evaluation {
 public:
  /// All arguments must outlive this object. `polynomials` and `block` are those after the
  /// measurement stage, with its factor of D and its measurement.
  ChainEvaluation(const Polynomials& polynomials, const ErrorBasis& basis,
                  const EstimationOptions& options, const Block& block,
                  std::shared_ptr<const NoiseWhitening> whitening,
                  const std::vector<SetEffect>& effects, Chain* chain)
      : Evaluation(polynomials, options, block, std::move(whitening)),
        basis_(basis),
        effects_(effects),
        chain_(*chain) {}

  /// Adds to the response of Evaluation::run() the random signals and the noise stage.
  void complete(Response* response) const;

 protected:
  std::unique_ptr<PlantResponse> respond(const Signals& input) const override;
  void addFreeResponse(Response* response) const override;

 private:
  void addRandom(Response* response) const;
  void divideByDeviation(Response* response) const;

  const ErrorBasis& basis_;
  const std::vector<SetEffect>& effects_;
  Chain& chain_;
};

}  // namespace uncertainty_identification
