#include "model/sensitivity.h"

#include <algorithm>
#include <complex>
#include <map>

#include "configuration/require.h"
#include "math/polynomial.h"
#include "model/plant_derivatives.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// A second derivative smaller than this share of the first is rounding.
constexpr double kVanishing = 1e-8;

using Eigen::ArrayXcd;
using Eigen::Index;
using Eigen::VectorXd;

/// Names of the entries of theta on which B or A depend.
std::vector<std::string> namesThatMoveGo(const NominalModel& nominal) {
  const std::vector<std::string> names = nominal.names();
  const VectorXd anywhere =
      nominal.fromUnbounded(VectorXd::Constant(static_cast<Index>(names.size()), 0.1));
  const Polynomials p = nominal.polynomials(anywhere);
  const Eigen::MatrixXd of_go = nominal.jacobian(anywhere).topRows(p.b.size() + p.a.size());
  std::vector<std::string> moving;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!of_go.col(static_cast<Index>(k)).isZero(0)) moving.push_back(names[k]);
  }
  return moving;
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all.empty() ? "none" : all;
}

/// Frequency responses of Go and of its derivatives, by the recursion of PlantDerivatives.
class PlantResponses {
 public:
  PlantResponses(const NominalModel& nominal, const VectorXd& theta, const VectorXd& omega)
      : plant_(nominal, theta),
        backward_shift_(
            (std::complex<double>(0, -1) * omega.cast<std::complex<double>>()).array().exp()) {}

  const ArrayXcd& response(const DerivativeIndex& index) {
    const auto known = responses_.find(index);
    if (known != responses_.end()) return known->second;
    const VectorXd all = plant_.derivative(index);
    ArrayXcd sum = polynomial(all.head(plant_.nb()), plant_.delay());
    const unsigned whole = 1u << index.size();
    for (unsigned mask = 1; mask < whole; ++mask) {
      DerivativeIndex part, rest;
      for (unsigned k = 0; k < index.size(); ++k)
        ((mask >> k & 1u) != 0 ? part : rest).push_back(index[k]);
      sum -= polynomial(plant_.derivative(part).tail(plant_.na()), 1) * response(rest);
    }
    sum /= 1.0 + polynomial(plant_.derivative({}).tail(plant_.na()), 1);
    return responses_.emplace(index, std::move(sum)).first->second;
  }

 private:
  /// sum_k c_k q^-(first + k)
  ArrayXcd polynomial(const VectorXd& coefficients, int first) const {
    ArrayXcd sum = ArrayXcd::Zero(backward_shift_.size());
    for (Index k = coefficients.size(); k-- > 0;) sum = sum * backward_shift_ + coefficients[k];
    return sum * backward_shift_.pow(first);
  }

  PlantCoefficients plant_;
  ArrayXcd backward_shift_;
  std::map<DerivativeIndex, ArrayXcd> responses_;
};

void subtract(const VectorXd& term, VectorXd* from) {
  if (from->size() < term.size()) from->conservativeResizeLike(VectorXd::Zero(term.size()));
  from->head(term.size()) -= term;
}

/// Numerators of the derivatives of Go, by the recursion of PlantDerivatives. Those of order n have
/// the denominator A^(n + 1).
class PlantNumerators {
 public:
  PlantNumerators(const NominalModel& nominal, const VectorXd& theta)
      : plant_(nominal, theta), denominator_(1 + plant_.na()) {
    denominator_ << 1, plant_.derivative({}).tail(plant_.na());
  }

  int delay() const { return plant_.delay(); }

  VectorXd timesPower(VectorXd x, std::size_t power) const {
    for (; power > 0; --power) x = product(x, denominator_);
    return x;
  }

  VectorXd numerator(const DerivativeIndex& index) {
    VectorXd sum = timesPower(plant_.derivative(index).head(plant_.nb()), index.size());
    const unsigned whole = 1u << index.size();
    for (unsigned mask = 1; mask < whole; ++mask) {
      DerivativeIndex part, rest;
      for (unsigned k = 0; k < index.size(); ++k)
        ((mask >> k & 1u) != 0 ? part : rest).push_back(index[k]);
      VectorXd change = VectorXd::Zero(1 + plant_.na());
      change.tail(plant_.na()) = plant_.derivative(part).tail(plant_.na());
      subtract(timesPower(product(change, numerator(rest)), part.size() - 1), &sum);
    }
    return sum;
  }

 private:
  PlantCoefficients plant_;
  VectorXd denominator_;
};

}  // namespace

bool variesParameters(BasisKind basis) {
  return basis == BasisKind::sensitivity || basis == BasisKind::parameter_spread;
}

