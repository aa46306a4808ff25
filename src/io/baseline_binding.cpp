#include "io/baseline_binding.h"

#include "io/archive.h"
#include "io/estimate_binding.h"

namespace uncertainty_identification {

void bind(Archive& archive, ExperimentFit& fit) {
  archive("id", fit.id);
  archive("parameters", fit.parameters);
  archive("delay", fit.delay);
  archive("b", fit.b);
  archive("a", fit.a);
  archive("c", fit.c);
  archive("d", fit.d);
  archive("offset", fit.offset);
  archive("noise_variance", fit.noise_variance);
  archive("log_likelihood", fit.log_likelihood);
}

void bind(Archive& archive, Baseline& baseline) {
  archive("method", baseline.method);
  archive("experiments", baseline.fits);
  archive("mean", baseline.mean);
  archive("deviation", baseline.deviation);
  archive("error_models", baseline.error_models);
  archive("omega", baseline.omega);
  archive("magnitude_bands", baseline.magnitude_bands);
}

}  // namespace uncertainty_identification
