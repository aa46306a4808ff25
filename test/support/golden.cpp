#include "support/golden.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification::test {
namespace {

using nlohmann::json;

std::ifstream open(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) throw FileError(path + ": cannot be opened");
  return stream;
}

Eigen::VectorXd toVector(const json& values) {
  Eigen::VectorXd vector(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    vector[static_cast<Eigen::Index>(i)] = values[i].get<double>();
  }
  return vector;
}

Eigen::MatrixXd toMatrix(const json& rows) {
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()),
                         static_cast<Eigen::Index>(rows.front().size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    matrix.row(static_cast<Eigen::Index>(i)) = toVector(rows[i]).transpose();
  }
  return matrix;
}

GoldenPoint toPoint(const json& object) {
  GoldenPoint point;
  point.theta = toVector(object.at("theta"));
  point.mixture.weights = object.at("weights").get<std::vector<double>>();
  for (const auto& mean : object.at("means")) point.mixture.means.push_back(toVector(mean));
  for (const auto& covariance : object.at("covariances")) {
    point.mixture.covariances.push_back(toMatrix(covariance));
  }
  point.noise_variance = object.at("noise_variance").get<double>();
  point.log_likelihood = object.value("log_likelihood", std::numeric_limits<double>::quiet_NaN());
  if (object.contains("gradient_theta_finite_difference")) {
    point.gradient_theta = toVector(object.at("gradient_theta_finite_difference"));
  }
  return point;
}

Eigen::VectorXd toVector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Columns experiment, t, u, y.
std::vector<Experiment> readExperiments(const std::string& path, double sample_time) {
  std::ifstream stream = open(path);
  std::string line;
  std::getline(stream, line);
  std::map<int, std::pair<std::vector<double>, std::vector<double>>> signals;
  while (std::getline(stream, line)) {
    std::istringstream fields(line);
    int experiment = 0;
    double t = 0, u = 0, y = 0;
    char comma = ',';
    fields >> experiment >> comma >> t >> comma >> u >> comma >> y;
    if (!fields) throw FileError(path + ": not four numbers: " + line);
    signals[experiment].first.push_back(u);
    signals[experiment].second.push_back(y);
  }
  std::vector<Experiment> experiments;
  for (const auto& [number, signal] : signals) {
    Experiment experiment;
    experiment.id = std::to_string(number);
    experiment.sample_time = sample_time;
    experiment.u = toVector(signal.first);
    experiment.y = toVector(signal.second);
    experiments.push_back(experiment);
  }
  return experiments;
}

}  // namespace

Golden readGolden(const std::string& name) {
  const std::string path = std::string(TEST_DATA) + "/golden/" + name;
  std::ifstream stream = open(path + ".json");
  const json document = json::parse(stream);
  const json& model = document.at("model");
  Golden golden;
  golden.nb = model.at("nb").get<int>();
  golden.na = model.at("na").get<int>();
  golden.nc = model.at("nc").get<int>();
  golden.nd = model.at("nd").get<int>();
  golden.delay = model.at("delay").get<int>();
  golden.T = toMatrix(document.at("error_basis_T"));
  for (const auto& point : document.at("likelihood_points")) {
    golden.points.push_back(toPoint(point));
  }
  golden.start = toPoint(document.at("start"));
  golden.optimum = toPoint(document.at("optimum"));
  golden.experiments = readExperiments(path + ".csv", model.at("sample_time").get<double>());
  return golden;
}

dense::Model denseModel(const Golden& golden, const GoldenPoint& point) {
  const int taps = static_cast<int>(golden.T.rows());
  dense::Model model;
  model.b = point.theta.head(golden.nb);
  model.a = point.theta.segment(golden.nb, golden.na);
  model.c = point.theta.segment(golden.nb + golden.na, golden.nc);
  model.d = point.theta.tail(golden.nd);
  model.delay = golden.delay;
  model.basis = dense::firBasis(taps, taps);
  model.basis_order = taps - 1;
  model.T = golden.T;
  model.mixture = point.mixture;
  model.noise_variance = point.noise_variance;
  return model;
}

}  // namespace uncertainty_identification::test
