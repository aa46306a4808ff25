#include "model/sensitivity_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/noise_whitening.h"
#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kExperiments = 11;  // two blocks, the second not full

struct VaryingCase {
  std::string name;
  BasisKind basis;
  int order;
  Structure structure;
  std::vector<std::string> parameters;
  OffsetSide side;
  Offsets offsets;
};

std::vector<VaryingCase> varyingCases() {
  using B = BasisKind;
  return {
      {"FirstOrder",
       B::sensitivity,
       1,
       Structure::box_jenkins,
       {},
       OffsetSide::input,
       Offsets::estimate},
      {"SecondOrder",
       B::sensitivity,
       2,
       Structure::continuous,
       {"tau1", "zeta1"},
       OffsetSide::output,
       Offsets::estimate},
      {"SpreadOfCoefficients",
       B::parameter_spread,
       1,
       Structure::armax,
       {"b2", "a1"},
       OffsetSide::input,
       Offsets::per_experiment},
      {"SpreadOfTimeConstant",
       B::parameter_spread,
       1,
       Structure::continuous,
       {"tau1"},
       OffsetSide::input,
       Offsets::estimate},
      {"SpreadFromUnknownStarts",
       B::parameter_spread,
       1,
       Structure::continuous,
       {"tau1", "zeta1"},
       OffsetSide::output,
       Offsets::per_experiment},
  };
}

/// Nuisances of all kinds, experiments of several lengths with gaps; the data need not fit.
class SensitivityModelTest : public testing::TestWithParam<VaryingCase> {
 protected:
  SensitivityModelTest() {
    const VaryingCase& c = GetParam();
    Configuration configuration;
    NominalModelOptions& nominal = configuration.nominal_model;
    nominal.structure = c.structure;
    nominal.nb = nominal.na = 2;
    nominal.resonances = 1;
    configuration.error_model.basis = c.basis;
    configuration.error_model.constraint = Constraint::zero_mean;
    configuration.error_model.sensitivity_order = c.order;
    configuration.error_model.parameters = c.parameters;
    configuration.estimation.offset_side = c.side;
    configuration.estimation.offsets = c.offsets;
    test::RandomSystemOptions options;
    options.experiments = kExperiments;
    options.min_samples = 30;
    options.max_samples = 60;
    std::vector<Experiment> experiments = test::randomSystem(options, 4).experiments;
    for (Experiment& experiment : experiments) experiment.sample_time = 0.01;
    experiments[2].valid.assign(static_cast<std::size_t>(experiments[2].samples()), 1);
    for (std::size_t k : {0, 7, 8, 20}) experiments[2].valid[k] = 0;
    setup_ = std::make_unique<test::CoreSetup>(configuration, experiments);
    parameters_ = c.structure == Structure::continuous
                      ? test::vectorOf({1.5, 0.02, 150, 0.3, 0.2, -0.4})
                      : test::vectorOf({1.0, 0.4, -1.2, 0.5, 0.3, -0.4});
    parameters_.conservativeResize(setup_->model().parameterCount());
    if (c.offsets == Offsets::estimate) parameters_.tail(1)[0] = 0.3;
  }

  /// The model, about different points for all experiments where it needs any.
  std::unique_ptr<LinearModel> spread() const {
    xi_ = 0.1 * MatrixXd::Random(setup_->model().regressors(), kExperiments);
    if (!setup_->model().isLocallyLinear()) return nullptr;
    points_ = setup_->model().pointsOf(setup_->blocks(), parameters_, xi_);
    return setup_->model().linearisedAbout(points_);
  }

  Statistics statisticsOf(const LinearModel& model, const VectorXd& at, bool derivatives) const {
    return Likelihood(model, setup_->blocks(), kExperiments, 1).statistics(at, derivatives);
  }

  std::unique_ptr<test::CoreSetup> setup_;
  VectorXd parameters_;
  mutable MatrixXd xi_, points_;
};

