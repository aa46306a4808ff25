#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>

namespace uncertainty_identification {

struct StampedSignal;

/// When a sample arrived, and how many were lost before it.
struct Arrival {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s] NaN: not known
  long lost = 0;  ///< messages missing between the previous one and this one
};

/// Age, delay, jitter and losses of the samples of a signal in one experiment, from stamps,
/// arrivals and sequence numbers. NaN if not known.
struct SignalTiming {
  double age = std::numeric_limits<double>::quiet_NaN();  ///< [s] of the newest sample on arrival
  /// [s] smallest difference of arrival and stamp: the time of the quickest transport, plus the
  /// difference of the receiving and the stamping clock
  double delay = std::numeric_limits<double>::quiet_NaN();
  /// [s] largest departure of a stamp from a uniform grid; NaN where they follow none
  double jitter = std::numeric_limits<double>::quiet_NaN();
  long lost = 0;  ///< messages that are missing in the sequence
};

/// Age, delay and losses; the jitter is fitSampleGrid's.
SignalTiming timingOf(const StampedSignal& signal);

/// The timing of an experiment.
struct ExperimentTiming {
  SignalTiming input, output;

  /// [s] by how much the clock of the output's stamps is ahead of that of the input's, if the
  /// quickest transport takes equally long for both: the difference of their delays. A difference
  /// of the transports cannot be distinguished from one of the clocks; in the samples, both look
  /// like dead time of the plant.
  double clockOffset() const { return input.delay - output.delay; }
};

/// Counts messages that are missing, by the sequence numbers of each publisher. A number that does
/// not rise is ignored: the publisher was restarted, or does not number its messages.
class SequenceCounter {
 public:
  /// How many messages of the publisher are missing before this one.
  long missingBefore(const std::string& publisher, std::uint32_t sequence);

 private:
  std::map<std::string, std::uint32_t> last_;  // by publisher
};

}  // namespace uncertainty_identification
