#pragma once

#include "uncertainty_identification/configuration.h"

/// The keys of a configuration, each stated once for reading and for writing.
/// config/reference.yaml explains them.
namespace uncertainty_identification {

class Archive;

void bind(Archive& archive, Configuration& configuration);
void bind(Archive& archive, ResamplingOptions& options);

/// The keys that define an error basis and its constraint, which stand in the current group.
void bindBasis(Archive& archive, ErrorModelOptions& options);

/// The keys of an error model, which stand in the current group. `parameters_key` is the key of the
/// names of the parameters that the basis varies: a result has its estimates under `parameters`.
void bindErrorModel(Archive& archive, const char* parameters_key, ErrorModelOptions& options);

/// The keys of a mixture, which stand in the current group.
void bindMixture(Archive& archive, Mixture& mixture);

/// Topic, field, scale and offset of the input or the output, which unlike covariates have no name.
void bindSignal(Archive& archive, const char* key, SignalOptions& options);

}  // namespace uncertainty_identification
