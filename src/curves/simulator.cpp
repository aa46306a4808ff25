// What the curves, plays and limits at each place do to the signals and to their derivatives.
#include "curves/simulator.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {

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

/// added_ += factor curve(through)
void Simulator::addProduct(std::size_t curve, const Dual& through, const Dual& factor) {
  const double slope = curveAt(curve, through.value);
  const auto& columns = tables_[curve].columns;
  const double value = (1 - share_) * columns(0, left_) + share_ * columns(0, left_ + 1);
  added_.value += factor.value * value;
  if (derive_) added_.by += value * factor.by;
  addDerivatives(curve, slope, &through.by, factor.value, &added_.by);
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

/// input_ += the input behind plays, weighted
void Simulator::addPlays(std::size_t curve, int k) {
  const auto plays = window_.plays.row(std::max(k - model_.delay, 0)).transpose();
  input_.value += plays.dot(model_.theta.segment(first_[curve], kPlays));
  if (derive_) input_.by.segment(first_[curve], kPlays) += plays.array();
}

void Simulator::actOnInput(int k) {
  for (std::size_t c = 0; c < model_.curves.size(); ++c) {
    switch (model_.curves[c].place()) {
      case Place::input:
        distort(c, &input_);
        break;
      case Place::input_hysteresis:
        addPlays(c, k);
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

/// added_ += curve(error) - curve(0), where the error is the input less the one that holds x: the
/// loop rests where it is zero.
void Simulator::actOnLoop(std::size_t curve) {
  const int n = model_.order, bias = model_.biasIndex();
  const double inverse = model_.inverseGain(), gains = model_.sumOfB();
  error_.value = input_.value + model_.theta[bias] - inverse * x_.value;
  if (derive_) {
    error_.by = input_.by - inverse * x_.by;
    error_.by[bias] += 1;
    error_.by.head(n) -= x_.value / gains;
    error_.by.segment(n, n) += inverse * x_.value / gains;
  }
  add(curve, error_, &added_);
  curveAt(curve, 0);
  const auto& columns = tables_[curve].columns;
  added_.value -= (1 - share_) * columns(0, left_) + share_ * columns(0, left_ + 1);
  addDerivatives(curve, 0, nullptr, -1, &added_.by);
}

/// added_ += |u| curve(x)
void Simulator::addBySizeOfInput(std::size_t curve) {
  const double input = input_.value + model_.input_zero;
  size_.value = std::abs(input);
  if (derive_) size_.by = input < 0 ? -input_.by : input_.by;
  addProduct(curve, x_, size_);
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
      case Place::loop_error:
        actOnLoop(c);
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
      case Place::input_times_position:
        addProduct(c, input_, x_);
        break;
      case Place::hysteresis:
        addBySizeOfInput(c);
        break;
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

}  // namespace uncertainty_identification
