#include "support/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace uncertainty_identification {
namespace {

std::string contentOf(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path).rdbuf();
  return content.str();
}

void redirect(int descriptor, const std::string& path) {
  dup2(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), descriptor);
}

// The mask of handled signals as Linux shows it; empty once the process has ended.
std::string handledSignals(pid_t id) {
  std::ifstream status("/proc/" + std::to_string(id) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("SigCgt:", 0) == 0) return line.substr(7);
  }
  return "";
}

}  // namespace

Process::Process(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  id_ = fork();
  if (id_ < 0) throw std::runtime_error("fork failed");
  if (id_ == 0) {
    redirect(STDOUT_FILENO, folder_ / "output");
    redirect(STDERR_FILENO, folder_ / "errors");
    execv(arguments[0], arguments.data());
    _exit(127);
  }
}

Process::~Process() {
  if (id_ < 0) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

bool Process::waitUntilItHandles(int signal) const {
  while (waitid(P_PID, static_cast<id_t>(id_), nullptr, WEXITED | WNOHANG | WNOWAIT) == 0) {
    const std::string mask = handledSignals(id_);
    if (mask.empty()) return false;
    if ((std::stoull(mask, nullptr, 16) >> (signal - 1)) & 1) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

ProcessResult Process::wait() {
  int status = 0;
  waitpid(id_, &status, 0);
  id_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
          contentOf(folder_ / "output"), contentOf(folder_ / "errors")};
}

ProcessResult runProcess(const std::vector<std::string>& command) {
  return Process(command).wait();
}

}  // namespace uncertainty_identification
