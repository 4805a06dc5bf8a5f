#include "study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace couloir::test {
namespace {

std::string text(double value, const char* format) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

const char* folder() {
  return std::getenv("COULOIR_VERIFICATION");
}

}  // namespace

Study::Study(std::string section, std::string name, std::string measure)
    : section_(std::move(section)), name_(std::move(name)), measure_(std::move(measure)) {}

Study::~Study() {
  const bool orders = demand_.rfind("order", 0) == 0;
  std::ostringstream list[3];
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const char* gap = k > 0 ? " " : "";
    list[0] << gap << points_[k].cells;
    list[1] << gap << text(points_[k].value, "%.3g");
    if (k > 0 && orders) list[2] << (k > 1 ? " " : "") << text(order(k), "%.2f");
  }
  const std::string cells = list[0].str(), values = list[1].str(), rates = list[2].str();
  std::printf("%s  %s: %s at %s: %s%s%s (%s)\n", section_.c_str(), name_.c_str(), measure_.c_str(), cells.c_str(), values.c_str(),
              orders ? ", orders " : "", rates.c_str(), demand_.c_str());
  if (!folder()) return;
  std::ofstream table(std::filesystem::path(folder()) / "table.csv", std::ios::app);
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  table << section_ << ';' << name_ << ';' << measure_ << ';' << cells << ';' << values << ';' << rates << ';' << demand_ << ';'
        << (test ? std::string(test->test_suite_name()) + "." + test->name() : "") << '\n';
}

void Study::add(int cells, double value) {
  points_.push_back({cells, value});
}

double Study::order(std::size_t k) const {
  const double factor = static_cast<double>(points_[k].cells) / points_[k - 1].cells;
  return std::log(points_[k - 1].value / points_[k].value) / std::log(factor);
}

void Study::expect_order(double least) {
  demand_ = "order at least " + text(least, "%g");
  EXPECT_GE(points_.size(), 3u) << name_;
  for (std::size_t k = 1; k < points_.size(); ++k) {
    EXPECT_GE(order(k), least) << name_ << ", " << measure_ << ": " << points_[k - 1].value << " at " << points_[k - 1].cells
                               << " cells, " << points_[k].value << " at " << points_[k].cells;
  }
}

void Study::expect_below(double bound) {
  demand_ = "below " + text(bound, "%g");
  for (const Point& p : points_) EXPECT_LT(p.value, bound) << name_ << ", " << measure_ << " at " << p.cells << " cells";
}

void Study::expect_zero() {
  demand_ = "exactly 0";
  for (const Point& p : points_) EXPECT_EQ(p.value, 0) << name_ << ", " << measure_ << " at " << p.cells << " cells";
}

void record_profile(const std::string& file, const std::string& header, const std::vector<std::vector<double>>& rows) {
  if (!folder()) return;
  std::ofstream out(std::filesystem::path(folder()) / (file + ".csv"));
  out << header << '\n';
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) out << (k ? "," : "") << text(row[k], "%.7g");
    out << '\n';
  }
}

}  // namespace couloir::test
