#include "ros/bag_survey.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "inspection/signal_names.h"
#include "io/printable.h"
#include "ros/bag_file.h"
#include "ros/message_decoder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::uint32_t kMostElements = 32;  // of an array that is looked at
constexpr std::size_t kMostFields = 200;     // of a topic

bool isOfTheSystem(const std::string& topic) {
  static const std::set<std::string> topics{"/rosout",    "/rosout_agg",  "/clock",          "/tf",
                                            "/tf_static", "/diagnostics", "/diagnostics_agg"};
  return topics.count(topic) > 0;
}

/// One field of a topic.
struct FieldReader {
  std::unique_ptr<const MessageDecoder> decoder;
  Channel channel;
};

/// Reads all numeric fields of the messages of one topic. The fields are those of its first
/// message; messages that lack one are counted.
class TopicSurveyor {
 public:
  explicit TopicSurveyor(const BagConnection& connection) {
    stream_.name = connection.topic;
    stream_.type = connection.type;
  }

  void add(const BagMessage& message) {
    try {
      if (md5sum_.empty()) begin(message);
      if (message.connection.md5sum != md5sum_)
        throw DataError("the topic changes its type to " + message.connection.type);
      const bool has_header = clock_ != nullptr && clock_->hasStamp();
      const double stamp = has_header ? clock_->stamp(message.bytes) : message.time;
      stamps_.push_back(stamp);
      for (FieldReader& field : fields_) addValue(field, stamp, message.bytes);
    } catch (const Error& error) {
      if (stream_.remark.empty()) stream_.remark = error.what();
    }
  }

  /// Appends stream and channels to the survey of a bag.
  void finish(const std::string& path, Survey& survey) {
    stream_.file = path;
    stream_.stamps = summaryOf(stamps_);
    for (FieldReader& field : fields_) {
      stream_.fields.push_back(field.channel.field);
      survey.channels.push_back(std::move(field.channel));
    }
    if (clock_ == nullptr || !clock_->hasStamp())
      stream_.remark += stream_.remark.empty() ? "no header: stamped on recording" : "";
    survey.streams.push_back(std::move(stream_));
  }

 private:
  void begin(const BagMessage& message) {
    const BagConnection& from = message.connection;
    md5sum_ = from.md5sum;
    if (isOfTheSystem(from.topic)) return;
    definition_ = std::make_shared<MessageDefinition>(from.type, from.definition);
    for (const std::string& field : definition_->numericFields(false)) addField(field, message);
  }

  std::unique_ptr<const MessageDecoder> decoderOf(const std::string& field) const {
    return std::make_unique<MessageDecoder>(definition_, field, stream_.name);
  }

  static bool holds(const MessageDecoder& decoder, const BagMessage& message) {
    try {
      decoder.value(message.bytes);
      return true;
    } catch (const DataError&) {
      return false;
    }
  }

  /// A field, or the elements of an array, whose path is listed with the index 0 at last.
  void addField(const std::string& field, const BagMessage& message) {
    const auto bracket = field.rfind("[0]");
    if (bracket == std::string::npos) return addPath(field, message);
    const auto element = [&](std::uint32_t index) {
      return field.substr(0, bracket) + "[" + std::to_string(index) + "]" +
             field.substr(bracket + 3);
    };
    std::uint32_t count = 0;
    while (count <= kMostElements && existsIn(element(count), message)) ++count;
    if (count > kMostElements) return;
    const std::vector<std::string> names = namesIn(element(0), count, message);
    for (std::uint32_t index = 0; index < count; ++index) {
      if (names.empty()) {
        addPath(element(index), message);
        continue;
      }
      const bool is_number = names[index].find_first_not_of("0123456789") == std::string::npos;
      const std::string name = is_number ? "'" + names[index] + "'" : names[index];
      const std::string named =
          field.substr(0, bracket) + "[" + name + "]" + field.substr(bracket + 3);
      if (existsIn(named, message))
        addPath(named, message, element(index));
      else  // the names are those of an array further out
        addPath(element(index), message);
    }
  }

  /// The names of the elements; empty where the message has none that tell each of them apart.
  std::vector<std::string> namesIn(const std::string& field, std::uint32_t count,
                                   const BagMessage& message) const {
    if (count == 0) return {};
    const std::vector<std::string> names = decoderOf(field)->elementNames(message.bytes);
    const std::set<std::string> different(names.begin(), names.end());
    const bool usable = std::all_of(names.begin(), names.end(), [](const std::string& name) {
      return !name.empty() && isPrintable(name) && name.find_first_of("[]'\"") == std::string::npos;
    });
    if (names.size() != count || different.size() != count || !usable) return {};
    return names;
  }

  bool existsIn(const std::string& field, const BagMessage& message) const {
    try {
      return holds(*decoderOf(field), message);
    } catch (const ConfigurationError&) {
      return false;  // beyond the end of an array of fixed length
    }
  }

  void addPath(const std::string& field, const BagMessage& message,
               const std::string& numbered = "") {
    if (fields_.size() >= kMostFields) return;
    FieldReader reader{decoderOf(field), {}};
    if (!holds(*reader.decoder, message)) return;
    reader.channel.name = stream_.name + " " + field;
    reader.channel.topic = stream_.name;
    reader.channel.field = field;
    reader.channel.numbered_field = numbered;
    reader.channel.unit = unitOfName(field);
    reader.channel.records.resize(1);
    fields_.push_back(std::move(reader));
    if (clock_ == nullptr) clock_ = fields_.front().decoder.get();
  }

  static void addValue(FieldReader& field, double stamp, SerialisedMessage bytes) {
    double value = 0;
    try {
      value = field.decoder->value(bytes);
    } catch (const DataError&) {
      ++field.channel.empty;
      return;
    }
    StampedSignal& record = field.channel.records.front();
    if (!std::isfinite(value)) ++field.channel.not_finite;
    if (!std::isfinite(value) || (!record.stamps.empty() && stamp <= record.stamps.back())) return;
    record.stamps.push_back(stamp);
    record.values.push_back(value);
  }

  SurveyedStream stream_;
  std::string md5sum_;  ///< of the first message
  std::shared_ptr<const MessageDefinition> definition_;
  std::vector<FieldReader> fields_;
  const MessageDecoder* clock_ = nullptr;  ///< tells the stamps; null: there is no field
  std::vector<double> stamps_;
};

}  // namespace

Survey surveyBag(const std::string& path) {
  BagFile bag(path);
  std::map<std::string, TopicSurveyor> topics;
  for (const auto& [id, connection] : bag.connections())
    topics.emplace(connection.topic, TopicSurveyor(connection));
  bag.read([](const BagConnection&) { return true; },
           [&](const BagMessage& message) { topics.at(message.connection.topic).add(message); });
  Survey survey;
  survey.records = 1;
  for (auto& [name, topic] : topics) topic.finish(path, survey);
  return survey;
}

}  // namespace uncertainty_identification
