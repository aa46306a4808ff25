#include <algorithm>
#include <cmath>

#include "effects/built_in_effects.h"
#include "math/polynomial.h"
#include "model/filter.h"
#include "model/plant_derivatives.h"

/// Parameters of Go that vary at random from experiment to experiment.
namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// One parameter of Go is theta_j (1 + c_r) in experiment r, c_r random.
class PlantParameterSpread : public Effect {
 public:
  PlantParameterSpread(const std::string& parameter, int index)
      : Effect({"plant_parameter_spread",
                parameter,
                parameter +
                    " varies from experiment to experiment more than the error model can describe",
                "Identify with error_model: {basis: parameter_spread, parameters: [" + parameter +
                    "]}.",
                {},
                Stage::output,
                ScreeningKind::likelihood,
                {logVariance("deviation", "relative")},
                values({-6, -3, 0, 3, 6}),
                /*nonlinear=*/true,
                /*own_point=*/true,
                {Trait::in_mixture, Trait::by_experiment}}),
        index_(index) {}

  /// Linearised about the parameter's value t_r in each experiment, as the error basis
  /// parameter_spread is:
  ///   x + (Go(t_r) - Go) u + (theta_j (1 + c_r) - t_r) dGo/dtheta_j(t_r) u.
  void apply(const VectorXd& psi, Chain* chain) const override {
    const double common = chain->theta[index_];
    const Lanes own = chain->ownPoint();
    const bool apart = (own != common).any();
    std::vector<PlantCoefficients> plants;
    VectorXd theta = chain->theta;
    for (int lane = 0; lane < (apart ? chain->block.lanes : 1); ++lane) {
      theta[index_] = own[lane];
      plants.emplace_back(chain->nominal, theta);
    }
    PlantDerivatives plant(&plants, chain->u);
    RandomSignal spread{common * plant.signal({index_}), std::exp(psi[0]), Lanes::Zero(),
                        chain->own_point};
    if (apart) {
      const Polynomials go = chain->nominal.polynomials(chain->theta);
      Signals usual;
      filter(go.b, go.a, go.delay, chain->u, &usual);
      spread.about = own / common - 1;
      chain->x += plant.signal({}) - usual - spread.z.colwise() * spread.about;
    }
    chain->random.push_back(std::move(spread));
  }

  /// The parameter's value in an experiment where c_r = size. Where the plant would not be
  /// admissible, the deviation is halved until it is.
  double pointAt(double size, const NominalModel& nominal, const VectorXd& theta) const override {
    constexpr int kHalvings = 10;
    VectorXd own = theta;
    for (int k = 0; k < kHalvings; ++k, size /= 2) {
      own[index_] = theta[index_] * (1 + size);
      if (nominal.admissible(own)) return own[index_];
    }
    return theta[index_];
  }

 private:
  int index_;
};

constexpr double kSmallest = -0.9;  // of c_r: time constants a tenth as long

/// The monic polynomial with these roots, complex ones in conjugate pairs.
VectorXd withRoots(const VectorXcd& all) {
  VectorXcd product = VectorXcd::Zero(all.size() + 1);
  product[0] = 1;
  for (Index k = 0; k < all.size(); ++k)
    product.segment(1, k + 1) -= (all[k] * product.head(k + 1)).eval();
  return product.tail(all.size()).real();
}

/// All time constants of Go are 1 + c_r times as long in experiment r, c_r random, at the same
/// static gain: the poles p become p^(1/(1 + c_r)).
class PlantTimeConstantSpread : public Effect {
 public:
  explicit PlantTimeConstantSpread(const std::string& variant)
      : Effect({"plant_parameter_spread",
                variant,
                variant +
                    " of the plant varies from experiment to experiment while its gain is constant",
                "Look for what makes the plant slower in some runs: temperature, load, wear; or "
                "identify with structure: continuous and error_model: {basis: parameter_spread, "
                "parameters: [tau1]}.",
                {},
                Stage::output,
                ScreeningKind::likelihood,
                {logVariance("deviation", "relative")},
                values({-6, -3, 0, 3, 6}),
                /*nonlinear=*/true,
                /*own_point=*/true,
                {Trait::in_mixture, Trait::by_experiment}}) {}

  /// Linearised about the value of c_r in each experiment, by a central difference.
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
    return std::max(size, kSmallest);
  }

 private:
  /// The output of Go with time constants 1 + c times as long.
  static Signals response(const Lanes& c, const Chain& chain) {
    std::vector<PlantCoefficients> plants;
    const int different = (c == c[0]).all() ? 1 : chain.block.lanes;
    plants.reserve(static_cast<std::size_t>(different));
    for (int lane = 0; lane < different; ++lane)
      plants.emplace_back(chain.nominal, withTimeConstants(c[lane], chain));
    return PlantDerivatives(&plants, chain.u).signal({});
  }

  /// theta of the plant with time constants 1 + c times as long. Poles at 0 and on the negative
  /// real axis have no time constant and stay.
  static VectorXd withTimeConstants(double c, const Chain& chain) {
    Polynomials p = chain.nominal.polynomials(chain.theta);
    VectorXcd poles = roots(p.a);
    for (Eigen::Index k = 0; k < poles.size(); ++k)
      if (poles[k].real() > 0 || poles[k].imag() != 0) poles[k] = std::pow(poles[k], 1 / (1 + c));
    const double before = 1 + p.a.sum();
    p.a = withRoots(poles);
    p.b *= (1 + p.a.sum()) / before;
    return chain.nominal.fromPolynomials(p);
  }
};

}  // namespace

/// One effect for each parameter that moves Go.
MadeEffects plantParameterSpread(const DataSummary& data) {
  MadeEffects all;
  for (const std::string& parameter : data.plant_parameters)
    all.push_back(std::make_shared<PlantParameterSpread>(parameter, static_cast<int>(all.size())));
  return all;
}

/// Only for plants whose parameters are polynomials: those of continuous plants include the time
/// constants, whose spreads plantParameterSpread() makes.
MadeEffects plantTimeConstantSpread(const DataSummary& data) {
  const auto& names = data.plant_parameters;
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (!has("a1")) return {};
  return {
      std::make_shared<PlantTimeConstantSpread>(has("a2") ? "time_constants" : "time_constant")};
}

}  // namespace uncertainty_identification
