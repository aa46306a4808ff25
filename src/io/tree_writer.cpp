#include "io/tree_writer.h"

#include <cmath>
#include <stdexcept>

namespace uncertainty_identification {
namespace {

using nlohmann::json;

json finiteOrNull(double value) { return std::isfinite(value) ? json(value) : json(); }

template <class Vector>
json listOf(const Vector& values) {
  json list = json::array();
  for (Eigen::Index i = 0; i < values.size(); ++i) list.push_back(finiteOrNull(values[i]));
  return list;
}

}  // namespace

bool TreeWriter::enter(std::string_view key, bool) {
  nodes_.push_back(&(*nodes_.back())[std::string(key)]);
  return true;
}

void TreeWriter::enterEntry(std::size_t index) { nodes_.push_back(&(*nodes_.back())[index]); }

void TreeWriter::beginGroup(bool) { *nodes_.back() = json::object(); }

std::size_t TreeWriter::beginList(std::size_t size) {
  *nodes_.back() = json(size, nullptr);  // at its full length, so that entries do not move
  return size;
}

std::vector<std::string> TreeWriter::beginMap() {
  beginGroup(false);
  return {};
}

bool TreeWriter::isAutomatic(bool automatic) {
  if (automatic) *nodes_.back() = "auto";
  return automatic;
}

bool TreeWriter::isNull(bool null) {
  if (null) *nodes_.back() = nullptr;
  return null;
}

std::size_t TreeWriter::visitWord(const std::vector<std::string>& words, std::size_t chosen) {
  if (chosen >= words.size()) throw std::invalid_argument("a value without a word for it");
  *nodes_.back() = words[chosen];
  return chosen;
}

void TreeWriter::visit(double& value) { *nodes_.back() = finiteOrNull(value); }
void TreeWriter::visit(int& value) { *nodes_.back() = value; }
void TreeWriter::visit(long& value) { *nodes_.back() = value; }
void TreeWriter::visit(std::uint64_t& value) { *nodes_.back() = value; }
void TreeWriter::visit(bool& value) { *nodes_.back() = value; }
void TreeWriter::visit(std::string& value) { *nodes_.back() = value; }
void TreeWriter::visit(Eigen::VectorXd& value) { *nodes_.back() = listOf(value); }

void TreeWriter::visit(Eigen::MatrixXd& value) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < value.rows(); ++i) rows.push_back(listOf(value.row(i)));
  *nodes_.back() = rows;
}

void TreeWriter::visit(Word& value) { *nodes_.back() = value.word; }

void TreeWriter::visit(OrAutomatic<int>& value) {
  if (!isAutomatic(value.value == value.automatic)) visit(value.value);
}

void TreeWriter::visit(OrAutomatic<double>& value) {
  if (!isAutomatic(value.value == value.automatic)) visit(value.value);
}

}  // namespace uncertainty_identification
