// Programs of a user, good and bad: each is a few lines of Python or shell.
#include "io/program_simulation.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <memory>

#include "io/child_process.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

const char* const kLoop =
    "import json, sys, os, signal, time\n"
    "for line in sys.stdin:\n"
    "    request = json.loads(line)\n";

std::unique_ptr<Simulation> start(const std::vector<std::string>& command, double time_limit = 20) {
  return startProgramSimulation(
      {command, "the program " + command[0], {{"mass", 2, "kg"}}, time_limit, 200});
}

std::unique_ptr<Simulation> python(const std::string& body, double time_limit = 20) {
  return start({"python3", "-c", kLoop + body}, time_limit);
}

SimulationInput threeSamples() {
  return {0.5, Eigen::Vector3d(1, -2, 3), {{"temp", Eigen::Vector3d(7, 8, 9)}}, {{"load", 5}}, {}};
}

Eigen::VectorXd two() { return Eigen::VectorXd::Constant(1, 2); }

std::string complaintOf(Simulation& simulation) {
  return messageOf<DataError>([&] { simulation.run(threeSamples(), two()); });
}

void expectMention(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(ProgramSimulation, AnswersEachLineWithALine) {
  const auto simulation = python(
      "    y = [request['parameters']['mass'] * u + request['covariates']['temp'][0]\n"
      "         + request['covariates']['load'] + request['sample_time'] for u in request['u']]\n"
      "    print(json.dumps({'y': y}), flush=True)\n");
  EXPECT_EQ(simulation->parameters().at(0).name, "mass");
  EXPECT_EQ(simulation->parameters().at(0).unit, "kg");
  EXPECT_TRUE(simulation->canRerun());
  for (int repeat = 0; repeat < 3; ++repeat)
    EXPECT_EQ(simulation->run(threeSamples(), two()), Eigen::Vector3d(14.5, 8.5, 18.5));
  EXPECT_EQ(simulation->run(threeSamples(), 2 * two()), Eigen::Vector3d(16.5, 4.5, 24.5));
}

TEST(ProgramSimulation, LongSignalsPassBothWays) {
  const auto simulation = python("    print(json.dumps({'y': request['u']}), flush=True)\n");
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(200000, 0, M_PI);
  EXPECT_EQ(simulation->run({1, u, {}, {}, {}}, two()), u) << "every bit of a number is kept";
}

TEST(ProgramSimulation, SaysWhyAProgramCannotBeStarted) {
  expectMention(messageOf<ConfigurationError>([] { start({"./no_such_program"}); }),
                "simulation.command: cannot start './no_such_program': No such file");
  expectMention(messageOf<ConfigurationError>([] { start({"/"}); }), "Permission denied");
}

TEST(ProgramSimulation, ToldHowItCrashed) {
  expectMention(complaintOf(*python("    raise ValueError('mass must not be 2')\n")),
                "it ended before it answered: it ended with exit status 1; its standard error ends "
                "with:\nTraceback");
  expectMention(complaintOf(*python("    raise ValueError('mass must not be 2')\n")),
                "mass must not be 2");
  expectMention(complaintOf(*python("    os.kill(os.getpid(), signal.SIGSEGV)\n")),
                "the program python3: it ended before it answered: it was ended by signal 11");
  expectMention(complaintOf(*start({"true"})), "it ended with exit status 0");
}

TEST(ProgramSimulation, DiesHalfWay) {
  const auto simulation =
      python("    sys.stdout.write('{\"y\": [1, 2')\n    sys.stdout.flush()\n    sys.exit(3)\n");
  expectMention(complaintOf(*simulation), "exit status 3");
  const auto second = python(
      "    if request['u'][0] > 1: sys.exit(4)\n"
      "    print(json.dumps({'y': request['u']}), flush=True)\n");
  SimulationInput input = threeSamples();
  EXPECT_EQ(second->run(input, two()), input.u);
  input.u *= 2;
  expectMention(messageOf<DataError>([&] { second->run(input, two()); }), "exit status 4");
}

TEST(ProgramSimulation, WhatHangsIsEnded) {
  const auto simulation = python("    time.sleep(1000)\n", 0.3);
  expectMention(complaintOf(*simulation),
                "it gave no answer within 0.3 s (simulation.time_limit); does it flush");
  const char* const unflushed = "    print('{\"y\": [1,2,3]}', file=out)\n";
  expectMention(
      complaintOf(
          *start({"python3", "-c", std::string("out = open(1, 'w')\n") + kLoop + unflushed}, 0.3)),
      "no answer within");
  expectMention(complaintOf(*start({"sleep", "1000"}, 0.3)), "no answer within");
}

TEST(ProgramSimulation, AllocatesNoMoreThanItMay) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's own memory would count";
#endif
  const auto greedy = python("    all = [bytearray(10**6) for _ in range(10**6)]\n");
  const std::string text = complaintOf(*greedy);
  expectMention(text, "MemoryError");
  expectMention(text, "(simulation.memory_limit is 200 MB)");
}

