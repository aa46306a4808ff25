#include "own_simulation/linear_factors.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <locale>
#include <sstream>

#include "configuration/require.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Complex = std::complex<double>;

constexpr double kRounding = 1e-7;  // of a pole, relative: double roots are known no better

/// Zeros, poles and the factor before prod(s - zero) / prod(s - pole).
struct ZerosPolesGain {
  std::vector<Complex> zeros, poles;
  double gain = 1;
};

std::vector<Complex> rootsOf(const Eigen::VectorXd& descending) {
  if (descending.size() < 2) return {};
  const Eigen::VectorXd monic = descending.tail(descending.size() - 1) / descending[0];
  Eigen::Index zeros = 0;  // at the origin; told apart exactly, since they are integrators
  while (zeros < monic.size() && monic[monic.size() - 1 - zeros] == 0) ++zeros;
  const Eigen::VectorXcd found = roots(monic.head(monic.size() - zeros));
  std::vector<Complex> all(found.data(), found.data() + found.size());
  all.insert(all.end(), static_cast<std::size_t>(zeros), Complex(0, 0));
  return all;
}

Eigen::VectorXd withoutLeadingZeros(const Eigen::VectorXd& descending, const std::string& key) {
  Eigen::Index first = 0;
  while (first < descending.size() && descending[first] == 0) ++first;
  require(first < descending.size(), key, "zeros only", "at least one coefficient other than 0");
  return descending.tail(descending.size() - first);
}

/// "-2", "-3+4j" or "1e-3-2i".
Complex complexNumber(const std::string& text, const std::string& key) {
  const auto number = [](const std::string& part, double* value) {
    std::istringstream stream(part);
    stream.imbue(std::locale::classic());
    return (stream >> *value) && stream.peek() == std::istringstream::traits_type::eof();
  };
  double real = 0, imaginary = 0;
  bool read = number(text, &real);
  if (!read && !text.empty() && (text.back() == 'j' || text.back() == 'i')) {
    std::size_t sign = text.find_last_of("+-");
    if (sign != std::string::npos && sign > 0 && (text[sign - 1] == 'e' || text[sign - 1] == 'E'))
      sign = text.find_last_of("+-", sign - 1);
    if (sign == std::string::npos) sign = 0;
    const std::string after = text.substr(sign, text.size() - sign - 1);
    read = (sign == 0 || number(text.substr(0, sign), &real)) &&
           number(after[0] == '+' ? after.substr(1) : after, &imaginary);
  }
  require(read && std::isfinite(real) && std::isfinite(imaginary), key, "'" + text + "'",
          "numbers such as -2 or -3+4j");
  return {real, imaginary};
}

std::vector<Complex> complexNumbers(const std::vector<std::string>& texts, const std::string& key) {
  std::vector<Complex> all(texts.size());
  std::transform(texts.begin(), texts.end(), all.begin(),
                 [&](const std::string& text) { return complexNumber(text, key); });
  for (const Complex& each : all) {
    const auto same = [&](const Complex& value) {
      return std::count_if(all.begin(), all.end(), [&](const Complex& other) {
        return std::abs(other - value) <= kRounding * std::abs(value);
      });
    };
    std::ostringstream found;
    found << each.real() << (each.imag() < 0 ? "" : "+") << each.imag() << "j alone";
    require(same(each) == same(std::conj(each)), key, found.str(),
            "complex numbers together with their conjugates");
  }
  return all;
}

double value(const OwnModelOptions& options, const std::string& name, double otherwise) {
  const auto found = options.physical.find(name);
  return found == options.physical.end() ? otherwise : found->second;
}

ZerosPolesGain readForm(const OwnModelOptions& options) {
  if (options.poles.empty()) {
    const Eigen::VectorXd num = withoutLeadingZeros(options.num, "simulation.model.num");
    const Eigen::VectorXd den = withoutLeadingZeros(options.den, "simulation.model.den");
    return {rootsOf(num), rootsOf(den), num[0] / den[0]};
  }
  return {complexNumbers(options.zeros, "simulation.model.zeros"),
          complexNumbers(options.poles, "simulation.model.poles"), value(options, "gain", 1)};
}

