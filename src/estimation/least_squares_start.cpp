#include "estimation/least_squares_start.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "data/bridged_output.h"
#include "estimation/excerpt.h"
#include "math/interruption.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd overPolynomial(const VectorXd& in, const VectorXd& monic) {
  VectorXd out = in;
  for (Index t = 0; t < out.size(); ++t) {
    for (Index k = 1; k <= std::min<Index>(monic.size(), t); ++k)
      out[t] -= monic[k - 1] * out[t - k];
  }
  return out;
}

double lagged(const VectorXd& x, Index t) { return t >= 0 ? x[t] : 0.0; }

/// Upper triangular factor of a tall matrix whose rows are added one at a time.
class RowAccumulator {
 public:
  explicit RowAccumulator(Index columns)
      : columns_(columns),
        buffer_(MatrixXd::Zero(columns + std::max<Index>(4 * columns, 64), columns)) {}

  auto next() {
    if (used_ == buffer_.rows()) reduce();
    return buffer_.row(used_++);
  }

  MatrixXd factor() {
    reduce();
    return buffer_.topRows(columns_);
  }

 private:
  void reduce() {
    buffer_.bottomRows(buffer_.rows() - used_).setZero();
    triangularise();
    const MatrixXd R = buffer_.topRows(columns_).triangularView<Eigen::Upper>();
    buffer_.setZero();
    buffer_.topRows(columns_) = R;
    used_ = columns_;
  }

  /// The QR decomposition of the buffer, whose upper triangle becomes R. Many columns, as of long
  /// delays, are decomposed in panels, because all at once would take seconds.
  void triangularise() {
    constexpr Index kAtOnce = 256, kPanel = 64;
    const Index width = columns_ <= kAtOnce ? columns_ : kPanel;
    for (Index first = 0; first < columns_; first += width) {
      checkpoint();
      const Index own = std::min(width, columns_ - first), rows = buffer_.rows() - first;
      const Eigen::HouseholderQR<MatrixXd> qr(buffer_.block(first, first, rows, own));
      buffer_.block(first, first, rows, own) = qr.matrixQR();
      for (Index k = first + own; k < columns_; k += kAtOnce) {
        checkpoint();
        const Index others = std::min(kAtOnce, columns_ - k);
        buffer_.block(first, k, rows, others).applyOnTheLeft(qr.householderQ().adjoint());
      }
    }
  }

  Index columns_, used_ = 0;
  MatrixXd buffer_;
};

/// What filtering by 1/A from rest leaves of an unknown start: the free responses of 1/A. No column
/// for a record that is too short to show anything else.
MatrixXd freeResponses(const VectorXd& prefilter, const std::vector<Index>& times) {
  const Index na = prefilter.size(), rows = static_cast<Index>(times.size());
  if (na == 0 || rows <= 2 * na) return MatrixXd(rows, 0);
  VectorXd impulse = VectorXd::Zero(times.back() + na);
  impulse[0] = 1;
  const VectorXd response = overPolynomial(impulse, prefilter);
  MatrixXd free(rows, na);
  for (Index i = 0; i < rows; ++i) {
    for (Index k = 0; k < na; ++k)
      free(i, k) = response[times[static_cast<std::size_t>(i)] - times.front() + k];
  }
  return free;
}

/// A constant behind the prefilter, of which `one` is the response, at these times.
MatrixXd constantAt(const std::vector<Index>& times, const VectorXd& one) {
  MatrixXd constant(static_cast<Index>(times.size()), 1);
  for (Index i = 0; i < constant.rows(); ++i)
    constant(i, 0) = one[times[static_cast<std::size_t>(i)]];
  return constant;
}

/// Takes what a record has of its own, the columns of both together, out of all columns of its
/// regression.
void remove(const MatrixXd& constant, const MatrixXd& free, MatrixXd* regression) {
  MatrixXd own(regression->rows(), constant.cols() + free.cols());
  own << constant, free;
  if (own.size() > 0) *regression -= own * own.colPivHouseholderQr().solve(*regression);
}

/// Minimises |A w - b| with columns scaled to unit length. Directions that rounding makes
/// indeterminate get the value zero.
VectorXd leastSquares(const MatrixXd& A, const VectorXd& b, double* residual) {
  const VectorXd scale = A.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(A * scale.asDiagonal());
  const VectorXd w = qr.solve(b);
  *residual = (A * (scale.cwiseProduct(w)) - b).squaredNorm();
  return scale.cwiseProduct(w);
}

}  // namespace