TEST_P(SensitivityModelTest, DerivativesOfTheStatisticsAreThoseOfDifferences) {
  const std::unique_ptr<LinearModel> about = spread();
  const LinearModel& model = about != nullptr ? *about : setup_->model();
  ASSERT_TRUE(model.admissible(parameters_));
  const auto stacked = [&](const VectorXd& at) -> VectorXd {
    Statistics s = statisticsOf(model, at, false);
    const Index gram = s.gram(0).size();
    VectorXd all(kExperiments * (gram + 1));
    for (int r = 0; r < kExperiments; ++r) {
      all.segment(r * gram, gram) = Eigen::Map<const VectorXd>(s.gram(r).data(), gram);
      all[kExperiments * gram + r] = s.logJacobian()[r];
    }
    return all;
  };
  // second order takes third derivatives of the coefficients, differences of a Jacobian that is
  // itself made of differences
  const double tolerance = GetParam().order == 2 ? 5e-5 : 1e-6;
  const Statistics s = statisticsOf(model, parameters_, true);
  const Index gram = s.gram(0).size();
  for (int j = 0; j < model.parameterCount(); ++j) {
    const double step = 1e-3 * std::max(std::abs(parameters_[j]), 1e-3);
    const auto moved = [&](double distance) -> VectorXd {
      VectorXd there = parameters_;
      there[j] += distance;
      return stacked(there);
    };
    const VectorXd expected =
        (8 * (moved(step) - moved(-step)) - (moved(2 * step) - moved(-2 * step))) / (12 * step);
    for (int r = 0; r < kExperiments; ++r) {
      const MatrixXd found = s.gramDerivative(r, j);
      const Eigen::Map<const MatrixXd> difference(expected.data() + r * gram, found.rows(),
                                                  found.cols());
      EXPECT_LT((found - difference).norm(), tolerance * (difference.norm() + 1e-3))
          << model.names()[static_cast<std::size_t>(j)] << ", experiment " << r;
      EXPECT_NEAR(s.logJacobianDerivatives()(j, r), expected[kExperiments * gram + r],
                  tolerance * (1 + std::abs(expected[kExperiments * gram + r])));
    }
  }
}

/// At its own point an experiment's linearised output is that of its plant: the plain model with
/// that theta, noise model included as the common theta has it, and with the free response that is
/// known of the experiment.
TEST_P(SensitivityModelTest, AtThePointsTheOutputIsExact) {
  const std::unique_ptr<LinearModel> about = spread();
  if (about == nullptr) return;
  VectorXd moved = 1.01 * parameters_;  // points stay where they are
  const Index own = about->nominal().parameterCount();
  for (const Block& block : setup_->blocks()) {
    Response response;
    about->evaluate(block, moved, false, &response);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int r = block.index[static_cast<std::size_t>(lane)];
      const VectorXd point = about->points(parameters_, xi_).col(r);
      const std::vector<std::string> names = about->nominal().names();
      VectorXd plant = moved, xi(point.size());
      for (std::size_t i = 0; i < GetParam().parameters.size(); ++i) {
        const auto j = std::find(names.begin(), names.end(), GetParam().parameters[i]);
        const Index at = j - names.begin();
        plant[at] = point[static_cast<Index>(i)];
        xi[static_cast<Index>(i)] = point[static_cast<Index>(i)] / moved[at] - 1;
      }
      Eigen::ArrayXd rest = response.value.residual.row(lane).transpose();
      for (Index i = 0; i < xi.size(); ++i) {
        rest -=
            xi[i] * response.value.regressors[static_cast<std::size_t>(i)].row(lane).transpose();
      }
      const Signals simulated = about->simulate(block, plant);
      const Polynomials p = about->nominal().polynomials(moved.head(own));
      Signals whitened;
      NoiseWhitening(p.c, p.d, NoiseStart::stationary, 0, block, false)
          .apply(block.y - simulated, &whitened);
      const VectorXd start = points_.col(r).tail(points_.rows() - point.size());
      for (Index k = 0; k < start.size(); ++k)
        whitened.row(lane) -=
            start[k] *
            withZerosUntil(whitened.cols(), *response.value.columns[static_cast<std::size_t>(k)])
                .row(lane);
      EXPECT_LT((rest - whitened.row(lane).transpose()).matrix().norm(), 1e-9) << r;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, SensitivityModelTest, testing::ValuesIn(varyingCases()),
                         [](const auto& info) { return info.param.name; });

TEST(SensitivityModel, IsAdmissibleOnlyWhereEveryPlantIs) {
  Configuration configuration = test::atRest(1, 1, 0, 0, 1);
  configuration.error_model.basis = BasisKind::parameter_spread;
  configuration.error_model.constraint = Constraint::zero_mean;
  configuration.error_model.parameters = {"a1"};
  const test::CoreSetup setup(configuration, test::example1(1, 3).experiments);
  const VectorXd theta = test::vectorOf({1.0, -0.9});
  const auto about = [&](double last) {
    const MatrixXd xi = (MatrixXd(1, 3) << 0, -0.1, last).finished();
    return setup.model().linearisedAbout(setup.model().points(theta, xi));
  };
  EXPECT_TRUE(about(0.1)->admissible(theta));
  EXPECT_FALSE(about(0.12)->admissible(theta));
}

}  // namespace
}  // namespace uncertainty_identification
