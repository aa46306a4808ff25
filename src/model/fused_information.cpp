#include "model/box_jenkins_sweep.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// The Gram matrix of [Phi d] for derivatives d to the parameters, from that of derivatives to the
/// coefficients.
MatrixXd onParameters(const MatrixXd& gram, Index n, const MatrixXd& jacobian) {
  const Index count = jacobian.rows(), p = jacobian.cols();
  MatrixXd made(n + p, n + p);
  made.topLeftCorner(n, n) = gram.topLeftCorner(n, n);
  made.topRightCorner(n, p) = gram.topRightCorner(n, count) * jacobian;
  made.bottomLeftCorner(p, n) = made.topRightCorner(n, p).transpose();
  made.bottomRightCorner(p, p) =
      jacobian.transpose() * gram.bottomRightCorner(count, count) * jacobian;
  return made;
}

}  // namespace

/// The taps of 1 + GDelta at the means of xi.
std::vector<Lanes> BoxJenkinsSweep::inputTaps(const LaneMatrix& means) const {
  std::vector<Lanes> taps;
  for (Index i = 0; i < means.rows(); ++i) {
    const Eigen::VectorXd& of_regressor = model_.taps[static_cast<std::size_t>(i)];
    taps.resize(static_cast<std::size_t>(of_regressor.size()), Lanes::Zero());
    for (Index k = 0; k < of_regressor.size(); ++k)
      taps[static_cast<std::size_t>(k)] += of_regressor[k] * means(i, 0);
  }
  return taps;
}

/// Initial values of the residual become those of e - Phi m.
void BoxJenkinsSweep::moveToMeans(const LaneMatrix& means, LaneMatrix* values) const {
  for (Index k = 0; k < values->rows(); ++k) {
    for (Index i = 0; i < means.rows(); ++i)
      (*values)(k, size() - 1) -= means(i, 0) * (*values)(k, i);
  }
}

/// Derivatives of the residual's coefficients to the parameters, with the signs of
/// PiecewiseSweep::derivatives(); a common offset has a row of its own.
MatrixXd BoxJenkinsSweep::signedJacobian() const {
  const Index step = step_ ? 1 : 0;
  MatrixXd all = MatrixXd::Zero(derived() + step, jacobian_.cols() + step);
  all.topLeftCorner(derived(), jacobian_.cols()) = residual_signs_.asDiagonal() * jacobian_;
  if (step_) all(derived(), jacobian_.cols()) = -1;
  return all;
}

namespace {

/// The means of xi of a block's experiments.
LaneMatrix meansOfLanes(const MatrixXd& means, Index n, const Block& block) {
  LaneMatrix of_lanes(n, 1);
  for (int lane = 0; lane < block.lanes; ++lane) {
    for (Index i = 0; i < n; ++i)
      of_lanes(i, 0)[lane] = means(i, block.index[static_cast<std::size_t>(lane)]);
  }
  return of_lanes;
}

}  // namespace

bool BoxJenkinsSweep::sensitivities(const Block& block, const MatrixXd& means,
                                    std::vector<MatrixXd>* products) const {
  if (block.gaps) return false;
  const Index n = size() - 1;
  const LaneMatrix of_lanes = meansOfLanes(means, n, block);
  SweepStart start = rest();
  InitialValues first = [&] {
    PiecewiseSweep sweep(model_, block, start);
    return initialValues(block, &sweep);
  }();
  moveToMeans(of_lanes, &first.values);
  start.values.swap(first.values.values());

  PiecewiseSweep sweep(model_, block, start, inputTaps(of_lanes));
  const auto own = static_cast<std::ptrdiff_t>(n * derived());  // those of the residual follow
  std::vector<const double*> changes(sweep.derivatives().begin() + own, sweep.derivatives().end());
  Signals step(kLanes, PiecewiseSweep::kPiece);
  if (step_) changes.push_back(step.data());
  std::vector<const double*> all(sweep.values().begin(), sweep.values().end() - 1);
  all.insert(all.end(), changes.begin(), changes.end());
  const auto count = static_cast<Index>(changes.size());
  LaneMatrix gram(n + count, n + count), of_columns(columns_.count(), count);
  while (sweep.next()) {
    sweep.differentiate(false);
    for (int t = 0; step_ && t < sweep.samples(); ++t)
      step.col(t) = step_->delayed(0)[sweep.begin() + t] * sweep.active();
    sweepKernels().products(all.data(), static_cast<int>(all.size()), all.data(),
                            static_cast<int>(all.size()), sweep.samples(), block.lanes,
                            gram.data());
    if (columns_.count() > 0) addColumnProducts(block, sweep, changes, &of_columns);
  }

  const MatrixXd jacobian = signedJacobian();
  const AbsorptionOfLanes absorbed = absorptions(block);
  products->clear();
  for (int lane = 0; lane < block.lanes; ++lane) {
    MatrixXd one = gram.lane(lane);
    one.topLeftCorner(n, n) += first.prior.lane(lane).topLeftCorner(n, n);
    const MatrixXd cross = of_columns.lane(lane);
    if (columns_.count() > 0) {
      one.bottomRightCorner(count, count) -=
          cross.transpose() * absorbed[static_cast<std::size_t>(lane)]->estimate * cross;
    }
    products->push_back(onParameters(one, n, jacobian));
  }
  return true;
}

}  // namespace uncertainty_identification
