#include "identification/single_fits.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <utility>

#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A single experiment as the data of a problem of its own.
CheckedData single(const Experiment& experiment) {
  CheckedData one;
  one.experiments = {experiment};
  one.blocks = makeBlocks(one.experiments);
  return one;
}

/// Fits of single experiments, one each, and the sum of their half BIC.
struct SingleFits {
  std::vector<StructureFit> each;
  double score = -std::numeric_limits<double>::infinity();
};

const NominalModelOptions& ordersOf(const StructureFit& fit) {
  return fit.structure.configuration.nominal_model;
}

int delayOf(const StructureFit& fit) { return ordersOf(fit).delay; }

/// Whether most of the plants have modes.
bool haveModes(const SingleFits& fits) {
  const auto modal = std::count_if(fits.each.begin(), fits.each.end(), [](const auto& fit) {
    return hasModes(fit.start().polynomials.a);
  });
  return 2 * modal >= static_cast<long>(fits.each.size());
}

/// The best fits of an order, each with a delay of its own.
std::vector<StructureFit> ofOwnDelays(const Problem& problem, const std::vector<CheckedData>& data,
                                      int order, Journal* journal) {
  std::vector<StructureFit> fits;
  for (const CheckedData& one : data) {
    if (journal->progress.searchEnds()) break;
    if (auto fit = fitOfOrder(problemOf(one, problem.configuration), order, journal))
      fits.push_back(std::move(*fit));
  }
  return fits;
}

/// Fits of all experiments in a structure, from the same starts. Empty where one cannot be fitted.
SingleFits fitEach(const Problem& problem, const std::vector<CheckedData>& data,
                   const ErrorStructure& structure, const std::vector<StartingPoint>& starts,
                   Journal* journal) {
  SingleFits fits{{}, 0};
  for (const CheckedData& one : data) {
    const Problem alone = problemOf(one, problem.configuration);
    auto fit = fitStructure(alone, structure, starts, false, journal);
    if (!fit) return {};
    fits.score += scoreOf(alone, *fit);
    fits.each.push_back(std::move(*fit));
  }
  return fits;
}

/// Replaces the fit of an experiment if another one of its structure surpasses it.
void take(const StructureFit& fit, std::size_t experiment, SingleFits* fits) {
  StructureFit& now = fits->each[experiment];
  const double gain = fit.log_likelihood - now.log_likelihood;
  if (!(gain > 0) || delayOf(fit) != delayOf(now)) return;
  now = fit;
  fits->score += gain;
}

/// The plant with zeros in place of what a larger order adds: the same response, with `earlier`
/// samples less of delay.
StartingPoint enlarged(StartingPoint start, int order, int earlier) {
  Polynomials& p = start.polynomials;
  VectorXd a = VectorXd::Zero(order), b = a;
  a.head(p.a.size()) = p.a;
  b.segment(earlier, p.b.size()) = p.b;
  p.a = a;
  p.b = b;
  p.delay -= earlier;
  return start;
}

/// Fits of an order from those of a smaller one, and `earlier` samples less of delay.
SingleFits enlarged(const Problem& problem, const std::vector<CheckedData>& data,
                    const SingleFits& smaller, int order, int earlier, Journal* journal) {
  ErrorStructure structure = smaller.each.front().structure;
  NominalModelOptions& nominal = structure.configuration.nominal_model;
  nominal.nb = nominal.na = order;
  nominal.delay -= earlier;
  SingleFits fits{{}, 0};
  for (std::size_t k = 0; k < data.size(); ++k) {
    const Problem alone = problemOf(data[k], problem.configuration);
    const StartingPoint start = enlarged(smaller.each[k].start(), order, earlier);
    auto fit = fitStructure(alone, structure, {start}, false, journal);
    if (!fit) return {};
    fits.score += scoreOf(alone, *fit);
    fits.each.push_back(std::move(*fit));
  }
  return fits;
}

/// The fits, or better ones from the plants of the others.
void learnFromEachOther(const Problem& problem, const std::vector<CheckedData>& data,
                        SingleFits* fits, Journal* journal) {
  const std::vector<StructureFit> all = fits->each;
  for (std::size_t k = 0; k < all.size() && all.size() > 1; ++k) {
    std::vector<StartingPoint> others;
    for (std::size_t j = 0; j < all.size(); ++j)
      if (j != k) others.push_back(all[j].start());
    const Problem alone = problemOf(data[k], problem.configuration);
    auto fit = fitStructure(alone, all[k].structure, others, false, journal);
    if (fit) take(*fit, k, fits);
  }
}

