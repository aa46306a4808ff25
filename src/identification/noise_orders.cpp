#include <algorithm>

#include "estimation/selection.h"
#include "identification/structure_fit.h"

/// The orders of C and D around a structure that is chosen.
namespace uncertainty_identification {
namespace {

/// The error parameters of the points that a fit of factors is linearised about.
Eigen::MatrixXd errorParameters(const StructureFit& fit) {
  const Eigen::Index n = fit.model->regressors();
  const Eigen::VectorXd of_zero = fit.point.parameters.head(n);  // the factors are the first ones
  return (fit.points.topRows(n).array().colwise() / of_zero.array() - 1).matrix();
}

/// The chosen fit with other orders of C and D. Modes start where they are, as no start from the
/// data finds them.
std::optional<StructureFit> withNoiseOf(const Problem& problem, const ErrorStructure& structure,
                                        const StructureFit& chosen, Journal* journal) {
  const NominalModelOptions& wanted = structure.configuration.nominal_model;
  if (wanted.structure != Structure::modal)
    return fitStructure(problem, structure, {chosen.start()}, true, journal);
  ModelParameters start = chosen.point;
  const NominalModelOptions& had = chosen.structure.configuration.nominal_model;
  const Eigen::VectorXd before = start.parameters;
  const Eigen::Index own = chosen.model->nominal().parameterCount() - had.nc - had.nd;
  const Eigen::Index after = before.size() - own - had.nc - had.nd;
  start.parameters = Eigen::VectorXd::Zero(own + wanted.nc + wanted.nd + after);
  start.parameters.head(own) = before.head(own);
  start.parameters.segment(own, std::min(wanted.nc, had.nc)) =
      before.segment(own, std::min(wanted.nc, had.nc));
  start.parameters.segment(own + wanted.nc, std::min(wanted.nd, had.nd)) =
      before.segment(own + had.nc, std::min(wanted.nd, had.nd));
  start.parameters.tail(after) = before.tail(after);
  return fitStructureFrom(problem, structure, start, errorParameters(chosen), journal);
}

}  // namespace

StructureFit withNoiseOrders(const Problem& problem, const StructureFit& chosen, Journal* journal) {
  constexpr double kImmaterial = 2;  // gain in log-likelihood [nats]
  std::vector<ErrorStructure> structures;
  for (int order = 0; order <= kLargestNoiseOrder; ++order) {
    const std::string count = std::to_string(order);
    structures.push_back({"nc=" + count + " nd=" + count, chosen.structure.configuration});
    NominalModelOptions& options = structures.back().configuration.nominal_model;
    options.nc = options.nd = order;
  }
  std::vector<StructureFit> fits;
  for (const ErrorStructure& structure : structures) {
    const double before = fits.empty() ? 0 : fits.back().log_likelihood;
    auto fit = withNoiseOf(problem, structure, chosen, journal);
    if (!fit) continue;
    const bool in_vain = fits.size() > 1 && fit->log_likelihood < before + kImmaterial;
    fits.push_back(std::move(*fit));
    if (in_vain || journal->progress.searchEnds()) break;
  }
  if (fits.empty()) return chosen;
  return bestOf(problem, fits, "noise orders", false, journal);
}

}  // namespace uncertainty_identification
