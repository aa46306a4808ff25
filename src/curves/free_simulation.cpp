#include "curves/free_simulation.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {
namespace {

constexpr double kLargest = 50;       ///< standard deviations at which a diverging state is held
constexpr double kOutputState = 0.1;  ///< unit of curves that act on the output's own state

/// A quantity and its derivatives by theta and the initial state.
struct Dual {
  double value = 0;
  Eigen::ArrayXd by;
};

/// Play or rate limit: what it remembers.
struct Memory {
  bool is_set = false;
  Dual held;
};

class Simulator {
 public:
  Simulator(const CurveModel& model, const std::vector<CurveTable>& tables,
            const SimulationWindow& window, bool with_derivatives);
  void begin(const Eigen::VectorXd& initial);
  double step(int k);
  const Eigen::ArrayXd& outputDerivatives() const { return output_.by; }
  double rate() const { return rate_.value; }

 private:
  double curveAt(std::size_t curve, double z);
  /// slope * through + basis of the curve that was looked up last, times factor.
  void addDerivatives(std::size_t curve, double slope, const Eigen::ArrayXd* through, double factor,
                      Eigen::ArrayXd* to) const;
  void add(std::size_t curve, const Dual& through, Dual* to);
  void distort(std::size_t curve, Dual* signal);
  void multiply(std::size_t curve, double z, const Eigen::ArrayXd* through);
  void play(std::size_t curve, Dual* signal);
  void limitRate(std::size_t curve, Dual* signal);
  double widthOf(std::size_t curve, double* sign) const;
  void actOnInput();
  void feedBack(int k);
  void actOnOutput();
  void advance();

