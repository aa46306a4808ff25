#pragma once

#include <nlohmann/json.hpp>

#include "io/archive.h"

namespace uncertainty_identification {

/// Writes structs to a tree through their bind() functions. Numbers that are not finite become
/// null.
class TreeWriter : public Archive {
 public:
  /// The tree must outlive the writer.
  explicit TreeWriter(nlohmann::json& tree) : nodes_{&tree} {}

  bool reads() const override { return false; }
  bool has(std::string_view /*key*/) const override { return false; }
  bool hasList(std::string_view /*key*/) const override { return false; }
  bool isWord(std::string_view /*key*/, const char* /*word*/) override { return false; }

 private:
  bool enter(std::string_view key, bool optional) override;
  void enterEntry(std::size_t index) override;
  void leave() override { nodes_.pop_back(); }
  void beginGroup(bool defaults) override;
  void endGroup() override {}
  std::size_t beginList(std::size_t size) override;
  std::vector<std::string> beginMap() override;
  bool isAutomatic(bool automatic) override;
  bool isNull(bool null) override;
  bool isSingle(bool single) override { return single; }
  std::size_t visitWord(const std::vector<std::string>& words, std::size_t chosen) override;
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

  std::vector<nlohmann::json*> nodes_;  ///< from the root to the node where the writer stands
};

/// The tree of a struct that has a bind() function; taken by value, because bind() serves the
/// reader too and so takes what it could change.
template <class Value>
nlohmann::json writtenTree(Value value) {
  nlohmann::json tree;
  TreeWriter writer(tree);
  writer(value);
  return tree;
}

}  // namespace uncertainty_identification
