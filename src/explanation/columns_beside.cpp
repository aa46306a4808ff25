#include "explanation/columns_beside.h"

#include <algorithm>
#include <set>

#include "explanation/column_products.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Whether y at t, ..., t - before is measured, and the signal known there.
bool isKnown(const Experiment& experiment, const VectorXd& signal, Index t, Index before) {
  for (Index k = 0; k <= before; ++k)
    if (!experiment.isValid(static_cast<int>(t - k))) return false;
  return signal.segment(t - before, before + 1).allFinite();
}

/// Of what its own last changes do not tell of a signal's change, the share that the changes of the
/// output tell, up to the same sample. 0 where the data are too few, or where its own changes tell
/// all.
double toldByOutput(const std::vector<Experiment>& experiments, const std::string& name) {
  constexpr Index kOwn = 12, kOutput = 5;  // changes of the signal before this one, of the output
  constexpr double kAll = 1e-6;
  ColumnProducts products(kOwn + kOutput + 1);
  for (const Experiment& experiment : experiments) {
    const auto signal = experiment.signals.find(name);
    if (signal == experiment.signals.end()) continue;
    const VectorXd &x = signal->second, &y = experiment.y;
    for (Index t = kOwn + 1; t < x.size(); ++t) {
      if (!isKnown(experiment, x, t, kOutput) || !x.segment(t - kOwn - 1, kOwn + 2).allFinite())
        continue;
      VectorXd row(kOwn + kOutput + 1);
      for (Index k = 0; k < kOwn; ++k) row[k] = x[t - k - 1] - x[t - k - 2];
      for (Index k = 0; k < kOutput; ++k) row[kOwn + k] = y[t - k] - y[t - k - 1];
      row[kOwn + kOutput] = x[t] - x[t - 1];
      products.add(row);
    }
  }
  if (!products.areEnough()) return 0;
  const double left = products.leftBy(range(0, kOwn));
  return left > kAll ? 1 - products.leftBy(range(0, kOwn + kOutput)) / left : 0;
}

/// Whether the input is what a controller makes of this signal and the output: the signal tells
/// most of what the input's past and the output do not, and the output of what the input's past and
/// the signal do not.
bool isSetpoint(const std::vector<Experiment>& experiments, const std::string& name) {
  constexpr Index kPast = 4, kNow = kPast + 1;
  constexpr double kMost = 0.5, kAll = 1e-6;
  ColumnProducts products(kPast + 2 * kNow + 1);
  for (const Experiment& experiment : experiments) {
    const auto signal = experiment.signals.find(name);
    if (signal == experiment.signals.end()) continue;
    const double u_mean = experiment.u.mean(), level = signal->second[0];
    for (Index t = kPast; t < signal->second.size(); ++t) {
      if (!isKnown(experiment, signal->second, t, kPast)) continue;
      VectorXd row(kPast + 2 * kNow + 1);
      row << experiment.u.segment(t - kPast, kPast).array() - u_mean,
          experiment.y.segment(t - kPast, kNow).array() - level,
          signal->second.segment(t - kPast, kNow).array() - level, experiment.u[t] - u_mean;
      products.add(row);
    }
  }
  if (!products.areEnough()) return false;
  std::vector<Index> with_signal = range(0, kPast);
  for (const Index column : range(kPast + kNow, kNow)) with_signal.push_back(column);
  const double by_output = products.leftBy(range(0, kPast + kNow)),
               by_signal = products.leftBy(with_signal),
               by_both = products.leftBy(range(0, kPast + 2 * kNow));
  return by_output > kAll && by_both < (1 - kMost) * std::min(by_output, by_signal);
}

/// Leaves these signals out of the experiments; their names.
std::string leaveOut(const std::set<std::string>& names, Split* data) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
    for (std::vector<Experiment>* experiments : {&data->train, &data->held})
      for (Experiment& experiment : *experiments) experiment.signals.erase(name);
  }
  return text;
}

constexpr const char* kNevertheless = "; 'covariates' states signals to be tried nevertheless";

}  // namespace

std::vector<std::string> leaveOutColumnsOfTheLoop(const Configuration& configuration, Split* data) {
  constexpr double kReading = 0.05;
  std::set<std::string> all, readings, setpoints;
  for (const Experiment& experiment : data->train)
    for (const auto& [name, signal] : experiment.signals) all.insert(name);
  for (const SignalOptions& stated : configuration.covariates) all.erase(stated.name);
  for (const std::string& name : all) {
    if (toldByOutput(data->train, name) > kReading)
      readings.insert(name);
    else if (isSetpoint(data->train, name))
      setpoints.insert(name);
  }
  std::vector<std::string> remarks;
  if (!readings.empty())
    remarks.push_back("no cause was sought in " + leaveOut(readings, data) +
                      ": it follows the output within a sample, as another reading of the machine "
                      "or what a controller makes of the output" +
                      kNevertheless);
  if (!setpoints.empty())
    remarks.push_back("no cause was sought in " + leaveOut(setpoints, data) +
                      ": it moves the input together with the output, as the setpoint of a "
                      "controller that computes the input from both" +
                      kNevertheless);
  return remarks;
}

}  // namespace uncertainty_identification