  const CurveModel& model_;
  const std::vector<CurveTable>& tables_;
  const SimulationWindow& window_;
  const bool derive_;
  // Derivatives of what no curve acts on stay zero.
  bool input_moves_ = false, gain_moves_ = false, state_moves_ = false, reads_rate_ = false;
  const int columns_;
  std::vector<int> first_;
  std::vector<const double*> covariates_;
  std::vector<Memory> memory_;
  Eigen::VectorXd state_;
  Eigen::ArrayXXd by_state_;  ///< columns_ x order
  double previous_ = 0;
  Eigen::ArrayXd previous_by_;
  Dual x_, input_, gain_, added_, to_state_, rate_, total_, plant_output_, output_;
  int left_ = 0;
  double share_ = 0;
};

Simulator::Simulator(const CurveModel& model, const std::vector<CurveTable>& tables,
                     const SimulationWindow& window, bool with_derivatives)
    : model_(model),
      tables_(tables),
      window_(window),
      derive_(with_derivatives),
      columns_(with_derivatives ? model.parameters() + model.order : 0),
      memory_(model.curves.size()) {
  for (std::size_t c = 0; c < model.curves.size(); ++c) {
    first_.push_back(model.firstOf(c));
    const std::string& name = model.curves[c].covariate();
    covariates_.push_back(name.empty() ? nullptr : window.covariates.at(name).data());
    const Place place = model.curves[c].place();
    input_moves_ |= place == Place::input || place == Place::play || place == Place::rate_limit;
    gain_moves_ |= place == Place::position_gain || place == Place::rate_gain ||
                   place == Place::time_gain || place == Place::covariate_gain;
    state_moves_ |= place == Place::output_state;
    reads_rate_ |= place == Place::rate || place == Place::rate_gain;
  }
}

void Simulator::begin(const Eigen::VectorXd& initial) {
  state_ = initial;
  by_state_ = Eigen::ArrayXXd::Zero(columns_, model_.order);
  if (derive_) by_state_.bottomRows(model_.order).matrix().setIdentity();
  const int ahead = std::min(3, window_.samples() - 1);
  previous_ = window_.y[0] - (ahead > 0 ? (window_.y[ahead] - window_.y[0]) / ahead : 0.0);
  for (Eigen::ArrayXd* each :
       {&previous_by_, &x_.by, &input_.by, &gain_.by, &added_.by, &to_state_.by, &rate_.by,
        &total_.by, &plant_output_.by, &output_.by})
    each->setZero(columns_);
  for (Memory& each : memory_) each.held.by.setZero(columns_);
}

double Simulator::curveAt(std::size_t curve, double z) {
  return tables_[curve].locate(z, &left_, &share_);
}

void Simulator::addDerivatives(std::size_t curve, double slope, const Eigen::ArrayXd* through,
                               double factor, Eigen::ArrayXd* to) const {
  if (!derive_) return;
  if (through) *to += (factor * slope) * *through;
  const int count = model_.curves[curve].parameters();
  const auto& columns = tables_[curve].columns;
  to->segment(first_[curve], count) += factor * ((1 - share_) * columns.col(left_).tail(count) +
                                                 share_ * columns.col(left_ + 1).tail(count))
                                                    .array();
}

/// to += curve(through)
void Simulator::add(std::size_t curve, const Dual& through, Dual* to) {
  const double slope = curveAt(curve, through.value);
  const auto& columns = tables_[curve].columns;
  to->value += (1 - share_) * columns(0, left_) + share_ * columns(0, left_ + 1);
  addDerivatives(curve, slope, &through.by, 1, &to->by);
}

/// signal += curve(signal)
void Simulator::distort(std::size_t curve, Dual* signal) {
  const double slope = curveAt(curve, signal->value);
  const auto& columns = tables_[curve].columns;
  signal->value += (1 - share_) * columns(0, left_) + share_ * columns(0, left_ + 1);
  if (derive_) signal->by *= 1 + slope;
  addDerivatives(curve, 0, nullptr, 1, &signal->by);
}

/// gain_ *= 1 + curve(z)
void Simulator::multiply(std::size_t curve, double z, const Eigen::ArrayXd* through) {
  const double slope = curveAt(curve, z);
  const auto& columns = tables_[curve].columns;
  const double factor = 1 + (1 - share_) * columns(0, left_) + share_ * columns(0, left_ + 1);
  if (derive_) gain_.by *= factor;
  addDerivatives(curve, slope, through, gain_.value, &gain_.by);
  gain_.value *= factor;
}

double Simulator::widthOf(std::size_t curve, double* sign) const {
  const double raw = model_.theta[first_[curve]];
  *sign = raw < 0 ? -1 : 1;
  return std::abs(raw) + 1e-6;
}

void Simulator::play(std::size_t curve, Dual* signal) {
  Memory& memory = memory_[curve];
  double sign = 1;
  const double width = widthOf(curve, &sign);
  if (!memory.is_set) memory = {true, *signal};
  const double side = memory.held.value < signal->value - width   ? -1
                      : memory.held.value > signal->value + width ? 1
                                                                  : 0;
  if (side != 0) {
    memory.held.value = signal->value + side * width;
    if (derive_) {
      memory.held.by = signal->by;
      memory.held.by[first_[curve]] += side * sign;
    }
  }
  *signal = memory.held;
}

void Simulator::limitRate(std::size_t curve, Dual* signal) {
  Memory& memory = memory_[curve];
  double sign = 1;
  const double limit = widthOf(curve, &sign);
  if (!memory.is_set) memory = {true, *signal};
  const double change = signal->value - memory.held.value;
  if (std::abs(change) <= limit) {
    memory.held = *signal;
  } else {
    memory.held.value += change > 0 ? limit : -limit;
    if (derive_) memory.held.by[first_[curve]] += change > 0 ? sign : -sign;
  }
  *signal = memory.held;
}

void Simulator::actOnInput() {
  for (std::size_t c = 0; c < model_.curves.size(); ++c) {
    switch (model_.curves[c].place()) {
      case Place::input:
        distort(c, &input_);
        break;
      case Place::play:
        play(c, &input_);
        break;
      case Place::rate_limit:
        limitRate(c, &input_);
        break;
      default:
        break;
    }
  }
}

void Simulator::feedBack(int k) {
  for (std::size_t c = 0; c < model_.curves.size(); ++c) {
    switch (model_.curves[c].place()) {
      case Place::position:
        add(c, x_, &added_);
        break;
      case Place::output_state:
        add(c, x_, &to_state_);
        break;
      case Place::rate:
        add(c, rate_, &added_);
        break;
      case Place::position_gain:
        multiply(c, x_.value, &x_.by);
        break;
      case Place::rate_gain:
        multiply(c, rate_.value, &rate_.by);
        break;
      case Place::time_gain:
        multiply(c, window_.time[k], nullptr);
        break;
      case Place::covariate_gain:
        multiply(c, covariates_[c][k], nullptr);
        break;
      case Place::input_times_position: {
        const double slope = curveAt(c, input_.value);
        const auto& columns = tables_[c].columns;
        const double value = (1 - share_) * columns(0, left_) + share_ * columns(0, left_ + 1);
        added_.value += x_.value * value;
        if (derive_) added_.by += value * x_.by;
        addDerivatives(c, slope, &input_.by, x_.value, &added_.by);
        break;
      }
      case Place::time:
      case Place::covariate: {
        const double z =
            model_.curves[c].place() == Place::time ? window_.time[k] : covariates_[c][k];
        curveAt(c, z);
        const auto& columns = tables_[c].columns;
        added_.value += (1 - share_) * columns(0, left_) + share_ * columns(0, left_ + 1);
        addDerivatives(c, 0, nullptr, 1, &added_.by);
        break;
      }
      default:
        break;
    }
  }
}

void Simulator::actOnOutput() {
  output_ = plant_output_;
  for (std::size_t c = 0; c < model_.curves.size(); ++c) {
    if (model_.curves[c].place() == Place::sensor) {
      distort(c, &output_);
    } else if (model_.curves[c].place() == Place::output_play) {
      play(c, &output_);
    }
  }
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
    const bool diverges = !(std::abs(next) <= kLargest);
    state_[i] = diverges ? (next < 0 ? -kLargest : kLargest) : next;
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
  actOnInput();
  feedBack(k);
  advance();
  actOnOutput();
  return output_.value;
}

}  // namespace

FreeSimulation simulateFreely(const CurveModel& model, const std::vector<CurveTable>& tables,
                              const SimulationWindow& window, const Eigen::VectorXd& initial,
                              bool with_derivatives) {
  FreeSimulation simulated;
  const int samples = window.samples();
  simulated.y.resize(samples);
  simulated.rate.resize(samples);
  if (with_derivatives) simulated.derivatives.resize(model.parameters() + model.order, samples);
  Simulator simulator(model, tables, window, with_derivatives);
  simulator.begin(initial);
  for (int k = 0; k < samples; ++k) {
    simulated.y[k] = simulator.step(k);
    simulated.rate[k] = simulator.rate();
    if (with_derivatives) simulated.derivatives.col(k) = simulator.outputDerivatives().matrix();
  }
  return simulated;
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
