#include "live/live_server.h"

#include "uncertainty_identification/errors.h"

/// For a machine without cpp-httplib (cmake/live_page.cmake).
namespace uncertainty_identification {

std::string liveServerObstacle() {
  return "this package was built without cpp-httplib 0.11, which serves the page; install "
         "libcpp-httplib-dev (Debian 12) and build again, or set the port to 0";
}

std::unique_ptr<LiveServer> startLiveServer(int port, const std::string& /*page*/,
                                            LiveBoard& /*board*/,
                                            const LiveServerLimits& /*limits*/) {
  throw ConfigurationError("live_page.port: found " + std::to_string(port) + ", but " +
                           liveServerObstacle());
}

}  // namespace uncertainty_identification
