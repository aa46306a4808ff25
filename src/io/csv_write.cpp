#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>

#include "data/text.h"
#include "io/atomic_file.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {
namespace {

/// With 17 significant digits, no two doubles have the same text.
std::string exact(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

/// A cell of text, in quotes if it would otherwise not be read back as the same text.
std::string quoted(const std::string& text) {
  if (text.find_first_of("\r\n") != std::string::npos) {
    throw DataError("the name '" + text +
                    "' has a line break, which a CSV file cannot hold; choose another name");
  }
  const bool plain = !text.empty() && text.find_first_of(",;\"#% \t") == std::string::npos &&
                     text.compare(0, 2, "//") != 0;
  if (plain) return text;
  std::string cell = "\"";
  for (const char character : text) cell += character == '"' ? "\"\"" : std::string(1, character);
  return cell + '"';
}

std::set<std::string> covariateNames(const std::vector<Experiment>& experiments) {
  std::set<std::string> names;
  for (const Experiment& experiment : experiments) {
    for (const auto& [name, value] : experiment.scalars) names.insert(name);
    for (const auto& [name, values] : experiment.signals) names.insert(name);
  }
  return names;
}

std::string header(const std::set<std::string>& names) {
  std::string line = "experiment,t,u,y";
  for (const std::string& name : names) line += ',' + quoted(name);
  return line + '\n';
}

std::string covariateCell(const Experiment& experiment, const std::string& name, int k) {
  const auto scalar = experiment.scalars.find(name);
  if (scalar != experiment.scalars.end()) return exact(scalar->second);
  const auto signal = experiment.signals.find(name);
  return signal == experiment.signals.end() ? "" : exact(signal->second(k));
}

std::string row(const Experiment& experiment, const std::string& id,
                const std::set<std::string>& names, int k) {
  double stamp = experiment.start_time + k * experiment.sample_time;
  if (experiment.stamp_offset.size() > 0) stamp += experiment.stamp_offset(k);
  std::string line = id + ',' + exact(stamp) + ',' + exact(experiment.u(k)) + ',';
  if (experiment.isValid(k)) line += exact(experiment.y(k));
  for (const std::string& name : names) line += ',' + covariateCell(experiment, name, k);
  return line + '\n';
}

class Writer {
 public:
  Writer(const std::string& path, const std::string& temporary)
      : path_(path), file_(std::fopen(temporary.c_str(), "wb"), &std::fclose) {
    if (!file_) fail();
  }
  void write(const std::string& content) {
    if (std::fwrite(content.data(), 1, content.size(), file_.get()) != content.size()) fail();
  }
  void close() {
    if (std::fclose(file_.release()) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw FileError("cannot write '" + path_ + "': " + std::strerror(errno));
  }

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace

void writeCsv(const std::string& path, const std::vector<Experiment>& experiments) {
  writeAtomically(path, [&](const std::string& temporary) {
    const std::set<std::string> names = covariateNames(experiments);
    Writer writer(path, temporary);
    writer.write(header(names));
    for (const Experiment& experiment : experiments) {
      const std::string id = quoted(experiment.id);
      for (int k = 0; k < experiment.samples(); ++k) writer.write(row(experiment, id, names, k));
    }
    writer.close();
  });
}

}  // namespace uncertainty_identification
