#include "model/piecewise_sweep.h"

#include <algorithm>
#include <cstring>

#include "math/interruption.h"
#include "math/polynomial.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SweepModel::SweepModel(const Polynomials& polynomials, const MatrixXd& T, double common_offset)
    : p(polynomials), monic_d(withLeadingOne(p.d)), offset(common_offset) {
  for (Index i = 0; i < T.cols(); ++i) {
    taps.push_back(T.col(i));
    of_input.push_back(product(p.b, taps.back()));
  }
  history = static_cast<int>(
      std::max({p.b.size() + T.rows(), p.a.size(), p.c.size(), p.d.size(), Index{1}}));
}

PiecewiseSweep::PiecewiseSweep(const SweepModel& model, const Block& block, const SweepStart& start,
                               std::vector<Lanes> input_taps)
    : model_(model),
      block_(block),
      start_(start),
      input_taps_(std::move(input_taps)),
      kernels_(sweepKernels()),
      active_(Lanes::Zero()),
      chains_(static_cast<std::size_t>(model.regressors()) + 1) {
  const auto most = static_cast<Index>(4 + 8 * chains_.size());
  memory_.reset(new double[static_cast<std::size_t>(most * stride())]);  // without initial values
  layOut();
  listDerivatives();
  restart();
}

void PiecewiseSweep::restart() {
  begin_ = samples_ = 0;
  active_.setZero();
  active_.head(block_.lanes).setOnes();
  for (Index s = 0; s < signals_; ++s)
    std::fill_n(memory_.get() + stride() * s, model_.history * kLanes, 0.0);
}

double* PiecewiseSweep::take() {
  double* start = memory_.get() + stride() * signals_++;
  return start + static_cast<Index>(model_.history) * kLanes;
}

void PiecewiseSweep::layOut() {
  const Polynomials& p = model_.p;
  const bool colored = p.c.size() + p.d.size() > 0;
  input_copy_ = take();
  filtered_input_ = input_taps_.empty() ? input_copy_ : take();
  over_a_ = p.a.size() > 0 ? take() : filtered_input_;
  white_input_ = colored ? take() : over_a_;
  copies_input_ = over_a_ == input_copy_;
  for (std::size_t s = 0; s < chains_.size(); ++s) layOut(s);
}

void PiecewiseSweep::layOut(std::size_t signal) {
  const Polynomials& p = model_.p;
  const bool colored = p.c.size() + p.d.size() > 0;
  const bool residual = signal + 1 == chains_.size();
  Chain& chain = chains_[signal];
  chain.driven = take();
  chain.raw = residual || start_.own_offset ? take() : chain.driven;
  chain.white = colored ? take() : chain.raw;
  chain.to_input = residual ? white_input_ : take();
  if (p.a.size() > 0) {
    chain.driven_a = take();
    chain.white_a = colored ? take() : chain.driven_a;
  }
  if (p.c.size() > 0) chain.white_c = take();
  if (p.d.size() > 0) chain.raw_c = p.c.size() > 0 ? take() : chain.raw;
  values_.push_back(chain.white);
  whitened_.add(chain.raw, chain.white);
}

void PiecewiseSweep::listDerivatives() {
  const Polynomials& p = model_.p;
  const auto list = [this](const double* signal, int first, Index count) {
    for (Index k = 0; k < count; ++k) derivatives_.push_back(signal - (first + k) * kLanes);
  };
  for (const Chain& chain : chains_) {
    list(chain.to_input, 0, p.b.size());
    list(chain.white_a, 1, p.a.size());
    list(chain.white_c, 1, p.c.size());
    list(chain.raw_c, 1, p.d.size());
  }
}

bool PiecewiseSweep::next() {
  checkpoint();
  keepHistory();
  begin_ += samples_;
  samples_ = 0;
  if (begin_ >= block_.samples) return false;
  endExperiments();
  loadInput();
  for (std::size_t s = 0; s < chains_.size(); ++s) drive(s);
  if (begin_ >= start_.noise || start_.values.empty()) {
    filter(model_.monic_d, model_.p.c, whitened_);
  } else {
    for (std::size_t s = 0; s < chains_.size(); ++s) {
      filterInjected(model_.monic_d, model_.p.c, chains_[s].raw, 0, start_.noise, s, -1,
                     chains_[s].white);
    }
  }
  return true;
}

void PiecewiseSweep::keepHistory() {
  if (begin_ + samples_ == 0) return;
  const Index kept = static_cast<Index>(model_.history) * kLanes;
  for (Index s = 0; s < signals_; ++s) {
    double* signal = memory_.get() + s * stride();
    std::memmove(signal, signal + static_cast<Index>(samples_) * kLanes,
                 static_cast<std::size_t>(kept) * sizeof(double));
  }
}

/// Zeroes all past of experiments that end before this piece, and lets the piece end where the next
/// one does. What follows is then zero, too, because all inputs are.
void PiecewiseSweep::endExperiments() {
  int end = std::min(begin_ + kPiece, block_.samples);
  for (int lane = 0; lane < block_.lanes; ++lane) {
    const int length = block_.lengths[static_cast<std::size_t>(lane)];
    if (length > begin_) {
      end = std::min(end, length);
    } else if (active_[lane] != 0) {
      active_[lane] = 0;
      for (Index s = 0; s < signals_; ++s) {
        double* signal = memory_.get() + s * stride() + lane;
        for (int k = 0; k < model_.history; ++k) signal[static_cast<Index>(k) * kLanes] = 0;
      }
    }
  }
  samples_ = end - begin_;
}