double SensitivityTerms::scale(int i, const VectorXd& theta) const {
  const std::vector<int>& term = indices[static_cast<std::size_t>(i)];
  double product = term.size() == 2 && term[0] == term[1] ? 0.5 : 1.0;
  for (int j : term) product *= theta[j];
  return product;
}

double SensitivityTerms::scaleDerivative(int i, int l, const VectorXd& theta) const {
  const std::vector<int>& term = indices[static_cast<std::size_t>(i)];
  if (term.size() == 1) return term[0] == l ? 1.0 : 0.0;
  if (term[0] == term[1]) return term[0] == l ? theta[l] : 0.0;
  return term[0] == l ? theta[term[1]] : (term[1] == l ? theta[term[0]] : 0.0);
}

SensitivityTerms sensitivityTerms(const NominalModel& nominal, const ErrorModelOptions& options) {
  const std::vector<std::string> names = nominal.names(), moving = namesThatMoveGo(nominal);
  std::vector<int> varied;
  for (const std::string& name : options.parameters) {
    require(std::find(moving.begin(), moving.end(), name) != moving.end(), "error_model.parameters",
            name, "a parameter of Go: " + listed(moving));
    varied.push_back(static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin()));
  }
  SensitivityTerms terms;
  for (int j : varied) terms.indices.push_back({j});
  const VectorXd anywhere =
      nominal.fromUnbounded(VectorXd::Constant(static_cast<Index>(names.size()), 0.1));
  PlantNumerators plant(nominal, anywhere);
  const bool second = options.basis == BasisKind::sensitivity && options.sensitivity_order == 2;
  for (std::size_t j = 0; second && j < varied.size(); ++j) {
    for (std::size_t k = j; k < varied.size(); ++k) {
      const DerivativeIndex term = with({varied[j]}, varied[k]);
      const double first = plant.numerator({varied[j]}).norm();
      if (std::abs(anywhere[varied[k]]) * plant.numerator(term).norm() > kVanishing * first)
        terms.indices.push_back(term);
    }
  }
  return terms;
}

void completeErrorModel(const NominalModel& nominal, ErrorModelOptions* options) {
  if (!variesParameters(options->basis) || options->taps == 0) return;
  if (options->parameters.empty()) {
    const std::vector<std::string> moving = namesThatMoveGo(nominal);
    require(!moving.empty(), "error_model.basis", "one that varies parameters of Go",
            "fir, laguerre or kautz where Go has no free parameters (fit: simulation fixes it)");
    require(options->basis == BasisKind::sensitivity || moving.size() == 1,
            "error_model.parameters", "nothing",
            "the names of the parameters that vary between experiments, from " + listed(moving));
    options->parameters = moving;
  }
  const int count = sensitivityTerms(nominal, *options).count();
  require(count <= kMaxErrorParameters, "error_model.parameters",
          std::to_string(count) + " regressors",
          "at most " + std::to_string(kMaxErrorParameters) +
              "; name fewer parameters, or use sensitivity_order 1");
  options->taps = count;
}

SensitivityNumerators sensitivityNumerators(const NominalModel& nominal,
                                            const SensitivityTerms& terms, int order,
                                            const VectorXd& theta) {
  PlantNumerators plant(nominal, theta);
  const auto power = static_cast<std::size_t>(order);
  SensitivityNumerators all;
  all.delay = plant.delay();
  all.nominal = plant.timesPower(plant.numerator({}), power);
  const VectorXd denominator = plant.timesPower(VectorXd::Ones(1), power + 1);
  all.denominator = denominator.tail(denominator.size() - 1);
  all.terms.resize(0, terms.count());
  for (int i = 0; i < terms.count(); ++i) {
    const DerivativeIndex& index = terms.indices[static_cast<std::size_t>(i)];
    const VectorXd one =
        terms.scale(i, theta) * plant.timesPower(plant.numerator(index), power - index.size());
    if (one.size() > all.terms.rows())
      all.terms.conservativeResizeLike(Eigen::MatrixXd::Zero(one.size(), terms.count()));
    all.terms.col(i).head(one.size()) = one;
  }
  const Index size = std::max(all.nominal.size(), all.terms.rows());
  all.nominal.conservativeResizeLike(VectorXd::Zero(size));
  all.terms.conservativeResizeLike(Eigen::MatrixXd::Zero(size, terms.count()));
  return all;
}

Eigen::MatrixXcd sensitivityResponses(const NominalModel& nominal, const SensitivityTerms& terms,
                                      const VectorXd& theta, const VectorXd& omega) {
  PlantResponses plant(nominal, theta, omega);
  Eigen::MatrixXcd responses(omega.size(), terms.count());
  for (int i = 0; i < terms.count(); ++i) {
    responses.col(i) =
        terms.scale(i, theta) * plant.response(terms.indices[static_cast<std::size_t>(i)]);
  }
  return responses;
}

}  // namespace uncertainty_identification
