#include "io/program_simulation.h"

#include "io/child_process.h"
#include "io/simulation_protocol.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kBytesPerSample = 64, kShortestLimit = 1 << 16;  // of an answer

class ProgramSimulation : public Simulation {
 public:
  explicit ProgramSimulation(const ProgramToRun& program)
      : program_(program), process_(program.command, program.memory_limit) {}

  std::string description() const override { return program_.description; }
  std::vector<SimulationParameter> parameters() const override { return program_.parameters; }
  bool canRerun() const override { return true; }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    const std::string request = requestText(input, program_.parameters, values);
    const std::size_t most =
        kShortestLimit + kBytesPerSample * static_cast<std::size_t>(input.u.size());
    try {
      return answerFrom(process_.ask(request, program_.time_limit, most));
    } catch (const DataError& error) {
      throw DataError(description() + ": " + error.what());
    }
  }

 private:
  const ProgramToRun program_;
  ChildProcess process_;
};

}  // namespace

std::unique_ptr<Simulation> startProgramSimulation(const ProgramToRun& program) {
  return std::make_unique<ProgramSimulation>(program);
}

}  // namespace uncertainty_identification