/// The delayed input with its past. It is read where it lies unless part of it lies before the
/// first sample, or belongs to an experiment that has ended.
void PiecewiseSweep::loadInput() {
  const int first = begin_ - model_.p.delay - model_.history;
  const bool ended = block_.ragged && active_.head(block_.lanes).sum() < block_.lanes;
  if (first >= 0 && !ended && !copies_input_) {
    input_ = block_.u.data() + static_cast<Index>(first + model_.history) * kLanes;
  } else {
    Eigen::Map<Signals> copy(input_copy_ - static_cast<Index>(model_.history) * kLanes, kLanes,
                             model_.history + samples_);
    const int zeros = std::clamp(-first, 0, static_cast<int>(copy.cols()));
    copy.leftCols(zeros).setZero();
    for (Index k = zeros; k < copy.cols(); ++k) copy.col(k) = block_.u.col(first + k) * active_;
    input_ = input_copy_;
  }
  if (input_taps_.empty()) {
    residual_input_ = input_;
    return;
  }
  residual_input_ = filtered_input_;
  Eigen::Map<Signals> filtered(filtered_input_, kLanes, samples_);
  filtered = Eigen::Map<const Signals>(input_, kLanes, samples_);
  for (std::size_t k = 0; k < input_taps_.size(); ++k) {
    const double* delayed = input_ - static_cast<Index>(k) * kLanes;
    filtered += Eigen::Map<const Signals>(delayed, kLanes, samples_).colwise() * input_taps_[k];
  }
}

void PiecewiseSweep::filter(const VectorXd& numerator, const VectorXd& denominator,
                            const double* const* in, std::size_t signals,
                            double* const* out) const {
  kernels_.filter({numerator.data(), static_cast<int>(numerator.size()), denominator.data(),
                   static_cast<int>(denominator.size())},
                  in, static_cast<int>(signals), samples_, block_.lanes, out);
}

/// The same for one signal, with `sign` times value `first` + k of the start added to the
/// numerator's output at sample k < count.
void PiecewiseSweep::filterInjected(const VectorXd& numerator, const VectorXd& denominator,
                                    const double* in, int first, int count, std::size_t signal,
                                    double sign, double* out) const {
  if (begin_ >= count || start_.values.empty()) return filter(numerator, denominator, &in, 1, &out);
  filter(numerator, VectorXd(), &in, 1, &out);
  for (int k = begin_; k < std::min(count, begin_ + samples_); ++k) {
    const Lanes& value =
        start_.values[static_cast<std::size_t>(first + k) * chains_.size() + signal];
    Eigen::Map<Lanes>(out + static_cast<Index>(k - begin_) * kLanes) += sign * active_ * value;
  }
  if (denominator.size() > 0) filter(VectorXd(), denominator, &out, 1, &out);
}

Lanes PiecewiseSweep::ownOffset(std::size_t signal) const {
  if (!start_.own_offset || start_.values.empty()) return Lanes::Zero();
  const auto row = static_cast<std::size_t>(start_.noise + start_.states);
  return active_ * start_.values[row * chains_.size() + signal];
}

/// Computes the regressor, or what the output exceeds Go u by, before noise whitening.
void PiecewiseSweep::drive(std::size_t signal) {
  const Polynomials& p = model_.p;
  const Chain& chain = chains_[signal];
  if (signal + 1 == chains_.size()) {
    filterInjected(p.b, p.a, residual_input_, start_.noise, start_.states, signal, 1, chain.driven);
    const Lanes offset = active_ * model_.offset + ownOffset(signal);
    kernels_.subtract(block_.y.data() + static_cast<Index>(begin_) * kLanes, chain.driven,
                      offset.data(), samples_, block_.lanes, chain.raw);
    return;
  }
  filterInjected(model_.of_input[signal], p.a, input_, start_.noise, start_.states, signal, -1,
                 chain.driven);
  if (!start_.own_offset) return;
  Eigen::Map<Signals>(chain.raw, kLanes, samples_) =
      Eigen::Map<const Signals>(chain.driven, kLanes, samples_).colwise() - ownOffset(signal);
}

void PiecewiseSweep::differentiate(bool regressors) {
  const std::size_t first = regressors ? 0 : chains_.size() - 1;
  if (over_c_of_.in.empty() && over_a_of_.in.empty()) group(first);
  const Polynomials& p = model_.p;
  if (p.a.size() > 0) {
    filter(VectorXd(), p.a, &residual_input_, 1, &over_a_);
    filter(VectorXd(), p.a, over_a_of_);
  }
  filter(model_.monic_d, p.c, whitened_a_);
  filter(VectorXd(), p.c, over_c_of_);
  for (std::size_t s = first; s + 1 < chains_.size(); ++s)
    filter(model_.taps[s], VectorXd(), &white_input_, 1, &chains_[s].to_input);
}

/// Groups the filters of the derivatives of signals `first` and following by what they divide by.
void PiecewiseSweep::group(std::size_t first) {
  const Polynomials& p = model_.p;
  whitened_a_.add(over_a_, white_input_);
  for (std::size_t s = first; s < chains_.size(); ++s) {
    const Chain& chain = chains_[s];
    if (p.a.size() > 0) {
      over_a_of_.add(chain.driven, chain.driven_a);
      whitened_a_.add(chain.driven_a, chain.white_a);
    }
    if (p.c.size() > 0) over_c_of_.add(chain.white, chain.white_c);
    if (p.d.size() > 0) over_c_of_.add(chain.raw, chain.raw_c);
  }
}

}  // namespace uncertainty_identification
