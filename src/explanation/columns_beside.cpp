#include "explanation/columns_beside.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kOwn = 12, kOutput = 5;  // changes of the signal before this one, of the output
constexpr Index kColumns = kOwn + kOutput + 1;

/// Products of a signal's changes: its own before this one, those of the output until now, and
/// this one.
class Changes {
 public:
  void add(const Experiment& experiment, const VectorXd& signal) {
    for (Index t = kOwn + 1; t < signal.size(); ++t) {
      if (!isKnown(experiment, signal, t)) continue;
      VectorXd row(kColumns);
      for (Index k = 0; k < kOwn; ++k) row[k] = signal[t - k - 1] - signal[t - k - 2];
      for (Index k = 0; k < kOutput; ++k)
        row[kOwn + k] = experiment.y[t - k] - experiment.y[t - k - 1];
      row[kColumns - 1] = signal[t] - signal[t - 1];
      products_.selfadjointView<Eigen::Lower>().rankUpdate(row);
      ++rows_;
    }
  }

  /// Of what its own changes do not tell of this one, the share that the output tells. 0 where the
  /// data are too few, or where its own changes tell all.
  double toldByOutput() const {
    constexpr double kAll = 1e-6;
    const double power = products_(kColumns - 1, kColumns - 1);
    if (rows_ < 20 * kColumns || !(power > 0)) return 0;
    const double left = leftBy(kOwn);
    return left > kAll * power ? 1 - leftBy(kOwn + kOutput) / left : 0;
  }

 private:
  static bool isKnown(const Experiment& experiment, const VectorXd& signal, Index t) {
    for (Index k = 0; k <= kOutput; ++k)
      if (!experiment.isValid(static_cast<int>(t - k))) return false;
    return signal.segment(t - kOwn - 1, kOwn + 2).allFinite();
  }

  /// The sum of squares that the first columns leave of this change.
  double leftBy(Index columns) const {
    MatrixXd gram = products_.topLeftCorner(columns, columns).selfadjointView<Eigen::Lower>();
    gram.diagonal() *= 1 + 1e-9;
    gram.diagonal().array() += 1e-300;
    const VectorXd with = products_.bottomLeftCorner(1, columns).transpose();
    return products_(kColumns - 1, kColumns - 1) - with.dot(gram.ldlt().solve(with));
  }

  MatrixXd products_ = MatrixXd::Zero(kColumns, kColumns);
  Index rows_ = 0;
};

}  // namespace

std::string leaveOutReadingsOfTheOutput(const Configuration& configuration, Split* data) {
  constexpr double kReading = 0.05;
  std::map<std::string, Changes> all;
  for (const Experiment& experiment : data->train)
    for (const auto& [name, signal] : experiment.signals) all[name].add(experiment, signal);
  for (const SignalOptions& stated : configuration.covariates) all.erase(stated.name);
  std::string names;
  for (const auto& [name, changes] : all) {
    if (changes.toldByOutput() <= kReading) continue;
    names += (names.empty() ? "" : ", ") + name;
    for (std::vector<Experiment>* experiments : {&data->train, &data->held})
      for (Experiment& experiment : *experiments) experiment.signals.erase(name);
  }
  if (names.empty()) return "";
  return "no cause was sought in " + names +
         ": it follows the output within a sample, as another reading of the machine or what a "
         "controller makes of the output; 'covariates' states signals to be tried nevertheless";
}

}  // namespace uncertainty_identification
