#include "export/exported_model.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "bounds/frequency_grid.h"
#include "math/polynomial.h"
#include "model/filter.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFrequencies = 500;
constexpr int kReferenceSamples = 300;  ///< in addition to the dead time

/// q^-delay num/den, one per row, filled up with zeros to equal length.
ExportedSystems ofEqualLength(int delay, const MatrixXd& num, const MatrixXd& den) {
  const Index length = std::max(delay + num.cols(), den.cols());
  ExportedSystems systems{
      MatrixXd::Zero(num.rows(), length), MatrixXd::Zero(num.rows(), length), {}};
  systems.num.middleCols(delay, num.cols()) = num;
  systems.den.leftCols(den.cols()) = den;
  return systems;
}

/// Plants and their responses, computed from the factors Go (1 + GDelta).
ExportedSystems plantSystems(const PlantSamples& plants, const VectorXd& omega) {
  const TransferFunctions models = transferFunctions(plants);
  ExportedSystems systems = ofEqualLength(plants.delay, models.num, models.den);
  systems.response = delayedResponses(plants, omega);
  return systems;
}

/// num/den without a delay.
ExportedSystems systemOf(const VectorXd& num, const VectorXd& den, const VectorXd& omega,
                         double sample_time) {
  ExportedSystems system = ofEqualLength(0, num.transpose(), den.transpose());
  system.response.resize(1, omega.size());
  for (Index k = 0; k < omega.size(); ++k) {
    const std::complex<double> z_inverse = std::polar(1.0, -omega[k] * sample_time);
    system.response(0, k) = valueAt(num, z_inverse) / valueAt(den, z_inverse);
  }
  return system;
}

MatrixXd stacked(const std::vector<Band>& bands, const VectorXd Band::*limit) {
  MatrixXd rows(bands.size(), bands.empty() ? 0 : (bands[0].*limit).size());
  for (std::size_t i = 0; i < bands.size(); ++i)
    rows.row(static_cast<Index>(i)) = (bands[i].*limit).transpose();
  return rows;
}

/// With the estimation errors where these are known.
const std::vector<Band>& pointwise(const UncertaintyBands& bands) {
  return bands.total.empty() ? bands.mixture.pointwise : bands.total.pointwise;
}

bool isTransferFunction(const VectorXd& num, const VectorXd& den) {
  return num.size() > 0 && den.size() > 0 && den[0] == 1 && num.allFinite() && den.allFinite();
}

void takeBounds(const Bounds& bounds, ExportedModel* model) {
  const FrequencyBounds& frequency = bounds.frequency;
  const std::vector<Band>&magnitude = pointwise(frequency.magnitude_bands),
        &phase = pointwise(frequency.phase_bands), &error = pointwise(frequency.relative_error);
  if (magnitude.empty()) {
    model->missing.push_back("bands: the result holds none");
  } else {
    model->bands = {
        Eigen::Map<const VectorXd>(bounds.levels.data(), static_cast<Index>(bounds.levels.size())),
        frequency.omega,
        stacked(magnitude, &Band::lower),
        stacked(magnitude, &Band::upper),
        stacked(phase, &Band::lower),
        stacked(phase, &Band::upper),
        stacked(error, &Band::upper)};
  }
  if (!bounds.weight) {
    model->missing.push_back("weight: the result holds none, as its plants do not differ");
    return;
  }
  if (!isTransferFunction(bounds.weight->num, bounds.weight->den)) {
    model->missing.push_back("weight: the result's is no transfer function");
    return;
  }
  model->weight =
      systemOf(bounds.weight->num, bounds.weight->den, model->omega, model->sample_time);
  model->weight_level = bounds.weight->level;
}

void drawSamples(const Estimate& estimate, int count, std::uint64_t seed, ExportedModel* model) {
  try {
    const PlantDistribution distribution(estimate);
    const bool total = distribution.hasEstimationErrors();
    if (!total && estimate.error_model.mixture.dimension() == 0) {
      model->missing.push_back(
          "plants drawn: the result holds neither an error model nor estimation errors");
      return;
    }
    model->samples_hold_estimation_errors = total;
    model->samples_seed = seed;
    model->samples = plantSystems(
        distribution.draw(count, total ? Uncertainty::total : Uncertainty::mixture, seed),
        model->omega);
  } catch (const Error& error) {
    model->missing.push_back(std::string("plants drawn: ") + error.what());
  }
}