Constant constantOf(Offsets offsets) {
  if (offsets == Offsets::none) return Constant::none;
  return offsets == Offsets::per_experiment ? Constant::of_each : Constant::common;
}

LeastSquaresStart::LeastSquaresStart(const std::vector<const Experiment*>& experiments,
                                     Constant constant, int max_samples)
    : constant_(constant) {
  long total = 0;
  for (const Experiment* experiment : experiments) total += experiment->samples();
  // If there are too many samples, use the beginning of each experiment, or a subset of many short
  // ones.
  const double share =
      std::min(1.0, static_cast<double>(max_samples) / static_cast<double>(std::max(total, 1L)));
  constexpr int kEnough = 500;
  double credit = 0;
  for (const Experiment* experiment : experiments) {
    credit += share * experiment->samples();
    const int wanted = std::min(experiment->samples(), std::max(static_cast<int>(credit), kEnough));
    if (credit < std::min(experiment->samples(), kEnough) * 0.999) continue;
    credit -= wanted;
    Record record{experiment->u.head(wanted), bridgedOutput(*experiment).head(wanted), {}};
    for (int k = 0; k < wanted; ++k) record.valid.push_back(experiment->isValid(k) ? 1 : 0);
    records_.push_back(std::move(record));
  }
}

MatrixXd LeastSquaresStart::triangularFactor(const VectorXd& prefilter, int na, int u_lags,
                                             Start start) const {
  const bool is_common = constant_ == Constant::common;
  const Index constant = u_lags + 1, columns = u_lags + 1 + (is_common ? 1 : 0) + na + 1;
  RowAccumulator rows(columns);
  for (const Record& record : records_) {
    checkpoint();
    const VectorXd u = overPolynomial(record.u, prefilter), y = overPolynomial(record.y, prefilter);
    const VectorXd one = overPolynomial(VectorXd::Ones(u.size()), prefilter);
    const Index first = std::min<Index>(
        std::max(na, u_lags), u.size() / 2);  // earlier samples, which the lags need, are not known
    std::vector<Index> times;
    for (Index t = first; t < u.size(); ++t)
      if (record.valid[static_cast<std::size_t>(t)] != 0) times.push_back(t);
    MatrixXd regression(static_cast<Index>(times.size()), columns);
    for (std::size_t i = 0; i < times.size(); ++i) {
      auto row = regression.row(static_cast<Index>(i));
      const Index t = times[i];
      for (Index k = 0; k <= u_lags; ++k) row[k] = lagged(u, t - k);
      if (is_common) row[constant] = one[t];
      for (Index k = 1; k <= na; ++k) row[columns - 1 - na + k - 1] = -lagged(y, t - k);
      row[columns - 1] = y[t];
    }
    const MatrixXd nothing(regression.rows(), 0);
    remove(constant_ == Constant::of_each ? constantAt(times, one) : nothing,
           start == Start::unknown ? freeResponses(prefilter, times) : nothing, &regression);
    for (Index i = 0; i < regression.rows(); ++i) rows.next() = regression.row(i);
  }
  return rows.factor();
}

LeastSquaresModel LeastSquaresStart::solve(const MatrixXd& factor, int nb, int na, int delay,
                                           int u_lags) const {
  checkpoint();
  const bool is_common = constant_ == Constant::common;
  const Index columns = factor.cols(), constants = is_common ? 1 : 0;
  MatrixXd selected(factor.rows(), nb + constants + na);
  selected.leftCols(nb) = factor.middleCols(delay, nb);
  if (is_common) selected.col(nb) = factor.col(u_lags + 1);
  selected.rightCols(na) = factor.middleCols(columns - 1 - na, na);
  LeastSquaresModel model;
  const VectorXd w = leastSquares(selected, factor.col(columns - 1), &model.residual_squares);
  model.polynomials.delay = delay;
  model.polynomials.b = w.head(nb);
  model.polynomials.a = w.tail(na);
  if (is_common) model.offset = w[nb] / (1 + model.polynomials.a.sum());
  return model;
}

