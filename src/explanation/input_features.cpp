#include "explanation/input_features.h"

#include "math/polynomial.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Feature {
  std::string name;
  Signals signal;
};

void addShiftsOf(const Signals& u, std::vector<Feature>* all) {
  for (const int lag : {0, 1, 2, 3, 5, 8}) {
    Signals v;
    shift(lag, u, &v);
    const std::string of = " of the input " + std::to_string(lag) + " samples before";
    all->push_back({"the value" + of, v});
    all->push_back({"the square" + of, v.square() - 1});
    all->push_back({"the cube" + of, v.cube()});
    all->push_back({"the size" + of, v.abs()});
  }
}

std::vector<Feature> featuresOf(const Fit& fit, const Block& block, const DataSummary& scales) {
  const Polynomials p = fit.model->nominal().polynomials(
      fit.at.parameters.head(fit.model->nominal().parameterCount()));
  Signals x, before;
  filter(p.b, p.a, p.delay, block.u, &x);
  x /= scales.output_deviation;
  const Signals u = block.u / scales.input_deviation;
  shift(1, u, &before);
  Signals share = Signals::Zero(kLanes, block.samples);
  for (int lane = 0; lane < block.lanes; ++lane)
    share.row(lane) = Eigen::Array<double, 1, Eigen::Dynamic>::LinSpaced(
        block.samples, 0, 1.0 * block.samples / block.lengths[static_cast<std::size_t>(lane)]);
  std::vector<Feature> all;
  addShiftsOf(u, &all);
  all.push_back({"the square of the simulated output", x.square() - 1});
  all.push_back({"the cube of the simulated output", x.cube()});
  all.push_back({"a gain of the output that changes over time", x * share});
  all.push_back({"a gain of the input that changes over time", u * share});
  all.push_back({"a constant", Signals::Ones(kLanes, block.samples)});
  all.push_back({"time", share});
  all.push_back({"the product of output and input", x * before});
  for (const auto& [name, mean] : scales.covariates) {
    Signals value = Signals::Zero(kLanes, block.samples);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Experiment& experiment = *block.experiments[static_cast<std::size_t>(lane)];
      const auto signal = experiment.signals.find(name);
      if (signal == experiment.signals.end()) continue;
      value.row(lane).head(signal->second.size()) = signal->second.transpose().array() - mean;
    }
    all.push_back({name, value});
    all.push_back({"the product of " + name + " and the output", x * value});
  }
  return all;
}

}  // namespace

FeatureProducts featureProducts(const Fit& fit, const FitData& data,
                                const std::vector<Signals>& residual) {
  const DataSummary scales = summarise(data.experiments());
  const Polynomials p = fit.model->nominal().polynomials(
      fit.at.parameters.head(fit.model->nominal().parameterCount()));
  FeatureProducts sums;
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    std::vector<Feature> features = featuresOf(fit, data.blocks()[b], scales);
    std::vector<Signals> whitened(features.size());
    std::vector<const Signals*> list;
    sums.names.clear();
    for (std::size_t i = 0; i < features.size(); ++i) {
      filter(withLeadingOne(p.d), p.c, 0, features[i].signal, &whitened[i]);
      whitened[i] *= data.blocks()[b].weight;
      list.push_back(&whitened[i]);
      sums.names.push_back(features[i].name);
    }
    list.push_back(&residual[b]);
    const auto size = static_cast<Index>(features.size());
    if (sums.gram.size() == 0) {
      sums.gram = MatrixXd::Zero(size, size);
      sums.cross = VectorXd::Zero(size);
    }
    const std::vector<Lanes> products = innerProducts(list, list);
    for (Index i = 0; i < size; ++i) {
      for (Index j = 0; j < size; ++j)
        sums.gram(i, j) += products[static_cast<std::size_t>(i * (size + 1) + j)].sum();
      sums.cross[i] += products[static_cast<std::size_t>(i * (size + 1) + size)].sum();
    }
  }
  return sums;
}

}  // namespace uncertainty_identification
