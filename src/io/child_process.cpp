#include "io/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <sstream>
#include <thread>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kErrorsKept = 2000;  ///< bytes of the standard error
constexpr int kGrace = 500;                ///< [ms] for a program to end once its input has ended

void closeIfOpen(int* descriptor) {
  if (*descriptor >= 0) close(*descriptor);
  *descriptor = -1;
}

void keepFromChildren(int descriptor) { fcntl(descriptor, F_SETFD, FD_CLOEXEC); }

constexpr double kBytes = 1e6;  ///< of an MB

/// What a program allocates; memory that it only reserves, as virtual machines do, does not count.
/// The sanitizers' own does, so that programs that are built with them have no limit.
void limitMemory([[maybe_unused]] double megabytes) {
#ifndef __SANITIZE_ADDRESS__
  const auto bytes = static_cast<rlim_t>(megabytes * kBytes);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

/// Only calls that are allowed between fork() and exec(). Reports why exec() failed.
[[noreturn]] void becomeProgram(char* const* arguments, double memory_limit, int channel,
                                int errors, int report) {
  setpgid(0, 0);
  limitMemory(memory_limit);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  dup2(channel, STDIN_FILENO);
  dup2(channel, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  signal(SIGPIPE, SIG_DFL);
  execvp(arguments[0], arguments);
  const int reason = errno;
  const ssize_t ignored = write(report, &reason, sizeof reason);
  _exit(ignored == sizeof reason ? 127 : 126);
}

/// Whether the process has ended within the time; its status, and what it has used.
bool hasEnded(pid_t process, int milliseconds, int* status, rusage* used) {
  for (int waited = 0;; waited += 5) {
    if (wait4(process, status, WNOHANG, used) == process) return true;
    if (waited >= milliseconds) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, double memory_limit)
    : memory_limit_(memory_limit) {
  std::array<int, 2> channel{-1, -1}, errors{-1, -1}, report{-1, -1};
  const bool ready = socketpair(AF_UNIX, SOCK_STREAM, 0, channel.data()) == 0 &&
                     pipe(errors.data()) == 0 && pipe(report.data()) == 0;
  int reason = ready ? 0 : errno;
  if (ready) {
    for (const int each : {channel[0], channel[1], errors[0], errors[1], report[0], report[1]})
      keepFromChildren(each);
    std::vector<char*> arguments;
    for (const std::string& each : command) arguments.push_back(const_cast<char*>(each.c_str()));
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ == 0)
      becomeProgram(arguments.data(), memory_limit, channel[1], errors[1], report[1]);
    if (process_ < 0) reason = errno;
  }
  for (int* each : {&channel[1], &errors[1], &report[1]}) closeIfOpen(each);
  channel_ = channel[0];
  errors_ = errors[0];
  if (process_ > 0) {
    setpgid(process_, process_);  // in both, so that neither can be first
    int from_child = 0;
    if (read(report[0], &from_child, sizeof from_child) == sizeof from_child) reason = from_child;
  }
  closeIfOpen(&report[0]);
  if (reason != 0) {
    end();
    throw ConfigurationError("simulation.command: cannot start '" + command.front() +
                             "': " + std::strerror(reason));
  }
  fcntl(channel_, F_SETFL, O_NONBLOCK);
  fcntl(errors_, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() { end(); }

/// The end of the input asks the program to end; what is left of its group then is killed.
void ChildProcess::end() {
  if (channel_ >= 0) shutdown(channel_, SHUT_WR);
  if (process_ > 0) {
    int status = 0;
    rusage used{};
    const bool ended = hasEnded(process_, closed_ ? 0 : kGrace, &status, &used);
    kill(-process_, SIGKILL);
    if (!ended) waitpid(process_, &status, 0);
    process_ = -1;
  }
  closeIfOpen(&channel_);
  closeIfOpen(&errors_);
}

void ChildProcess::readErrors() {
  std::array<char, 4096> buffer;
  ssize_t count = 0;
  while ((count = read(errors_, buffer.data(), buffer.size())) > 0) {
    error_text_.append(buffer.data(), static_cast<std::size_t>(count));
    if (error_text_.size() > kErrorsKept) error_text_.erase(0, error_text_.size() - kErrorsKept);
  }
}

/// How the program ended; it is waited for a little.
std::string ChildProcess::endText() {
  constexpr double kNear = 0.5;  // of the limit: what a failed allocation may leave
  int status = 0;
  rusage used{};
  if (!hasEnded(process_, kGrace, &status, &used)) return "it closed its output but runs on";
  kill(-process_, SIGKILL);  // its children, while the group still has its number
  process_ = -1;
  std::ostringstream text;
  if (WIFSIGNALED(status))
    text << "it was ended by signal " << WTERMSIG(status) << " (" << strsignal(WTERMSIG(status))
         << ")";
  else
    text << "it ended with exit status " << WEXITSTATUS(status);
  const double megabytes = static_cast<double>(used.ru_maxrss) * 1024 / kBytes;
  if (megabytes > kNear * memory_limit_)
    text << "; it had taken " << std::round(megabytes) << " MB (simulation.memory_limit is "
         << memory_limit_ << " MB)";
  return text.str();
}

void ChildProcess::fail(const std::string& what) {
  readErrors();
  std::string text = what;
  while (!error_text_.empty() && error_text_.back() == '\n') error_text_.pop_back();
  if (!error_text_.empty()) text += "; its standard error ends with:\n" + error_text_;
  throw DataError(text);
}

/// Sends and receives what can be without waiting longer than this. Returns false once the program
/// has closed its output.
bool ChildProcess::exchange(int milliseconds, const std::string& line, std::size_t* sent) {
  const bool is_sending = *sent < line.size();
  std::array<pollfd, 2> wait{
      {{channel_, static_cast<short>(POLLIN | (is_sending ? POLLOUT : 0)), 0},
       {errors_, POLLIN, 0}}};
  if (poll(wait.data(), wait.size(), milliseconds) <= 0) return true;
  if (wait[1].revents & POLLIN) readErrors();
  if (wait[0].revents & POLLOUT) {
    const ssize_t count = send(channel_, line.data() + *sent, line.size() - *sent, MSG_NOSIGNAL);
    if (count > 0) *sent += static_cast<std::size_t>(count);
  }
  if (!(wait[0].revents & (POLLIN | POLLHUP | POLLERR))) return true;
  std::array<char, 65536> buffer;
  const ssize_t count = recv(channel_, buffer.data(), buffer.size(), 0);
  if (count > 0) received_.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

std::string ChildProcess::ask(const std::string& line, double seconds, std::size_t most_bytes) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  std::size_t sent = 0;
  for (;;) {
    const std::size_t length = received_.find('\n');
    if (length != std::string::npos && sent == line.size()) {
      const std::string answer = received_.substr(0, length);
      received_.erase(0, length + 1);
      return answer;
    }
    if (received_.size() > most_bytes)
      fail("it wrote more than " + std::to_string(most_bytes) + " bytes without an end of line");
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) {
      std::ostringstream text;
      text << "it gave no answer within " << seconds
           << " s (simulation.time_limit); does it flush its output after each line?";
      fail(text.str());
    }
    if (closed_ ||
        !exchange(static_cast<int>(std::min<long>(left.count(), 1000)) + 1, line, &sent)) {
      closed_ = true;
      fail("it ended before it answered: " + endText());
    }
  }
}

}  // namespace uncertainty_identification
