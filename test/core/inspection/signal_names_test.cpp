#include "inspection/signal_names.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

struct NamedSignal {
  const char* name;
  SignalRole role;
  int strength;
};

TEST(SignalNames, TellInputsFromOutputs) {
  const SignalRole input = SignalRole::input, output = SignalRole::output,
                   unknown = SignalRole::unknown;
  for (const NamedSignal& each : {NamedSignal{"u", input, 3},
                                  {"Y", output, 3},
                                  {"u2", input, 2},
                                  {"y_1", output, 2},
                                  {"motor_voltage", input, 1},
                                  {"motorVoltage [V]", input, 1},
                                  {"wheel_speed", output, 1},
                                  {"speed_setpoint", input, 2},
                                  {"measured_current", output, 2},
                                  {"PWM1", input, 2},
                                  {"/cmd_vel linear.x", input, 2},
                                  {"/odom twist.twist.linear.x", output, 2},
                                  {"/joint_states effort[0]", input, 1},
                                  {"/joint_states position[0]", output, 1},
                                  {"/pad axes.y", unknown, 0},
                                  {"yaw", unknown, 0},
                                  {"x1", unknown, 0},
                                  {"", unknown, 0}}) {
    const NameHint hint = hintOf(each.name);
    EXPECT_EQ(hint.role, each.role) << each.name << ": " << hint.word;
    EXPECT_EQ(hint.strength, each.strength) << each.name << ": " << hint.word;
  }
}

TEST(SignalNames, StateUnits) {
  EXPECT_EQ(unitOfName("angle_deg"), "deg");
  EXPECT_EQ(unitOfName("wheel [rad/s]"), "rad/s");
  EXPECT_EQ(unitOfName("motor_voltage"), "V");
  EXPECT_EQ(unitOfName("effort[0]"), "");
  EXPECT_EQ(unitOfName("speed"), "");
  EXPECT_EQ(unitOfName(")"), "");
  EXPECT_EQ(unitOfName(""), "");
}

}  // namespace
}  // namespace uncertainty_identification