/// The numbers of the fits, those that improve most on what was reached before first.
std::vector<std::size_t> byImprovement(const std::vector<StructureFit>& fits,
                                       const std::vector<StructureFit>& before) {
  std::vector<std::size_t> numbers(fits.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const auto gain = [&](std::size_t k) {
    return fits[k].log_likelihood - (before.empty() ? 0 : before[k].log_likelihood);
  };
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](std::size_t i, std::size_t j) { return gain(i) > gain(j); });
  return numbers;
}

/// The best fits with the delays and from the plants of those experiments that improve most on what
/// was reached before. What one shows, another may hide in a local optimum.
SingleFits fromShown(const Problem& problem, const std::vector<CheckedData>& data, int order,
                     const SingleFits& before, Journal* journal) {
  constexpr int kShown = 2;
  SingleFits best;
  const std::vector<StructureFit> own = ofOwnDelays(problem, data, order, journal);
  if (own.size() < data.size()) return best;
  int shown = 0;
  for (const std::size_t k : byImprovement(own, before.each)) {
    if (!hasModes(own[k].start().polynomials.a)) continue;
    if (++shown > kShown || journal->progress.searchEnds()) break;
    SingleFits fits = fitEach(problem, data, own[k].structure, {own[k].start()}, journal);
    for (std::size_t r = 0; r < fits.each.size(); ++r) take(own[r], r, &fits);
    if (fits.score > best.score) best = std::move(fits);
  }
  learnFromEachOther(problem, data, &best, journal);
  return haveModes(best) ? best : SingleFits{};
}

/// The best fits from those of a smaller order, with up to as many samples less of delay as there
/// are more poles.
SingleFits fromSmaller(const Problem& problem, const std::vector<CheckedData>& data,
                       const SingleFits& smaller, int order, Journal* journal) {
  SingleFits best;
  if (smaller.each.empty()) return best;
  const NominalModelOptions& before = ordersOf(smaller.each.front());
  for (int earlier = 0; earlier <= std::min(order - before.na, before.delay); ++earlier) {
    if (journal->progress.searchEnds()) break;
    SingleFits fits = enlarged(problem, data, smaller, order, earlier, journal);
    if (fits.score > best.score && haveModes(fits)) best = std::move(fits);
  }
  learnFromEachOther(problem, data, &best, journal);
  return haveModes(best) ? best : SingleFits{};
}

}  // namespace

Problem problemOf(const CheckedData& one, Configuration configuration) {
  ErrorModelOptions& errors = configuration.error_model;
  errors.basis = BasisKind::fir;
  errors.constraint = Constraint::free;
  errors.taps = 0;
  errors.components = 1;
  return {one, {}, nullptr, std::move(configuration), {}, {}};
}

std::vector<CheckedData> singles(const CheckedData& data, std::size_t most,
                                 std::vector<Index>* numbers) {
  std::vector<const Experiment*> moved;
  for (const Experiment& experiment : data.experiments)
    if (experiment.u.size() > 0 && experiment.u.maxCoeff() > experiment.u.minCoeff())
      moved.push_back(&experiment);
  std::vector<CheckedData> some;
  const std::size_t count = std::min(most, moved.size());
  some.reserve(count);  // blocks point to their experiments, which must stay where they are
  for (std::size_t k = 0; k < count; ++k) {
    const Experiment* each = moved[k * moved.size() / count];
    some.push_back(single(*each));
    if (numbers != nullptr) numbers->push_back(each - data.experiments.data());
  }
  return some;
}

bool hasModes(const VectorXd& a) {
  constexpr double kFastest = 0.02;
  const Eigen::VectorXcd all = roots(a);
  return std::all_of(all.data(), all.data() + all.size(), [](const std::complex<double>& root) {
    return std::abs(root.imag()) > 1e-9 || root.real() > kFastest;
  });
}

std::vector<StartingPoint> plantsOfLeastBic(const Problem& problem,
                                            const std::vector<CheckedData>& data,
                                            Journal* journal) {
  constexpr int kInVain = 2, kSamplesEach = 40;
  int largest = problem.configuration.nominal_model.max_order;
  for (const CheckedData& one : data)
    largest = std::min(largest, one.experiments.front().samples() / kSamplesEach);
  SingleFits best;
  int best_order = 0;
  for (int order = 1; order <= std::min(largest, best_order + kInVain); ++order) {
    const SingleFits before = best;
    for (const SingleFits& fits : {fromShown(problem, data, order, before, journal),
                                   fromSmaller(problem, data, before, order, journal)}) {
      if (!(fits.score > best.score)) continue;
      best = fits;
      best_order = order;
    }
  }
  std::vector<StartingPoint> plants;
  plants.reserve(best.each.size());
  for (const StructureFit& fit : best.each) plants.push_back(fit.start());
  return plants;
}

}  // namespace uncertainty_identification
