#pragma once
// Reads the published test vectors: comment lines, a header row of names, then rows of numbers.
#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace canhil {

class Csv {
 public:
  explicit Csv(const std::string& path) {
    std::ifstream file(path);
    std::string line, cell;
    do std::getline(file, line);
    while (file && line.starts_with('#'));
    if (!file) throw std::runtime_error(path + ": expected a header row");
    std::istringstream names(line);
    for (std::size_t i = 0; std::getline(names, cell, ','); ++i) column_[cell] = i;
    while (std::getline(file, line)) {
      std::vector<double> row;
      std::istringstream cells(line);
      while (std::getline(cells, cell, ',')) row.push_back(std::stod(cell));
      if (row.size() != column_.size()) throw std::runtime_error(path + ": a row of another length");
      rows_.push_back(row);
    }
  }
  std::size_t rows() const { return rows_.size(); }
  double at(std::size_t row, const std::string& name) const { return rows_.at(row).at(column_.at(name)); }
  /// Points to the value in the named column; the values of the columns to its right follow.
  const double* from(std::size_t row, const std::string& name) const {
    return &rows_.at(row).at(column_.at(name));
  }

 private:
  std::map<std::string, std::size_t> column_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace canhil
