#include "study/tasks.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <map>
#include <stdexcept>

namespace uncertainty_identification::study {
namespace {

struct Process {
  int task;
  int pipe;  ///< end from which the result is read
};

/// The child's part. The system ends a process that takes too long.
[[noreturn]] void work(int task, std::size_t size, int seconds, int pipe,
                       const std::function<void(int, void*)>& function) {
  const rlimit limit{static_cast<rlim_t>(seconds), static_cast<rlim_t>(seconds) + 1};
  setrlimit(RLIMIT_CPU, &limit);
  std::vector<std::max_align_t> result(size / sizeof(std::max_align_t) + 1);
  int status = 1;
  try {
    function(task, result.data());
    status = write(pipe, result.data(), size) == static_cast<ssize_t>(size) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "task %d: %s\n", task, error.what());
  }
  _exit(status);
}

void begin(int task, std::size_t size, int seconds, const std::function<void(int, void*)>& function,
           std::map<pid_t, Process>* running) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a task's result");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process for a task");
  if (child == 0) work(task, size, seconds, ends[1], function);
  close(ends[1]);
  (*running)[child] = {task, ends[0]};
}

/// Waits until a process has ended. A result is smaller than a pipe's buffer, so that it can be
/// read afterwards.
void finish(std::size_t size, const std::function<void(int, const void*)>& done,
            std::map<pid_t, Process>* running) {
  int status = 0;
  const pid_t child = wait(&status);
  const auto found = running->find(child);
  if (found == running->end()) throw std::runtime_error("a task's process was lost");
  const Process process = found->second;
  running->erase(found);
  std::vector<std::max_align_t> result(size / sizeof(std::max_align_t) + 1);
  const bool complete = read(process.pipe, result.data(), size) == static_cast<ssize_t>(size);
  close(process.pipe);
  if (WIFSIGNALED(status))
    std::fprintf(stderr, "task %d was ended by signal %d\n", process.task, WTERMSIG(status));
  done(process.task, complete ? result.data() : nullptr);
}

}  // namespace

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int runProcesses(int count, std::size_t size, const TaskLimits& limits,
                 const std::function<void(int, void*)>& work,
                 const std::function<void(int, const void*)>& done) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(60 * limits.minutes);
  std::map<pid_t, Process> running;
  int begun = 0;
  while (begun < count && Clock::now() < deadline) {
    if (static_cast<int>(running.size()) >= limits.jobs) {
      finish(size, done, &running);
      continue;
    }
    begin(begun++, size, limits.task_seconds, work, &running);
  }
  while (!running.empty()) finish(size, done, &running);
  return begun;
}

}  // namespace uncertainty_identification::study
