#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <vector>

namespace uncertainty_identification::study {

/// Limits for running the tasks of a study.
struct TaskLimits {
  int jobs = 2;
  int task_seconds = 120;  ///< of processor time; a task that takes longer is ended without result
  double minutes = 10;     ///< no task is begun after this time
};

/// [s] Processor time that this task has taken so far. Unlike wall time it does not depend on what
/// else the machine does.
double processorSeconds();

/// Runs tasks 0 to count - 1, each in a process of its own: one that crashes or hangs costs only
/// its own result. `work` writes `size` bytes of result; `done` receives them or, where a task did
/// not complete, null. Returns how many tasks were begun.
int runProcesses(int count, std::size_t size, const TaskLimits& limits,
                 const std::function<void(int, void*)>& work,
                 const std::function<void(int, const void*)>& done);

/// The results of the tasks that were begun; absent where a task did not complete.
template <class Result>
std::vector<std::optional<Result>> runTasks(
    int count, const TaskLimits& limits, const std::function<Result(int)>& work,
    const std::function<void(int, const std::optional<Result>&)>& show = {}) {
  static_assert(std::is_trivially_copyable_v<Result>, "results are copied between processes");
  std::vector<std::optional<Result>> results(static_cast<std::size_t>(count));
  const int begun = runProcesses(
      count, sizeof(Result), limits,
      [&](int task, void* bytes) { *static_cast<Result*>(bytes) = work(task); },
      [&](int task, const void* bytes) {
        std::optional<Result>& result = results[static_cast<std::size_t>(task)];
        if (bytes != nullptr) result = *static_cast<const Result*>(bytes);
        if (show) show(task, result);
      });
  results.resize(static_cast<std::size_t>(begun));
  return results;
}

}  // namespace uncertainty_identification::study
