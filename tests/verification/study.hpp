#pragma once
// One measure of one case over several resolutions: prints its line, adds it to a table, asserts orders and bounds.
//
//   COULOIR_VERIFICATION=<folder>   the folder to add the lines of table.csv and the profiles of the pictures to

#include <string>
#include <vector>

namespace couloir::test {

class Study {
 public:
  // section: a to i of the exact cases; measure: what is listed, with its unit.
  Study(std::string section, std::string name, std::string measure);
  ~Study();  // prints and records
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  void add(int cells, double value);
  double last() const { return points_.back().value; }

  // Each refinement falls at this order or better.
  void expect_order(double least);
  // Every value is below this bound.
  void expect_below(double bound);
  // Every value is 0 to the last bit.
  void expect_zero();

 private:
  struct Point {
    int cells;
    double value;
  };
  double order(std::size_t k) const;  // from point k - 1 to k

  std::string section_, name_, measure_, demand_;
  std::vector<Point> points_;
};

// Adds rows of numbers to <folder>/<file>.csv of the pictures; does nothing without COULOIR_VERIFICATION.
void record_profile(const std::string& file, const std::string& header, const std::vector<std::vector<double>>& rows);

}  // namespace couloir::test
