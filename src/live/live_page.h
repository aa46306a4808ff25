#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "live/live_board.h"
#include "live/live_documents.h"
#include "live/live_server.h"

namespace uncertainty_identification {

/// The page on which a browser follows what a node does. Nobody who tells it something waits: a
/// thread of its own asks the node how it is, a few times a second at most, and the server's
/// threads see copies of the answers only. All functions may be called from any thread.
class LivePage {
 public:
  /// Functions that return the node's present state; called from the page's thread.
  struct Source {
    std::function<LiveStatus()> status;
    std::function<std::vector<ExperimentDigest>()> experiments;
  };

  /// Serves from now on. Throws ConfigurationError, with the key live_page.port, when no page can
  /// be served.
  LivePage(int port, Source source);

  ~LivePage() { stop(); }

  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  int port() const { return server_->port(); }

  /// Begins to ask the source.
  void start();

  /// Closes all connections. Afterwards the source is not called any more. To be called once.
  void stop();

  /// The answers of the source are other ones, or the running identification has got on.
  void changed();
  void changed(const Progress& progress);

  /// Shows a result, unless forget() was called for it; the result of the same number is replaced.
  void show(const Result& result, const ResultContext& context);
  void show(const Explanation& explanation);

  /// Shows no explanation any more, and no result up to this number.
  void forget(std::uint32_t last_sequence);

 private:
  void run();

  const Source source_;
  LiveBoard board_;
  std::unique_ptr<LiveServer> server_;
  std::mutex mutex_;  // guards the members below
  std::condition_variable wake_;
  bool stopping_ = false, changed_ = true;
  std::optional<Progress> progress_;
  std::uint32_t forgotten_ = 0;  // number of the last result that is not shown
  std::thread thread_;           // joinable between start() and stop()
};

}  // namespace uncertainty_identification
