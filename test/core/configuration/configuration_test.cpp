#include "uncertainty_identification/configuration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct BadValue {
  std::string key;    // that the message must start with
  std::string found;  // that it must contain
  std::function<void(Configuration&)> spoil;
};

std::ostream& operator<<(std::ostream& out, const BadValue& bad) {
  return out << bad.key << " " << bad.found;
}

class BadValueTest : public testing::TestWithParam<BadValue> {};

TEST_P(BadValueTest, IsNamedWithItsValueAndWhatIsAllowed) {
  Configuration configuration;
  ASSERT_NO_THROW(configuration.validate());
  GetParam().spoil(configuration);
  try {
    configuration.validate();
    FAIL() << "accepted";
  } catch (const ConfigurationError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind(GetParam().key + ": found " + GetParam().found, 0), 0u) << message;
    EXPECT_NE(message.find("; allowed: "), std::string::npos) << message;
  }
}

std::vector<BadValue> badModels() {
  return {
      {"sample_time", "-1", [](auto& c) { c.sample_time = -1; }},
      {"sample_time", "nan", [](auto& c) { c.sample_time = kNan; }},
      {"sample_time", "inf", [](auto& c) { c.sample_time = kInfinity; }},
      {"nominal_model.nb", "0", [](auto& c) { c.nominal_model.nb = 0; }},
      {"nominal_model.na", "-1", [](auto& c) { c.nominal_model.na = -1; }},
      {"nominal_model.nc", "51", [](auto& c) { c.nominal_model.nc = 51; }},
      {"nominal_model.nd", "-2", [](auto& c) { c.nominal_model.nd = -2; }},
      {"nominal_model.delay", "-1", [](auto& c) { c.nominal_model.delay = -1; }},
      {"nominal_model.max_order", "21", [](auto& c) { c.nominal_model.max_order = 21; }},
      {"nominal_model.max_delay", "-1", [](auto& c) { c.nominal_model.max_delay = -1; }},
      {"nominal_model.time_constants", "-1", [](auto& c) { c.nominal_model.time_constants = -1; }},
      {"nominal_model.resonances", "26", [](auto& c) { c.nominal_model.resonances = 26; }},
      {"nominal_model.zeros", "-1", [](auto& c) { c.nominal_model.zeros = -1; }},
      {"nominal_model.zeros", "2",
       [](auto& c) {
         c.nominal_model.structure = Structure::modal;
         c.nominal_model.orders_auto = false;
         c.nominal_model.zeros = 2;
       }},
      {"nominal_model.dead_time", "true",
       [](auto& c) {
         c.nominal_model.structure = Structure::modal;
         c.nominal_model.orders_auto = false;
         c.nominal_model.dead_time = true;
       }},
      {"nominal_model.fixed", "1 parameters",
       [](auto& c) {
         c.nominal_model.structure = Structure::modal;
         c.nominal_model.orders_auto = false;
         c.nominal_model.fixed["tau1"] = 2;
       }},
      {"nominal_model.zeros", "1",
       [](auto& c) {
         c.nominal_model.structure = Structure::continuous;
         c.nominal_model.orders_auto = false;
         c.nominal_model.zeros = 1;
       }},
      {"nominal_model.orders", "auto",
       [](auto& c) {
         c.nominal_model.structure = Structure::continuous;
         c.nominal_model.orders_auto = true;
       }},
      {"explanation.time_limit", "-1", [](auto& c) { c.explanation.time_limit = -1; }},
      {"nominal_model.orders", "auto",
       [](auto& c) {
         c.nominal_model.na = 2;
         c.nominal_model.orders_auto = true;
       }},
      {"nominal_model.fixed.gain", "inf",
       [](auto& c) { c.nominal_model.fixed["gain"] = kInfinity; }},
      {"error_model.taps", "12", [](auto& c) { c.error_model.taps = 12; }},
      {"error_model.taps", "-2", [](auto& c) { c.error_model.taps = -2; }},
      {"error_model.taps", "1", [](auto& c) { c.error_model.taps = 1; }},  // nothing left free
      {"error_model.taps", "11",
       [](auto& c) {
         c.error_model.taps = 11;
         c.error_model.constraint = Constraint::free;
       }},
      {"error_model.basis", "auto",
       [](auto& c) { c.error_model.constraint = Constraint::zero_mean; }},
      {"error_model.components", "0", [](auto& c) { c.error_model.components = 0; }},
      {"error_model.max_taps", "0", [](auto& c) { c.error_model.max_taps = 0; }},
      {"error_model.max_components", "11", [](auto& c) { c.error_model.max_components = 11; }},
      {"error_model.pole", "1", [](auto& c) { c.error_model.pole = 1; }},
      {"error_model.pole_real", "0.99", [](auto& c) { c.error_model.pole_real = 0.99; }},
      {"error_model.pole_imag", "0",
       [](auto& c) {
         c.error_model.basis = BasisKind::kautz;
         c.error_model.pole_imag = 0;
       }},
      {"error_model.sensitivity_order", "3", [](auto& c) { c.error_model.sensitivity_order = 3; }},
      {"error_model.constraint", "zero_static_gain",
       [](auto& c) { c.error_model.basis = BasisKind::sensitivity; }},
      {"error_model.constraint", "free",
       [](auto& c) {
         c.error_model.basis = BasisKind::parameter_spread;
         c.error_model.constraint = Constraint::free;
       }},
      {"error_model.parameters", "tau1",
       [](auto& c) {
         c.error_model.basis = BasisKind::parameter_spread;
         c.error_model.constraint = Constraint::zero_mean;
         c.error_model.parameters = {"tau1", "tau1"};
       }},
      {"error_model.T", "a 0 x 0 matrix",
       [](auto& c) { c.error_model.constraint = Constraint::explicit_matrix; }},
      {"error_model.taps", "auto",
       [](auto& c) {
         c.error_model.constraint = Constraint::explicit_matrix;
         c.error_model.taps = kAutomatic;
       }},
  };
}