VectorXd uniformSignal(Index samples, std::mt19937_64* random) {
  return VectorXd::NullaryExpr(samples, [random](Index) {
    return static_cast<double>((*random)() >> 11) * std::ldexp(1.0, -52) - 1;
  });
}

VectorXd filtered(const VectorXd& num, const VectorXd& monic, int delay, const VectorXd& in) {
  Signals lanes = Signals::Zero(kLanes, in.size()), out;
  lanes.row(0) = in.transpose();
  filter(num, monic, delay, lanes, &out);
  return out.row(0).transpose();
}

ReferenceSignals referenceSignals(const NominalModelEstimate& go, double offset_u,
                                  double offset_y) {
  std::mt19937_64 random(1);
  const Index samples = kReferenceSamples + go.delay;
  ReferenceSignals signals;
  signals.u = uniformSignal(samples, &random);
  signals.residual = uniformSignal(samples, &random);
  signals.y = filtered(go.b, go.a, go.delay, signals.u.array() + offset_u).array() + offset_y;
  signals.innovation = filtered(withLeadingOne(go.d), go.c, 0, signals.residual);
  return signals;
}

std::vector<std::string> aboutOf(const Result& result) {
  const Estimate& estimate = result.estimate;
  std::vector<std::string> lines{
      "Identified by uncertainty_identification " + estimate.version + ", data fingerprint " +
      estimate.data_fingerprint +
      (result.origin.date.empty() ? "" : ", " + result.origin.date + " UTC") + "."};
  if (!result.physical.sentence.empty()) lines.push_back(result.physical.sentence);
  for (std::string& line : lines) line = plainText(line);
  return lines;
}

/// Of ASCII.
bool isLetterOrDigit(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         (character >= '0' && character <= '9');
}

void noteWhatIsLeftOut(const Estimate& estimate, ExportedModel* model) {
  if (!estimate.effects.empty())
    model->missing.push_back("effects: only the linear model is exported, without the " +
                             std::to_string(estimate.effects.size()) + " effects that extend it");
  for (std::string& line : model->missing) line = plainText(line);
}

}  // namespace

ExportedModel exportedModel(const Result& result, const std::string& name, int count,
                            std::uint64_t seed) {
  const Estimate& estimate = result.estimate;
  const NominalModelEstimate& go = estimate.nominal_model;
  if (go.b.size() == 0) throw DataError("the result holds no model: B has no coefficients");
  ExportedModel model;
  model.name = name;
  model.about = aboutOf(result);
  model.sample_time = go.sample_time;
  model.delay = go.delay;
  model.offset_u = estimate.offset_u;
  model.offset_y = estimate.offset_y;
  model.noise_variance = estimate.noise_variance.value;
  model.omega = frequencyGrid(go, kFrequencies);
  model.plant = plantSystems({go.sample_time, go.delay, go.b.transpose(), go.a.transpose(),
                              MatrixXd(1, 0), ErrorModelOptions()},
                             model.omega);
  model.noise = systemOf(withLeadingOne(go.c), withLeadingOne(go.d), model.omega, go.sample_time);
  model.physical = result.physical;
  model.trust = estimate.trust;
  model.reference = referenceSignals(go, estimate.offset_u, estimate.offset_y);
  if (result.bounds) {
    takeBounds(*result.bounds, &model);
  } else {
    model.missing.push_back("bands and weight: the result holds no bounds");
  }
  drawSamples(estimate, count, seed, &model);
  noteWhatIsLeftOut(estimate, &model);
  return model;
}

std::string plainText(const std::string& text) {
  const std::string punctuation = " .,:;()[]+-=%/_<>'|";
  std::string plain = text;
  for (char& character : plain)
    if (!isLetterOrDigit(character) && punctuation.find(character) == std::string::npos)
      character = '?';
  return plain;
}

std::string identifierText(const std::string& text) {
  constexpr std::size_t kLongest = 40;
  std::string name = text.substr(0, kLongest);
  for (char& character : name)
    if (!isLetterOrDigit(character)) character = '_';
  const bool begins_with_letter = !name.empty() && name[0] > '9' && name[0] != '_';
  return begins_with_letter ? name : ("model_" + name).substr(0, kLongest);
}

}  // namespace uncertainty_identification