TEST(ProgramSimulation, RefusesWhatIsNoAnswer) {
  expectMention(complaintOf(*python("    print('loading...', flush=True)\n")),
                "it wrote 'loading...'; expected one line {\"y\": [...]}");
  expectMention(complaintOf(*python("    print('[1, 2]', flush=True)\n")), "it wrote '[1, 2]'");
  expectMention(complaintOf(*python("    print('{\"x\": [1]}', flush=True)\n")), "it wrote");
  expectMention(complaintOf(*python("    print('{\"y\": [1, \"two\"]}', flush=True)\n")),
                "sample 1 of its answer is '\"two\"'; expected a number");
  expectMention(complaintOf(*python("    os.write(1, bytes([255, 0, 7, 10]))\n")),
                "it wrote '" + std::string(3, '?'));
  expectMention(complaintOf(*python("    os.write(1, b'x' * 300000)\n    time.sleep(1000)\n")),
                "bytes without an end of line");
}

TEST(ProgramSimulation, NumbersThatAreNotFiniteAreNone) {
  const auto simulation =
      python("    print(json.dumps({'y': [1, float('nan'), float('inf')]}), flush=True)\n");
  const Eigen::VectorXd y = simulation->run(threeSamples(), two());
  EXPECT_EQ(y[0], 1);
  EXPECT_TRUE(std::isnan(y[1]) && std::isnan(y[2]));
}

TEST(ProgramSimulation, MuchOnItsStandardErrorDoesNotStopIt) {
  const auto simulation = python(
      "    sys.stderr.write('x' * 1000000)\n    sys.stderr.flush()\n"
      "    print(json.dumps({'y': request['u']}), flush=True)\n");
  EXPECT_EQ(simulation->run(threeSamples(), two()), threeSamples().u);
}

bool isAlive(pid_t process) { return kill(process, 0) == 0; }

TEST(ProgramSimulation, NothingIsLeftOfItOrItsChildren) {
  pid_t program = 0, child = 0;
  {
    const auto simulation = python(
        "    child = os.fork()\n"
        "    if child == 0: time.sleep(1000)\n"
        "    print(json.dumps({'y': [os.getpid(), child, 0]}), flush=True)\n");
    const Eigen::VectorXd ids = simulation->run(threeSamples(), two());
    program = static_cast<pid_t>(ids[0]);
    child = static_cast<pid_t>(ids[1]);
    EXPECT_TRUE(isAlive(program) && isAlive(child));
  }
  EXPECT_FALSE(isAlive(program)) << "not even as a zombie";
  // The child belongs to the system's first process, which may take a moment to collect it.
  const auto is_running = [child] {
    std::ifstream status("/proc/" + std::to_string(child) + "/stat");
    std::string id, name, state;
    return (status >> id >> name >> state) && state != "Z" && state != "X";
  };
  while (is_running()) usleep(1000);
}

TEST(ChildProcess, ASecondQuestionAfterTheEndSaysSo) {
  ChildProcess process({"sh", "-c", "read line; echo one"}, 200);
  EXPECT_EQ(process.ask("?\n", 20, 1000), "one");
  EXPECT_NE(messageOf<DataError>([&] { process.ask("?\n", 20, 1000); }).find("exit status 0"),
            std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
