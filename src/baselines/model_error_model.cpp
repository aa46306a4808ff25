#include "uncertainty_identification/baselines/model_error_model.h"

#include <algorithm>

#include "model/box_jenkins.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The experiment with its output replaced by the residual y - Go u minus the offset.
Experiment residualOf(const Experiment& experiment, const Polynomials& go, double offset_u,
                      double offset_y) {
  Signals u = Signals::Zero(kLanes, experiment.samples()), x, y;
  u.row(0) = experiment.u.transpose().array() + offset_u;
  filter(VectorXd::Ones(1), go.a, 0, u, &x);
  filter(go.b, VectorXd(), go.delay, x, &y);
  Experiment residual = experiment;
  residual.y -= y.row(0).matrix().transpose();
  residual.y.array() -= offset_y;
  return residual;
}

}  // namespace

ModelErrorModels modelErrorModels(const Configuration& configuration,
                                  const PredictionErrorFits& nominal,
                                  const std::vector<Experiment>& experiments, int order) {
  ModelErrorModels models;
  models.nominal = nominal.nominal->polynomials(nominal.mean);
  const bool at_input = configuration.estimation.offset_side == OffsetSide::input;
  std::vector<Experiment> residuals;
  residuals.reserve(experiments.size());
  for (const Experiment& experiment : experiments) {
    residuals.push_back(residualOf(experiment, models.nominal, at_input ? nominal.offset : 0.0,
                                   at_input ? 0.0 : nominal.offset));
  }
  Configuration fir = configuration;  // FIR with white noise v; the offset is the residual's
  fir.nominal_model = NominalModelOptions();
  fir.nominal_model.orders_auto = false;
  fir.nominal_model.structure = Structure::output_error;
  fir.nominal_model.nb = order;
  fir.nominal_model.na = 0;
  fir.nominal_model.delay = models.nominal.delay;
  models.fits = fitExperiments(fir, makeBoxJenkins(fir.nominal_model), residuals).fits;
  return models;
}

PlantSamples plantsOf(const ModelErrorModels& models, double sample_time) {
  const Polynomials& go = models.nominal;
  const auto count = static_cast<Index>(models.fits.size());
  const Index order = models.fits.front().b.size(), na = go.a.size();
  const Index size = std::max(go.b.size(), order + na);
  ErrorModelOptions none;
  none.taps = 0;
  PlantSamples plants{sample_time,
                      go.delay,
                      MatrixXd::Zero(count, size),
                      go.a.transpose().replicate(count, 1),
                      MatrixXd(count, 0),
                      none};
  for (Index r = 0; r < count; ++r) {  // numerator of (B + A E)/A
    const VectorXd& e = models.fits[static_cast<std::size_t>(r)].b;
    plants.b.row(r).head(go.b.size()) = go.b.transpose();
    plants.b.row(r).head(order) += e.transpose();
    for (Index k = 0; k < na; ++k) plants.b.row(r).segment(k + 1, order) += go.a[k] * e.transpose();
  }
  return plants;
}

}  // namespace uncertainty_identification
