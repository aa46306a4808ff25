#pragma once

#include <nlohmann/json_fwd.hpp>

#include "io/archive.h"
#include "io/tree.h"

namespace uncertainty_identification {

/// How TreeReader treats what a document leaves out or adds.
enum class ReadingRule {
  configuration,  ///< an absent key keeps its default, an unknown key is an error
  record  ///< an absent key is an error (truncated), an unknown one is ignored (newer), null is NaN
};

/// Fills structs from a tree through their bind() functions. Every error is a ConfigurationError
/// that names the key's path, its line where known, what was found and what is expected.
class TreeReader : public Archive {
 public:
  /// The tree must outlive the reader. `lines` as in Tree.
  TreeReader(const nlohmann::json& tree, ReadingRule rule, std::map<std::string, int> lines = {});

  bool reads() const override { return true; }
  bool has(std::string_view key) const override;
  bool hasList(std::string_view key) const override;
  bool isWord(std::string_view key, const char* word) override;

 private:
  /// A node on the way from the root to where the reader stands.
  struct Frame {
    const nlohmann::json& node;
    ReadingRule rule;
    std::string_view key;              ///< empty at the root and for an entry of a list
    std::optional<std::size_t> index;  ///< of an entry of a list
    std::vector<std::string> known;    ///< the keys that were asked for
  };

  bool enter(std::string_view key, bool optional) override;
  void enterEntry(std::size_t index) override;
  void leave() override { frames_.pop_back(); }
  void beginGroup(bool defaults) override;
  /// Throws for the first key that was not asked for, naming the nearest that was (configuration
  /// only).
  void endGroup() override;
  std::size_t beginList(std::size_t size) override;
  std::vector<std::string> beginMap() override;
  bool isAutomatic(bool automatic) override;
  bool isNull(bool null) override;
  bool isSingle(bool single) override;
  std::size_t visitWord(const std::vector<std::string>& words, std::size_t chosen) override;
  using Archive::visit;
  void visit(double& value) override;
  void visit(int& value) override;
  void visit(long& value) override;
  void visit(std::uint64_t& value) override;
  void visit(bool& value) override;
  void visit(std::string& value) override;
  void visit(Eigen::VectorXd& value) override;
  void visit(Eigen::MatrixXd& value) override;
  void visit(Word& value) override;
  void visit(OrAutomatic<int>& value) override;
  void visit(OrAutomatic<double>& value) override;

  const nlohmann::json& node() const { return frames_.back().node; }
  std::string path() const;
  [[noreturn]] void fail(const std::string& expected) const;
  double number(const std::string& expected) const;
  std::int64_t integer(const std::string& expected) const;

  std::map<std::string, int> lines_;
  std::vector<Frame> frames_;
};

/// A configuration, validated. Throws ConfigurationError.
template <class Value>
Value readConfiguration(const nlohmann::json& tree, const std::map<std::string, int>& lines = {}) {
  Value value;
  TreeReader reader(tree, ReadingRule::configuration, lines);
  reader(value);
  value.validate();
  return value;
}

/// The same from YAML.
template <class Value>
Value readYamlConfiguration(const YAML::Node& node) {
  const Tree tree = treeFromYaml(node);
  return readConfiguration<Value>(*tree.value, tree.lines);
}

/// A record, such as a part of result.json. Throws ConfigurationError.
template <class Value>
Value readRecord(const nlohmann::json& tree) {
  Value value;
  TreeReader reader(tree, ReadingRule::record);
  reader(value);
  return value;
}

}  // namespace uncertainty_identification
