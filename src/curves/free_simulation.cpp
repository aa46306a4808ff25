#include "curves/free_simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "curves/linear_simulation.h"
#include "curves/simulator.h"

namespace uncertainty_identification {
namespace {

constexpr double kOutputState = 0.1;  ///< unit of curves that act on the output's own state

}  // namespace

Simulator::Simulator(const CurveModel& model, const std::vector<CurveTable>& tables,
                     const SimulationWindow& window, bool with_derivatives)
    : model_(model),
      tables_(tables),
      window_(window),
      derive_(with_derivatives),
      columns_(with_derivatives ? model.parameters() + model.initialValues() : 0),
      memory_(model.curves.size()) {
  for (std::size_t c = 0; c < model.curves.size(); ++c) {
    first_.push_back(model.firstOf(c));
    const std::string& name = model.curves[c].covariate();
    covariates_.push_back(name.empty() ? nullptr : window.covariates.at(name).data());
    const Place place = model.curves[c].place();
    input_moves_ |= place == Place::input || place == Place::play || place == Place::rate_limit ||
                    place == Place::input_hysteresis;
    gain_moves_ |= place == Place::position_gain || place == Place::rate_gain ||
                   place == Place::time_gain || place == Place::covariate_gain;
    state_moves_ |= place == Place::output_state;
    reads_rate_ |= place == Place::rate || place == Place::rate_gain;
  }
}

void Simulator::begin(const Eigen::VectorXd& initial) {
  state_ = initial.head(model_.order);
  level_ = model_.own_level ? initial[model_.order] : 0;
  by_state_ = Eigen::ArrayXXd::Zero(columns_, model_.order);
  if (derive_) by_state_.middleRows(model_.parameters(), model_.order).matrix().setIdentity();
  previous_ = valueBefore(window_);
  for (Eigen::ArrayXd* each :
       {&previous_by_, &x_.by, &input_.by, &gain_.by, &added_.by, &to_state_.by, &rate_.by,
        &total_.by, &plant_output_.by, &output_.by})
    each->setZero(columns_);
  for (Memory& each : memory_) each.held.by.setZero(columns_);
}

void Simulator::advance() {
  const int n = model_.order;
  const double direct = model_.directGain();
  total_.value = input_.value * gain_.value + added_.value;
  plant_output_.value = x_.value + direct * total_.value;
  if (derive_) {
    total_.by = added_.by;
    if (input_moves_) total_.by += gain_.value * input_.by;
    if (gain_moves_) total_.by += input_.value * gain_.by;
    plant_output_.by = x_.by;
    if (model_.direct) {
      plant_output_.by += direct * total_.by;
      plant_output_.by[2 * n] += total_.value;
    }
  }
  for (int i = 0; i < n; ++i) {
    const double a = model_.theta[i], b = model_.theta[n + i];
    double next = (i + 1 < n ? state_[i + 1] : 0) - a * plant_output_.value + b * total_.value;
    if (i == 0) next += kOutputState * to_state_.value;
    const bool diverges = !(std::abs(next) <= kLargestState);
    state_[i] = diverges ? (next < 0 ? -kLargestState : kLargestState) : next;
    if (!derive_) continue;
    if (diverges) {
      by_state_.col(i).setZero();
      continue;
    }
    if (i + 1 < n)
      by_state_.col(i) = by_state_.col(i + 1) - a * plant_output_.by + b * total_.by;
    else
      by_state_.col(i) = b * total_.by - a * plant_output_.by;
    if (i == 0 && state_moves_) by_state_.col(i) += kOutputState * to_state_.by;
    by_state_(i, i) -= plant_output_.value;
    by_state_(n + i, i) += total_.value;
  }
}

double Simulator::step(int k) {
  x_.value = state_[0];
  input_.value = window_.u[std::max(k - model_.delay, 0)];
  gain_.value = 1;
  added_.value = model_.theta[model_.biasIndex()];
  to_state_.value = 0;
  rate_.value = (x_.value - previous_) / model_.rate_scale;
  if (derive_) {
    x_.by = by_state_.col(0);
    if (input_moves_) input_.by.setZero();
    if (gain_moves_) gain_.by.setZero();
    if (state_moves_) to_state_.by.setZero();
    added_.by.setZero();
    added_.by[model_.biasIndex()] = 1;
    if (reads_rate_) {
      rate_.by = (x_.by - previous_by_) / model_.rate_scale;
      previous_by_ = x_.by;
    }
  }
  previous_ = x_.value;
  actOnInput(k);
  feedBack(k);
  advance();
  actOnOutput();
  output_.value += level_;
  if (derive_ && model_.own_level) output_.by[columns_ - 1] += 1;
  return output_.value;
}

FreeSimulation simulateFreely(const CurveModel& model, const std::vector<CurveTable>& tables,
                              const SimulationWindow& window, const Eigen::VectorXd& initial,
                              bool with_derivatives) {
  if (model.curves.empty())
    if (auto linear = simulateLinearly(model, window, initial, with_derivatives))
      return std::move(*linear);
  FreeSimulation simulated;
  const int samples = window.samples();
  simulated.y.resize(samples);
  simulated.rate.resize(samples);
  if (with_derivatives)
    simulated.derivatives.resize(model.parameters() + model.initialValues(), samples);
  Simulator simulator(model, tables, window, with_derivatives);
  simulator.begin(initial);
  for (int k = 0; k < samples; ++k) {
    simulated.y[k] = simulator.step(k);
    simulated.rate[k] = simulator.rate();
    if (with_derivatives) simulated.derivatives.col(k) = simulator.outputDerivatives().matrix();
  }
  return simulated;
}

double valueBefore(const SimulationWindow& window) {
  const int ahead = std::min(3, window.samples() - 1);
  return window.y[0] - (ahead > 0 ? (window.y[ahead] - window.y[0]) / ahead : 0.0);
}

std::vector<CurveTable> tablesOf(const CurveModel& model) {
  std::vector<CurveTable> tables;
  for (std::size_t c = 0; c < model.curves.size(); ++c) {
    const Curve& curve = model.curves[c];
    tables.push_back(isScalar(curve.place()) ? CurveTable{} : curve.table(model.parametersOf(c)));
  }
  return tables;
}

}  // namespace uncertainty_identification