LeastSquaresModel LeastSquaresStart::leastDelayed(const MatrixXd& factor, int nb, int na,
                                                  int first_delay, int last_delay) const {
  constexpr double kMargin = 1.01;  // a longer delay must reduce the residual by 1 %
  LeastSquaresModel best;
  best.residual_squares = std::numeric_limits<double>::infinity();
  for (int delay = first_delay; delay <= last_delay; ++delay) {
    LeastSquaresModel model = solve(factor, nb, na, delay, last_delay + nb - 1);
    if (model.residual_squares * kMargin < best.residual_squares) best = std::move(model);
  }
  return best;
}

LeastSquaresModel LeastSquaresStart::arx(int nb, int na, int delay) const {
  const int u_lags = delay + nb - 1;
  return solve(triangularFactor(VectorXd(), na, u_lags, Start::rest), nb, na, delay, u_lags);
}

LeastSquaresModel LeastSquaresStart::steiglitzMcBride(int nb, int na, int first_delay,
                                                      int last_delay, Start start) const {
  constexpr int kIterations = 8;
  constexpr double kStands = 1e-4;  // change of A that is immaterial to a start
  const int u_lags = last_delay + nb - 1;
  VectorXd prefilter;
  LeastSquaresModel best;
  best.residual_squares = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    const MatrixXd factor = triangularFactor(prefilter, na, u_lags, start);
    LeastSquaresModel least = leastDelayed(factor, nb, na, first_delay, last_delay);
    if (!least.polynomials.a.allFinite() || !least.polynomials.b.allFinite()) break;
    least.polynomials.a = stabilised(least.polynomials.a, 0.9995);
    // The first regression minimises the equation error, which cannot be compared with the output
    // error of the later ones.
    if (iteration > 0 && least.residual_squares < best.residual_squares) best = least;
    if (iteration == 0) best.polynomials = least.polynomials, best.offset = least.offset;
    if (na == 0) return least;
    const bool stands = iteration > 0 && (least.polynomials.a - prefilter).norm() < kStands;
    prefilter = least.polynomials.a;
    if (stands) break;
  }
  return best;
}

std::vector<int> LeastSquaresStart::likelyDelays(int nb, int na, int last_delay) const {
  const int rest = steiglitzMcBride(nb, na, 0, last_delay, Start::rest).polynomials.delay;
  const int unknown = steiglitzMcBride(nb, na, 0, last_delay, Start::unknown).polynomials.delay;
  return rest == unknown ? std::vector<int>{rest} : std::vector<int>{rest, unknown};
}

void hannanRissanen(const std::vector<VectorXd>& residuals, int nc, int nd, VectorXd* c,
                    VectorXd* d) {
  c->setZero(nc);
  d->setZero(nd);
  if (nc + nd == 0) return;
  Index longest = 0;
  for (const VectorXd& v : residuals) longest = std::max(longest, v.size());
  const Index long_order = std::min<Index>(2 * (nc + nd) + 6, longest / 4);
  RowAccumulator first(long_order + 1);
  for (const VectorXd& v : residuals) {
    for (Index t = long_order; t < v.size(); ++t) {
      auto row = first.next();
      for (Index k = 1; k <= long_order; ++k) row[k - 1] = v[t - k];
      row[long_order] = v[t];
    }
  }
  double residual = 0;
  const MatrixXd R = first.factor();
  const VectorXd autoregression =
      leastSquares(R.leftCols(long_order), R.col(long_order), &residual);
  RowAccumulator second(nc + nd + 1);
  for (const VectorXd& v : residuals) {
    VectorXd innovation = VectorXd::Zero(v.size());
    for (Index t = long_order; t < v.size(); ++t) {
      innovation[t] = v[t];
      for (Index k = 1; k <= long_order; ++k) innovation[t] -= autoregression[k - 1] * v[t - k];
    }
    for (Index t = long_order + std::max(nc, nd); t < v.size(); ++t) {
      auto row = second.next();
      for (Index k = 1; k <= nc; ++k) row[k - 1] = innovation[t - k];
      for (Index k = 1; k <= nd; ++k) row[nc + k - 1] = -v[t - k];
      row[nc + nd] = v[t];
    }
  }
  const MatrixXd S = second.factor();
  const VectorXd w = leastSquares(S.leftCols(nc + nd), S.col(nc + nd), &residual);
  if (!w.allFinite()) return;
  *c = stabilised(w.head(nc), 0.98);
  *d = stabilised(w.tail(nd), 0.98);
}

}  // namespace uncertainty_identification
