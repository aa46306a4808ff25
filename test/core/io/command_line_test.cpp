#include "io/command_line.h"

#include <gtest/gtest.h>

#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// What is written to std::cerr while it exists.
class CapturedErrors {
 public:
  CapturedErrors() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~CapturedErrors() { std::cerr.rdbuf(before_); }
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

/// Runs a program whose body is this, without arguments.
template <class Body>
int statusOf(const Body& body) {
  Program program;
  program.name = "tool";
  program.run = [&body](const auto&) { return body(); };
  const char* const arguments[] = {"tool"};
  return runProgram(program, 1, arguments);
}

template <class Error>
int statusOfThrowing() {
  return statusOf([]() -> int { throw Error("what\nwhy"); });
}

TEST(CommandLine, ExceptionsBecomeStatusAndMessage) {
  const CapturedErrors errors;
  EXPECT_EQ(statusOf([] { return 0; }), 0);
  EXPECT_EQ(statusOf([] { return 1; }), 1);
  EXPECT_EQ(errors.text(), "");
  EXPECT_EQ(statusOfThrowing<DataError>(), 1);
  EXPECT_EQ(errors.text(), "tool: what\ntool: why\n");
  EXPECT_EQ(statusOfThrowing<ConfigurationError>(), 2);
  EXPECT_EQ(statusOfThrowing<FileError>(), 2);
}

TEST(CommandLine, AnUnexpectedExceptionIsAnInternalErrorAndNotOneOfUsage) {
  const CapturedErrors errors;
  EXPECT_EQ(statusOfThrowing<std::invalid_argument>(), 1);
  EXPECT_EQ(errors.text().rfind("tool: internal error: what\n", 0), 0u) << errors.text();
  EXPECT_NE(errors.text().find("Please report it"), std::string::npos);
}

TEST(CommandLine, MessagesEscapeWhatIsNoText) {
  const CapturedErrors errors;
  printMessage("tool", "no 'caf\xE9\x1b[2J'\nbut '\xC3\xA9'");
  EXPECT_EQ(errors.text(), "tool: no 'caf\\xE9\\x1B[2J'\ntool: but '\xC3\xA9'\n");
}

}  // namespace
}  // namespace uncertainty_identification
