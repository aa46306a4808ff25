#pragma once

#include <ros/ros.h>
#include <signal.h>

#include <memory>
#include <string>

#include "support/process.h"

namespace uncertainty_identification {

/// The node /identification as a program that a test starts, ends and starts again. Its parameters
/// stay on the server.
class NodeProcess {
 public:
  void start() {
    process_ = std::make_unique<Process>(std::vector<std::string>{
        std::string(TOOLS_FOLDER) + "/identification_node", "__name:=identification"});
  }

  pid_t id() const { return process_->id(); }

  /// As a power cut does.
  void kill() { end(SIGKILL); }

  /// As roslaunch does.
  ProcessResult interrupt() { return end(SIGINT); }

  ~NodeProcess() {
    if (process_) kill();
  }

 private:
  ProcessResult end(int signal) {
    ::kill(process_->id(), signal);
    const ProcessResult result = process_->wait();
    process_.reset();
    return result;
  }

  std::unique_ptr<Process> process_;
};

}  // namespace uncertainty_identification
