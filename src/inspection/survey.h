#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/data/recording.h"

/// What is in recorded data, before anything is identified from it.
namespace uncertainty_identification {

/// The stamps of the rows of a file, or of the messages of a topic.
struct StampSummary {
  long count = 0;                   ///< rows or messages
  double start = 0, end = 0;        ///< [s] first and last stamp
  double period = 0;                ///< [s] median spacing, refined; 0: fewer than two stamps
  double jitter = 0;                ///< [s] largest departure from a uniform grid
  bool uniform = false;             ///< the stamps lie around a uniform grid
  long pauses = 0;                  ///< silences of more than 20 periods
  double longest_pause = 0;         ///< [s]
  long repeated = 0, backward = 0;  ///< stamps equal to, or before, the one that they follow
};

/// Summary of stamps [s] in the order in which they were stored.
StampSummary summaryOf(const std::vector<double>& stamps);

/// A stream of rows or messages: one experiment of a file, or one topic of a bag.
struct SurveyedStream {
  std::string file;  ///< its path
  std::string name;  ///< of the experiment in the file, or of the topic
  std::string type;  ///< of the topic's messages; empty for a file of columns
  StampSummary stamps;
  std::vector<std::string> fields;  ///< numeric columns or fields
  std::string remark;               ///< what stands against its use; empty: nothing
};

/// One numeric column, or one numeric field of a topic, with the values that are stored.
struct Channel {
  std::string name;    ///< as messages name it: "motor_voltage" or "/odom twist.twist.linear.x"
  std::string column;  ///< of a file; empty for a field
  std::string topic, field;                 ///< of a bag; empty for a column
  std::string unit;                         ///< as the file states it; empty: not
  std::vector<StampedSignal> records = {};  ///< one of each record of the survey; may be empty
  long not_finite = 0;  ///< values left out of the records: NaN and infinite ones
  long empty = 0;       ///< rows without a value
  /// Of an element that is called by its name: the field with its number instead.
  std::string numbered_field = {};
};

/// Files of columns: how their time was read.
struct SurveyedTime {
  std::string column;       ///< empty: the rows were counted
  std::string unit;         ///< s, ms, us, ns, min, h, d, index or dates
  bool assumed = false;     ///< nothing in the files says that it is this unit
  std::string experiments;  ///< the column that names the experiments; empty: none does
};

/// What several files hold.
struct Survey {
  std::vector<SurveyedStream> streams;
  std::vector<Channel> channels;     ///< those of the same name in several files are one
  std::vector<SurveyedTime> times;   ///< of the files of columns, the different ones
  std::vector<std::string> remarks;  ///< on reading, each once
  std::size_t records = 0;  ///< recordings with stamps of their own: experiments of files, bags
};

/// Appends what another file holds.
void append(Survey more, Survey& all);

}  // namespace uncertainty_identification