std::vector<BadValue> badOthers() {
  return {
      {"estimation.max_iterations", "-1", [](auto& c) { c.estimation.max_iterations = -1; }},
      {"estimation.tolerance", "0", [](auto& c) { c.estimation.tolerance = 0; }},
      {"estimation.restarts", "-1", [](auto& c) { c.estimation.restarts = -1; }},
      {"estimation.threads", "0", [](auto& c) { c.estimation.threads = 0; }},
      {"estimation.discard_samples", "-5", [](auto& c) { c.estimation.discard_samples = -5; }},
      {"estimation.thinning", "0", [](auto& c) { c.estimation.thinning = 0; }},
      {"initial.theta", "an entry",
       [](auto& c) { c.initial.theta = Eigen::VectorXd::Constant(1, kNan); }},
      {"initial.noise_variance", "0", [](auto& c) { c.initial.noise_variance = 0; }},
      {"resampling.max_age", "-1", [](auto& c) { c.resampling.max_age = -1; }},
      {"resampling.max_jitter", "nan", [](auto& c) { c.resampling.max_jitter = kNan; }},
      {"input.topic", "an empty text", [](auto& c) { c.input.topic = ""; }},
      {"output.field", "an empty text", [](auto& c) { c.output.field = ""; }},
      {"covariates[0].name", "an empty text",
       [](auto& c) {
         c.covariates = {{"", "topic", "auto"}};
       }},
      {"covariates[1].topic", "an empty text",
       [](auto& c) {
         c.covariates = {{"a", "topic", "auto"}, {"b", "", "auto"}};
       }},
      {"input.scale", "0", [](auto& c) { c.input.scale = 0; }},
      {"output.scale", "nan", [](auto& c) { c.output.scale = kNan; }},
      {"output.offset", "nan", [](auto& c) { c.output.offset = kNan; }},
      {"time.sample_time", "0", [](auto& c) { c.time.unit = TimeUnit::index; }},
      {"time.sample_time", "0.1",
       [](auto& c) {
         c.time.sample_time = 0.1;
         c.time.column = "stamp";
       }},
      {"covariates[1].name", "a",
       [](auto& c) {
         c.covariates = {{"a", "x", "auto"}, {"a", "y", "auto"}};
       }},
      {"experiment.topic", "an empty text", [](auto& c) { c.experiment.topic = ""; }},
      {"experiment.duration", "0", [](auto& c) { c.experiment.mode = ExperimentMode::duration; }},
      {"experiment.gap", "0", [](auto& c) { c.experiment.mode = ExperimentMode::gap; }},
      {"experiment.gap", "-1", [](auto& c) { c.experiment.gap = -1; }},
      {"limits.max_experiments", "0", [](auto& c) { c.limits.max_experiments = 0; }},
      {"limits.max_samples", "0", [](auto& c) { c.limits.max_samples = 0; }},
      {"limits.min_samples", "30",
       [](auto& c) {
         c.limits.min_samples = 30;
         c.limits.max_samples = 29;
       }},
      {"limits.max_missing", "1", [](auto& c) { c.limits.max_missing = 1; }},
      {"limits.max_request_size", "1025", [](auto& c) { c.limits.max_request_size = 1025; }},
      {"limits.max_bag_size", "0", [](auto& c) { c.limits.max_bag_size = 0; }},
      {"limits.max_saved_files", "-1", [](auto& c) { c.limits.max_saved_files = -1; }},
      {"limits.max_request_time", "0", [](auto& c) { c.limits.max_request_time = 0; }},
      {"live_page.port", "65536", [](auto& c) { c.live_page_port = 65536; }},
      {"estimation.time_limit", "-1", [](auto& c) { c.estimation.time_limit = -1; }},
  };
}

INSTANTIATE_TEST_SUITE_P(Models, BadValueTest, testing::ValuesIn(badModels()));
INSTANTIATE_TEST_SUITE_P(Others, BadValueTest, testing::ValuesIn(badOthers()));

TEST(Configuration, EdgesOfTheRangesAreAllowed) {
  Configuration configuration;
  configuration.error_model.taps = 0;  // no error model
  configuration.error_model.pole = -0.999;
  configuration.estimation.max_iterations = 0;
  configuration.nominal_model.orders_auto = false;
  configuration.nominal_model.delay = 0;
  configuration.limits.max_missing = 0;
  EXPECT_NO_THROW(configuration.validate());
  configuration.error_model = paperErrorModel();
  configuration.error_model.taps = 11;  // zero_static_gain leaves 10
  EXPECT_NO_THROW(configuration.validate());
}

TEST(Configuration, ExplicitMatrixMustHaveTapsRows) {
  Configuration configuration;
  configuration.error_model.basis = BasisKind::fir;
  configuration.error_model.constraint = Constraint::explicit_matrix;
  configuration.error_model.T = Eigen::MatrixXd::Ones(2, 1);
  EXPECT_NO_THROW(configuration.validate());
  configuration.error_model.taps = 3;
  EXPECT_THROW(configuration.validate(), ConfigurationError);
}

TEST(EnumNames, GiveEachValueItsWord) {
  EXPECT_EQ(nameOf(Structure::box_jenkins), "box_jenkins");
  EXPECT_EQ(nameOf(Constraint::explicit_matrix), "explicit");
  EXPECT_THROW(nameOf(static_cast<Offsets>(99)), std::invalid_argument);
}

}  // namespace
}  // namespace uncertainty_identification
