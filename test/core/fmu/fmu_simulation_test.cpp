// FMUs of a motor with friction (test/data/fmu/motor.c), in each interface that can be run.
#include "fmu/fmu_simulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fmu/unpacked_fmu.h"
#include "support/error_message.h"
#include "support/fmu_builder.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

const FmuSignals kSignals{"voltage", "speed", {{"inertia", 0.02}, {"friction", 0.15}}, 10};

/// The same motor, friction before inertia.
Eigen::VectorXd expected(const SimulationInput& input, double friction, double inertia) {
  Eigen::VectorXd y(input.u.size());
  double speed = 0;
  const double step = input.sample_time / 10;
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const auto slope = [&](double at) {
      return (0.5 * input.u[k] - 0.1 * at - friction * std::tanh(at / 0.05)) / inertia;
    };
    y[k] = speed;
    for (int part = 0; part < 10; ++part) {
      const double a = slope(speed), b = slope(speed + step / 2 * a),
                   c = slope(speed + step / 2 * b), d = slope(speed + step * c);
      speed += step * (a + 2 * b + 2 * c + d) / 6;
    }
  }
  return y;
}

SimulationInput steps() {
  SimulationInput input;
  input.sample_time = 0.01;
  input.u = Eigen::VectorXd::Constant(100, 1.5);
  input.u.tail(50).setConstant(-2);
  return input;
}

class FmuSimulationTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!readsFmus()) GTEST_SKIP() << "built without libzip or tinyxml2";
  }

  std::unique_ptr<Simulation> built(const test::FmuRecipe& recipe) {
    test::buildFmu(path_, recipe);
    return loadFmu(path_, kSignals);
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "motor.fmu";
};

TEST_F(FmuSimulationTest, AllInterfacesGiveTheSame) {
  for (const char* interface : {"CO_SIMULATION_2", "MODEL_EXCHANGE_2", "CO_SIMULATION_3"}) {
    const auto motor = built({interface, {}, {}, {}, {}});
    ASSERT_EQ(motor->parameters().size(), 2u);
    EXPECT_EQ(motor->parameters()[1].unit, "kg m2");
    const SimulationInput input = steps();
    for (const auto& [friction, inertia] : {std::pair(0.15, 0.02), std::pair(0.3, 0.05)}) {
      const Eigen::VectorXd y = motor->run(input, Eigen::Vector2d(friction, inertia));
      EXPECT_LT((y - expected(input, friction, inertia)).norm(), 1e-9) << interface;
    }
    EXPECT_EQ(motor->run(input, Eigen::Vector2d(0.15, 0.02)),
              motor->run(input, Eigen::Vector2d(0.15, 0.02)))
        << "each run starts afresh";
  }
}

TEST_F(FmuSimulationTest, TimeEventsOfModelExchangeAct) {
  const auto motor = built({"MODEL_EXCHANGE_2", {"TIME_EVENT=0.3"}, {}, {}, {}});
  const SimulationInput input = steps();
  const Eigen::VectorXd y = motor->run(input, Eigen::Vector2d(0.15, 0.02));
  const Eigen::VectorXd without = expected(input, 0.15, 0.02);
  EXPECT_LT((y - without).head(31).norm(), 1e-9);
  EXPECT_LT(y[40], 0.8 * without[40]) << "the motor's constant is halved at 0.3 s";
}

TEST_F(FmuSimulationTest, AnErrorIsOneOfTheUsersValuesOnly) {
  for (const char* interface : {"CO_SIMULATION_2", "MODEL_EXCHANGE_2", "CO_SIMULATION_3"}) {
    const auto motor = built({interface, {"FAULT=5"}, {}, {}, {}});
    const std::string message =
        messageOf<DataError>([&] { motor->run(steps(), Eigen::Vector2d(0.15, 0.02)); });
    EXPECT_NE(message.find(" failed"), std::string::npos) << message;
    EXPECT_FALSE(motor->run(steps(), Eigen::Vector2d(0.3, 0.02)).allFinite())
        << "other values cannot be simulated";
  }
}

TEST_F(FmuSimulationTest, NanIsHandedOn) {
  const auto motor = built({"CO_SIMULATION_2", {"FAULT=3"}, {}, {}, {}});
  const Eigen::VectorXd y = motor->run(steps(), Eigen::Vector2d(0.15, 0.02));
  EXPECT_TRUE(std::isfinite(y[1]));
  EXPECT_TRUE(std::isnan(y[2]));
}

TEST_F(FmuSimulationTest, AWrongGuidIsRefusedByTheFmu) {
  test::FmuRecipe recipe;
  recipe.description = test::motorDescription("CO_SIMULATION_2");
  recipe.description.replace(recipe.description.find("{motor}"), 7, "{other}");
  const auto motor = built(recipe);
  EXPECT_NE(messageOf<DataError>([&] {
              motor->run(steps(), Eigen::Vector2d(0.15, 0.02));
            }).find("fmi2Instantiate failed"),
            std::string::npos);
}

TEST_F(FmuSimulationTest, ALibraryWithoutTheInterfaceIsToldSo) {
  test::FmuRecipe recipe;
  recipe.description = test::motorDescription("CO_SIMULATION_3");
  recipe.interface = "CO_SIMULATION_2";
  const auto motor = built(recipe);
  EXPECT_NE(messageOf<FileError>([&] {
              motor->run(steps(), Eigen::Vector2d(0.15, 0.02));
            }).find("lacks the function fmi3InstantiateCoSimulation"),
            std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