bool isReal(const Complex& root) { return std::abs(root.imag()) <= kRounding * std::abs(root); }

/// left times (1 + f1 x + f2 x^2), ascending powers.
Eigen::VectorXd with(const Eigen::VectorXd& left, double f1, double f2) {
  return product(left, f2 == 0 ? Eigen::VectorXd(Eigen::Vector2d(1, f1))
                               : Eigen::VectorXd(Eigen::Vector3d(1, f1, f2)));
}

/// Adds tau_k or omega_k and zeta_k for poles in the s plane, the slowest first.
void addPoles(std::vector<Complex> poles, LinearFactors* factors) {
  std::sort(poles.begin(), poles.end(), [](const Complex& left, const Complex& right) {
    return std::abs(left) < std::abs(right);
  });
  int reals = 0, pairs = 0;
  for (const Complex& pole : poles)
    if (isReal(pole))
      factors->parameters.push_back({"tau" + std::to_string(++reals), -1 / pole.real(), "s"});
  for (const Complex& pole : poles) {
    if (isReal(pole) || pole.imag() < 0) continue;
    const std::string number = std::to_string(++pairs);
    factors->parameters.push_back({"omega" + number, std::abs(pole), "rad/s"});
    factors->parameters.push_back({"zeta" + number, -pole.real() / std::abs(pole), "1"});
  }
}

void requireStable(bool stable, const Complex& pole, const std::string& where) {
  std::ostringstream found;
  found << "the pole " << pole.real();
  if (!isReal(pole)) found << (pole.imag() < 0 ? "" : "+") << pole.imag() << "j";
  require(stable, "simulation.model", found.str(),
          "poles " + where + ": an unstable model cannot be simulated without its controller");
}

void factoriseContinuous(const ZerosPolesGain& form, LinearFactors* factors) {
  double gain = form.gain;
  std::vector<Complex> poles;
  for (const Complex& pole : form.poles) {
    requireStable(pole.real() <= kRounding * std::abs(pole), pole,
                  "in the left half-plane or at 0");
    if (pole == Complex(0, 0)) {
      factors->fixed_denominator = product(factors->fixed_denominator, Eigen::Vector2d(0, 1));
      continue;
    }
    poles.push_back(pole);
    if (isReal(pole)) gain /= -pole.real();
    if (!isReal(pole) && pole.imag() > 0) gain /= std::norm(pole);
  }
  std::vector<SimulationParameter> zeros;
  for (const Complex& zero : form.zeros) {
    if (zero == Complex(0, 0)) {
      factors->fixed_numerator = product(factors->fixed_numerator, Eigen::Vector2d(0, 1));
    } else if (isReal(zero)) {
      gain *= -zero.real();
      zeros.push_back({"zero" + std::to_string(zeros.size() + 1), -1 / zero.real(), "s"});
    } else if (zero.imag() > 0) {
      gain *= std::norm(zero);
      factors->fixed_numerator =
          with(factors->fixed_numerator, -2 * zero.real() / std::norm(zero), 1 / std::norm(zero));
    }
  }
  factors->parameters.push_back({"gain", gain, ""});
  addPoles(poles, factors);
  factors->parameters.insert(factors->parameters.end(), zeros.begin(), zeros.end());
}

/// Coefficients of prod(1 - root z^-1).
Eigen::VectorXd coefficientsOf(const std::vector<Complex>& found) {
  Eigen::VectorXd all = Eigen::VectorXd::Ones(1);
  for (const Complex& root : found) {
    if (isReal(root)) all = with(all, -root.real(), 0);
    if (!isReal(root) && root.imag() > 0) all = with(all, -2 * root.real(), std::norm(root));
  }
  return all;
}

