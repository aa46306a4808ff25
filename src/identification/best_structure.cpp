#include <algorithm>
#include <limits>
#include <tuple>

#include "identification/structure_fit.h"
#include "uncertainty_identification/errors.h"

/// Which of several fitted structures is chosen.
namespace uncertainty_identification {
namespace {

/// Structures whose half BIC is higher than the least by more than this are out of question [nats].
constexpr double kNearlyAsGood = 10;

/// Gains of the density of all held-out experiments together that are no reason for a larger
/// structure [nats].
constexpr double kImmaterial = 2;

/// Of candidates with a density of held-out experiments, the one with the fewest parameters that
/// loses nothing material against the highest. "None" must be the highest itself: bands of a model
/// without differences would be too narrow where there are some after all.
std::size_t simplestOfDensest(const std::vector<Candidate>& candidates,
                              const std::vector<StructureFit>& fits, int experiments) {
  const auto density = [&](std::size_t k) {
    return candidates[k].held_out_density.value_or(-std::numeric_limits<double>::infinity());
  };
  std::size_t highest = 0;
  for (std::size_t k = 1; k < fits.size(); ++k)
    if (density(k) > density(highest)) highest = k;
  const auto rank = [&](std::size_t k) {
    const bool loses = density(k) < density(highest) - kImmaterial / experiments;
    const bool is_none = fits[k].mixture == 0 && k != highest;
    return std::make_tuple(loses, is_none, candidates[k].parameters, -density(k));
  };
  std::size_t best = highest;
  for (std::size_t k = 0; k < fits.size(); ++k)
    if (rank(k) < rank(best)) best = k;
  return best;
}

}  // namespace

StructureFit bestOf(const Problem& problem, const std::vector<StructureFit>& fits,
                    const std::string& choice, bool by_held_out, Journal* journal) {
  if (fits.empty()) {
    throw DataError(
        "the likelihood is not finite at any start; check the units and the scale of the data, or "
        "give a start: initial.theta");
  }
  std::vector<Candidate> candidates;
  candidates.reserve(fits.size());
  for (const StructureFit& fit : fits)
    candidates.push_back({choice,
                          fit.structure.description,
                          fit.parameters + fit.mixture,
                          fit.log_likelihood,
                          -2 * scoreOf(problem, fit),
                          {},
                          false,
                          {}});
  const auto lower = [](const Candidate& left, const Candidate& right) {
    return *left.bic < *right.bic;
  };
  auto best = std::min_element(candidates.begin(), candidates.end(), lower);
  const double limit = *best->bic + 2 * kNearlyAsGood;
  const auto near = std::count_if(candidates.begin(), candidates.end(),
                                  [&](const Candidate& each) { return *each.bic < limit; });
  if (by_held_out && near > 1 && problem.data.count() > 1) {
    for (std::size_t k = 0; k < fits.size(); ++k)
      if (*candidates[k].bic < limit)
        candidates[k].held_out_density = heldOutDensity(problem, fits[k], journal);
    best = candidates.begin() +
           static_cast<long>(simplestOfDensest(candidates, fits, problem.data.count()));
  }
  best->chosen = true;
  const auto chosen = static_cast<std::size_t>(best - candidates.begin());
  journal->candidates.insert(journal->candidates.end(), candidates.begin(), candidates.end());
  return fits[chosen];
}

}  // namespace uncertainty_identification
