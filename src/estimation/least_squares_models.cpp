#include "estimation/least_squares_models.h"

#include <algorithm>
#include <utility>

#include "estimation/embedded_start.h"
#include "math/polynomial.h"
#include "model/continuous.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The coefficients' medians over fits of single experiments; few suffice for a start.
bool medianOfExperiments(const std::vector<Experiment>& experiments, const Polynomials& sizes,
                         Constant constant, LeastSquaresModel* median) {
  constexpr std::size_t kMost = 40;
  const Index nb = sizes.b.size(), na = sizes.a.size();
  std::vector<std::vector<double>> values(static_cast<std::size_t>(nb + na + 1));
  const std::size_t stride = std::max<std::size_t>(1, experiments.size() / kMost);
  for (std::size_t r = 0; r < experiments.size(); r += stride) {
    if (experiments[r].samples() < 4 * (nb + na + sizes.delay) + 10) continue;
    const LeastSquaresModel one =
        LeastSquaresStart({&experiments[r]}, constant, 2000)
            .steiglitzMcBride(static_cast<int>(nb), static_cast<int>(na), sizes.delay, sizes.delay);
    if (one.polynomials.b.size() != nb || one.polynomials.a.size() != na) continue;  // overflow
    VectorXd all(nb + na + 1);
    all << one.polynomials.b, one.polynomials.a, one.offset;
    if (!all.allFinite()) continue;
    for (Index k = 0; k < all.size(); ++k) values[static_cast<std::size_t>(k)].push_back(all[k]);
  }
  if (values.front().size() < 3) return false;
  VectorXd all(nb + na + 1);
  for (Index k = 0; k < all.size(); ++k) {
    std::vector<double>& of_one = values[static_cast<std::size_t>(k)];
    std::nth_element(of_one.begin(), of_one.begin() + static_cast<long>(of_one.size() / 2),
                     of_one.end());
    all[k] = of_one[of_one.size() / 2];
  }
  median->polynomials.delay = sizes.delay;
  median->polynomials.b = all.head(nb);
  median->polynomials.a = stabilised(all.segment(nb, na), 0.9995);
  median->offset = all[nb + na];
  return true;
}

/// The experiments with the answer of an ARX model of high order in place of what was measured:
/// free of the noise, whose colour draws the poles of low-order regressions away from the plant's.
/// Empty where they are too short for it.
std::vector<Experiment> withoutNoise(const LeastSquaresStart& pooled,
                                     const std::vector<Experiment>& experiments, int delay,
                                     int longest_dead_time) {
  constexpr int kOrder = 15, kSamplesForEach = 20;
  const int nb = kOrder + longest_dead_time;
  Index samples = 0;
  for (const Experiment& experiment : experiments) samples += experiment.samples();
  if (samples < kSamplesForEach * (nb + kOrder)) return {};
  LeastSquaresModel high = pooled.arx(nb, kOrder, delay);
  if (!high.polynomials.b.allFinite() || !high.polynomials.a.allFinite()) return {};
  high.polynomials.a = stabilised(high.polynomials.a, 0.9995);
  std::vector<Experiment> clean = experiments;
  for (Experiment& experiment : clean)
    experiment.y = simulated(high.polynomials, high.offset, experiment.u);
  return clean;
}

std::vector<const Experiment*> pointersTo(const std::vector<Experiment>& experiments) {
  std::vector<const Experiment*> all;
  all.reserve(experiments.size());
  for (const Experiment& experiment : experiments) all.push_back(&experiment);
  return all;
}

/// Adds least-squares models of Go at the dead times about that of the best one. The numerator is
/// as long as a fraction of a sample needs, and moved to its place in B.
void addModelsOfDeadTimes(const LeastSquaresStart& pooled, const Polynomials& sizes, int longest,
                          std::vector<LeastSquaresModel>* models) {
  const int na = static_cast<int>(sizes.a.size()), last = sizes.delay + longest;
  const int best = pooled.steiglitzMcBride(na + 1, na, sizes.delay, last).polynomials.delay;
  for (int delay = std::max(best - 1, sizes.delay); delay <= std::min(best + 2, last); ++delay) {
    LeastSquaresModel model = pooled.steiglitzMcBride(na + 1, na, delay, delay);
    Polynomials& p = model.polynomials;
    if (p.b.size() != na + 1) continue;  // the regression overflowed
    VectorXd b = VectorXd::Zero(sizes.b.size());
    b.segment(delay - sizes.delay, na + 1) = p.b;
    p.b = b;
    p.delay = sizes.delay;
    models->push_back(std::move(model));
  }
}

}  // namespace

Polynomials sizesOf(const NominalModel& nominal) {
  return nominal.polynomials(
      nominal.fromUnbounded(VectorXd::Constant(nominal.parameterCount(), 0.1)));
}

VectorXd simulated(const Polynomials& p, double offset, const VectorXd& u) {
  VectorXd x = VectorXd::Zero(u.size());
  for (Index t = 0; t < u.size(); ++t) {
    for (Index k = 0; k < p.b.size() && t - p.delay - k >= 0; ++k)
      x[t] += p.b[k] * u[t - p.delay - k];
    for (Index k = 1; k <= std::min<Index>(p.a.size(), t); ++k) x[t] -= p.a[k - 1] * x[t - k];
  }
  return x.array() + offset;
}

std::vector<LeastSquaresModel> leastSquaresModels(const LinearModel& model,
                                                  const std::vector<Experiment>& experiments) {
  const Polynomials sizes = sizesOf(model.nominal());
  const int nb = static_cast<int>(sizes.b.size()), na = static_cast<int>(sizes.a.size());
  const Constant constant = constantOf(model.offsets());
  const LeastSquaresStart pooled(pointersTo(experiments), constant);
  const int dead_time = longestDeadTime(model.nominal());
  if (dead_time > 0) {
    std::vector<LeastSquaresModel> models;
    addModelsOfDeadTimes(pooled, sizes, dead_time, &models);
    const std::vector<Experiment> clean = withoutNoise(pooled, experiments, sizes.delay, dead_time);
    if (!clean.empty())
      addModelsOfDeadTimes(LeastSquaresStart(pointersTo(clean), constant), sizes, dead_time,
                           &models);
    return models;
  }
  std::vector<LeastSquaresModel> models{pooled.steiglitzMcBride(nb, na, sizes.delay, sizes.delay),
                                        pooled.arx(nb, na, sizes.delay)};
  models[kArx].polynomials.a = stabilised(models[kArx].polynomials.a, 0.9995);
  LeastSquaresModel median;
  if (medianOfExperiments(experiments, sizes, constant, &median)) models.push_back(median);
  // Without an error model, a slow pole with a free state would follow what the model lacks.
  if (model.regressors() > 0)
    models.push_back(pooled.steiglitzMcBride(nb, na, sizes.delay, sizes.delay,
                                             LeastSquaresStart::Start::unknown));
  const std::vector<LeastSquaresModel> embedded =
      embeddedStarts(model.basis(), sizes, experiments, constant != Constant::none);
  models.insert(models.end(), embedded.begin(), embedded.end());
  return models;
}

}  // namespace uncertainty_identification
