#include "curves/curve_candidates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

/// A candidate that leaves this error in each of four windows.
CurveCandidate leaving(CandidateKind kind, Place place, const Eigen::Vector4d& errors) {
  CurveCandidate candidate;
  candidate.kind = kind;
  candidate.place.place = place;
  candidate.unseen = candidate.named_unseen = errors;
  candidate.fit.model.theta = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k)
    candidate.fit.residuals.push_back(
        Eigen::VectorXd::LinSpaced(500, -1, 1).unaryExpr([](double x) {
          return std::sin(1e4 * x);
        }));
  candidate.naming.fit = candidate.fit;
  return candidate;
}

CurveCandidate curve(Place place, const Eigen::Vector4d& errors) {
  return leaving(CandidateKind::curve, place, errors);
}

Eigen::VectorXd now() { return Eigen::Vector4d(10, 11, 9, 10); }

TEST(TiedWithFirst, HoldsWhatWindowsCannotTellApart) {
  const std::vector<CurveCandidate> tied =
      tiedWithFirst({curve(Place::sensor, {1, 1.2, 0.9, 1}),
                     curve(Place::input, {1.1, 1.1, 1, 0.95}), curve(Place::rate, {5, 6, 5, 5.5})},
                    now());
  ASSERT_EQ(tied.size(), 2u);
  EXPECT_EQ(tied[0].place.place, Place::input);  // which comes first among those that tie
  EXPECT_EQ(tied[1].place.place, Place::sensor);
}

TEST(TiedWithFirst, LeavesOutWhatEachWindowSaysIsWorse) {
  const std::vector<CurveCandidate> tied = tiedWithFirst(
      {curve(Place::sensor, {1, 1.1, 0.9, 1}), curve(Place::input, {1.2, 1.32, 1.1, 1.2})}, now());
  ASSERT_EQ(tied.size(), 1u);
  EXPECT_EQ(tied[0].place.place, Place::sensor);
}

/// Few windows can say that far more is not significantly more.
TEST(TiedWithFirst, LeavesOutWhatIsFarWorseHoweverUncertain) {
  const std::vector<CurveCandidate> tied = tiedWithFirst(
      {curve(Place::sensor, {1, 1, 1, 1}), curve(Place::input, {0.5, 0.5, 0.5, 40})}, now());
  EXPECT_EQ(tied.size(), 1u);
}

TEST(TiedWithFirst, AForceIsNamedAtThePosition) {
  const std::vector<CurveCandidate> tied =
      tiedWithFirst({curve(Place::output_state, {0.5, 0.5, 0.4, 0.5}),
                     curve(Place::position, {0.8, 0.85, 0.7, 0.8})},
                    now());
  ASSERT_EQ(tied.size(), 2u);
  EXPECT_EQ(tied[0].place.place, Place::position);
}

TEST(TiedWithFirst, DynamicsOfThePlantAreNoRivals) {
  const std::vector<CurveCandidate> tied =
      tiedWithFirst({curve(Place::input, {1, 1, 1, 1}),
                     leaving(CandidateKind::delay, Place::input, {1, 1, 1, 1})},
                    now());
  ASSERT_EQ(tied.size(), 1u);
  EXPECT_EQ(tied[0].kind, CandidateKind::curve);
}

}  // namespace
}  // namespace uncertainty_identification
