#pragma once

#include <memory>

#include "effects/extended_model.h"
#include "model/evaluation.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {

void applyStage(Stage stage, const std::vector<SetEffect>& effects, Chain* chain);

/// Runs an input through actuator, plant (with the error model) and output stages of a chain.
void runChain(const Polynomials& go, const ErrorBasis& basis, const std::vector<SetEffect>& effects,
              const Signals& input, Chain* chain);

/// The whitened response of a chain, value only.
class ChainEvaluation : public Evaluation {
 public:
  /// All must outlive this object; `polynomials` and `block` after the measurement stage.
  ChainEvaluation(const Polynomials& polynomials, const ErrorBasis& basis,
                  const EstimationOptions& options, const Block& block,
                  std::shared_ptr<const NoiseWhitening> whitening,
                  const std::vector<SetEffect>& effects, Chain* chain)
      : Evaluation(polynomials, options, block, std::move(whitening)),
        basis_(basis),
        effects_(effects),
        chain_(*chain) {}

  /// What Evaluation::run() leaves, with the random signals and the noise stage.
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