void factoriseSampled(const ZerosPolesGain& form, LinearFactors* factors) {
  double static_denominator = 1;
  std::vector<Complex> continuous;
  for (const Complex& pole : form.poles) {
    requireStable(std::abs(pole) <= 1 + kRounding, pole, "within the unit circle or at 1");
    const bool integrates = std::abs(pole - Complex(1, 0)) < kRounding;
    if (integrates || (isReal(pole) && pole.real() <= 0)) {
      factors->fixed_denominator = with(factors->fixed_denominator, -pole.real(), 0);
    } else {
      continuous.push_back(std::log(pole) / factors->sample_time);
    }
    if (integrates) continue;
    if (isReal(pole)) static_denominator *= 1 - pole.real();
    if (!isReal(pole) && pole.imag() > 0) static_denominator *= std::norm(1.0 - pole);
  }
  factors->delay = static_cast<int>(form.poles.size()) - static_cast<int>(form.zeros.size());
  const Eigen::VectorXd numerator = form.gain * coefficientsOf(form.zeros);
  const double sum = numerator.sum();
  const bool differentiates = std::abs(sum) < 1e-9 * numerator.cwiseAbs().sum();
  factors->fixed_numerator = numerator / (differentiates ? static_denominator : sum);
  factors->parameters.push_back({"gain", differentiates ? 1 : sum / static_denominator, ""});
  addPoles(continuous, factors);
}

std::string unitOf(const std::string& name) {
  if (name == "gain") return "";
  return name.rfind("omega", 0) == 0 ? "rad/s" : name.rfind("zeta", 0) == 0 ? "1" : "s";
}

int countOf(const OwnModelOptions& options, const std::string& kind) {
  return static_cast<int>(
      std::count_if(options.physical.begin(), options.physical.end(),
                    [&](const auto& each) { return each.first.rfind(kind, 0) == 0; }));
}

void takePhysical(const OwnModelOptions& options, LinearFactors* factors) {
  for (const std::string& name : physicalNames()) {
    const auto given = options.physical.find(name);
    if (name == "gain" && given == options.physical.end())
      factors->parameters.push_back({"gain", 1, ""});
    if (given == options.physical.end() || name == "dead_time") continue;
    factors->parameters.push_back({name, given->second, unitOf(name)});
    const std::string number = name.substr(name.size() - 1);
    for (const auto& [one, other] : {std::make_pair("omega", "zeta"), {"zeta", "omega"}})
      require(name.rfind(one, 0) != 0 || options.physical.count(other + number) > 0,
              "simulation.model." + (other + number), "nothing",
              "a number, because " + name + " is given");
  }
  const int zeros = countOf(options, "zero");
  const int poles = countOf(options, "tau") + 2 * countOf(options, "omega");
  require(zeros <= poles, "simulation.model",
          std::to_string(zeros) + " zeros and " + std::to_string(poles) + " poles",
          "at most as many zeros as poles");
}

}  // namespace

LinearFactors factorsOf(const OwnModelOptions& options, double sample_time) {
  LinearFactors factors;
  factors.domain = options.domain;
  factors.sample_time = sample_time;
  if (options.poles.empty() && options.num.size() == 0) {
    takePhysical(options, &factors);
  } else {
    const ZerosPolesGain form = readForm(options);
    require(form.zeros.size() <= form.poles.size(), "simulation.model",
            std::to_string(form.zeros.size()) + " zeros and " + std::to_string(form.poles.size()) +
                " poles",
            "at most as many zeros as poles");
    if (options.domain == TransferDomain::z) {
      require(
          options.sample_time == 0 ||
              std::abs(options.sample_time - sample_time) <= 1e-3 * sample_time,
          "simulation.model.sample_time", options.sample_time,
          "the data's sample time, " + std::to_string(sample_time) + " s; or give the model in s");
      factoriseSampled(form, &factors);
    } else {
      factoriseContinuous(form, &factors);
    }
  }
  factors.parameters.push_back({"dead_time", value(options, "dead_time", 0), "s"});
  return factors;
}

}  // namespace uncertainty_identification
