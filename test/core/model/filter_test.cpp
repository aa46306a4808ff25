#include "model/filter.h"

#include <gtest/gtest.h>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::vectorOf;

TEST(Filter, IsTheConvolutionWithItsImpulseResponseInEveryLane) {
  const VectorXd numerator = vectorOf({0.5, -2, 1}), denominator = vectorOf({-1.2, 0.5, 0.1});
  const Signals in = Signals::Random(kLanes, 40);
  for (int delay : {0, 1, 4, 50}) {
    Signals out;
    filter(numerator, denominator, delay, in, &out);
    const dense::Matrix response =
        dense::toeplitz(dense::impulseResponse(numerator, dense::monic(denominator), delay, 40));
    for (int lane = 0; lane < kLanes; ++lane) {
      const VectorXd u = in.row(lane).matrix().transpose();
      const VectorXd expected = (response * u.cast<dense::Real>()).cast<double>();
      EXPECT_LT((out.row(lane).matrix().transpose() - expected).norm(), 1e-12) << delay;
    }
  }
}

TEST(Shift, MovesAndFillsWithZeros) {
  const Signals in = Signals::Random(kLanes, 6);
  Signals out;
  shift(2, in, &out);
  EXPECT_TRUE(out.leftCols(2).isZero(0));
  EXPECT_TRUE((out.rightCols(4) == in.leftCols(4)).all());
  shift(0, in, &out);
  EXPECT_TRUE((out == in).all());
  shift(9, in, &out);
  EXPECT_TRUE(out.isZero(0));
}

TEST(AddShifted, Accumulates) {
  const Signals in = Signals::Random(kLanes, 6);
  Signals out = Signals::Ones(kLanes, 6);
  addShifted(-2, 1, in, &out);
  EXPECT_TRUE((out.col(0) == 1).all());
  EXPECT_LT((out.rightCols(5) - (1 - 2 * in.leftCols(5))).abs().maxCoeff(), 1e-15);
}

TEST(InnerProducts, OfShorterSignalsEndWithThem) {
  // lengths at, before and behind the ends of the pieces that the sums proceed in
  const std::vector<Index> lengths{200, 3, 64, 130, 200, 65, 1, 129};
  std::vector<Signals> signals;
  for (const Index length : lengths) signals.push_back(Signals::Random(kLanes, length));
  std::vector<const Signals*> left, right;
  for (const Signals& signal : signals) left.push_back(&signal);
  left.push_back(nullptr);
  right.assign(left.begin() + 1, left.end());
  for (const auto& other : {left, right}) {
    const std::vector<Lanes> found = innerProducts(left, other);
    for (std::size_t i = 0; i < left.size(); ++i) {
      for (std::size_t j = 0; j < other.size(); ++j) {
        Lanes expected = Lanes::Zero();
        if (left[i] != nullptr && other[j] != nullptr) {
          const Index both = std::min(left[i]->cols(), other[j]->cols());
          expected = (left[i]->leftCols(both) * other[j]->leftCols(both)).rowwise().sum();
        }
        EXPECT_LT((found[i * other.size() + j] - expected).abs().maxCoeff(), 1e-12)
            << i << " " << j;
      }
    }
  }
}

}  // namespace
}  // namespace uncertainty_identification
