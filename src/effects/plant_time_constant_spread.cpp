#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "model/filter.h"
#include "model/plant_derivatives.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kFastest = -0.9;  // c: the time constants are a tenth

/// The monic polynomial with these roots, complex ones in conjugate pairs.
VectorXd withRoots(const VectorXcd& all) {
  VectorXcd product = VectorXcd::Zero(all.size() + 1);
  product[0] = 1;
  for (Index k = 0; k < all.size(); ++k)
    product.segment(1, k + 1) -= (all[k] * product.head(k + 1)).eval();
  return product.tail(all.size()).real();
}

/// All time constants of Go vary in proportion from experiment to experiment, at constant static
/// gain: the poles p become p^(1/(1 + c_r)), c_r random.
class PlantTimeConstantSpread : public Effect {
 public:
  explicit PlantTimeConstantSpread(const std::string& variant)
      : Effect({"plant_parameter_spread",
                variant,
                variant + " of the plant varies from experiment to experiment, its gain does not",
                "Look for what makes the plant slower in some runs: temperature, load, wear; or "
                "identify with structure: continuous and error_model: {basis: parameter_spread, "
                "parameters: [tau1]}.",
                {},
                Stage::output,
                ScreeningKind::likelihood,
                {logVariance("deviation", "relative")},
                values({-6, -3, 0, 3, 6}),
                true,
                true}) {}

  /// Linearised about the experiment's own c, by a central difference.
  void apply(const VectorXd& psi, Chain* chain) const override {
    constexpr double kStep = 1e-4;
    const Lanes own = chain->ownPoint();
    RandomSignal spread{Signals(), std::exp(psi[0]), own, chain->own_point};
    spread.z = (response(own + kStep, *chain) - response(own - kStep, *chain)) / (2 * kStep);
    if ((own != 0).any()) {
      chain->x += response(own, *chain) - response(Lanes::Zero(), *chain);
      chain->x -= spread.z.colwise() * own;
    }
    chain->random.push_back(std::move(spread));
  }

  double pointAt(double size, const NominalModel& /*nominal*/,
                 const VectorXd& /*theta*/) const override {
    return std::max(size, kFastest);
  }

 private:
  /// Go u with its time constants 1 + c times as long.
  static Signals response(const Lanes& c, const Chain& chain) {
    std::vector<PlantCoefficients> plants;
    const int different = (c == c[0]).all() ? 1 : chain.block.lanes;
    plants.reserve(static_cast<std::size_t>(different));
    for (int lane = 0; lane < different; ++lane)
      plants.emplace_back(chain.nominal, slowed(c[lane], chain));
    return PlantDerivatives(&plants, chain.u).signal({});
  }

  /// Poles without a time constant, on the negative real axis or at 0, stay.
  static VectorXd slowed(double c, const Chain& chain) {
    Polynomials p = chain.nominal.polynomials(chain.theta);
    VectorXcd poles = roots(p.a);
    for (auto& pole : poles)
      if (pole.real() > 0 || pole.imag() != 0) pole = std::pow(pole, 1 / (1 + c));
    const double before = 1 + p.a.sum();
    p.a = withRoots(poles);
    p.b *= (1 + p.a.sum()) / before;
    return chain.nominal.fromPolynomials(p);
  }
};

/// Of polynomials; the time constants of a continuous plant are parameters of their own.
const EffectRegistration kRegistration(51, [](const DataSummary& data) -> MadeEffects {
  const auto& names = data.plant_parameters;
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (!has("a1")) return {};
  return {
      std::make_shared<PlantTimeConstantSpread>(has("a2") ? "time_constants" : "time_constant")};
});
}  // namespace
}  // namespace uncertainty_identification
