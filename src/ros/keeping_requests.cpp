#include "ros/keeping_requests.h"

#include "ros/answer.h"
#include "ros/experiment_bag.h"

namespace uncertainty_identification {
namespace {

using Configure = messages::Configure::Response;
using Load = messages::Load::Response;
using Save = messages::Save::Response;

}  // namespace

Save answerSave(const messages::Save::Request& request, const SavedExperiments& saved,
                const std::optional<messages::IdentificationResult>& result) {
  try {
    const auto written = saved.save(request.name, [&](const auto& path, const auto& experiments) {
      writeExperimentBag(path, experiments, result ? &*result : nullptr);
    });
    if (written.experiments == 0)
      return answerOf<Save>(Save::NONE_YET, "there are no experiments to save yet");
    auto response =
        answerOf<Save>(Save::OK, std::to_string(written.experiments) + " experiments were saved");
    response.path = written.path;
    response.experiments = static_cast<std::uint32_t>(written.experiments);
    return response;
  } catch (const RefusedError& error) {
    return answerOf<Save>(Save::REFUSED, error.what());
  } catch (const std::exception& error) {
    return answerOf<Save>(Save::FILE_ERROR, error.what());
  }
}

Load answerLoad(const messages::Load::Request& request, SavedExperiments& saved) {
  try {
    const auto loaded = saved.load(request.name);
    auto response =
        answerOf<Load>(Load::OK, std::to_string(loaded.added) + " experiments were added, " +
                                     std::to_string(loaded.known) + " were there already");
    response.added = static_cast<std::uint32_t>(loaded.added);
    response.known = static_cast<std::uint32_t>(loaded.known);
    return response;
  } catch (const RefusedError& error) {
    return answerOf<Load>(Load::REFUSED, error.what());
  } catch (const DataError& error) {
    return answerOf<Load>(Load::DATA_ERROR, error.what());
  } catch (const std::exception& error) {
    return answerOf<Load>(Load::FILE_ERROR, error.what());
  }
}

Configure answerConfigure(const messages::Configure::Request& request,
                          Reconfiguration& reconfiguration,
                          const std::function<bool()>& keep_going) {
  try {
    const auto outcome = reconfiguration.configure(request.configuration, keep_going);
    return answerOf<Configure>(outcome.adopted ? Configure::OK : Configure::NOT_USABLE,
                               outcome.message);
  } catch (const RefusedError& error) {
    return answerOf<Configure>(Configure::REFUSED, error.what());
  } catch (const ConfigurationError& error) {
    return answerOf<Configure>(Configure::CONFIGURATION_ERROR, error.what());
  } catch (const DataError& error) {
    return answerOf<Configure>(Configure::DATA_ERROR, error.what());
  } catch (const std::exception& error) {
    return answerOf<Configure>(Configure::INTERNAL_ERROR,
                               std::string("internal error: ") + error.what());
  }
}

}  // namespace uncertainty_identification
